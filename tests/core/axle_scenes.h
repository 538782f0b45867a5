/* Scenes on an axle that several tests run, each with numbers of its own for the answer. */
#ifndef AXLE_SCENES_H
#define AXLE_SCENES_H

#include "scene/axle/axle.h"

enum axle_scene_name {
  CONSTANT_FREE,
  RAMP_FREE,
  COASTING,
  CONSTANT_DAMPED,
  PULSE,
  POSITIVE,
  FAR,
  DRIVEN,
  DRIVEN_BACKWARD,
  CLOSE_KNOTS,
  TINY,
  HUGE_INERTIA,
  LONG_TIMES,
  SETTLED,
  HARDLY_DAMPED,
  COASTING_LONG,
  UNDRIVEN_START,
  DRIVEN_LONG,
  RAMP_DRIVEN_LONG,
  BACKWARD_FREE,
  BREATH,
  AXLE_SCENES
};

static const double ramp_free_knots_s[] = {0.0, 3.0};
static const double ramp_free_knots_n_m[] = {0.0, 12.0};
static const double pulse_knots_s[] = {0.0, 2.0, 2.0, 3.0, 3.0, 6.0, 6.0, 6.25, 6.25, 9.0};
static const double pulse_knots_n_m[] = {1.0, 5.0, -3.0, 2.0, 0.0, 0.0, 20.0, 20.0, 0.0, 4.0};
static const double positive_knots_s[] = {0.0, 10.0, 20.0, 50.0};
static const double positive_knots_n_m[] = {1.0, 7.0, 2.0, 9.0};
static const double far_knots_s[] = {0.0, 100.0, 300.0};
static const double far_knots_n_m[] = {3.0, 4.0, 50.0};
static const double driven_knots_s[] = {-2.0, 1.0, 3.0};
static const double driven_knots_n_m[] = {1.0, -2.0, 4.0};
static const double driven_backward_knots_s[] = {-6.0, 6.0, 6.0, 9.5, 9.5};
static const double driven_backward_knots_n_m[] = {5.0, 5.0, -900.0, -900.0, 1.0};
static const double close_knots_s[] = {1000.0, 1000.5, 1000.5000000000002, 1001.0};
static const double close_knots_n_m[] = {2.0, 3.0, -3.0, -1.0};
static const double tiny_knots_s[] = {0.0, 2.0};
static const double tiny_knots_n_m[] = {1e-300, 3e-300};
static const double huge_inertia_knots_s[] = {0.0, 2.0};
static const double huge_inertia_knots_n_m[] = {1e300, 3e300};
static const double settled_knots_s[] = {0.0, 2.0};
static const double settled_knots_n_m[] = {3.0, 7.0};
static const double hardly_damped_knots_s[] = {0.0, 7.0, 7.0};
static const double hardly_damped_knots_n_m[] = {5.0, 5.0, 1.0};
static const double undriven_start_knots_s[] = {0.1, 0.7, 4.3};
static const double undriven_start_knots_n_m[] = {0.0, 0.3, 0.3};
static const double ramp_driven_long_knots_s[] = {0.1, 1500.7};
static const double ramp_driven_long_knots_n_m[] = {2.0, 900.0};
static const double backward_free_knots_s[] = {1.0, 2.0, 2.0, 5.0};
static const double backward_free_knots_n_m[] = {0.0, 0.0, 1000.0, 1000.0};

static const struct axle_scene {
  const char *name;
  int one_sign; /* torque and speed, against resistance: forward from the start nothing cancels, and
                   ulps can be asked for */
  rot_axle_params p;
} axle_scenes[AXLE_SCENES] = {
    [CONSTANT_FREE] = {"constant torque, no resistance",
                       0,
                       {2.0, 0.0, 1.0, 0.5, -4.0, {0, NULL, NULL, 6.0, 0.0, NULL, NULL}}},
    [RAMP_FREE] = {"a ramp, no resistance",
                   0,
                   {2.0,
                    0.0,
                    0.0,
                    0.25,
                    3.0,
                    {2, ramp_free_knots_s, ramp_free_knots_n_m, 0.0, 5.0, NULL, NULL}}},
    [COASTING] = {"coasting", 1, {2.0, 3.0, 0.0, 0.5, 5.0, {0, NULL, NULL, 0.0, 0.0, NULL, NULL}}},
    [CONSTANT_DAMPED] = {"constant torque against resistance",
                         1,
                         {2.0, 3.0, -1.0, 0.5, 7.0, {0, NULL, NULL, 4.0, 0.0, NULL, NULL}}},
    [PULSE] =
        {"ramps, a jump and a pulse",
         0,
         {0.7, 0.3, 0.4, 0.1, 2.0, {10, pulse_knots_s, pulse_knots_n_m, 2.0, 3.0, NULL, NULL}}},
    [POSITIVE] = {"all signs positive, z up to 1",
                  1,
                  {3.0,
                   0.05,
                   0.0,
                   2.0,
                   5.0,
                   {4, positive_knots_s, positive_knots_n_m, 1.0, 9.0, NULL, NULL}}},
    [FAR] = {"torque far from its start",
             1,
             {2.0, 5.0, 0.0, 0.0, 0.0, {3, far_knots_s, far_knots_n_m, 0.0, 50.0, NULL, NULL}}},
    [DRIVEN] =
        {"driven: negative resistance",
         0,
         {2.0, -3.0, 0.0, 0.5, 0.2, {3, driven_knots_s, driven_knots_n_m, -1.0, 4.0, NULL, NULL}}},
    [DRIVEN_BACKWARD] = {"backward far through negative resistance",
                         0,
                         {2.0,
                          -3.0,
                          10.0,
                          0.5,
                          4.0,
                          {5, driven_backward_knots_s, driven_backward_knots_n_m, 0.0, 1.0, NULL,
                           NULL}}},
    [CLOSE_KNOTS] =
        {"a late start between close knots",
         0,
         {0.2, 0.1, 1000.5, -3.0, 1.0, {4, close_knots_s, close_knots_n_m, 2.0, -1.0, NULL, NULL}}},
    [TINY] = {"tiny inertia",
              1,
              {1e-300,
               3e-300,
               0.0,
               0.0,
               2.0,
               {2, tiny_knots_s, tiny_knots_n_m, 0.0, 3e-300, NULL, NULL}}},
    [HUGE_INERTIA] = {"huge inertia",
                      1,
                      {1e300,
                       3e300,
                       0.0,
                       0.0,
                       2.0,
                       {2, huge_inertia_knots_s, huge_inertia_knots_n_m, 0.0, 3e300, NULL, NULL}}},
    [LONG_TIMES] = {"long times",
                    1,
                    {7.0, 1e-290, 0.0, 0.0, 3.0, {0, NULL, NULL, 2e-295, 0.0, NULL, NULL}}},
    [SETTLED] = {"settled at once",
                 1,
                 {1e-300,
                  5.0,
                  0.0,
                  0.0,
                  2.0,
                  {2, settled_knots_s, settled_knots_n_m, 0.0, 7.0, NULL, NULL}}},
    [HARDLY_DAMPED] = {"hardly any resistance",
                       1,
                       {2.0,
                        1e-17,
                        0.0,
                        1.0,
                        3.0,
                        {3, hardly_damped_knots_s, hardly_damped_knots_n_m, 5.0, 1.0, NULL, NULL}}},
    [COASTING_LONG] = {"coasting through hundreds of time constants",
                       1,
                       {0.7, 0.3, 0.1, 0.0, 5.0, {0, NULL, NULL, 0.0, 0.0, NULL, NULL}}},
    [UNDRIVEN_START] = {"an undriven start",
                        1,
                        {0.7,
                         0.3,
                         0.1,
                         0.0,
                         0.0,
                         {3, undriven_start_knots_s, undriven_start_knots_n_m, 0.0, 0.3, NULL,
                          NULL}}},
    [DRIVEN_LONG] = {"driven through hundreds of time constants",
                     0,
                     {0.7, -0.3, 0.1, 0.0, 5.0, {0, NULL, NULL, 2.0, 2.0, NULL, NULL}}},
    [RAMP_DRIVEN_LONG] = {"a ramp driven through hundreds of time constants",
                          0,
                          {0.7,
                           -0.3,
                           0.1,
                           0.0,
                           5.0,
                           {2, ramp_driven_long_knots_s, ramp_driven_long_knots_n_m, 2.0, 2.0, NULL,
                            NULL}}},
    [BACKWARD_FREE] = {"backward out of a torque, no resistance",
                       0,
                       {2.0,
                        0.0,
                        5.0,
                        100.0,
                        3.0,
                        {4, backward_free_knots_s, backward_free_knots_n_m, 0.0, 0.0, NULL, NULL}}},
    [BREATH] = {"coasting, but for a breath of torque",
                1,
                {0.7, 0.3, 0.1, 0.0, 5.0, {0, NULL, NULL, 1e-59, 1e-59, NULL, NULL}}},
};

#endif
