/* The motion where a run is: its phase, its state and the slope there, its sizes so far. */
#ifndef ROT_ODE_STATE_H
#define ROT_ODE_STATE_H

/*   MOVING     -> a step -> MOVING, CUT
 *   CUT        -> the last step was cut where an event seemed near; a step -> MOVING
 *   LEAVING    -> a stretch begins at rest, its direction known; a step -> MOVING; none -> HELD
 *   UNDECIDED  -> the same where nothing drives: the direction is a guess, and may flip -> LEAVING
 *   HELD       -> until it breaks loose -> LEAVING
 *   STIFF      -> ended: not for an explicit method
 *   ENDED      -> ended by an event */
typedef enum rot_ode_phase {
  ROT_ODE_MOVING,
  ROT_ODE_CUT,
  ROT_ODE_LEAVING,
  ROT_ODE_UNDECIDED,
  ROT_ODE_HELD,
  ROT_ODE_STIFF,
  ROT_ODE_ENDED
} rot_ode_phase;

typedef struct rot_ode_state {
  rot_ode_phase phase;
  double *y, *slope; /* dim each */
  int slope_known;   /* slope holds rhs of the time and y */
  double *largest;   /* size of each measure so far */
} rot_ode_state;

#endif
