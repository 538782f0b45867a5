/* The batch kernel of bodies on an incline, for sweeps. */
#ifndef ROT_INCLINE_BATCH_H
#define ROT_INCLINE_BATCH_H

#include "engine/batch.h"

extern const rot_batch rot_incline_batches[];

#endif
