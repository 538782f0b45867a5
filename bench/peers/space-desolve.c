/* A free body for deSolve: quaternion, body to space, and angular velocity. */
static double moment[3];

void space_begin(void (*parameters)(int *, double *)) {
  int n = 3;
  parameters(&n, moment);
}

void space_rates(int *n, double *t, double *q, double *f, double *out, int *ip) {
  const double *w = q + 4;
  (void)n, (void)t, (void)out, (void)ip;
  f[0] = 0.5 * (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2]);
  f[1] = 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]);
  f[2] = 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]);
  f[3] = 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
  f[4] = (moment[1] - moment[2]) / moment[0] * w[1] * w[2];
  f[5] = (moment[2] - moment[0]) / moment[1] * w[2] * w[0];
  f[6] = (moment[0] - moment[1]) / moment[2] * w[0] * w[1];
}
