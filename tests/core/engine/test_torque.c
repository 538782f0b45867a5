/* Torque laws of knots: pieces, their search, and values against exact rational arithmetic. */
#include "engine/torque.h"
#include "ground/real.h"
#include "rot_test.h"

/* A ramp, a jump at 2 s, a fall through zero, and a jump at the last knot. */
static const double knot_s[] = {1.0, 2.0, 2.0, 5.0, 5.0};
static const double knot_n_m[] = {3.0, 7.0, -4.0, 8.0, 2.0};

static rot_torque ramp(void) {
  rot_torque torque = {5, knot_s, knot_n_m, -11.0, 13.0, NULL, NULL};
  return torque;
}

static rot_torque constant(double value) {
  rot_torque torque = {0, NULL, NULL, value, -99.0, NULL, NULL};
  return torque;
}

static void check_piece(rot_torque_piece piece, double start_s, double end_s, double start_n_m,
                        double end_n_m) {
  ROT_CHECK(piece.start_s == start_s);
  ROT_CHECK(piece.end_s == end_s);
  ROT_CHECK(piece.start_n_m == start_n_m);
  ROT_CHECK(piece.end_n_m == end_n_m);
}

static void check_pieces(void) {
  const rot_torque torque = ramp();
  check_piece(rot_torque_piece_at(&torque, 0), -INFINITY, 1.0, -11.0, -11.0);
  check_piece(rot_torque_piece_at(&torque, 1), 1.0, 2.0, 3.0, 7.0);
  check_piece(rot_torque_piece_at(&torque, 2), 2.0, 2.0, 7.0, -4.0);
  check_piece(rot_torque_piece_at(&torque, 3), 2.0, 5.0, -4.0, 8.0);
  check_piece(rot_torque_piece_at(&torque, 4), 5.0, 5.0, 8.0, 2.0);
  check_piece(rot_torque_piece_at(&torque, 5), 5.0, INFINITY, 13.0, 13.0);
}

/* A constant has no knot: one piece from -Inf to +Inf. */
static void check_no_knots(void) {
  const rot_torque torque = constant(-3.0);
  check_piece(rot_torque_piece_at(&torque, 0), -INFINITY, INFINITY, -3.0, -3.0);
  ROT_CHECK_EQ_INT(rot_torque_find(&torque, 5.0, 1), 0);
  ROT_CHECK_EQ_INT(rot_torque_find(&torque, -5.0, 0), 0);
  ROT_CHECK(rot_torque_at(&torque, 0.0) == -3.0);
  ROT_CHECK(rot_torque_at(&torque, -1e300) == -3.0);
  ROT_CHECK(rot_torque_at(&torque, 1e300) == -3.0);
}

static void check_one_knot(void) {
  const rot_torque torque = {1, knot_s, knot_n_m, -2.0, 5.0, NULL, NULL};
  check_piece(rot_torque_piece_at(&torque, 0), -INFINITY, 1.0, -2.0, -2.0);
  check_piece(rot_torque_piece_at(&torque, 1), 1.0, INFINITY, 5.0, 5.0);
  ROT_CHECK(rot_torque_at(&torque, 0.5) == -2.0);
  ROT_CHECK(rot_torque_at(&torque, 1.0) == 3.0);
  ROT_CHECK(rot_torque_at(&torque, 1.5) == 5.0);
}

/* Between knots the direction does not matter; at a knot it decides. */
static void check_find(void) {
  const rot_torque torque = ramp();
  static const struct {
    double t;
    int forward, backward;
  } row[] = {{-1e300, 0, 0}, {0.9, 0, 0}, {1.0, 1, 0}, {1.5, 1, 1}, {2.0, 3, 1},
             {2.1, 3, 3},    {4.9, 3, 3}, {5.0, 5, 3}, {5.1, 5, 5}, {1e300, 5, 5}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    ROT_CHECK_EQ_INT(rot_torque_find(&torque, row[i].t, 1), row[i].forward);
    ROT_CHECK_EQ_INT(rot_torque_find(&torque, row[i].t, 0), row[i].backward);
  }
}

/* The search halves its way through many knots: every knot and every gap. */
static void check_find_among_many(void) {
  enum { N = 37 };
  double time_s[N], torque_n_m[N];
  for (int i = 0; i < N; i++) time_s[i] = 3.0 * i, torque_n_m[i] = 2.0 * i;
  for (size_t n = 1; n <= N; n++) {
    const rot_torque torque = {n, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};
    for (size_t i = 0; i < n; i++) {
      ROT_CHECK_EQ_INT(rot_torque_find(&torque, time_s[i], 1), i + 1);
      ROT_CHECK_EQ_INT(rot_torque_find(&torque, time_s[i], 0), i);
      ROT_CHECK_EQ_INT(rot_torque_find(&torque, time_s[i] + 1.0, 1), i + 1);
      ROT_CHECK_EQ_INT(rot_torque_find(&torque, time_s[i] + 1.0, 0), i + 1);
    }
  }
}

/* After the jump at a jump, the last knot's at the last knot, `after` only beyond it. */
static void check_values(void) {
  const rot_torque torque = ramp();
  static const double row[][2] = {{-5.0, -11.0}, {0.999, -11.0}, {1.0, 3.0},    {1.25, 4.0},
                                  {1.75, 6.0},   {2.0, -4.0},    {2.5, -2.0},   {3.0, 0.0},
                                  {4.0, 4.0},    {5.0, 2.0},     {5.001, 13.0}, {1e9, 13.0}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    ROT_CHECK_ULP(rot_torque_at(&torque, row[i][0]), row[i][1], 0);
  }
}

/* A piece of its own knows both its ends, even where they are a jump at one time. */
static void check_ends_of_piece(void) {
  const rot_torque_piece piece = {0.1, 0.7, 0.3, -0.9}, jump = {2.0, 2.0, 7.0, -4.0};
  ROT_CHECK(rot_torque_in_piece(&piece, 0.1) == 0.3);
  ROT_CHECK(rot_torque_in_piece(&piece, 0.7) == -0.9);
  ROT_CHECK(rot_torque_in_piece(&jump, 2.0) == 7.0);
  const rot_torque_piece outer = {5.0, INFINITY, 13.0, 13.0};
  ROT_CHECK(rot_torque_in_piece(&outer, 1e300) == 13.0);
}

/* Knots that stand almost on each other: two steps of 1 ulp, and values all between the ends. */
static void check_close_knots(void) {
  const double time_s[] = {1.0, 1.0 + 1e-15, 2.0}, torque_n_m[] = {2.0, 3.0, 5.0};
  const rot_torque torque = {3, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};
  ROT_CHECK(rot_torque_at(&torque, 1.0) == 2.0);
  double t = 1.0, last = 2.0;
  for (int i = 0; i < 5; i++) { /* 1e-15 is 4.5 ulp above 1: five of them after rounding */
    t = nextafter(t, 2.0);
    const double now = rot_torque_at(&torque, t);
    ROT_CHECK(now > last && now <= 3.0);
    ROT_CHECK_ULP(now, 2.0 + (t - 1.0) / (time_s[1] - 1.0), 2);
    last = now;
  }
  ROT_CHECK(t == time_s[1] && last == 3.0);
  ROT_CHECK(rot_torque_at(&torque, 1.5) > 3.99 && rot_torque_at(&torque, 1.5) < 4.01);
}

/* start, end, torque at both, time, exact torque. The lower half lies next to a zero crossing,
 * where plain interpolation has no correct digit. */
static void check_exact_values(void) {
  static const struct {
    rot_torque_piece piece;
    double t, want;
  } row[] = {
      {{0.0, 3.0, 2.0, 5.0}, 1.0, 3},
      {{0.0, 3.0, -2.0, -5.0}, 1.0, -3},
      {{0.0, 3.0, 5.0, 2.0}, 2.5, 2.5},
      {{0.1, 0.7, 0.3, 0.9}, 0.2, 0.40000000000000000833},
      {{0.1, 0.7, 0.3, 0.0}, 0.6999999999999998, 5.5511151231257829589e-17},
      {{0.1, 0.7, 0.0, -0.3}, 0.10000000000000002, -6.9388939039072286986e-18},
      {{1000000000000000.0, 1000000000000001.0, 2.0, 3.0}, 1000000000000000.5, 2.5},
      {{1.0, 1.000000000000001, 2.0, 3.0}, 1.0000000000000004, 2.4},
      {{1000000.0, 1000000.000000003, -2.0, 7.0}, 1000000.000000001, 1.1153846153846153846},
      {{-1e300, 1e300, 2.0, 6.0}, 5e299, 5},
      {{-3e-300, 5e-300, 2.0, 6.0}, 1e-300, 4.0000000000000000829},
      {{0.0, 3.0, 2e300, 5e300}, 1.0, 3.0000000000000001575e300},
      {{0.0, 3.0, 2e-300, 5e-300}, 1.0, 3.0000000000000000199e-300},
      {{0.0, 3.0, -1e300, 1e-300}, 2.9, -3.3333333333333364689e298},
      {{0.0, 3.0, -2.0, 5.0}, 1.0, 0.33333333333333333333},
      {{0.1, 0.7, -0.3, 0.9}, 0.2, -0.099999999999999959292},
      {{0.1, 0.7, -0.3, 0.9}, 0.3, 0.10000000000000001480},
      {{90.47591070196373, 400.7072585984197, -506.6490885396089, 0.006286463459649072},
       400.70340931914853,
       -8.9382660084052322207e-14},
      {{95.15264724177526, 397.16502971508424, 0.005019338374812986, -181.60348374265544},
       95.16099433078979,
       1.0499250320379083033e-14},
      {{126.8905565766697, 625.4374307685258, -6.885302801804563, 6.850638765226654},
       376.7930603804916,
       6.6351580532857914472e-16},
      {{0.01663403250699956, 0.020752767158703427, 8.916084752809159, -0.12707433030230972},
       0.02069489076365741,
       -8.5660582187360255979e-15},
      {{0.08810622333133136, 0.27148216568105765, -54.97958369861124, 17.64898852377898},
       0.22692119190674817,
       1.1436172138077541973e-14},
      {{81.35574757703571, 405.3802041267588, 0.07370286593481545, -7.82191044142092},
       84.38040571960676,
       -3.7386365465450880109e-16},
      {{5.950382456516468, 24.203113204872533, -0.019702279464844808, 0.00044786217853534107},
       23.797423363984322,
       -3.2004014523114225685e-18},
      {{0.00010898741111409205, 0.0005132106209521872, 52.29885484122998, -0.0004576819492713531},
       0.0005132070835124447,
       1.3138998954998905760e-14},
      {{1258.9098244680483, 2626.5952380949675, 0.00038008866607641467, -967.6685949343877},
       1258.9103616783318,
       6.4443337941976246798e-14},
      {{269.19293770772134, 380.4166685675827, 0.5184458614686084, -2.5991031537852956},
       287.68935353927714,
       -2.1711206285790937395e-16},
      {{0.08948497550020432, 0.4421696762785926, 0.4773074461470813, -0.20485718887573506},
       0.33625683258723965,
       -1.9348082086544935464e-17},
      {{0.09418170123542957, 0.20941669972082827, 0.28963919929099546, -9.962521483670116},
       0.09743726596210041,
       1.3924976308895049913e-15},
      {{0.011539196685006135, 0.057203418656693684, 0.0004973875130150452, -0.07954207207955409},
       0.011822966889301385,
       -2.1292700320339859861e-18},
      {{0.007723399113625072, 0.010577716570929834, 0.0113958166101243, -0.4345336419339054},
       0.007796341767821373,
       6.5419745579179527105e-17},
      {{-1.0, 1.0, -3.0, 3.0}, 1e-300, 3.0000000000000000752e-300},
      {{-1.0, 1.0, 3.0, -3.0}, 1e-17, -3.0000000000000002146e-17},
      {{-2.0, 1.0, -3.0, 1.5}, 1e-25, 1.5000000000000000577e-25},
  };
  double worst = 0.0;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    const rot_torque_piece p = row[i].piece,
                           reversed = {-p.end_s, -p.start_s, p.end_n_m, p.start_n_m};
    const rot_torque_piece negated = {p.start_s, p.end_s, -p.start_n_m, -p.end_n_m};
    ROT_CHECK_ULP(rot_torque_in_piece(&p, row[i].t), row[i].want, 3);
    ROT_CHECK_ULP(rot_torque_in_piece(&reversed, -row[i].t), row[i].want, 3);
    ROT_CHECK_ULP(rot_torque_in_piece(&negated, row[i].t), -row[i].want, 3);
    worst = fmax(worst, rot_test_ulp(rot_torque_in_piece(&p, row[i].t), row[i].want));
  }
  printf("rot_torque_in_piece: worst %g ulp\n", worst);
}

/* A crossing at zero time can be met to any depth; what is left is the square of the roundoff. */
static void check_deep_crossing(void) {
  const rot_torque_piece piece = {-1.0, 1.1, -1.0, 1.1}; /* torque = t */
  for (double t = 1e-3; t > 1e-40; t *= 0.1) {
    ROT_CHECK(fabs(rot_torque_in_piece(&piece, t) - t) <= 2.0 * ROT_EPS * t + ROT_EPS * ROT_EPS);
    ROT_CHECK(fabs(rot_torque_in_piece(&piece, -t) + t) <= 2.0 * ROT_EPS * t + ROT_EPS * ROT_EPS);
  }
  ROT_CHECK(fabs(rot_torque_in_piece(&piece, 0.0)) <= ROT_EPS * ROT_EPS);
}

/* An end of zero keeps its zero, and one of no torque at all stays so. */
static void check_zero_ends(void) {
  const rot_torque_piece falling = {0.0, 3.0, 6.0, 0.0}, rising = {0.0, 3.0, 0.0, 6.0};
  const rot_torque_piece nothing = {0.0, 3.0, 0.0, 0.0};
  ROT_CHECK_ULP(rot_torque_in_piece(&falling, 1.0), 4.0, 0);
  ROT_CHECK_ULP(rot_torque_in_piece(&rising, 1.0), 2.0, 0);
  ROT_CHECK(rot_torque_in_piece(&rising, 1e-300) == 2e-300);
  ROT_CHECK(rot_torque_in_piece(&nothing, 1.0) == 0.0);
}

int main(void) {
  check_pieces();
  check_no_knots();
  check_one_knot();
  check_find();
  check_find_among_many();
  check_values();
  check_ends_of_piece();
  check_close_knots();
  check_exact_values();
  check_deep_crossing();
  check_zero_ends();
  return rot_test_report("torque");
}
