#include "scene/axle/closed.h"

#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/forced.h"
#include "scene/axle/linear.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"

const rot_axle_model rot_axle_forms[ROT_AXLE_MODELS] = {rot_axle_free_scene,
                                                        rot_axle_linear_scene,
                                                        rot_axle_skater,
                                                        rot_axle_drag,
                                                        rot_axle_forced,
                                                        rot_axle_oscillator,
                                                        rot_axle_pendulum,
                                                        rot_axle_bands,
                                                        NULL,
                                                        NULL,
                                                        NULL,
                                                        NULL,
                                                        NULL};
