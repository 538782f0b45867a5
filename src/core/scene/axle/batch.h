/* The batch kernel of wheels with viscous resistance, for sweeps. */
#ifndef ROT_AXLE_BATCH_H
#define ROT_AXLE_BATCH_H

#include "engine/batch.h"

extern const rot_batch rot_axle_batches[];

#endif
