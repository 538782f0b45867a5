/* Rows of a sweep: numbers by their paths, outputs, one model for all. */
#include "sweep/rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "rot_test.h"

static rot_object *made(const char *constructor) {
  rot_object *object = rot_object_new(constructor);
  ROT_CHECK(object != NULL);
  return object;
}

static void bench(const char *what, const rot_row_plan *plan, const double low[], const double high[]) {
  rot_rows_worker *w;
  rot_refusal no;
  rot_status status = rot_rows_open(plan, &w, &no);
  if (status != ROT_OK) { printf("%s: %d %zu %s\n", what, (int)status, no.input, no.reason); return; }
  enum { N = 100000 };
  double x[8], y[8], error, sum = 0;
  int bad = 0;
  clock_t t0 = clock();
  for (int i = 0; i < N; i++) {
    for (size_t k = 0; k < plan->n_inputs; k++) x[k] = low[k] + (high[k] - low[k]) * ((i * 37 % N) + 0.5) / N;
    bad += rot_rows_run(w, x, y, &error, NULL, &no) != ROT_OK;
    sum += y[0];
  }
  printf("%s: %.3f us, %d bad, %g\n", what, (double)(clock() - t0) / CLOCKS_PER_SEC / N * 1e6, bad, sum);
  rot_rows_close(w);
}

int main(void) {
  {
    rot_object *scene = made("scene_incline"), *ball = made("body_sphere");
    rot_object_number(ball, "mass_kg", 1); rot_object_number(ball, "radius_m", 0.1);
    rot_object_part(scene, "body", ball); rot_object_number(scene, "incline_angle_deg", 20);
    rot_object_number(scene, "static_friction", 0.1);
    const char *in[] = {"incline_angle_deg"}, *in2[] = {"body$radius_m", "incline_angle_deg"}, *out[] = {"final_x_m", "final_v_m_per_s"};
    double t = 2, lo[] = {10, 10}, hi[] = {30, 20}, lo2[] = {.1, 10}, hi2[]={.2,20};
    rot_row_plan plan = {scene, 1, in, 1, &t, "incline_exact", 0, 1e-9, 1e6, 2, out};
    bench("incline", &plan, lo, hi);
    plan.inputs = in2; plan.n_inputs = 2;
    bench("incline with body", &plan, lo2, hi2);
    rot_object_free(ball); rot_object_free(scene);
  }
  {
    rot_object *scene = made("scene_axle"), *ball = made("body_disk"), *r = made("resistance");
    rot_object_number(ball, "mass_kg", 2); rot_object_number(ball, "radius_m", 0.25);
    rot_object_part(scene, "body", ball); rot_object_number(scene, "torque", 0.8);
    rot_object_number(r, "viscous_n_m_s", 0.03);
    rot_object_part(scene, "resistance", r);
    const char *in[] = {"omega0_rad_per_s"}, *in2[] = {"body$mass_kg", "resistance$viscous_n_m_s"}, *out[] = {"final_theta_rad", "final_omega_rad_per_s", "lost_j"};
    double t = 2, lo[] = {0, 10}, hi[] = {3, 20}, lo2[] = {1, 0.01}, hi2[]={3,0.05};
    rot_row_plan plan = {scene, 1, in, 1, &t, "axle_linear", 0, 1e-9, 1e6, 2, out};
    bench("axle", &plan, lo, hi);
    plan.inputs = in2; plan.n_inputs = 2;
    bench("axle with body", &plan, lo2, hi2);
    plan.n_outputs = 3;
    bench("axle with body, lost_j", &plan, lo2, hi2);
    plan.n_outputs = 2;
    plan.model = NULL;
    bench("axle with body, choice", &plan, lo2, hi2);
    rot_object_number(r, "coulomb_n_m", 0.01);
    rot_object_part(scene, "resistance", r);
    plan.model = "axle_bands";
    bench("axle, dry friction", &plan, lo2, hi2);
    rot_object_free(ball); rot_object_free(r); rot_object_free(scene);
  }
  {
    rot_object *scene = made("scene_free"), *ball = made("body_box");
    rot_object_number(ball, "mass_kg", 2); rot_object_number(ball, "length_m", 0.25);rot_object_number(ball, "width_m", 0.35);rot_object_number(ball, "height_m", 0.45);
    rot_object_part(scene, "body", ball); double om[] = {1, 2, 3}; rot_object_numbers(scene, "omega0_rad_per_s", 3, om);
    const char *in[] = {"omega0_rad_per_s[2]"}, *in2[] = {"body$mass_kg"}, *out[] = {"final_qw", "final_omega_x_rad_per_s"};
    double t = 2, lo[] = {2, 10}, hi[] = {3, 20};
    rot_row_plan plan = {scene, 1, in, 1, &t, "free_exact", 0, 1e-9, 1e6, 2, out};
    bench("free", &plan, lo, hi);
    plan.inputs = in2;
    bench("free with body", &plan, lo, hi);
    rot_object_free(ball); rot_object_free(scene);
  }
  return 0;
}
