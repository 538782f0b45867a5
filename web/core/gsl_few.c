/* The routines of GSL that the integrators of the core use, for builds without GSL: a step of
 * Prince and Dormand's method of order 8(7) and the nodes of Gauss and Legendre. The numbers are
 * those of GSL to the last bit (web/tests/gsl_few.c).
 *
 * The method: P. J. Prince, J. R. Dormand, High order embedded Runge-Kutta formulae, J. Comput.
 * Appl. Math. 7 (1981) 67, table 2, RK8(7)13M. The nodes: zeros of Legendre's polynomials by
 * Newton's method in pairs of doubles, from the recurrence (n + 1) P_n+1 = (2 n + 1) x P_n - n
 * P_n-1. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

gsl_error_handler_t *gsl_set_error_handler_off(void) { return NULL; }

/* ---- a step ---------------------------------------------------------------------------------- */

enum { STAGES = 13 };

/* Row k: the weights of the slopes 0 .. k - 1 in the state of stage k. */
static const double stage_weight[STAGES][STAGES - 1] = {
    {0.0},
    {1.0 / 18.0},
    {1.0 / 48.0, 1.0 / 16.0},
    {1.0 / 32.0, 0.0, 3.0 / 32.0},
    {5.0 / 16.0, 0.0, -75.0 / 64.0, 75.0 / 64.0},
    {3.0 / 80.0, 0.0, 0.0, 3.0 / 16.0, 3.0 / 20.0},
    {29443841.0 / 614563906.0, 0.0, 0.0, 77736538.0 / 692538347.0, -28693883.0 / 1125000000.0,
     23124283.0 / 1800000000.0},
    {16016141.0 / 946692911.0, 0.0, 0.0, 61564180.0 / 158732637.0, 22789713.0 / 633445777.0,
     545815736.0 / 2771057229.0, -180193667.0 / 1043307555.0},
    {39632708.0 / 573591083.0, 0.0, 0.0, -433636366.0 / 683701615.0, -421739975.0 / 2616292301.0,
     100302831.0 / 723423059.0, 790204164.0 / 839813087.0, 800635310.0 / 3783071287.0},
    {246121993.0 / 1340847787.0, 0.0, 0.0, -37695042795.0 / 15268766246.0,
     -309121744.0 / 1061227803.0, -12992083.0 / 490766935.0, 6005943493.0 / 2108947869.0,
     393006217.0 / 1396673457.0, 123872331.0 / 1001029789.0},
    {-1028468189.0 / 846180014.0, 0.0, 0.0, 8478235783.0 / 508512852.0, 1311729495.0 / 1432422823.0,
     -10304129995.0 / 1701304382.0, -48777925059.0 / 3047939560.0, 15336726248.0 / 1032824649.0,
     -45442868181.0 / 3398467696.0, 3065993473.0 / 597172653.0},
    {185892177.0 / 718116043.0, 0.0, 0.0, -3185094517.0 / 667107341.0, -477755414.0 / 1098053517.0,
     -703635378.0 / 230739211.0, 5731566787.0 / 1027545527.0, 5232866602.0 / 850066563.0,
     -4093664535.0 / 808688257.0, 3962137247.0 / 1805957418.0, 65686358.0 / 487910083.0},
    {403863854.0 / 491063109.0, 0.0, 0.0, -5068492393.0 / 434740067.0, -411421997.0 / 543043805.0,
     652783627.0 / 914296604.0, 11173962825.0 / 925320556.0, -13158990841.0 / 6184727034.0,
     3936647629.0 / 1978049680.0, -160528059.0 / 685178525.0, 248638103.0 / 1413531060.0, 0.0}};

/* When each stage is, in steps. */
static const double stage_at[STAGES] = {0.0,
                                        1.0 / 18.0,
                                        1.0 / 12.0,
                                        1.0 / 8.0,
                                        5.0 / 16.0,
                                        3.0 / 8.0,
                                        59.0 / 400.0,
                                        93.0 / 200.0,
                                        5490023248.0 / 9719169821.0,
                                        13.0 / 20.0,
                                        1201146811.0 / 1299019798.0,
                                        1.0,
                                        1.0};

static const double order_8[STAGES] = {14005451.0 / 335480064.0,
                                       0.0,
                                       0.0,
                                       0.0,
                                       0.0,
                                       -59238493.0 / 1068277825.0,
                                       181606767.0 / 758867731.0,
                                       561292985.0 / 797845732.0,
                                       -1041891430.0 / 1371343529.0,
                                       760417239.0 / 1151165299.0,
                                       118820643.0 / 751138087.0,
                                       -528747749.0 / 2220607170.0,
                                       1.0 / 4.0};

static const double order_7[STAGES] = {13451932.0 / 455176623.0,
                                       0.0,
                                       0.0,
                                       0.0,
                                       0.0,
                                       -808719846.0 / 976000145.0,
                                       1757004468.0 / 5645159321.0,
                                       656045339.0 / 265891186.0,
                                       -3867574721.0 / 1518517206.0,
                                       465885868.0 / 322736535.0,
                                       53011238.0 / 667516719.0,
                                       2.0 / 45.0,
                                       0.0};

struct gsl_odeiv2_step {
  size_t dim;
  double *slope[STAGES], *at, *start; /* dim each */
};

static const gsl_odeiv2_step_type rk8pd = {"rk8pd"};
const gsl_odeiv2_step_type *gsl_odeiv2_step_rk8pd = &rk8pd;

gsl_odeiv2_step *gsl_odeiv2_step_alloc(const gsl_odeiv2_step_type *type, size_t dim) {
  gsl_odeiv2_step *step = type == &rk8pd ? calloc(1, sizeof *step) : NULL;
  double *all = step ? calloc((STAGES + 2) * dim, sizeof *all) : NULL;
  if (!all) {
    free(step);
    return NULL;
  }
  step->dim = dim;
  for (int k = 0; k < STAGES; k++) step->slope[k] = all + (size_t)k * dim;
  step->at = all + STAGES * dim;
  step->start = step->at + dim;
  return step;
}

void gsl_odeiv2_step_free(gsl_odeiv2_step *step) {
  if (step) free(step->slope[0]);
  free(step);
}

/* The sum of the slopes so far, of component i. The weights of 0 are left out, as GSL does; the
 * last one of the last stage is not, so that slopes beyond the doubles give the same. */
static double weighted(const gsl_odeiv2_step *step, const double weight[], int stages, size_t i) {
  double sum = weight[0] * step->slope[0][i];
  for (int k = 1; k < stages; k++) {
    if (weight[k] != 0.0 || k == STAGES - 2) sum += weight[k] * step->slope[k][i];
  }
  return sum;
}

int gsl_odeiv2_step_apply(gsl_odeiv2_step *step, double t, double h, double y[], double yerr[],
                          const double dydt_in[], double dydt_out[],
                          const gsl_odeiv2_system *system) {
  const size_t dim = step->dim;
  int code = GSL_SUCCESS;
  memcpy(step->start, y, dim * sizeof *y);
  if (dydt_in) {
    memcpy(step->slope[0], dydt_in, dim * sizeof *dydt_in);
  } else {
    code = system->function(t, y, step->slope[0], system->params);
  }
  for (int k = 1; k < STAGES && code == GSL_SUCCESS; k++) {
    for (size_t i = 0; i < dim; i++) {
      step->at[i] = k == 1 ? y[i] + stage_weight[1][0] * h * step->slope[0][i]
                           : y[i] + h * weighted(step, stage_weight[k], k, i);
    }
    code = system->function(t + stage_at[k] * h, step->at, step->slope[k], system->params);
  }
  if (code != GSL_SUCCESS) return code;
  for (size_t i = 0; i < dim; i++) {
    const double sum_8 = weighted(step, order_8, STAGES, i);
    const double sum_7 = weighted(step, order_7, STAGES - 1, i);
    y[i] += h * sum_8;
    yerr[i] = h * (sum_7 - sum_8);
  }
  if (dydt_out) code = system->function(t + h, y, dydt_out, system->params);
  if (code != GSL_SUCCESS) memcpy(y, step->start, dim * sizeof *y);
  return code;
}

/* ---- Gauss's nodes --------------------------------------------------------------------------- */

struct gsl_integration_glfixed_table {
  size_t n;
  double *x, *w; /* the nodes from the middle on, not below 0 */
};

/* A number as the sum of two doubles. */
typedef struct pair {
  double high, low;
} pair;

static pair quick(double high, double low) {
  const double sum = high + low;
  return (pair){sum, low - (sum - high)};
}

static pair sum_of(double a, double b) {
  const double sum = a + b, part = sum - a;
  return (pair){sum, (a - (sum - part)) + (b - part)};
}

static pair add(pair a, pair b) {
  const pair s = sum_of(a.high, b.high);
  return quick(s.high, s.low + (a.low + b.low));
}

static pair times(pair a, pair b) {
  const double high = a.high * b.high;
  return quick(high, fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high));
}

static pair minus(pair a) { return (pair){-a.high, -a.low}; }

static pair over(pair a, pair b) {
  const double first = a.high / b.high;
  const pair left = add(a, minus(times((pair){first, 0.0}, b)));
  const double second = left.high / b.high;
  const pair rest = add(left, minus(times((pair){second, 0.0}, b)));
  return add(quick(first, second), (pair){rest.high / b.high, 0.0});
}

static pair whole(size_t n) { return (pair){(double)n, 0.0}; }

/* P_n(x) and its derivative n (x P_n - P_n-1)/(x^2 - 1). */
static void legendre(size_t n, pair x, pair *value, pair *slope) {
  pair before = {1.0, 0.0}, now = x;
  for (size_t k = 1; k < n; k++) {
    const pair next = over(
        add(times(times(whole(2 * k + 1), x), now), minus(times(whole(k), before))), whole(k + 1));
    before = now;
    now = next;
  }
  *value = now;
  *slope =
      over(times(whole(n), add(times(x, now), minus(before))), add(times(x, x), (pair){-1.0, 0.0}));
}

gsl_integration_glfixed_table *gsl_integration_glfixed_table_alloc(size_t n) {
  const size_t half = (n + 1) / 2;
  gsl_integration_glfixed_table *table = n ? calloc(1, sizeof *table) : NULL;
  double *x = table ? calloc(2 * half, sizeof *x) : NULL;
  if (!x) {
    free(table);
    return NULL;
  }
  *table = (gsl_integration_glfixed_table){n, x, x + half};
  for (size_t i = 0; i < half; i++) {
    const size_t from_right = half - i;
    const double angle = 3.14159265358979323846 * ((double)from_right - 0.25) / ((double)n + 0.5);
    const int middle = n % 2 && i == 0;
    pair at = {middle ? 0.0 : cos(angle), 0.0}, value, slope;
    /* It doubles the digits each time: 3, 6, 12, 24, 32. */
    for (int turn = 0; turn < 6 && !middle; turn++) {
      legendre(n, at, &value, &slope);
      at = add(at, minus(over(value, slope)));
    }
    legendre(n, at, &value, &slope);
    const pair beside = add((pair){1.0, 0.0}, minus(times(at, at)));
    table->x[i] = at.high;
    table->w[i] = over((pair){2.0, 0.0}, times(beside, times(slope, slope))).high;
  }
  return table;
}

void gsl_integration_glfixed_table_free(gsl_integration_glfixed_table *table) {
  if (table) free(table->x);
  free(table);
}

int gsl_integration_glfixed_point(double a, double b, size_t i, double *xi, double *wi,
                                  const gsl_integration_glfixed_table *table) {
  const double middle = (b + a) / 2.0, half = (b - a) / 2.0;
  const size_t left = table->n / 2; /* nodes below the middle */
  const int below = i < left;
  const size_t at = below ? left - i - !(table->n % 2) : i - left;
  *xi = below ? middle - half * table->x[at] : middle + half * table->x[at];
  *wi = half * table->w[at];
  return GSL_SUCCESS;
}
