/* The header of the C interface, for the core. */
#ifndef ROT_API_INTERFACE_H
#define ROT_API_INTERFACE_H

#include "../../inst/include/rotdyn.h"

#include "ground/ieee.h"

#endif
