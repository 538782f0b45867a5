/* The batch kernel of tumbling bodies, for sweeps. */
#ifndef ROT_FREE_BATCH_H
#define ROT_FREE_BATCH_H

#include "engine/batch.h"

extern const rot_batch rot_free_batches[];

#endif
