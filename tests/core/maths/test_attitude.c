/* Attitudes in all forms: against mpmath at 40 digits, by round trips, next to 0 and pi and at the
 * gimbal lock of all 24 sequences. */
#include "maths/attitude.h"
#include "ground/real.h"
#include "rot_test.h"

/* rotation vector; quaternion, matrix, modified Rodrigues parameters by mpmath */
static const struct known {
  double vector[3], q[4], r[9], p[3];
} known[] = {
    {{-1.4154172642740397, 0.7293078863526798, 0.5473512731313914},
     {0.6660792492238253, -0.6270265885058369, 0.32308171412948533, 0.24247535350074342},
     {0.6736478178796861, -0.7281772528685722, 0.12631906376599233, -0.08214604720834483,
      0.0960867205028427, 0.9919775043170349, -0.7344730385752642, -0.6786200929443426,
      0.004911726603770704},
     {-0.3763485973419027, 0.19391737474672893, 0.14553650650994251}},
    {{1.5852686024380243, -0.8239851843828366, -0.879208151641059},
     {0.5439829268499752, 0.6680225736488568, -0.34722235883143954, -0.3704929822801282},
     {0.48434316721741527, -0.06082103379376987, -0.8727614211329806, -0.8669884613062504,
      -0.1670384176465313, -0.46949885515511464, -0.11722928103346551, 0.984072644106318,
      -0.13363505075382234},
     {0.43266189154808365, -0.22488743417638726, -0.23995924814790914}},
    {{0.8426137109209082, 0.5704200656642728, -0.7092432940019218},
     {0.8137843953355764, 0.39481562667713227, 0.2672763957855775, -0.3323234976581177},
     {0.6362488423202928, 0.7519291485912063, 0.17259770028882424, -0.3298295577988543,
      0.4673634276716367, -0.8202340454268104, -0.6974237402385292, 0.4649451386711365,
      0.5453678983748294},
     {0.2176750597769288, 0.14735841617830628, -0.1832210589708117}},
    {{0.6632392610770397, -0.3719748778811498, 0.9990597164044044},
     {0.8093403139283033, 0.31026332692896036, -0.17400984820769472, 0.46736013623344425},
     {0.502590151573183, -0.8644845476001463, 0.008343051133457, 0.6485290499068552,
      0.370622342045659, -0.6648677695628675, 0.5716757918335852, 0.33956670410563083,
      0.7469144813794162},
     {0.17147870112689856, -0.09617308964387007, 0.258304163476437}},
    {{-1.3737615484844212, -0.9962419812759016, 1.4452671105889159},
     {0.4406188430884877, -0.5532564380004876, -0.40121758434375354, 0.58205394847878},
     {0.00047530214724941734, -0.068975451633242, -0.9976182441995831, 0.9568802979419831,
      -0.2897589702574513, 0.020489864953265526, -0.29048213283837343, -0.9546109816188644,
      0.06586352764875131},
     {-0.38404081735761714, -0.2785036349265004, 0.4040304979150049}},
    {{-0.5110823533813442, -0.8625516049682173, 1.0954126229719987},
     {0.7367914310639859, -0.23270070872267354, -0.3927280377771508, 0.4987518978553946},
     {0.1940224654587017, -0.5521760636814944, -0.8108371461610138, 0.917728434585526,
      0.39419384909121497, -0.04884393198599337, 0.34659746573009853, -0.7346514847435229,
      0.5832301370073485},
     {-0.1339831050295529, -0.22612274033190008, 0.2871685620592055}},
    {{1e-09, -2e-09, 3e-10},
     {1.0, 5e-10, -1e-09, 1.5e-10},
     {1.0, -3.00000001e-10, -1.99999999985e-09, 2.99999999e-10, 1.0, -1.0000000003e-09,
      2.0000000001500002e-09, 9.999999997e-10, 1.0},
     {2.5e-10, -5e-10, 7.5e-11}},
    {{1e-200, 0.0, 2e-200},
     {1.0, 5e-201, 0.0, 1e-200},
     {1.0, -2e-200, 0.0, 2e-200, 1.0, -1e-200, 0.0, 1e-200, 1.0},
     {2.5e-201, 0.0, 5e-201}},
    {{3.0, 0.5, -0.7},
     {0.010347488701438872, 0.9612105413779408, 0.1602017568963235, -0.22428245965485286},
     {0.8480655507570012, 0.31261675538644373, -0.42784995719396385, 0.3033337145176057,
      -0.9484566531298098, -0.0917531185886968, -0.4344807006717053, -0.05196865772224806,
      -0.8991806155374857},
     {0.9513662894469587, 0.15856104824115977, -0.22198546753762366}},
    {{0.0, 3.141592653589793, 0.0},
     {6.123233995736766e-17, 0.0, 1.0, 0.0},
     {-1.0, 0.0, 1.2246467991473532e-16, 0.0, 1.0, 0.0, -1.2246467991473532e-16, 0.0, -1.0},
     {0.0, 0.9999999999999999, 0.0}},
    {{1.8137993642342178, 1.8137993642342178, 1.8137993642342178},
     {1.188843862245781e-17, 0.5773502691896257, 0.5773502691896257, 0.5773502691896257},
     {-0.3333333333333333, 0.6666666666666666, 0.6666666666666666, 0.6666666666666666,
      -0.3333333333333333, 0.6666666666666666, 0.6666666666666666, 0.6666666666666666,
      -0.3333333333333333},
     {0.5773502691896257, 0.5773502691896257, 0.5773502691896257}},
};
enum { KNOWN = sizeof known / sizeof *known };

static double difference(int n, const double x[], const double y[]) {
  double max = 0.0;
  for (int i = 0; i < n; i++) max = fmax(max, fabs(x[i] - y[i]));
  return max;
}

/* q and -q are one attitude. */
static double off(const double p[4], const double q[4]) {
  const double minus[4] = {-q[0], -q[1], -q[2], -q[3]};
  return fmin(difference(4, p, q), difference(4, p, minus));
}

static void check_known(void) {
  for (int i = 0; i < KNOWN; i++) {
    const struct known *k = &known[i];
    double q[4], x[9], largest = 0.0;
    ROT_CHECK(rot_attitude_from(ROT_FORM_VECTOR, k->vector, NULL, q) == 0.0);
    ROT_CHECK(off(q, k->q) <= 4.0 * ROT_EPS);
    for (int c = 1; c < 4; c++) {
      if (fabs(k->q[c]) < 1e-3) ROT_CHECK_ULP(q[c], k->q[c], 4); /* small ones are relative */
    }
    ROT_CHECK(rot_attitude_from(ROT_FORM_MATRIX, k->r, NULL, q) <= 0.0);
    ROT_CHECK(off(q, k->q) <= 6.0 * ROT_EPS);
    ROT_CHECK(rot_attitude_from(ROT_FORM_RODRIGUES, k->p, NULL, q) == 0.0);
    ROT_CHECK(off(q, k->q) <= 4.0 * ROT_EPS);
    rot_attitude_to(ROT_FORM_MATRIX, k->q, NULL, x);
    ROT_CHECK(difference(9, x, k->r) <= 8.0 * ROT_EPS);
    rot_attitude_to(ROT_FORM_VECTOR, k->q, NULL, x);
    for (int c = 0; c < 3; c++) largest = fmax(largest, fabs(k->vector[c]));
    ROT_CHECK(difference(3, x, k->vector) <= 8.0 * ROT_EPS * largest);
    rot_attitude_to(ROT_FORM_RODRIGUES, k->q, NULL, x);
    ROT_CHECK(difference(3, x, k->p) <= 4.0 * ROT_EPS);
    double axis[4];
    rot_attitude_to(ROT_FORM_AXIS_ANGLE, k->q, NULL, axis);
    for (int c = 0; c < 3; c++) x[c] = axis[c] * axis[3];
    ROT_CHECK(difference(3, x, k->vector) <= 8.0 * ROT_EPS * largest);
    axis[0] *= 3e7, axis[1] *= 3e7, axis[2] *= 3e7; /* its length has no effect */
    ROT_CHECK(rot_attitude_from(ROT_FORM_AXIS_ANGLE, axis, NULL, q) == 0.0);
    ROT_CHECK(off(q, k->q) <= 6.0 * ROT_EPS);
  }
}

/* The product of rotation matrices about single axes, without quaternions. */
static void matrix_of(const rot_euler *s, const double angle[3], double out[9]) {
  double r[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int n = 0; n < 3; n++) {
    const int a = s->axis[n], b = (a + 1) % 3, c = (a + 2) % 3;
    double one[9] = {0.0}, p[9];
    one[4 * a] = 1.0;
    one[4 * b] = one[4 * c] = cos(angle[n]);
    one[3 * b + c] = -sin(angle[n]);
    one[3 * c + b] = sin(angle[n]);
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) {
        p[3 * i + k] = 0.0;
        for (int j = 0; j < 3; j++) {
          p[3 * i + k] +=
              s->intrinsic ? r[3 * i + j] * one[3 * j + k] : one[3 * i + j] * r[3 * j + k];
        }
      }
    }
    memcpy(r, p, sizeof r);
  }
  memcpy(out, r, sizeof r);
}

static double draw(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

static void check_sequences(void) {
  const double pi = 0x1.921fb54442d18p+1;
  uint64_t seed = 24;
  int sequences = 0;
  double worst = 0.0, locked = 0.0;
  for (int code = 0; code < 54; code++) {
    const rot_euler s = {{code % 3, code / 3 % 3, code / 9 % 3}, code / 27};
    if (s.axis[0] == s.axis[1] || s.axis[1] == s.axis[2]) continue;
    const int same = s.axis[0] == s.axis[2];
    sequences++;
    for (int i = 0; i < 200; i++) {
      double x[3], r[9], q[4], p[4], back[3];
      /* the middle angle: anywhere, next to the lock by 1e-1 to 1e-20, at it */
      const double near = i < 100 ? 3.0 * (draw(&seed) - 0.5) : pow(10.0, -(i % 20) - 1.0);
      x[0] = 2.0 * pi * (draw(&seed) - 0.5);
      x[2] = 2.0 * pi * (draw(&seed) - 0.5);
      x[1] = i < 100 ? (same ? 0.5 * pi + near : near)
             : i % 2 ? (same ? near : 0.5 * pi - near)
                     : (same ? pi - near : near - 0.5 * pi);
      if (i >= 190) x[1] = i % 2 ? (same ? 0.0 : 0.5 * pi) : (same ? pi : -0.5 * pi);
      matrix_of(&s, x, r);
      ROT_CHECK(rot_attitude_from(ROT_FORM_EULER, x, &s, q) == 0.0);
      double m[9];
      rot_attitude_to(ROT_FORM_MATRIX, q, NULL, m);
      ROT_CHECK(difference(9, m, r) <= 12.0 * ROT_EPS);
      const int lock = rot_attitude_to(ROT_FORM_EULER, q, &s, back);
      ROT_CHECK(rot_attitude_from(ROT_FORM_EULER, back, &s, p) == 0.0);
      worst = fmax(worst, rot_attitude_angle(p, q)); /* at and next to the lock, too */
      ROT_CHECK(same ? back[1] >= 0.0 && back[1] <= pi : fabs(back[1]) <= 0.5 * pi);
      ROT_CHECK(fabs(back[0]) <= pi && fabs(back[2]) <= pi);
      if (i < 100) {
        ROT_CHECK(!lock && difference(3, x, back) <= 200.0 * ROT_EPS);
      } else if (i >= 190) {
        ROT_CHECK(lock && back[2] == 0.0);
      } else {
        ROT_CHECK(lock == (near <= 1.0e-7) || fabs(near - 1e-7) < 1e-14);
        locked += lock;
      }
    }
  }
  printf("24 sequences: round trips to %.1e rad, %g locked\n", worst, locked);
  ROT_CHECK_EQ_INT(sequences, 24);
  ROT_CHECK(worst <= 24.0 * ROT_EPS);
}

/* Yaw, pitch and roll by their textbook formulas (Goldstein's x-y-z convention). */
static void check_yaw_pitch_roll(void) {
  const rot_euler zyx = {{2, 1, 0}, 1};
  const double x[3] = {0.3, 0.1, -0.2};
  double q[4], r[9];
  rot_attitude_from(ROT_FORM_EULER, x, &zyx, q);
  rot_attitude_to(ROT_FORM_MATRIX, q, NULL, r);
  ROT_CHECK_REL(r[0], cos(0.1) * cos(0.3), 1e-15);
  ROT_CHECK_REL(r[3], cos(0.1) * sin(0.3), 1e-15);
  ROT_CHECK_REL(r[6], -sin(0.1), 1e-15);
  ROT_CHECK_REL(r[7], cos(0.1) * sin(-0.2), 1e-15);
  ROT_CHECK_REL(r[8], cos(0.1) * cos(-0.2), 1e-15);
}

static void check_faults(void) {
  double q[4] = {0.0, 0.0, 0.0, 0.0};
  ROT_CHECK(rot_attitude_unit(q) == 0.0 && isnan(q[0]));
  double endless[4] = {INFINITY, 0.0, 1.0, 0.0};
  ROT_CHECK(isinf(rot_attitude_unit(endless)));
  for (int i = 0; i < 4; i++) ROT_CHECK(isnan(endless[i]));
  double big[4] = {3e200, 0.0, -4e200, 0.0}, small[4] = {3e-320, 0.0, -4e-320, 0.0};
  ROT_CHECK_REL(rot_attitude_unit(big), 5e200, 1e-15);
  ROT_CHECK_REL(big[2], -0.8, 1e-15);
  rot_attitude_unit(small);
  ROT_CHECK_REL(small[2], -0.8, 1e-3);
  const double mirror[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1};
  ROT_CHECK(isinf(rot_attitude_from(ROT_FORM_MATRIX, mirror, NULL, q)));
  const double rough[9] = {1, 1e-7, 0, 0, 1, 0, 0, 0, 1};
  const double said = rot_attitude_from(ROT_FORM_MATRIX, rough, NULL, q);
  ROT_CHECK_REL(said, 1e-7, 1e-6);
  ROT_CHECK_REL(rot_attitude_angle(q, (const double[]){1, 0, 0, 0}), 0.5e-7, 1e-6);
  const double two[4] = {2.0, 0.0, 0.0, 0.0};
  ROT_CHECK(rot_attitude_from(ROT_FORM_QUATERNION, two, NULL, q) == 1.0 && q[0] == 1.0);
}

/* The angle of slerp grows evenly; q and -q are the same. */
static void check_slerp(void) {
  const double *p = known[0].q, *q = known[1].q;
  const double minus[4] = {-q[0], -q[1], -q[2], -q[3]};
  const double whole = rot_attitude_angle(p, q);
  for (int i = -4; i <= 12; i++) {
    double at[4], other[4];
    rot_attitude_slerp(p, q, i / 8.0, at);
    rot_attitude_slerp(p, minus, i / 8.0, other);
    ROT_CHECK(off(at, other) <= 4.0 * ROT_EPS);
    if (i >= 0 && i <= 8) {
      ROT_CHECK(fabs(rot_attitude_angle(p, at) - whole * i / 8.0) <= 8.0 * ROT_EPS);
    }
  }
  double near[4], at[4];
  rot_attitude_from(ROT_FORM_VECTOR, (const double[]){0.0, 2e-12, 0.0}, NULL, near);
  rot_attitude_slerp((const double[]){1, 0, 0, 0}, near, 0.25, at);
  ROT_CHECK_REL(at[2], 2.5e-13, 1e-14);
}

/* Vectors to space and back, the product, against the matrix. */
static void check_turns(void) {
  const double v[3] = {0.3, -1.2, 2.0};
  for (int i = 0; i < KNOWN; i++) {
    double s[3], b[3], r[3];
    for (int k = 0; k < 3; k++) {
      r[k] = known[i].r[3 * k] * v[0] + known[i].r[3 * k + 1] * v[1] + known[i].r[3 * k + 2] * v[2];
    }
    rot_attitude_to_space(known[i].q, v, s);
    rot_attitude_to_body(known[i].q, s, b);
    ROT_CHECK(difference(3, s, r) <= 16.0 * ROT_EPS && difference(3, b, v) <= 24.0 * ROT_EPS);
    double pq[4], first[3], both[3];
    rot_attitude_times(known[0].q, known[i].q, pq);
    rot_attitude_to_space(known[0].q, s, first);
    rot_attitude_to_space(pq, v, both);
    ROT_CHECK(difference(3, first, both) <= 32.0 * ROT_EPS);
  }
}

int main(void) {
  check_known();
  check_sequences();
  check_yaw_pitch_roll();
  check_faults();
  check_slerp();
  check_turns();
  return rot_test_report("attitude");
}
