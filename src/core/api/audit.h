/* Audits of scenes for the C interface. */
#ifndef ROT_API_AUDIT_H
#define ROT_API_AUDIT_H

#include "api/interface.h"

#endif
