// A free body by Simbody: a ball joint without gravity, Runge-Kutta-Merson.
//
//   space-simbody STEP ACCURACY I1 I2 I3 w1 w2 w3 t ...
//
// STEP 0: steps by the accuracy. A line for each time: t, the quaternion, body to space, the
// angular velocity along the body's axes, CPU seconds, steps.
#include <Simbody.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace SimTK;

int main(int argc, char **argv) {
  if (argc < 10) return 2;
  const double step = atof(argv[1]), accuracy = atof(argv[2]);
  double x[6];
  for (int i = 0; i < 6; i++) x[i] = atof(argv[3 + i]);
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  Body::Rigid info(MassProperties(1, Vec3(0), Inertia(x[0], x[1], x[2])));
  MobilizedBody::Ball body(matter.updGround(), Transform(), info, Transform());
  State state = system.realizeTopology();
  body.setUToFitAngularVelocity(state, Vec3(x[3], x[4], x[5]));
  RungeKuttaMersonIntegrator integrator(system);
  if (step > 0) integrator.setFixedStepSize(step);
  else integrator.setAccuracy(accuracy);
  TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  const clock_t start = clock();
  for (int i = 9; i < argc; i++) {
    stepper.stepTo(atof(argv[i]));
    const State &at = stepper.getState();
    system.realize(at, Stage::Velocity);
    const Quaternion q = body.getBodyRotation(at).convertRotationToQuaternion();
    const Vec3 w = ~body.getBodyRotation(at) * body.getBodyAngularVelocity(at);
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.6g %d\n", at.getTime(), q[0], q[1],
           q[2], q[3], w[0], w[1], w[2],
           static_cast<double>(clock() - start) / CLOCKS_PER_SEC, integrator.getNumStepsTaken());
  }
  return 0;
}
