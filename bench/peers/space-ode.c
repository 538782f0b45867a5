/* A free body by the Open Dynamics Engine: a world without gravity, fixed steps, damping and sleep
 * off, the gyroscopic term on, as they are by default.
 *
 *   space-ode STEP I1 I2 I3 w1 w2 w3 t ...
 *
 * A line for each time: t, the quaternion, body to space, the angular velocity along the body's
 * axes, CPU seconds, steps. */
#include <math.h>
#include <ode/ode.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int main(int argc, char **argv) {
  if (argc < 9) return 2;
  const double step = atof(argv[1]);
  double x[6];
  for (int i = 0; i < 6; i++) x[i] = atof(argv[2 + i]);
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  dMass mass;
  dMassSetParameters(&mass, 1, 0, 0, 0, (dReal)x[0], (dReal)x[1], (dReal)x[2], 0, 0, 0);
  dBodySetMass(body, &mass);
  dBodySetAngularVel(body, (dReal)x[3], (dReal)x[4], (dReal)x[5]);
  dBodySetAutoDisableFlag(body, 0);
  const clock_t start = clock();
  long done = 0;
  for (int i = 8; i < argc; i++) {
    const long end = lround(atof(argv[i]) / step);
    for (; done < end; done++) dWorldStep(world, (dReal)step);
    const dReal *q = dBodyGetQuaternion(body), *space = dBodyGetAngularVel(body);
    dVector3 w;
    dBodyVectorFromWorld(body, space[0], space[1], space[2], w);
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.6g %ld\n", atof(argv[i]),
           (double)q[0], (double)q[1], (double)q[2], (double)q[3], (double)w[0], (double)w[1],
           (double)w[2], (double)(clock() - start) / CLOCKS_PER_SEC, done);
  }
  dWorldDestroy(world);
  dCloseODE();
  return 0;
}
