/* The C interface, inst/include/rotdyn.h: checks arguments, translates structs, chooses a model. */
#ifndef ROT_API_H
#define ROT_API_H

#include "api/interface.h"

#endif
