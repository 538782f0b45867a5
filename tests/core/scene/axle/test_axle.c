/* The axle's closed forms: theta and omega against 90-digit values, the bounds against the true
 * errors, the several ways to compute a row against each other, and every way a run can end. */
#include <stdlib.h>

#include "axle_scenes.h"
#include "scene/axle/linear.h"
#include "maths/phi.h"
#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

enum { MAX_ROWS = 32768, COLUMNS = 7, ROWS_PER_POLL = 8192 };

/* ---- scenes with known answers -------------------------------------------------------------- */

/* The bounds are in units of roundoff: 12 (24 where c < 0) times the terms added, and |theta|. */
typedef struct known {
  double t, theta, omega, applied, theta_bound, omega_bound;
} known;

/* constant torque, no resistance */
static const known of_constant_free[] = {
    {-1.0, 14.5, -10.0, 6.0, 182.5, 120.0}, {0.0, 6.0, -7.0, 6.0, 72.0, 84.0},
    {1.0, 0.5, -4.0, 6.0, 0.0, 0.0},        {2.0, -2.0, -1.0, 6.0, 68.0, 84.0},
    {3.0, -1.5, 2.0, 6.0, 169.5, 120.0},    {11.0, 110.5, 26.0, 6.0, 2390.5, 408.0},
};
/* a ramp, no resistance */
static const known of_ramp_free[] = {
    {-2.0, -5.75, 3.0, 0.0, 77.75, 36.0},
    {0.0, 0.25, 3.0, 0.0, 0.0, 0.0},
    {1.0, 3.58333333333333333, 4.0, 4.0, 43.5833, 48.0},
    {2.0, 8.91666666666666667, 7.0, 8.0, 112.917, 84.0},
    {3.0, 18.25, 12.0, 12.0, 234.25, 144.0},
    {4.0, 31.5, 14.5, 5.0, 568.75, 318.0},
};
/* coasting */
static const known of_coasting[] = {
    {-2.0, -63.1184564106255591, 100.427684615938339, 0.0, 826.54, 1205.13},
    {-0.1, -0.0394474757609437743, 5.80917121364141566, 0.0, 6.51282, 69.7101},
    {0.0, 0.5, 5.0, 0.0, 0.0, 0.0},
    {1e-09, 0.500000004999999996, 4.99999999250000001, 0.0, 0.5, 60.0},
    {0.1, 0.964306745249807333, 4.303539882125289, 0.0, 6.53599, 51.6425},
    {0.3, 1.70790616126075565, 3.18814075810886652, 0.0, 16.2028, 38.2577},
    {0.5, 2.25877815752995098, 2.36183276370507354, 0.0, 23.3641, 28.342},
    {1.0, 3.08956613283856724, 1.11565080074214914, 0.0, 34.1644, 13.3878},
    {1.999, 3.66712731663705541, 0.249309025044416878, 0.0, 41.6727, 2.99171},
    {2.0, 3.66737643877378686, 0.248935341839319715, 0.0, 41.6759, 2.98722},
    {2.5, 3.75494084714663631, 0.117588729280045541, 0.0, 42.8142, 1.41106},
    {10.0, 3.83333231365893166, 1.52951160250912894e-6, 0.0, 43.8333, 1.83541e-5},
    {400.0, 3.83333333333333333, 1.32519827650215541e-260, 0.0, 43.8333, 1.59024e-259},
};
/* constant torque against resistance */
static const known of_constant_damped[] = {
    {-1.0, 0.5, 7.0, 4.0, 0.0, 0.0},
    {-0.99, 0.569577117055096674, 6.91563432441735501, 4.0, 1.4045, 82.9876},
    {-0.9, 1.15954764461644815, 6.21067853307532774, 4.0, 9.07412, 74.5281},
    {-0.5, 3.15994857853394444, 4.01007713219908334, 4.0, 35.0793, 48.1209},
    {0.3, 5.47363128511761537, 2.13955307232357692, 4.0, 65.1572, 25.6746},
    {0.9, 6.59258812113949918, 1.66111781829075128, 4.0, 79.7036, 19.9334},
    {0.999, 6.75474429218866277, 1.61588356171700584, 4.0, 81.8117, 19.3906},
    {1.0, 6.7563599639436251, 1.61546005408456234, 4.0, 81.8327, 19.3855},
    {1.001, 6.75797521250842678, 1.6150371812373596, 4.0, 81.8537, 19.3804},
    {3.0, 9.60174693622148265, 1.34737959566777603, 4.0, 118.823, 16.1686},
    {20.0, 32.2777777777776989, 1.33333333333345165, 4.0, 413.611, 16.0},
    {1000000.0, 1.33333894444444444e6, 1.33333333333333333, 4.0, 1.73334e7, 16.0},
};
/* ramps, a jump and a pulse */
static const known of_pulse[] = {
    {-3.0, 11.0012411456657813, -12.0433890624281928, 2.0, 620.795, 415.476},
    {-1.0, -0.795463172984842602, -1.27337292586363916, 2.0, 105.1, 130.267},
    {0.0, -0.586501101415401594, 1.49421475774945773, 1.0, 13.2924, 39.0454},
    {0.2, -0.268605913688109376, 1.70083110586633253, 1.40000000000000002, 5.86877, 31.8858},
    {0.4, 0.100000000000000006, 2.0, 1.80000000000000004, 0.0, 0.0},
    {0.7, 0.786394608573379253, 2.60583088203998016, 2.39999999999999991, 9.02313, 31.27},
    {1.5, 3.75732914751180867, 4.98971607963779648, 4.0, 47.6453, 59.8766},
    {2.0, 6.72534615534943459, 6.93199450485024268, -3.0, 86.2295, 83.1839},
    {2.5, 9.48690313488398497, 4.49847008504972098, -0.5, 174.891, 147.436},
    {2.6, 9.9249036894978561, 4.27504127592949049, 4.44089209850062616e-16, 189.789, 141.667},
    {2.9, 11.1595272858795284, 4.0673454489087736, 1.49999999999999956, 236.853, 141.312},
    {3.0, 11.5694099585256519, 4.14168144634614945, 0.0, 252.935, 142.738},
    {4.0, 14.9378761979962794, 2.69805305800159475, 0.0, 424.385, 125.362},
    {5.9, 18.4447252698232772, 1.19511774150430997, 0.0, 590.833, 55.5297},
    {6.0, 18.5617122739730886, 1.14498045401153365, 20.0, 596.386, 53.2002},
    {6.1, 18.8146294742363123, 3.89373022532728495, 20.0, 623.443, 97.6931},
    {6.25, 19.6949616729802723, 7.80215928300845535, 0.0, 642.292, 141.421},
    {7.0, 24.8343800696323396, 6.18396698314458234, 1.09090909090909091, 819.507, 176.754},
    {8.0, 30.8549132019727087, 6.2011410952584502, 2.54545454545454545, 981.176, 141.216},
    {9.0, 37.7945833276617292, 7.90232143100211699, 4.0, 1125.72, 138.346},
    {12.0, 64.2531224729143585, 9.42009036875099066, 3.0, 1741.04, 151.287},
    {17.0, 113.058747200145707, 9.93196548565184209, 3.0, 2454.29, 123.671},
    {40.0, 342.900008313871827, 9.99999643691208024, 3.0, 5452.69, 120.0},
};
/* all signs positive, z up to 1 */
static const known of_positive[] = {
    {0.001, 2.00500012503263875, 5.00025009791612269, 1.0006, 2.065, 60.003},
    {1.0, 7.15750334558019526, 5.34737494424033007, 1.6, 69.0475, 64.1685},
    {2.0, 12.7589496111503437, 5.88735083981416093, 2.2, 141.866, 70.6482},
    {5.0, 34.1212611796266141, 8.63131231367288974, 4.0, 419.576, 103.576},
    {9.0, 80.052597220054754, 14.799123379665754, 6.4, 1016.68, 177.589},
    {11.0, 113.586229201311838, 18.7235628466448026, 6.5, 1748.01, 422.592},
    {13.0, 154.481314492165392, 22.0419780917972433, 5.5, 2668.94, 455.925},
    {17.0, 252.372094219503029, 26.4104650963416159, 3.5, 4682.24, 496.001},
    {25.0, 477.131602681560939, 29.7200288441962061, 3.16666666666666667, 10879.7, 820.275},
    {30.0, 634.131150708625033, 33.3533697104118044, 4.33333333333333333, 15144.9, 826.805},
    {45.0, 1267.70642279270945, 53.2104485090103968, 7.83333333333333333, 29042.7, 970.734},
    {60.0, 2273.34684545004246, 80.4775525758326235, 9.0, 54981.8, 1858.59},
};
/* torque far from its start */
static const known of_far[] = {
    {0.01, 7.43797149507740196e-5, 0.0148143007126230653, 3.0001, 9.66936e-4, 0.177772},
    {0.3, 0.0533868153609664015, 0.31675796159758398, 3.003, 0.694029, 3.8011},
    {1.19, 0.487019148982115696, 0.570992377544710681, 3.0119, 6.33125, 6.85191},
    {1.2, 0.492732964546409604, 0.571767588633975922, 3.012, 6.40553, 6.86121},
    {1.3, 0.550263402133107157, 0.578566494667232174, 3.013, 7.15342, 6.9428},
    {2.0, 0.964334951136740805, 0.599162622158147988, 3.02, 12.5364, 7.18995},
    {50.0, 32.22032, 0.6992, 3.5, 418.864, 8.3904},
    {99.0, 68.88212, 0.7972, 3.99, 895.468, 9.5664},
    {100.0, 69.68032, 0.7992, 4.0, 905.844, 9.5904},
    {100.5, 70.0818930062301043, 0.809642484424739346, 4.115, 983.482, 12.4634},
    {150.0, 166.26736, 3.0816, 15.5, 2234.99, 36.9792},
    {200.0, 377.84736, 5.3816, 27.0, 4985.53, 64.5792},
    {300.0, 1146.00736, 9.9816, 50.0, 14971.6, 119.779},
    {1000.0, 8146.0, 10.0, 50.0, 1.07165e5, 120.0},
};
/* driven: negative resistance */
static const known of_driven[] = {
    {-6.0, -0.745208142228129104, 0.332187786657806355, -1.0, 48.9488, 8.00727},
    {-3.0, 0.186809671887696682, 0.230214507831545034, -1.0, 23.9591, 8.65426},
    {-2.0, 0.280791213423913725, -0.128813179864129401, 1.0, 14.2537, 7.84068},
    {-1.0, 0.295258036112964776, 0.142887054169447174, 0.0, 5.20907, 3.42929},
    {-0.3, 0.434228882578542627, 0.228843323867813947, -0.700000000000000011, 2.01274, 5.49224},
    {0.0, 0.5, 0.200000000000000011, -1.0, 0.0, 0.0},
    {0.5, 0.554674070136254902, -0.0304888947956176364, -1.5, 6.3913, 21.0549},
    {1.0, 0.396932961105051327, -0.704600558342422998, -2.0, 25.1534, 59.9346},
    {2.0, -1.73853374751822343, -4.15780062127733513, 1.0, 223.351, 389.534},
    {3.0, -10.5681870204569224, -16.1522805306853836, 4.0, 1226.25, 1934.63},
    {5.0, -201.78656295234423, -298.979844428516345, 4.0, 31319.3, 47255.1},
};
/* backward far through negative resistance */
static const known of_driven_backward[] = {
    {-8.0, -1032.05531881315071, -0.0829782197260707863, 0.0, 33493.5, 3.98297},
    {-5.0, -1034.77776412195677, -1.66664618293515513, 5.0, 32372.4, 40.001},
    {0.0, -1043.08642080752498, -1.62963121128747729, 5.0, 32179.5, 41.7629},
    {5.5, -957.772534232330621, 140.091198651504069, 5.0, 27376.8, 6787.82},
    {7.0, -556.676682680281568, 292.984975979577648, -900.0, 13964.4, 7032.81},
    {9.0, -45.933682652827703, 159.099476020758446, -900.0, 1181.01, 3841.8},
    {9.7, -0.446852006425989991, 2.42972199036101466, 1.0, 24.106, 64.1113},
    {10.0, 0.5, 4.0, 1.0, 0.0, 0.0},
};
/* a late start between close knots */
static const known of_close_knots[] = {
    {999.0, 11.8237012905314081, -22.6618506452657031, 2.0, 336.554, 438.999},
    {1000.25, -2.804265967470179, -2.53536701626491031, 2.5, 11.5442, 57.62},
    {1000.5, -3.0, 1.0, 3.0, 0.0, 0.0},
    {1000.75, -3.16431237377949131, -2.04284381310769622, -2.00000000000045475, 16.5963, 56.284},
    {1001.0, -3.89377384185071751, -3.55311307907236723, -1.0, 33.5454, 70.6742},
    {1002.0, -8.82046915448142204, -6.08976542275701469, -1.0, 157.102, 115.943},
};
/* tiny inertia */
static const known of_tiny[] = {
    {0.1, 0.177478091447870902, 1.57256572565638727, 1.10000000000000004e-300, 2.30722, 18.8708},
    {0.9, 0.887767103561629753, 0.641698689315110669, 1.90000000000000014e-300, 11.541, 7.70038},
    {1.1, 1.01684701191037632, 0.654458964268871116, 2.10000000000000023e-300, 13.219, 7.85351},
    {2.0, 1.70223481352493841, 0.893295559425184639, 3.00000000000000024e-300, 22.1291, 10.7195},
    {3.0, 2.66843750042601763, 0.994687498721946993, 3.00000000000000024e-300, 39.7872, 12.4699},
};
/* huge inertia */
static const known of_huge_inertia[] = {
    {0.1, 0.177478091447870903, 1.5725657256563873, 1.10000000000000006e300, 2.30722, 18.8708},
    {0.9, 0.887767103561629783, 0.641698689315110693, 1.90000000000000012e300, 11.541, 7.70038},
    {1.1, 1.01684701191037635, 0.654458964268871133, 2.1000000000000002e300, 13.219, 7.85351},
    {2.0, 1.70223481352493845, 0.893295559425184637, 3.00000000000000016e300, 22.1291, 10.7195},
    {3.0, 2.66843750042601767, 0.994687498721946992, 3.00000000000000016e300, 39.7872, 12.4699},
};
/* long times */
static const known of_long_times[] = {
    {1e280, 2.99999999997857167e280, 2.99999999995714314, 2.00000000000000012e-295, 3.9e281, 36.0},
    {1e289, 2.97867324817432051e289, 2.95744781074036685, 2.00000000000000012e-295, 3.87228e290,
     35.4894},
    {1e290, 2.79556546815215099e290, 2.60063636169254983, 2.00000000000000012e-295, 3.63424e291,
     31.2076},
    {3e290, 7.31979099331588688e290, 1.95432414381201609, 2.00000000000000012e-295, 9.51573e291,
     23.4519},
    {1e292, 2.10018468777135112e291, 2.18746123553399057e-5, 2.00000000000000012e-295, 2.73024e292,
     2.62495e-4},
};
/* settled at once */
static const known of_settled[] = {
    {1e-10, 6.00000000020000022e-11, 0.60000000004, 3.0000000002, 7.8e-10, 7.2},
    {0.1, 0.0620000000000000036, 0.640000000000000002, 3.20000000000000001, 0.806, 7.68},
    {1.0, 0.8, 1.0, 5.0, 10.4, 12.0},
    {2.0, 2.0, 1.4, 7.0, 26.0, 16.8},
    {5.0, 6.2, 1.4, 7.0, 82.6, 16.8},
};
/* hardly any resistance */
static const known of_hardly_damped[] = {
    {0.5, 2.8125, 4.24999999999999999, 5.0, 24.5625, 51.0},
    {3.0, 21.2499999999999999, 10.4999999999999999, 5.0, 264.25, 126.0},
    {7.0, 83.2499999999999989, 20.4999999999999996, 1.0, 1070.25, 246.0},
    {9.0, 125.249999999999998, 21.4999999999999994, 1.0, 2191.5, 504.0},
    {1000.0, 2.66951999999999541e5, 516.999999999998665, 1.0, 3.71473e6, 6450.0},
};
/* coasting through hundreds of time constants */
static const known of_coasting_long[] = {
    {-1500.1, -1.96553972603759807e280, 8.42374168301827766e279, 0.0, 2.5552e281, 1.01085e281},
    {-800.3, -1.10245912440933103e150, 4.72482481889713313e149, 0.0, 1.4332e151, 5.66979e150},
    {-20.7, -86758.790466619016, 37187.3387714081507, 0.0, 1.12786e6, 4.46248e5},
    {-0.3, -2.18165913042012566, 5.93499677018005388, 0.0, 28.3616, 71.22},
    {0.3, 0.958341551336253488, 4.58928219228446278, 0.0, 12.4584, 55.0714},
    {1.1, 4.0665443288043517, 3.2571952876552778, 0.0, 52.8651, 39.0863},
    {5.7, 10.608290544956854, 0.453589766447062455, 0.0, 137.908, 5.44308},
    {20.9, 11.66509803241478, 6.72271822237021767e-4, 0.0, 151.646, 0.00806726},
    {77.7, 11.6666666666666243, 1.80125988686554388e-14, 0.0, 151.667, 2.16151e-13},
    {800.3, 11.6666666666666664, 5.76473753687461827e-149, 0.0, 151.667, 6.91769e-148},
    {1500.1, 11.6666666666666664, 3.23340577306185951e-279, 0.0, 151.667, 3.88009e-278},
};
/* an undriven start */
static const known of_undriven_start[] = {
    {0.2, 1.17782964171250301e-4, 0.00352095015821232209, 0.0500000000000000051, 0.00153118,
     0.0422514},
    {0.3, 9.32317705974995448e-4, 0.013886149554582144, 0.0999999999999999963, 0.0121201, 0.166634},
    {0.65, 0.0186923089158912591, 0.100024724750332336, 0.275000000000000021, 0.243, 1.2003},
    {0.7, 0.0241427252451219284, 0.118224546323519166, 0.299999999999999989, 0.313855, 1.41869},
    {0.8, 0.0378279923313518268, 0.155216574715134963, 0.299999999999999989, 0.654779, 3.22178},
    {2.3, 0.603079685912402485, 0.555822991751827453, 0.299999999999999989, 9.50697, 7.38452},
    {4.3, 2.00649220894061901, 0.811503339025448949, 0.299999999999999989, 28.7112, 10.0413},
    {9.1, 6.42288457143321356, 0.975906612242908358, 0.299999999999999989, 108.566, 12.9943},
};
/* driven through hundreds of time constants */
static const known of_driven_long[] = {
    {-1500.1, 9974.11111111111088, -6.66666666666666691, 2.0, 2.49913e5, 160.0},
    {-20.7, 111.44810459103218, -6.66509803241478053, 2.0, 3346.13, 159.995},
    {0.3, 1.10291943208895648, 6.04410832803812421, 2.0, 27.573, 145.059},
    {1.1, 7.89893747416960385, 11.2424017746441164, 2.0, 197.473, 269.818},
    {5.7, 235.519801473021416, 121.937057774152039, 2.0, 5888.0, 2926.49},
    {20.9, 2.02298511088777646e5, 86763.7904666189933, 2.0, 5.05746e6, 2.08233e6},
    {77.7, 7.55643936244839036e15, 3.23847401247810838e15, 2.0, 1.88911e17, 7.77234e16},
    {300.1, 1.8740688148437613e57, 8.03172349218754865e56, 2.0, 4.68517e58, 1.92761e58},
    {800.3, 2.36109814610752323e150, 1.01189920547465284e150, 2.0, 5.90275e151, 2.42856e151},
    {1500.1, 4.20952768270161424e280, 1.80408329258640615e280, 2.0, 1.05238e282, 4.3298e281},
};
/* a ramp driven through hundreds of time constants */
static const known of_ramp_driven_long[] = {
    {0.3, 1.10408414398903333, 6.06170541301668192, 2.11968545914967345, 27.6021, 145.481},
    {5.7, 287.032343888398917, 157.418633091220113, 5.35119285619085699, 7175.81, 3778.05},
    {20.9, 2.82532814770737003e5, 1.21334851748339129e5, 14.447287751566039, 7.06332e6, 2.91204e6},
    {77.7, 1.05710924112132342e16, 4.53046817623704405e15, 48.4379581500733043, 2.64277e17,
     1.08731e17},
    {300.1, 2.62173143678596113e57, 1.12359918719398337e57, 181.528188724510204, 6.55433e58,
     2.69664e58},
    {800.3, 3.30306186515526226e150, 1.41559794220939815e150, 480.861522057843488, 8.25765e151,
     3.39744e151},
    {1500.1, 5.88892519439295967e280, 2.5238250833112685e280, 899.640943622550898, 1.47223e282,
     6.05718e281},
};
/* backward out of a torque, no resistance */
static const known of_backward_free[] = {
    {-10.0, 20305.0, -1497.0, 0.0, 6.83196e5, 53964.0},
    {0.5, 4586.5, -1497.0, 0.0, 1.00856e5, 53964.0},
    {1.5, 3089.5, -1497.0, 0.0, 50538.5, 36000.0},
    {2.0, 2341.0, -1497.0, 1000.0, 29449.0, 18036.0},
    {3.0, 1094.0, -997.0, 1000.0, 13166.0, 12036.0},
};
/* coasting, but for a breath of torque */
static const known of_breath[] = {
    {0.3, 0.958341551336253488, 4.58928219228446278, 1.00000000000000003e-59, 12.4584, 55.0714},
    {6.9, 11.0338344429967636, 0.271213810144244027, 1.00000000000000003e-59, 143.44, 3.25457},
    {7.3, 11.1335305520443966, 0.228486906266687065, 1.00000000000000003e-59, 144.736, 2.74184},
    {50.3, 11.6666666613772078, 2.26691082606574694e-9, 1.00000000000000003e-59, 151.667,
     2.72029e-8},
    {100.7, 11.6666666666666664, 9.43351680452849692e-19, 1.00000000000000003e-59, 151.667,
     1.13202e-17},
    {233.7, 11.6666666666666664, 1.65915957972435091e-43, 1.00000000000000003e-59, 151.667,
     1.99099e-42},
};

static const struct answers {
  const known *rows;
  size_t n;
} answers[AXLE_SCENES] = {
    [CONSTANT_FREE] = {of_constant_free, 6},
    [RAMP_FREE] = {of_ramp_free, 6},
    [COASTING] = {of_coasting, 13},
    [CONSTANT_DAMPED] = {of_constant_damped, 12},
    [PULSE] = {of_pulse, 23},
    [POSITIVE] = {of_positive, 12},
    [FAR] = {of_far, 14},
    [DRIVEN] = {of_driven, 11},
    [DRIVEN_BACKWARD] = {of_driven_backward, 8},
    [CLOSE_KNOTS] = {of_close_knots, 6},
    [TINY] = {of_tiny, 5},
    [HUGE_INERTIA] = {of_huge_inertia, 5},
    [LONG_TIMES] = {of_long_times, 5},
    [SETTLED] = {of_settled, 5},
    [HARDLY_DAMPED] = {of_hardly_damped, 5},
    [COASTING_LONG] = {of_coasting_long, 11},
    [UNDRIVEN_START] = {of_undriven_start, 8},
    [DRIVEN_LONG] = {of_driven_long, 10},
    [RAMP_DRIVEN_LONG] = {of_ramp_driven_long, 7},
    [BACKWARD_FREE] = {of_backward_free, 5},
    [BREATH] = {of_breath, 6},
};

/* ---- helpers -------------------------------------------------------------------------------- */

static rot_axle_columns split_into_columns(double *values) {
  rot_axle_columns out = {values,
                          values + MAX_ROWS,
                          values + 2 * MAX_ROWS,
                          values + 3 * MAX_ROWS,
                          values + 4 * MAX_ROWS,
                          values + 5 * MAX_ROWS,
                          values + 6 * MAX_ROWS};
  return out;
}

/* Two sets of columns: most tests compare one run with another. */
static rot_axle_columns columns(int which) {
  static double values[2][COLUMNS * MAX_ROWS];
  return split_into_columns(values[which]);
}

static rot_axle_params axle(double inertia, double viscous, double theta0, double omega0,
                            rot_torque torque) {
  rot_axle_params p = {inertia, viscous, 0.0, theta0, omega0, torque};
  return p;
}

static rot_torque constant(double value) {
  rot_torque torque = {0, NULL, NULL, value, value, NULL, NULL};
  return torque;
}

static rot_torque knots(size_t n, const double time_s[], const double torque_n_m[]) {
  rot_torque torque = {n, time_s, torque_n_m, torque_n_m[0], torque_n_m[n - 1], NULL, NULL};
  return torque;
}

/* Theta and omega of one row, with their bounds in *info. */
static void one_row(const rot_axle_params *p, double t, double *theta, double *omega,
                    rot_info *info) {
  rot_axle_columns out = columns(1);
  ROT_CHECK_EQ_INT(rot_axle_linear(p, 1, &t, &out, NULL, info), ROT_OK);
  ROT_CHECK_EQ_INT(info->rows_done, 1);
  *theta = out.theta_rad[0];
  *omega = out.omega_rad_per_s[0];
}

static double theta_at(const rot_axle_params *p, double t) {
  double theta, omega;
  rot_info info;
  one_row(p, t, &theta, &omega, &info);
  return theta;
}

static double omega_at(const rot_axle_params *p, double t) {
  double theta, omega;
  rot_info info;
  one_row(p, t, &theta, &omega, &info);
  return omega;
}

/* ---- known answers -------------------------------------------------------------------------- */

static void check_bound(double bound, double error, double expected) {
  ROT_CHECK(error <= 0.75 * bound || error == 0.0);
  ROT_CHECK(bound >= 0.9 * ROT_EPS * expected);
  ROT_CHECK(bound <= 1.1 * ROT_EPS * expected);
}

/* Each row by itself: value, torque, bound. */
static void check_scene(int scene) {
  const rot_axle_params *p = &axle_scenes[scene].p;
  double worst_theta = 0.0, worst_omega = 0.0;
  const long failed = rot_test_failed;
  for (size_t i = 0; i < answers[scene].n; i++) {
    const known *row = &answers[scene].rows[i];
    rot_axle_columns out = columns(0);
    rot_info info;
    ROT_CHECK_EQ_INT(rot_axle_linear(p, 1, &row->t, &out, NULL, &info), ROT_OK);
    check_bound(info.measure[ROT_THETA].error, fabs(out.theta_rad[0] - row->theta),
                row->theta_bound);
    check_bound(info.measure[ROT_OMEGA].error, fabs(out.omega_rad_per_s[0] - row->omega),
                row->omega_bound);
    ROT_CHECK_ULP(out.applied_torque_n_m[0], row->applied, 3);
    if (axle_scenes[scene].one_sign && row->t >= p->start_s) {
      ROT_CHECK_ULP(out.theta_rad[0], row->theta, 6);
      ROT_CHECK_ULP(out.omega_rad_per_s[0], row->omega, 6);
      worst_theta = fmax(worst_theta, rot_test_ulp(out.theta_rad[0], row->theta));
      worst_omega = fmax(worst_omega, rot_test_ulp(out.omega_rad_per_s[0], row->omega));
    }
  }
  if (worst_theta + worst_omega > 0.0)
    printf("%s: theta %g ulp, omega %g ulp\n", axle_scenes[scene].name, worst_theta, worst_omega);
  if (rot_test_failed > failed) printf("  in the scene: %s\n", axle_scenes[scene].name);
}

/* All rows in one run: as one by one, but for the rounding that their neighbours may turn. */
static void check_scene_together(int scene) {
  const size_t n = answers[scene].n;
  double t[64], theta_error = 0.0, omega_error = 0.0;
  rot_axle_columns out = columns(0);
  rot_info info;
  for (size_t i = 0; i < n; i++) t[i] = answers[scene].rows[i].t;
  ROT_CHECK_EQ_INT(rot_axle_linear(&axle_scenes[scene].p, n, t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.rows_done, n);
  ROT_CHECK(info.time_s == (t[n - 1] < axle_scenes[scene].p.start_s ? t[0] : t[n - 1]));
  for (size_t i = 0; i < n; i++) {
    const known *row = &answers[scene].rows[i];
    double theta, omega;
    rot_info one;
    one_row(&axle_scenes[scene].p, t[i], &theta, &omega, &one);
    ROT_CHECK(fabs(out.theta_rad[i] - theta) <= ROT_EPS * fabs(row->theta_bound) / 6.0);
    ROT_CHECK(fabs(out.omega_rad_per_s[i] - omega) <= ROT_EPS * fabs(row->omega_bound) / 6.0);
    ROT_CHECK_ULP(out.applied_torque_n_m[i], row->applied, 3);
    theta_error = fmax(theta_error, one.measure[ROT_THETA].error);
    omega_error = fmax(omega_error, one.measure[ROT_OMEGA].error);
  }
  /* The report is about the worst row. */
  ROT_CHECK(fabs(info.measure[ROT_THETA].error - theta_error) <= 0.06 * theta_error);
  ROT_CHECK(fabs(info.measure[ROT_OMEGA].error - omega_error) <= 0.06 * omega_error);
}

/* The largest values count the start and the knots passed on the way, whichever rows are asked. */
static void check_largest_values(void) {
  static const double time_s[] = {-2.0, -1.0, -1.0, 1.0, 1.0, 2.0},
                      torque_n_m[] = {0.0, 0.0, 20.0, 20.0, -30.0, -30.0};
  const rot_axle_params p = axle(2.0, 0.0, 3.0, -4.0, knots(6, time_s, torque_n_m));
  const double start = 0.0, next = 0.5, far[] = {-3.0, 3.0};
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &start, &out, NULL, &info), ROT_OK);
  ROT_CHECK(info.measure[ROT_THETA].largest == 3.0 && info.measure[ROT_OMEGA].largest == 4.0);
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &next, &out, NULL, &info), ROT_OK);
  ROT_CHECK(out.theta_rad[0] == 2.25 && out.omega_rad_per_s[0] == 1.0);
  ROT_CHECK(info.measure[ROT_THETA].largest == 3.0 && info.measure[ROT_OMEGA].largest == 4.0);
  /* theta and omega: 26, -14 at -2 s, 12, -14 at -1 s, 4, 6 at 1 s, 2.5, -9 at 2 s */
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &far[0], &out, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(out.theta_rad[0], 40.0, 1);
  ROT_CHECK(info.measure[ROT_THETA].largest == out.theta_rad[0] &&
            info.measure[ROT_OMEGA].largest == 14.0);
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &far[1], &out, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(out.omega_rad_per_s[0], -24.0, 1);
  ROT_CHECK(info.measure[ROT_THETA].largest == 14.0 && info.measure[ROT_OMEGA].largest == 24.0);
  /* Between knots, below what the knots behind had. */
  const double slow = 1.5, near = 2.5;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &slow, &out, NULL, &info), ROT_OK);
  ROT_CHECK(out.omega_rad_per_s[0] == -1.5 && info.measure[ROT_OMEGA].largest == 6.0);
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, &near, &out, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(out.theta_rad[0], -3.875, 3);
  ROT_CHECK_ULP(info.measure[ROT_THETA].largest, 4.0, 1);
  const rot_axle_params free = axle(2.0, 0.0, 8.0, -4.0, constant(0.0));
  const double turned_back = 2.5;
  ROT_CHECK_EQ_INT(rot_axle_free(&free, 1, &turned_back, &out, NULL, &info), ROT_OK);
  ROT_CHECK(out.theta_rad[0] == -2.0 && info.measure[ROT_THETA].largest == 8.0 &&
            info.measure[ROT_OMEGA].largest == 4.0);
}

/* Answers one can check in the head: inertia 2, torque 6, so 3 rad/s^2. */
static void check_by_head(void) {
  const double time_s[] = {-1.0, 0.0, 1.0, 2.0, 3.0}, double_s[] = {0.0, 4.0}, ramp[] = {0.0, 16.0};
  const rot_axle_params steady = axle(2.0, 0.0, 0.5, -4.0, constant(6.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&steady, 5, time_s, &out, NULL, &info), ROT_OK);
  for (int i = 0; i < 5; i++) {
    const double t = time_s[i];
    ROT_CHECK_ULP(out.omega_rad_per_s[i], -4.0 + 3.0 * t, 1);
    ROT_CHECK_ULP(out.theta_rad[i], 0.5 - 4.0 * t + 1.5 * t * t, 1);
  }
  /* Torque 4 t over inertia 2: omega grows by t^2, theta by t^3/3. */
  const rot_axle_params ramped = axle(2.0, 0.0, 0.25, 3.0, knots(2, double_s, ramp));
  for (double t = 0.0; t <= 4.0; t += 0.5) {
    ROT_CHECK_ULP(omega_at(&ramped, t), 3.0 + t * t, 2);
    ROT_CHECK_ULP(theta_at(&ramped, t), 0.25 + 3.0 * t + t * t * t / 3.0, 3);
  }
  /* Coasting at c/I = 3/2, and settling to 6/3. */
  const rot_axle_params coasting = axle(2.0, 3.0, 0.0, 5.0, constant(0.0));
  const rot_axle_params settling = axle(2.0, 3.0, 0.0, 0.0, constant(6.0));
  ROT_CHECK_ULP(omega_at(&coasting, 2.0), 5.0 * exp(-3.0), 3);
  ROT_CHECK_ULP(theta_at(&coasting, 2.0), 5.0 * (1.0 - exp(-3.0)) / 1.5, 3);
  ROT_CHECK_ULP(omega_at(&settling, 0.5), 2.0 * -expm1(-0.75), 4);
  ROT_CHECK_ULP(omega_at(&settling, 100.0), 2.0, 1);
  ROT_CHECK_ULP(theta_at(&settling, 100.0), 200.0 - 4.0 / 3.0, 2);
}

static void check_derived_columns(void) {
  const double t = 3.0;
  const rot_axle_params p = axle(2.0, 3.0, 0.0, 0.0, constant(0.0));
  rot_axle_columns out = columns(0);
  rot_axle_row(&p, &out, 4, 7.0, -5.0, 11.0);
  ROT_CHECK(out.theta_rad[4] == 7.0);
  ROT_CHECK(out.omega_rad_per_s[4] == -5.0);
  ROT_CHECK(out.applied_torque_n_m[4] == 11.0);
  ROT_CHECK(out.damping_torque_n_m[4] == 15.0);            /* -c omega */
  ROT_CHECK(out.net_torque_n_m[4] == 26.0);                /* applied + damping */
  ROT_CHECK(out.angular_momentum_kg_m2_per_s[4] == -10.0); /* I omega */
  ROT_CHECK(out.rotational_kinetic_energy_j[4] == 25.0);   /* I omega^2/2 */
  /* No resistance, no damping torque: 0, and not -0, which a table would print. */
  const rot_axle_params free = axle(2.0, 0.0, 0.0, 5.0, constant(0.0));
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&free, 1, &t, &out, NULL, &info), ROT_OK);
  ROT_CHECK(out.damping_torque_n_m[0] == 0.0 && !signbit(out.damping_torque_n_m[0]));
}

/* ---- one way to compute a row against another ----------------------------------------------- */

/* The same motion with inertia, resistance and torque 2^300 times as large: too wild for rows
 * several at a time, so each takes the careful step. */
static void compare_with_careful(const rot_axle_params *p, size_t n, const double t[]) {
  const double times = 0x1p300;
  double torque[16];
  rot_axle_params big = *p;
  rot_axle_columns fast = columns(0), careful = columns(1);
  rot_info fast_info, careful_info;
  double worst = 0.0;
  for (size_t i = 0; i < p->torque.n; i++) torque[i] = times * p->torque.torque_n_m[i];
  big.inertia_kg_m2 *= times;
  big.viscous_n_m_s *= times;
  big.torque.torque_n_m = torque;
  big.torque.before_n_m *= times;
  big.torque.after_n_m *= times;
  ROT_CHECK_EQ_INT(rot_axle_linear(p, n, t, &fast, NULL, &fast_info), ROT_OK);
  ROT_CHECK_EQ_INT(rot_axle_linear(&big, n, t, &careful, NULL, &careful_info), ROT_OK);
  for (size_t i = 0; i < n; i++) {
    ROT_CHECK_ULP(fast.theta_rad[i], careful.theta_rad[i], 6);
    ROT_CHECK_ULP(fast.omega_rad_per_s[i], careful.omega_rad_per_s[i], 6);
    ROT_CHECK_ULP(fast.applied_torque_n_m[i] * times, careful.applied_torque_n_m[i], 3);
    ROT_CHECK_ULP(fast.damping_torque_n_m[i] * times, careful.damping_torque_n_m[i], 7);
    ROT_CHECK_ULP(fast.angular_momentum_kg_m2_per_s[i] * times,
                  careful.angular_momentum_kg_m2_per_s[i], 7);
    worst = fmax(worst, rot_test_ulp(fast.theta_rad[i], careful.theta_rad[i]));
    worst = fmax(worst, rot_test_ulp(fast.omega_rad_per_s[i], careful.omega_rad_per_s[i]));
  }
  ROT_CHECK_ULP(fast_info.measure[ROT_THETA].largest, careful_info.measure[ROT_THETA].largest, 4);
  ROT_CHECK_ULP(fast_info.measure[ROT_OMEGA].largest, careful_info.measure[ROT_OMEGA].largest, 4);
  ROT_CHECK_REL(fast_info.measure[ROT_THETA].error, careful_info.measure[ROT_THETA].error, 0.06);
  ROT_CHECK_REL(fast_info.measure[ROT_OMEGA].error, careful_info.measure[ROT_OMEGA].error, 0.06);
  ROT_CHECK_EQ_INT(fast_info.steps, careful_info.steps);
  printf("fast against careful: worst %g ulp\n", worst);
}

static void check_fast_rows(void) {
  static const double time_s[] = {0.5, 3.5, 3.5, 5.0, 7.0, 7.0, 12.0, 14.0, 14.0, 20.0},
                      torque_n_m[] = {1.0, 5.0, 2.0, 0.0, 3.0, 0.0, 0.0, 2.0, 9.0, 4.0};
  static double t[2000];
  for (int i = 0; i < 2000; i++) t[i] = 0.0123 * i; /* z to 3 and far beyond, coasting, ramps */
  rot_axle_params p = axle(0.7, 0.9, 0.3, 2.0, knots(10, time_s, torque_n_m));
  compare_with_careful(&p, 2000, t);
  p.viscous_n_m_s = 0.01; /* z < 0.3 */
  compare_with_careful(&p, 2000, t);
  p.viscous_n_m_s = 0.0;
  compare_with_careful(&p, 2000, t);
  p.viscous_n_m_s = 30.0; /* settled within some rows of each knot */
  compare_with_careful(&p, 2000, t);
  p.start_s = 3.5; /* on a jump; rows backward too */
  p.viscous_n_m_s = 1e-3;
  p.theta0_rad = 1000.0; /* keeps theta away from zero crossings */
  p.omega0_rad_per_s = 100.0;
  compare_with_careful(&p, 2000, t);
  p.torque = constant(0.0);
  p.viscous_n_m_s = 0.9;
  p.start_s = 0.0;
  compare_with_careful(&p, 2000, t);
}

/* A row does not depend on which others are asked for: 0 to 40 rows of a long run, in steps. */
static void check_row_alone_and_among_others(void) {
  static const double time_s[] = {0.0, 3.0, 10.0}, torque_n_m[] = {1.0, 5.0, 2.0};
  static double t[400];
  const rot_axle_params p = axle(0.7, 0.2, 0.3, 2.0, knots(3, time_s, torque_n_m));
  rot_axle_columns all = columns(0), some = columns(1);
  rot_info info;
  double worst = 0.0;
  for (int i = 0; i < 400; i++) t[i] = 0.05 * i;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 400, t, &all, NULL, &info), ROT_OK);
  for (size_t n = 0; n <= 40; n++) {
    const size_t first = 9 * n;
    ROT_CHECK_EQ_INT(rot_axle_linear(&p, n, t + first, &some, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(info.rows_done, n);
    for (size_t i = 0; i < n; i++) {
      worst = fmax(worst, rot_test_ulp(some.theta_rad[i], all.theta_rad[first + i]));
      worst = fmax(worst, rot_test_ulp(some.omega_rad_per_s[i], all.omega_rad_per_s[first + i]));
      ROT_CHECK(some.applied_torque_n_m[i] == all.applied_torque_n_m[first + i]);
    }
  }
  printf("a row alone and among others: %g ulp apart\n", worst);
  ROT_CHECK(worst <= 1.0);
}

/* More rows than one chunk holds, on both sides of the start: no row left out, none twice. */
static void check_many_rows(void) {
  static double t[MAX_ROWS];
  const rot_axle_params steady = axle(2.0, 0.0, 0.5, -4.0, constant(6.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  long wrong = 0;
  for (int i = 0; i < MAX_ROWS; i++) t[i] = (i - 12000) * 0x1p-10;
  for (int i = 0; i < MAX_ROWS; i++) out.theta_rad[i] = out.omega_rad_per_s[i] = NAN;
  ROT_CHECK_EQ_INT(rot_axle_linear(&steady, MAX_ROWS, t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.rows_done, MAX_ROWS);
  for (int i = 0; i < MAX_ROWS; i++) {
    wrong += !(fabs(out.omega_rad_per_s[i] - (-4.0 + 3.0 * t[i])) <= 1e-13);
    wrong += !(fabs(out.theta_rad[i] - (0.5 - 4.0 * t[i] + 1.5 * t[i] * t[i])) <= 1e-12);
  }
  ROT_CHECK_EQ_INT(wrong, 0);
}

/* Repeated times give repeated rows. */
static void check_repeated_times(void) {
  static const double time_s[] = {0.0, 3.0, 3.0}, torque_n_m[] = {1.0, 5.0, 2.0};
  const double t[] = {-1.0, -1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 3.0, 3.0, 4.0, 4.0};
  const rot_axle_params p = axle(0.7, 0.2, 0.3, 2.0, knots(3, time_s, torque_n_m));
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 11, t, &out, NULL, &info), ROT_OK);
  for (int i = 1; i < 11; i++) {
    ROT_CHECK((t[i] == t[i - 1]) == (out.theta_rad[i] == out.theta_rad[i - 1]));
    if (t[i] == t[i - 1]) ROT_CHECK(out.applied_torque_n_m[i] == out.applied_torque_n_m[i - 1]);
  }
  ROT_CHECK(out.theta_rad[2] == 0.3 && out.omega_rad_per_s[2] == 2.0);
}

/* ---- motions that must agree ---------------------------------------------------------------- */

/* Backward from the start, then forward from there: back at the start within both bounds. */
static void check_there_and_back(void) {
  static const double time_s[] = {-4.0, -2.0, -2.0, 1.0}, torque_n_m[] = {1.0, 5.0, -3.0, 2.0};
  const double viscous[] = {0.0, 0.3, -0.3};
  for (int i = 0; i < 3; i++) {
    const rot_axle_params p = axle(0.7, viscous[i], 0.3, 2.0, knots(4, time_s, torque_n_m));
    rot_axle_params q = p;
    double theta, omega;
    rot_info back, forth;
    q.start_s = -5.0;
    one_row(&p, q.start_s, &q.theta0_rad, &q.omega0_rad_per_s, &back);
    one_row(&q, 0.0, &theta, &omega, &forth);
    ROT_CHECK(fabs(omega - 2.0) <=
              20.0 * back.measure[ROT_OMEGA].error + forth.measure[ROT_OMEGA].error);
    ROT_CHECK(fabs(theta - 0.3) <=
              20.0 * (back.measure[ROT_THETA].error + back.measure[ROT_OMEGA].error) +
                  forth.measure[ROT_THETA].error);
    ROT_CHECK(20.0 * (back.measure[ROT_OMEGA].error + forth.measure[ROT_OMEGA].error) < 1e-11);
  }
}

/* A body at rest stays there without torque, however an error would grow; with a torque that
 * begins or ends at zero it does not. */
static void check_at_rest(void) {
  static const double time_s[] = {0.0, 2.0}, falling[] = {6.0, 0.0}, rising[] = {0.0, 6.0};
  const rot_axle_params unstable = axle(2.0, -3.0, 0.5, 0.0, constant(0.0)),
                        down = axle(2.0, 0.0, 0.0, 0.0, knots(2, time_s, falling)),
                        up = axle(2.0, 0.0, 0.0, 0.0, knots(2, time_s, rising));
  ROT_CHECK(theta_at(&unstable, 1e4) == 0.5 && omega_at(&unstable, 1e4) == 0.0);
  ROT_CHECK_ULP(omega_at(&down, 2.0), 3.0, 2);
  ROT_CHECK_ULP(theta_at(&down, 2.0), 4.0, 2);
  ROT_CHECK_ULP(omega_at(&up, 2.0), 3.0, 2);
  ROT_CHECK_ULP(theta_at(&up, 2.0), 2.0, 2);
}

/* Mirror: torque and state negated, theta and omega negated to the last bit; the bounds stay. */
static void check_mirror(void) {
  static const double time_s[] = {0.0, 3.0, 10.0, 10.0, 20.0},
                      torque_n_m[] = {1.0, -5.0, 2.0, 0.0, 0.0},
                      mirrored[] = {-1.0, 5.0, -2.0, 0.0, 0.0};
  const double viscous[] = {0.0, 0.2, 3.0};
  for (int v = 0; v < 3; v++) {
    const rot_axle_params p = axle(0.7, viscous[v], 0.3, 2.0, knots(5, time_s, torque_n_m)),
                          q = axle(0.7, viscous[v], -0.3, -2.0, knots(5, time_s, mirrored));
    for (double t = -2.0; t < 20.0; t += 0.7) {
      double theta, omega, theta_mirrored, omega_mirrored;
      rot_info info, info_mirrored;
      one_row(&p, t, &theta, &omega, &info);
      one_row(&q, t, &theta_mirrored, &omega_mirrored, &info_mirrored);
      ROT_CHECK(theta == -theta_mirrored);
      ROT_CHECK(omega == -omega_mirrored);
      ROT_CHECK(info.measure[ROT_THETA].error == info_mirrored.measure[ROT_THETA].error);
      ROT_CHECK(info.measure[ROT_OMEGA].error == info_mirrored.measure[ROT_OMEGA].error);
    }
  }
}

/* Theta only adds up; where it starts does not matter to anything else. */
static void check_offset(void) {
  const rot_axle_params p = axle(0.7, 0.2, 0.0, 2.0, constant(3.0));
  rot_axle_params q = p;
  q.theta0_rad = 16.0;
  for (double t = 0.1; t < 40.0; t *= 1.7) {
    ROT_CHECK_ULP(theta_at(&q, t), 16.0 + theta_at(&p, t), 2);
    ROT_CHECK(omega_at(&q, t) == omega_at(&p, t));
  }
}

/* Knots that lie on the line change nothing but roundings. Without resistance 20000 of them leave
 * no trace at all, because the sums carry what they round off. */
static void check_knots_on_the_line(void) {
  enum { N = 20001 };
  static double time_s[N], torque_n_m[N];
  const double viscous[] = {0.0, 0.01, 2.0};
  for (int i = 0; i < N; i++) {
    time_s[i] = 0.0007 * i;
    torque_n_m[i] = 6.0;
  }
  for (int i = 0; i < 3; i++) {
    const rot_axle_params whole = axle(2.0, viscous[i], 0.5, 4.0, constant(6.0)),
                          split = axle(2.0, viscous[i], 0.5, 4.0, knots(N, time_s, torque_n_m));
    rot_info info, info_whole;
    double theta, omega, theta_whole, omega_whole;
    one_row(&split, 14.7, &theta, &omega, &info);
    one_row(&whole, 14.7, &theta_whole, &omega_whole, &info_whole);
    ROT_CHECK_EQ_INT(info.steps, N);
    ROT_CHECK(fabs(theta - theta_whole) <= info.measure[ROT_THETA].error);
    ROT_CHECK(fabs(omega - omega_whole) <= info.measure[ROT_OMEGA].error);
    if (viscous[i] == 0.0) {
      ROT_CHECK_ULP(theta, theta_whole, 2);
      ROT_CHECK_ULP(omega, omega_whole, 2);
    }
    printf("20000 knots on a line: theta %g ulp, omega %g ulp off\n",
           rot_test_ulp(theta, theta_whole), rot_test_ulp(omega, omega_whole));
  }
  /* A ramp split at dyadic places, so that the knots lie on it exactly. */
  static const double two_s[] = {0.0, 8.0}, two[] = {1.0, 9.0},
                      many_s[] = {0.0, 0.5, 3.0, 4.25, 8.0}, many[] = {1.0, 1.5, 4.0, 5.25, 9.0};
  const rot_axle_params one = axle(0.7, 0.3, 0.1, 2.0, knots(2, two_s, two)),
                        four = axle(0.7, 0.3, 0.1, 2.0, knots(5, many_s, many));
  for (double t = -1.0; t < 12.0; t += 0.31) {
    ROT_CHECK(fabs(theta_at(&one, t) - theta_at(&four, t)) <= 1e-13);
    ROT_CHECK(fabs(omega_at(&one, t) - omega_at(&four, t)) <= 1e-14);
  }
}

/* An impulse of 4 N m s, given in 2^-30 s, is a jump of omega by 4/I. */
static void check_pulse(void) {
  static const double time_s[] = {1.0, 1.0, 1.0 + 0x1p-30, 1.0 + 0x1p-30},
                      torque_n_m[] = {0.0, 0x1p32, 0x1p32, 0.0};
  const rot_axle_params p = axle(2.0, 3.0, 0.0, 5.0, knots(4, time_s, torque_n_m));
  const double before = omega_at(&p, 1.0), after = omega_at(&p, 1.0 + 0x1p-30);
  ROT_CHECK_ULP(before, 5.0 * exp(-1.5), 3);
  ROT_CHECK(fabs(after - before - 2.0) < 1e-8);
  ROT_CHECK(fabs(after - before - 2.0) > 1e-10); /* 2^-30 s of damping */
}

/* ---- ends of the range ---------------------------------------------------------------------- */

/* z = c t/I so large that the rate of the motion itself is out of range: torque over c, at once. */
static void check_settled_at_infinity(void) {
  static const double time_s[] = {0.0, 2.0}, torque_n_m[] = {3.0, 7.0};
  const rot_axle_params p = axle(1e-300, 1e20, 0.5, 2.0, knots(2, time_s, torque_n_m));
  ROT_CHECK_ULP(omega_at(&p, 1.0), 5e-20, 2);
  ROT_CHECK_ULP(theta_at(&p, 1.0), 0.5, 1);
  ROT_CHECK_ULP(omega_at(&p, 9.0), 7e-20, 2);
  const rot_axle_params q = axle(1e-300, 1e20, 0.0, 2.0, knots(2, time_s, torque_n_m));
  ROT_CHECK_ULP(theta_at(&q, 2.0), 1e-19, 3); /* 10 N m s over c */
}

/* Rows close to the start, of numbers that are tame by themselves but not divided by each other. */
static void check_close_rows(void) {
  const rot_axle_params p = axle(1e50, 0.0, 0.0, 0.0, constant(2e50));
  const double t[] = {1e-270, 1e-200, 1.0};
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 3, t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(out.omega_rad_per_s[0], 2e-270, 6);
  ROT_CHECK_ULP(out.omega_rad_per_s[1], 2e-200, 6);
  ROT_CHECK_ULP(out.omega_rad_per_s[2], 2.0, 6);
}

/* Numbers that must not be multiplied without watching their exponents. */
static void check_wild_torque(void) {
  static const double long_s[] = {0.0, 1e10}, up[] = {1.0, 1e300}, down[] = {1e300, 1.0},
                      ages_s[] = {0.0, 1e300}, slow[] = {1e50, 3e50};
  const double far = 9e9;
  rot_axle_columns out = columns(0);
  rot_info info;
  /* omega out of range is a failure, never an infinite row */
  const rot_axle_params rising = axle(1e-3, 0.0, 0.0, 0.0, knots(2, long_s, up)),
                        falling = axle(1e-3, 0.0, 0.0, 0.0, knots(2, long_s, down));
  ROT_CHECK_EQ_INT(rot_axle_linear(&rising, 1, &far, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 0);
  ROT_CHECK_EQ_INT(rot_axle_linear(&falling, 1, &far, &out, NULL, &info), ROT_ERANGE);
  const rot_axle_params pushed = axle(1e-59, 0.0, 0.0, 0.0, constant(1e59));
  const double times[] = {0.5, 1e100};
  ROT_CHECK_EQ_INT(rot_axle_linear(&pushed, 2, times, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 1);
  /* a ramp so long that torque times time is out of range, while all else is not */
  const rot_axle_params p = axle(1e50, 0.0, 0.0, 0.0, knots(2, ages_s, slow));
  ROT_CHECK_ULP(omega_at(&p, 2.0), 2.0, 4);
}

/* All of inertia, resistance and torque scaled alike: the same motion. */
static void check_scaling(void) {
  static const double time_s[] = {0.0, 2.0, 5.0};
  const double t[] = {0.3, 1.1, 2.0, 4.0, 7.0};
  for (int e = -990; e <= 990; e += 90) {
    const double times = ldexp(1.0, e);
    const double torque_n_m[] = {times, 3.0 * times, 2.0 * times}, unscaled_n_m[] = {1.0, 3.0, 2.0};
    const rot_axle_params p = axle(2.0 * times, 0.7 * times, 0.5, 4.0,
                                   knots(3, time_s, torque_n_m)),
                          q = axle(2.0, 0.7, 0.5, 4.0, knots(3, time_s, unscaled_n_m));
    for (int i = 0; i < 5; i++) {
      ROT_CHECK_ULP(theta_at(&p, t[i]), theta_at(&q, t[i]), 4);
      ROT_CHECK_ULP(omega_at(&p, t[i]), omega_at(&q, t[i]), 4);
    }
  }
}

/* Time, resistance and speed in other units; the powers of two are exact. */
static void check_time_scaling(void) {
  static const double time_s[] = {0.0, 2.0, 5.0}, torque_n_m[] = {1.0, 3.0, 2.0};
  for (int e = -400; e <= 400; e += 50) {
    const double second = ldexp(1.0, e);
    const double scaled_s[] = {0.0, 2.0 * second, 5.0 * second};
    double scaled_n_m[3];
    for (int i = 0; i < 3; i++) scaled_n_m[i] = torque_n_m[i] / second / second;
    const rot_axle_params p = axle(2.0, 0.7 / second, 0.5, 4.0 / second,
                                   knots(3, scaled_s, scaled_n_m)),
                          q = axle(2.0, 0.7, 0.5, 4.0, knots(3, time_s, torque_n_m));
    for (double t = 0.3; t < 9.0; t += 1.3) {
      ROT_CHECK_ULP(theta_at(&p, t * second), theta_at(&q, t), 4);
      ROT_CHECK_ULP(omega_at(&p, t * second) * second, omega_at(&q, t), 4);
    }
  }
}

/* ---- how a run ends ------------------------------------------------------------------------- */

static void check_no_rows(void) {
  const rot_axle_params p = axle(2.0, 3.0, 0.0, 5.0, constant(1.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  memset(&info, 0x5a, sizeof info);
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 0, NULL, &out, NULL, &info), ROT_OK);
  ROT_CHECK(info.status == ROT_OK && info.rows_done == 0 && info.steps == 0);
  ROT_CHECK(info.measure[ROT_THETA].error == 0.0 && info.measure[ROT_OMEGA].error == 0.0);
  memset(&info, 0x5a, sizeof info);
  ROT_CHECK_EQ_INT(rot_axle_free(&p, 0, NULL, &out, NULL, &info), ROT_OK);
  ROT_CHECK(info.status == ROT_OK && info.rows_done == 0 && info.steps == 0);
}

/* One step a piece that the run entered; the closed form evaluates no right-hand side. */
static void check_counts(void) {
  static const double time_s[] = {1.0, 2.0, 3.0}, torque_n_m[] = {1.0, 3.0, 2.0};
  const double t[] = {0.5, 1.5, 2.5};
  const rot_axle_params p = axle(2.0, 3.0, 0.0, 5.0, knots(3, time_s, torque_n_m));
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 3, t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.steps, 3);
  ROT_CHECK_EQ_INT(info.rhs_calls, 0);
  ROT_CHECK_EQ_INT(info.rejected, 0);
  ROT_CHECK(info.tolerance == 0.0);
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 1, t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.steps, 1);
}

/* omega = exp(t) leaves the doubles after 709: seven rows stand, the eighth says where. */
static void check_overflow_forward(void) {
  const double t[] = {0.0, 100.0, 200.0, 300.0, 400.0, 500.0, 709.0, 711.0, 800.0};
  const rot_axle_params p = axle(2.0, -2.0, 0.0, 1.0, constant(0.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  for (int i = 0; i < 9; i++) out.omega_rad_per_s[i] = -7.0;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 9, t, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.status, ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 7);
  ROT_CHECK(info.time_s == 711.0);
  ROT_CHECK_REL(out.omega_rad_per_s[6], 8.2184074615549724e307, 1e-14);
  ROT_CHECK(out.omega_rad_per_s[8] == -7.0); /* nothing beyond is touched */
}

/* The state can also leave between two rows, at a knot. */
static void check_overflow_at_knot(void) {
  static const double time_s[] = {0.0, 800.0, 801.0}, torque_n_m[] = {0.0, 0.0, 0.0};
  const double t[] = {1.0, 2.0, 900.0};
  const rot_axle_params p = axle(2.0, -2.0, 0.0, 1.0, knots(3, time_s, torque_n_m));
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 3, t, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 2);
  ROT_CHECK(info.time_s == 800.0);
}

static void check_overflow_of_theta(void) {
  const double t[] = {0.0, 1e100, 1e200};
  const rot_axle_params p = axle(2.0, 0.0, 0.0, 1e150, constant(0.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, 3, t, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 2);
  ROT_CHECK_EQ_INT(rot_axle_free(&p, 3, t, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.status, ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 2);
  ROT_CHECK(info.time_s == 1e200);
}

/* Backward growth exp(1.5 |t|). Whatever rows_done says, so many first rows must be there. */
static void check_overflow_backward(void) {
  enum { N = 10000 };
  static double t[N];
  static const double knot_s[] = {-900.0}, knot_n_m[] = {0.0};
  for (int cut = 0; cut < 2; cut++) { /* the second time with a knot on the way */
    const rot_axle_params p =
        axle(2.0, 3.0, 0.0, 5.0, cut ? knots(1, knot_s, knot_n_m) : constant(0.0));
    rot_axle_columns out = columns(0);
    rot_info info;
    for (int i = 0; i < N; i++) t[i] = -1000.0 + 0.1 * i;
    for (int i = 0; i < N; i++) out.theta_rad[i] = NAN;
    ROT_CHECK_EQ_INT(rot_axle_linear(&p, N, t, &out, NULL, &info), ROT_ERANGE);
    ROT_CHECK(info.time_s < -473.0);
    long missing = 0;
    for (size_t i = 0; i < info.rows_done; i++) missing += !isfinite(out.theta_rad[i]);
    ROT_CHECK_EQ_INT(missing, 0);
  }
}

typedef struct poller {
  int calls, stop_at;
  double last_fraction;
} poller;

static rot_status poll(void *ctx, double fraction) {
  poller *p = ctx;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  ROT_CHECK(fraction >= p->last_fraction);
  p->last_fraction = fraction;
  return ++p->calls == p->stop_at ? ROT_EUNWIND : ROT_OK;
}

/* Asked every 8192 rows; at the k-th no, k times 8192 rows are done. */
static void check_poll(void) {
  static double t[MAX_ROWS];
  const rot_axle_params p = axle(2.0, 0.1, 0.0, 5.0, constant(1.0)),
                        free = axle(2.0, 0.0, 0.0, 5.0, constant(0.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  for (int i = 0; i < MAX_ROWS; i++) t[i] = 1e-3 * i;
  for (int stop_at = 1; stop_at <= 3; stop_at++) {
    poller linear_poller = {0, stop_at, 0.0}, free_poller = {0, stop_at, 0.0};
    rot_hooks hooks = {poll, &linear_poller};
    ROT_CHECK_EQ_INT(rot_axle_linear(&p, MAX_ROWS, t, &out, &hooks, &info), ROT_EUNWIND);
    ROT_CHECK_EQ_INT(info.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(info.rows_done, stop_at * ROWS_PER_POLL);
    ROT_CHECK_EQ_INT(linear_poller.calls, stop_at);
    ROT_CHECK(info.time_s == t[info.rows_done - 1]);
    hooks.ctx = &free_poller;
    ROT_CHECK_EQ_INT(rot_axle_free(&free, MAX_ROWS, t, &out, &hooks, &info), ROT_EUNWIND);
    ROT_CHECK_EQ_INT(info.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(info.rows_done, stop_at * ROWS_PER_POLL);
    ROT_CHECK_EQ_INT(free_poller.calls, stop_at);
  }
  poller patient = {0, -1, 0.0};
  rot_hooks hooks = {poll, &patient};
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, MAX_ROWS, t, &out, &hooks, &info), ROT_OK);
  ROT_CHECK_EQ_INT(patient.calls, MAX_ROWS / ROWS_PER_POLL);
  ROT_CHECK(patient.last_fraction > 0.99);
}

/* Stopped on the way back, not one row from the first on is promised. */
static void check_poll_backward(void) {
  static double t[MAX_ROWS];
  const rot_axle_params p = axle(2.0, 0.1, 0.0, 5.0, constant(1.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  for (int i = 0; i < MAX_ROWS; i++) t[i] = 1e-3 * (i - 20000);
  poller stop_back = {0, 2, 0.0};
  rot_hooks hooks = {poll, &stop_back};
  ROT_CHECK_EQ_INT(rot_axle_linear(&p, MAX_ROWS, t, &out, &hooks, &info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.rows_done, 0);
  ROT_CHECK_EQ_INT(stop_back.calls, 2);
  ROT_CHECK(info.time_s == t[20000 - 2 * ROWS_PER_POLL]);
}

/* ---- free spin ------------------------------------------------------------------------------ */

static void check_free(void) {
  const double t[] = {-3.0, 0.5, 2.0, 7.0};
  rot_axle_params p = axle(2.0, 0.0, 0.25, -3.0, constant(0.0));
  rot_axle_columns out = columns(0);
  rot_info info;
  p.start_s = 0.5;
  ROT_CHECK_EQ_INT(rot_axle_free(&p, 4, t, &out, NULL, &info), ROT_OK);
  const double theta[] = {10.75, 0.25, -4.25, -19.25};
  for (int i = 0; i < 4; i++) {
    ROT_CHECK(out.theta_rad[i] == theta[i]);
    ROT_CHECK(out.omega_rad_per_s[i] == -3.0);
    ROT_CHECK(out.applied_torque_n_m[i] == 0.0 && out.damping_torque_n_m[i] == 0.0 &&
              out.net_torque_n_m[i] == 0.0);
    ROT_CHECK(out.angular_momentum_kg_m2_per_s[i] == -6.0);
    ROT_CHECK(out.rotational_kinetic_energy_j[i] == 9.0);
  }
  ROT_CHECK_EQ_INT(info.rows_done, 4);
  ROT_CHECK_EQ_INT(info.steps, 1);
  ROT_CHECK(info.time_s == 7.0 && info.measure[ROT_THETA].largest == 19.25 &&
            info.measure[ROT_OMEGA].largest == 3.0);
  ROT_CHECK(info.measure[ROT_OMEGA].error == 0.0);
  /* 2 |turned| + |theta| roundings, at the last row */
  ROT_CHECK_REL(info.measure[ROT_THETA].error, (2.0 * 19.5 + 19.25) * ROT_EPS, 1e-12);
}

/* Against double words: the bound holds, and is not idle. */
static void check_free_bound(void) {
  const rot_axle_params p = {2.0, 0.0, 0.1, 0.3, 1.7, {0, NULL, NULL, 0.0, 0.0, NULL, NULL}};
  double closest = 0.0;
  for (int i = 0; i < 500; i++) {
    const double t = -20.0 + 0.0831 * i;
    rot_axle_columns out = columns(0);
    rot_info info;
    rot_axle_free(&p, 1, &t, &out, NULL, &info);
    double s_lo, s = rot_two_sum(t, -p.start_s, &s_lo), turned_lo,
                 turned = rot_two_prod(p.omega0_rad_per_s, s, &turned_lo), sum_lo,
                 sum = rot_two_sum(p.theta0_rad, turned, &sum_lo);
    turned_lo += p.omega0_rad_per_s * s_lo;
    const double error = fabs((out.theta_rad[0] - sum) - (sum_lo + turned_lo));
    ROT_CHECK(error <= info.measure[ROT_THETA].error);
    closest = fmax(closest, error / info.measure[ROT_THETA].error);
  }
  ROT_CHECK(closest > 0.4);
}

/* ---- the single step ------------------------------------------------------------------------ */

static void check_step(void) {
  const rot_axle_params p = {2.0, 3.0, 0.5, 0.25, 5.0, {0, NULL, NULL, 6.0, 6.0, NULL, NULL}};
  const rot_torque_piece piece = {-INFINITY, INFINITY, 6.0, 6.0};
  const rot_axle_state start = rot_axle_start(&p);
  ROT_CHECK(start.time_s == 0.5 && start.theta_rad == 0.25 && start.omega_rad_per_s == 5.0);
  ROT_CHECK(start.theta_lo == 0.0 && start.omega_lo == 0.0);
  ROT_CHECK(start.theta_error == 0.0 && start.omega_error == 0.0);
  const rot_axle_state same = rot_axle_step(&p, &start, &piece, 0.5);
  ROT_CHECK(memcmp(&same, &start, sizeof same) == 0);
  const rot_axle_state to = rot_axle_step(&p, &start, &piece, 1.5);
  ROT_CHECK(to.time_s == 1.5);
  ROT_CHECK_ULP(to.omega_rad_per_s, 2.0 + 3.0 * exp(-1.5), 3);
  ROT_CHECK_ULP(to.theta_rad, 0.25 + 2.0 + 2.0 * (1.0 - exp(-1.5)), 3);
}

/* What a state carries below its last bit counts in the next step. */
static void check_low_words(void) {
  const rot_axle_params p = axle(2.0, 0.0, 1.0, 1.0, constant(0.0));
  const rot_torque_piece piece = {-INFINITY, INFINITY, 0.0, 0.0};
  rot_axle_state from = rot_axle_start(&p);
  from.theta_lo = 0x1p-54;
  from.omega_lo = 0x1p-54;
  for (int i = 1; i <= 8; i++) from = rot_axle_step(&p, &from, &piece, i * 0x1p-60);
  ROT_CHECK(from.omega_rad_per_s == 1.0 && from.omega_lo == 0x1p-54);
  ROT_CHECK(from.theta_rad == 1.0 && from.theta_lo == 0x1p-54 + 8 * 0x1p-60);
  /* Drives of 1 and 2^-54 rad/s on a body at -1: only the small one is left. */
  static const double time_s[] = {0.0, 1.0}, torque_n_m[] = {2.0, 0x1p-53};
  const rot_axle_params met = axle(1.0, 0.0, 0.0, -1.0, knots(2, time_s, torque_n_m));
  ROT_CHECK(omega_at(&met, 1.0) == 0x1p-54);
}

/* The rows use it, too, however they are computed: 3 parts of 4 of an ulp of theta round up, the 2
 * of the row itself do not. */
static void check_low_words_in_rows(void) {
  static const double time_s[] = {0.0, 1.0, 1.0, 9.0}, breath[] = {0.0, 0.0, 0x1p-150, 0x1p-150},
                      still[] = {0.0, 0.0, 0.0, 0.0}, push[] = {0x1p-54, 0x1p-54, 0x1p-54, 0x1p-54};
  const rot_axle_params coasting = axle(2.0, 0.0, 1.0, 0x1p-54, knots(4, time_s, still)),
                        in_lanes = axle(2.0, 0.0, 1.0, 0x1p-54, knots(4, time_s, breath)),
                        pushed = axle(1.0, 0.0, 0.0, 1.0, knots(4, time_s, push));
  ROT_CHECK(theta_at(&coasting, 3.0) == 1.0 + 0x1p-52);
  ROT_CHECK(theta_at(&in_lanes, 3.0) == 1.0 + 0x1p-52);
  ROT_CHECK(omega_at(&pushed, 3.0) == 1.0 + 0x1p-52);
  /* Settled: 1/3 of half an ulp from the knot behind, 4/5 from this piece. */
  static const double settled_s[] = {0.0, 20.0, 20.0, 200.0};
  double drift[] = {0.0, 0.0, 3.0 * 0.8 * 0x1p-53 / 100.0, 3.0 * 0.8 * 0x1p-53 / 100.0};
  const rot_axle_params settled = axle(1.0, 3.0, 1.0, 0x1p-53, knots(4, settled_s, drift));
  ROT_CHECK(theta_at(&settled, 120.0) == 1.0 + 0x1p-52);
  drift[2] = drift[3] = 0.6 * drift[2];
  ROT_CHECK(theta_at(&settled, 120.0) == 1.0);
}

/* ---- the shared table ----------------------------------------------------------------------- */

/* 6 eps of the largest term, which for one sign is 6 ulp or less. */
static void check_shared_row(const double in[6], double want_turned, double want_omega) {
  const double h = in[2], knot_s[] = {0.0, h}, knot_n_m[] = {in[3], in[4]};
  const rot_axle_params p = axle(in[0], in[1], 0.0, in[5], knots(2, knot_s, knot_n_m));
  double theta, omega;
  rot_info info;
  one_row(&p, h, &theta, &omega, &info);
  const double theta_error = fabs(theta - want_turned), omega_error = fabs(omega - want_omega);
  ROT_CHECK(theta_error <= info.measure[ROT_THETA].error);
  ROT_CHECK(omega_error <= info.measure[ROT_OMEGA].error);
  /* The bounds are 12 (24) roundings of all terms: 6 of the largest is less than 3/4 of them. */
  ROT_CHECK(theta_error <= 0.5 * info.measure[ROT_THETA].error);
  ROT_CHECK(omega_error <= 0.5 * info.measure[ROT_OMEGA].error);
  if (in[3] >= 0.0 && in[4] >= 0.0 && in[5] >= 0.0) {
    ROT_CHECK_ULP(theta, want_turned, 6);
    ROT_CHECK_ULP(omega, want_omega, 6);
  }
}

static void check_shared_table(void) {
  FILE *file = shared_table("refs/fixed_axis_linear.csv");
  double x[8];
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 8, x)) {
    check_shared_row(x, x[6], x[7]);
    rows++;
  }
  ROT_CHECK(rows >= 60);
}

int main(void) {
  for (int scene = 0; scene < AXLE_SCENES; scene++) {
    check_scene(scene);
    check_scene_together(scene);
  }
  check_largest_values();
  check_by_head();
  check_derived_columns();
  check_fast_rows();
  check_row_alone_and_among_others();
  check_many_rows();
  check_repeated_times();
  check_there_and_back();
  check_at_rest();
  check_mirror();
  check_offset();
  check_knots_on_the_line();
  check_pulse();
  check_settled_at_infinity();
  check_close_rows();
  check_wild_torque();
  check_scaling();
  check_time_scaling();
  check_no_rows();
  check_counts();
  check_overflow_forward();
  check_overflow_at_knot();
  check_overflow_of_theta();
  check_overflow_backward();
  check_poll();
  check_poll_backward();
  check_free();
  check_free_bound();
  check_step();
  check_low_words();
  check_low_words_in_rows();
  check_shared_table();
  return rot_test_report("axle");
}
