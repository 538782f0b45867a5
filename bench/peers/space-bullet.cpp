// A free body by Bullet, as a game steps it: a world without gravity, fixed steps, damping and
// sleep off, the gyroscopic term as Bullet has it by default (implicit, in the body's axes).
//
//   space-bullet STEP I1 I2 I3 w1 w2 w3 t ...
//
// A line for each time: t, the quaternion, body to space, the angular velocity along the body's
// axes, CPU seconds, steps.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

int main(int argc, char **argv) {
  if (argc < 9) return 2;
  const double step = atof(argv[1]);
  btScalar x[6];
  for (int i = 0; i < 6; i++) x[i] = static_cast<btScalar>(atof(argv[2 + i]));
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, 0));
  btSphereShape shape(1);
  btRigidBody body(
      btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &shape, btVector3(x[0], x[1], x[2])));
  body.setDamping(0, 0);
  body.setActivationState(DISABLE_DEACTIVATION);
  body.setAngularVelocity(btVector3(x[3], x[4], x[5]));
  world.addRigidBody(&body);
  const clock_t start = clock();
  long done = 0;
  for (int i = 8; i < argc; i++) {
    const long end = lround(atof(argv[i]) / step);
    for (; done < end; done++) world.stepSimulation(static_cast<btScalar>(step), 0);
    const btQuaternion q = body.getOrientation();
    const btVector3 w = quatRotate(q.inverse(), body.getAngularVelocity());
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.6g %ld\n", atof(argv[i]),
           static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
           static_cast<double>(q.z()), static_cast<double>(w.x()), static_cast<double>(w.y()),
           static_cast<double>(w.z()), static_cast<double>(clock() - start) / CLOCKS_PER_SEC, done);
  }
  world.removeRigidBody(&body);
  return 0;
}
