/* web/core/gsl_few.c beside GSL: steps, nodes and weights to the last bit. The stand-in is compiled
 * with other names (gsl_few_names.c); prints a line for each check. */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void *few_step_alloc(size_t dim);
int few_step_apply(void *step, double t, double h, double y[], double yerr[], const double in[],
                   double out[], int (*f)(double t, const double y[], double dydt[], void *params),
                   void *params);
void few_step_free(void *step);
void *few_table_alloc(size_t n);
void few_table_free(void *table);
void few_point(size_t i, double *x, double *w, const void *table);

static int failed;

static void check(const char *what, size_t wrong, size_t of) {
  printf("%s - %s (%zu of %zu differ)\n", wrong ? "not ok" : "ok", what, wrong, of);
  failed |= wrong > 0;
}

static int differs(double a, double b) { return memcmp(&a, &b, sizeof a) != 0; }

enum { DIM = 6 };

/* Two pendulums and a driven rotor: all kinds of operations, no symmetry. */
static int slope(double t, const double y[], double dydt[], void *params) {
  const double *p = params;
  dydt[0] = y[1];
  dydt[1] = -p[0] * sin(y[0]) - p[1] * y[1] + p[2] * sin(y[0] - y[2]);
  dydt[2] = y[3];
  dydt[3] = -p[1] * sin(y[2]) * y[3] * y[3] + cos(p[2] * t);
  dydt[4] = y[5] * y[1] + p[0];
  dydt[5] = -y[4] / (1.0 + y[0] * y[0]);
  return 0;
}

static uint64_t state = 20260401;

static double uniform(void) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (double)(state >> 11) * 0x1p-53;
}

static void steps(void) {
  gsl_odeiv2_step *ours = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, DIM);
  void *few = few_step_alloc(DIM);
  size_t wrong = 0, n = 0;
  for (int k = 0; k < 10000; k++) {
    double p[3], a[DIM], b[DIM], in[DIM], error[2][DIM] = {{0.0}}, out[2][DIM] = {{0.0}};
    for (int i = 0; i < 3; i++) p[i] = 5.0 * uniform() - 1.0;
    for (int i = 0; i < DIM; i++) a[i] = b[i] = 20.0 * uniform() - 10.0;
    const double t = 10.0 * uniform(), h = (k % 2 ? -1.0 : 1.0) * 0.3 * uniform();
    const gsl_odeiv2_system system = {slope, NULL, DIM, p};
    slope(t, a, in, p);
    const int codes = gsl_odeiv2_step_apply(ours, t, h, a, error[0], in, out[0], &system) |
                      few_step_apply(few, t, h, b, error[1], in, out[1], slope, p);
    wrong += codes != 0;
    for (int i = 0; i < DIM; i++, n += 3) {
      wrong += (size_t)(differs(a[i], b[i]) + differs(error[0][i], error[1][i]) +
                        differs(out[0][i], out[1][i]));
    }
  }
  few_step_free(few);
  gsl_odeiv2_step_free(ours);
  check("10000 random steps: state, error and slope", wrong, n);
}

static void nodes(void) {
  size_t wrong = 0, n = 0;
  /* Those that the core asks for: GSL has them as tables. */
  for (size_t order = 1; order <= 20; order++) {
    gsl_integration_glfixed_table *ours = gsl_integration_glfixed_table_alloc(order);
    void *few = few_table_alloc(order);
    for (size_t i = 0; i < order; i++, n += 2) {
      double x[2], w[2];
      gsl_integration_glfixed_point(-1.0, 1.0, i, &x[0], &w[0], ours);
      few_point(i, &x[1], &w[1], few);
      /* In the middle a node may be -0. */
      const int bad = (x[0] != x[1]) + differs(w[0], w[1]);
      if (bad) printf("# %zu, %zu: %a %a, %a %a\n", order, i, x[0], x[1], w[0], w[1]);
      wrong += (size_t)bad;
    }
    few_table_free(few);
    gsl_integration_glfixed_table_free(ours);
  }
  check("nodes and weights up to order 20", wrong, n);
}

int main(void) {
  steps();
  nodes();
  return failed;
}
