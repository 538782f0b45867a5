/* Approximations of the heavy top against the exact motion: their bounds cover, and are no decades
 * off; by hand what they are. */
#include "scene/pivot/approx.h"

#include <stdlib.h>

#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/choice.h"
#include "scene/pivot/pivot.h"
#include "rot_test.h"

static double norm3(const double a[3], const double b[3]) {
  return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Spin of `fast` times the square root of G/I1; the axis released at rest, steady but for a part,
 * or pushed. */
static rot_free_params random_top(int axis, int start, double fast) {
  rot_free_params p = {.axes = {1.0}};
  const double across = uniform(0.5, 2.0), slow = start == 0 ? 0.0 : start == 1 ? 1.0 : 3.0;
  const double axial = across * uniform(0.2, 1.9), weight = uniform(1.0, 4.0);
  const double omega3 = fast * sqrt(weight / across) * (uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0);
  double w[3], q[4], inclined = uniform(0.3, 2.8), up[3] = {0.0, 0.0, 1.0};
  const double phi = uniform(-3.0, 3.0), psi = uniform(-3.0, 3.0);
  q[0] = cos(0.5 * inclined) * cos(0.5 * (phi + psi));
  q[1] = sin(0.5 * inclined) * cos(0.5 * (phi - psi));
  q[2] = sin(0.5 * inclined) * sin(0.5 * (phi - psi));
  q[3] = cos(0.5 * inclined) * sin(0.5 * (phi + psi));
  /* phi' along the vertical, in the body's axes */
  rot_attitude_to_body(q, up, w);
  const double precession =
      slow * weight / (axial * omega3) * (start == 1 ? uniform(0.9, 1.1) : uniform(-1.0, 1.0));
  for (int i = 0; i < 3; i++) w[i] *= precession;
  w[2] = omega3;
  const double turns[3][4] = {{0.5, -0.5, -0.5, -0.5}, {0.5, 0.5, 0.5, 0.5}, {1.0, 0.0, 0.0, 0.0}};
  rot_attitude_times(q, turns[axis], p.q0);
  for (int i = 0; i < 3; i++) {
    p.moment_kg_m2[i] = i == axis ? axial : across;
    p.omega0_rad_per_s[(axis + 1 + i) % 3] = w[i];
  }
  p.lever_n_m[axis] = uniform(0.0, 1.0) < 0.3 ? -weight : weight;
  p.start_s = -0.5;
  return p;
}

static void check_bounds(void) {
  enum { N = 6 };
  double closest[2][3] = {{INFINITY, INFINITY, INFINITY}, {INFINITY, INFINITY, INFINITY}};
  double middle[2] = {0.0, 0.0};
  int offered[2] = {0, 0};
  srand(12);
  const int tops = rot_test_trials(3000);
  for (int k = 0; k < tops; k++) {
    const double fast = pow(10.0, uniform(0.3, 4.0));
    const rot_free_params p = random_top(k % 3, k / 3 % 3, fast);
    double t[N];
    const double size = fabs(p.lever_n_m[k % 3]) / p.moment_kg_m2[(k + 1) % 3];
    const double span = pow(10.0, uniform(-1.0, 2.0)) / sqrt(size);
    for (int i = 0; i < N; i++) t[i] = p.start_s + span * (i / 4.0 - 0.25);
    rows exact, near;
    const rot_free_columns form = columns_of(&exact), out = columns_of(&near);
    rot_info by_form, info;
    ROT_CHECK(rot_pivot_not_spinning(&p) == NULL);
    ROT_CHECK_EQ_INT(rot_pivot_top(&p, N, t, &form, NULL, NULL, &by_form), ROT_OK);
    for (int model = 0; model < 2; model++) {
      const rot_status status = model ? rot_pivot_small_nutation(&p, N, t, &out, NULL, NULL, &info)
                                      : rot_pivot_precession(&p, N, t, &out, NULL, NULL, &info);
      double off[3] = {0.0, 0.0, 0.0};
      if (status == ROT_ERANGE) continue; /* no bound: nothing is promised */
      for (int i = 0; i < N; i++) {
        double a[NUMBERS], b[NUMBERS];
        row_of(&exact, (size_t)i, a);
        row_of(&near, (size_t)i, b);
        off[0] = fmax(off[0], rot_attitude_angle(a, b));
        off[1] = fmax(off[1], norm3(a + 4, b + 4));
        off[2] = fmax(off[2], norm3(a + 10, b + 10));
      }
      for (int c = 0; c < 3; c++) {
        const double said = info.measure[c].error;
        ROT_CHECK(off[c] <= said + by_form.measure[c].error);
        if (off[c] > 1e-12) closest[model][c] = fmin(closest[model][c], said / off[c]);
      }
      const double figure = rot_info_error(&info);
      const double promised =
          model ? rot_pivot_nutation_bound(&p, span) : rot_pivot_precession_bound(&p, span);
      ROT_CHECK(figure <= promised * (1.0 + 1e-12));
      if (promised < 0.01) {
        const double worst =
            fmax(off[0], fmax(off[1] / info.measure[1].largest, off[2] / info.measure[2].largest));
        offered[model]++;
        middle[model] += log10(promised / worst);
      }
    }
  }
  for (int model = 0; model < 2; model++) {
    printf("%s: bound/error %.2g, %.2g, %.2g at least; of %d within 1e-2, 10^%.2g in the mean\n",
           model ? "small nutation" : "precession", closest[model][0], closest[model][1],
           closest[model][2], offered[model], middle[model] / offered[model]);
    ROT_CHECK(offered[model] > tops / 10 && middle[model] / offered[model] < 1.5);
  }
}

/* A gyroscope of 1 kg m^2, 100 rad/s, under 2 N m: 0.02 rad/s, whatever the angle. */
static void check_by_hand(void) {
  const double tilt = 1.1, t[2] = {0.0, 5.0};
  rot_free_params p = {.axes = {1.0}};
  p.moment_kg_m2[0] = p.moment_kg_m2[1] = 0.7;
  p.moment_kg_m2[2] = 1.0;
  p.omega0_rad_per_s[2] = 100.0;
  p.lever_n_m[2] = 2.0;
  p.q0[0] = cos(0.5 * tilt), p.q0[1] = sin(0.5 * tilt);
  rows x;
  rot_info info;
  const rot_free_columns out = columns_of(&x);
  ROT_CHECK_EQ_INT(rot_pivot_precession(&p, 2, t, &out, NULL, NULL, &info), ROT_OK);
  double q[NUMBERS], axis[3];
  const double along[3] = {0.0, 0.0, 1.0};
  row_of(&x, 1, q);
  rot_attitude_to_space(q, along, axis);
  ROT_CHECK_REL(axis[2], cos(tilt), 1e-14);
  ROT_CHECK_REL(atan2(axis[0], -axis[1]), 0.1, 1e-12);
  ROT_CHECK_REL(x.omega_space_z_rad_per_s[1], 0.02 + (100.0 - 0.02 * cos(tilt)) * cos(tilt), 1e-14);
  /* its nutation: w3 I3/I1, between tilt and tilt + 2 G I1 sin(tilt)/(I3 w3)^2 */
  const double a = 100.0 / 0.7, half = 3.14159265358979323846 / a;
  const double at[2] = {0.0, half};
  ROT_CHECK_EQ_INT(rot_pivot_small_nutation(&p, 2, at, &out, NULL, NULL, &info), ROT_OK);
  row_of(&x, 1, q);
  rot_attitude_to_space(q, along, axis);
  ROT_CHECK_REL(acos(axis[2]) - tilt, 2.0 * 2.0 * 0.7 / 1e4 * sin(tilt), 1e-3);
  ROT_CHECK_REL(rot_pivot_nutation_bound(&p, half) / rot_pivot_nutation_bound(&p, 2.0 * half), 0.5,
                0.1);
  /* no spin, a vertical axis, no top */
  p.omega0_rad_per_s[2] = 0.0;
  ROT_CHECK(rot_pivot_not_spinning(&p) != NULL && isinf(rot_pivot_precession_bound(&p, 1.0)));
  p.omega0_rad_per_s[2] = 100.0;
  p.q0[0] = 1.0, p.q0[1] = 0.0;
  ROT_CHECK(rot_pivot_not_spinning(&p) != NULL && isinf(rot_pivot_nutation_bound(&p, 1.0)));
  p.moment_kg_m2[0] = 0.8;
  ROT_CHECK(rot_pivot_not_spinning(&p) != NULL);
}

/* They are offered where the bound is within the accuracy, and not otherwise. */
static void check_choice(void) {
  const rot_constraint *pivot = rot_choice_constraint("pivot");
  double t[100];
  rot_free_params p = {.axes = {1.0}};
  p.moment_kg_m2[0] = p.moment_kg_m2[1] = 0.7;
  p.moment_kg_m2[2] = 1.0;
  p.omega0_rad_per_s[2] = 100.0;
  p.lever_n_m[2] = 2.0;
  p.q0[0] = cos(0.5), p.q0[1] = sin(0.5);
  for (int i = 0; i < 100; i++) t[i] = 0.02 * i;
  for (int k = 2; k < 12; k++) {
    const rot_query query = {100, t, pow(10.0, -k), 0.0};
    rot_candidate all[ROT_MAX_MODELS];
    const size_t n = rot_choice_candidates(pivot, &p, &query, all);
    for (size_t i = 0; i < n; i++) {
      const int precession = !strcmp(all[i].model->id, "pivot_precession");
      const int nutation = !strcmp(all[i].model->id, "pivot_nutation");
      if (!precession && !nutation) continue;
      const double bound =
          nutation ? rot_pivot_nutation_bound(&p, t[99]) : rot_pivot_precession_bound(&p, t[99]);
      ROT_CHECK(all[i].applies == (bound <= query.accuracy));
      if (all[i].applies) ROT_CHECK_REL(all[i].error, bound, 1e-12);
    }
    ROT_CHECK(rot_choice_pick(pivot, &p, &query, all) == 1);
    if (k == 2) ROT_CHECK(!strcmp(all[0].model->id, "pivot_precession"));
    if (k > 7) ROT_CHECK(!strcmp(all[0].model->id, "pivot_top"));
  }
}

/* A top by Euler's angles (0.3, theta, -0.4) and their rates. */
static rot_free_params euler_top(const double x[7]) {
  const double theta = x[3], phi = 0.3, psi = -0.4;
  rot_free_params p = {.axes = {1.0}};
  p.moment_kg_m2[0] = p.moment_kg_m2[1] = x[0];
  p.moment_kg_m2[2] = x[1];
  p.lever_n_m[2] = x[2];
  p.q0[0] = cos(0.5 * theta) * cos(0.5 * (phi + psi));
  p.q0[1] = sin(0.5 * theta) * cos(0.5 * (phi - psi));
  p.q0[2] = sin(0.5 * theta) * sin(0.5 * (phi - psi));
  p.q0[3] = cos(0.5 * theta) * sin(0.5 * (phi + psi));
  p.omega0_rad_per_s[0] = x[4] * sin(theta) * sin(psi) + x[5] * cos(psi);
  p.omega0_rad_per_s[1] = x[4] * sin(theta) * cos(psi) - x[5] * sin(psi);
  p.omega0_rad_per_s[2] = x[6];
  return p;
}

/* The bounds' own size, from above and below: by 40 digits, the limits of u as zeros of the cubic,
 * period and mean rates by quadrature over the nutation, slopes by differences. I1, I3, G, theta,
 * phi', theta', omega3, t; attitude and omega of the precession and of small nutation. */
static void check_bounds_by_digits(void) {
  static const double known[][12] = {
      {0.7, 1.0, 2.0, 1.1, 0.0, 0.0, 20.0, 0.015625, 0.016152331444328252, 0.17956002052343958,
       5.5254682742799154e-5, 0.0015895007934522669},
      {0.7, 1.0, 2.0, 1.1, 0.0, 0.0, 20.0, 3.0, 0.016686195803411635, 0.17965276935731663,
       0.010689591686689655, 0.0048238223654478306},
      {0.7, 1.0, 2.0, 1.1, 0.0, 0.0, 20.0, 40.0, 0.02938346731554484, 0.18080266065899646,
       0.14252788915586207, 0.044922197984189658},
      {1.5, 0.5, 3.0, 2.2, 0.5, -0.375, -24.0, 0.015625, 0.50349432267167347, 1.6797778868724974,
       0.02749910405469243, 0.80639915167363019},
      {1.5, 0.5, 3.0, 2.2, 0.5, -0.375, -24.0, 3.0, 0.59164450745276224, 1.7035695596103404,
       5.4005087105071467, 6.3440501836417976},
      {1.5, 0.5, 3.0, 2.2, 0.5, -0.375, -24.0, 40.0, 2.1474228286789952, 1.9985364760669487,
       71.766454635400742, 10.218413627087108},
      {0.75, 1.25, 2.5, 1.5, -0.25, 0.5, 12.0, 0.015625, 0.15761897009952304, 1.3081473882839248,
       0.0021641301405955928, 0.071295137538762399},
      {0.75, 1.25, 2.5, 1.5, -0.25, 0.5, 12.0, 3.0, 0.1730024778231023, 1.3151165270526619,
       0.42336189954802107, 0.64760247684160165},
      {0.75, 1.25, 2.5, 1.5, -0.25, 0.5, 12.0, 40.0, 0.6439841619203038, 1.4015192527299891,
       5.6448253273069475, 6.326304825346352},
      {1.0, 0.75, 1.5, 0.6, 0.25, 0.125, 32.0, 0.015625, 0.033245128482210182, 0.33432685195855444,
       0.00054029947872587625, 0.010077363482821428},
      {1.0, 0.75, 1.5, 0.6, 0.25, 0.125, 32.0, 3.0, 0.033547725079803479, 0.33435820814078519,
       0.10394356485785367, 0.041809213451894554},
      {1.0, 0.75, 1.5, 0.6, 0.25, 0.125, 32.0, 40.0, 0.041545327992078547, 0.33474695913304918,
       1.3859141981047156, 0.43521423816517832},
  };
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
    const double *x = known[k];
    const rot_free_params p = euler_top(x);
    rows r;
    rot_info info;
    const rot_free_columns out = columns_of(&r);
    for (int model = 0; model < 2; model++) {
      const rot_status status =
          model ? rot_pivot_small_nutation(&p, 1, x + 7, &out, NULL, NULL, &info)
                : rot_pivot_precession(&p, 1, x + 7, &out, NULL, NULL, &info);
      ROT_CHECK_EQ_INT(status, ROT_OK);
      ROT_CHECK_REL(info.measure[0].error, fmin(x[8 + 2 * model], 3.2), 1e-9);
      ROT_CHECK_REL(info.measure[1].error, x[9 + 2 * model], 1e-9);
    }
  }
}

/* Tops whose axis is also pushed to the side, so that the angle changes from the start. */
static void check_pushed(void) {
  double middle = 0.0;
  int counted = 0;
  srand(13);
  for (int k = 0; k < 300; k++) {
    const int axis = k % 3;
    rot_free_params p = random_top(axis, k / 3 % 3, pow(10.0, uniform(1.0, 3.0)));
    const double rate = p.lever_n_m[axis] / (p.moment_kg_m2[axis] * p.omega0_rad_per_s[axis]);
    for (int i = 1; i < 3; i++) p.omega0_rad_per_s[(axis + i) % 3] += rate * uniform(-2.0, 2.0);
    const double beat =
        fabs(p.omega0_rad_per_s[axis] * p.moment_kg_m2[axis]) / p.moment_kg_m2[(axis + 1) % 3];
    const double t[] = {p.start_s + 1.0 / beat, p.start_s + 2.0 / beat, p.start_s + 5.0 / beat};
    rows exact, near;
    const rot_free_columns form = columns_of(&exact), out = columns_of(&near);
    rot_info by_form, info;
    ROT_CHECK_EQ_INT(rot_pivot_top(&p, 3, t, &form, NULL, NULL, &by_form), ROT_OK);
    if (rot_pivot_small_nutation(&p, 3, t, &out, NULL, NULL, &info) != ROT_OK) continue;
    double off = 0.0;
    for (size_t i = 0; i < 3; i++) off = fmax(off, angle_between(&exact, &near, i));
    ROT_CHECK(off <= info.measure[0].error + by_form.measure[0].error);
    middle += log10(info.measure[0].error / fmax(off, 1e-14));
    counted++;
  }
  printf("pushed: bound 10^%.2g of the error, of %d\n", middle / counted, counted);
  ROT_CHECK(counted > 250 && middle / counted < 1.5);
}

/* A torque is an effect along whichever axis. */
static void check_torque_effect(void) {
  const rot_constraint *pivot = rot_choice_constraint("pivot");
  rot_free_params p = random_top(2, 0, 20.0);
  const unsigned without = pivot->effects_of(&p);
  unsigned with[3];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) p.torque[k] = k == i ? 0.1 : 0.0;
    with[i] = pivot->effects_of(&p);
  }
  ROT_CHECK(with[0] != without && (with[0] & without) == without);
  ROT_CHECK(with[1] == with[0] && with[2] == with[0]);
}

int main(void) {
  check_bounds();
  check_by_hand();
  check_choice();
  check_bounds_by_digits();
  check_pushed();
  check_torque_effect();
  return rot_test_report("pivot_approx");
}
