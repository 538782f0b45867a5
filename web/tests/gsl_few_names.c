/* The stand-in under other names, so that one program has it and GSL. */
#define gsl_set_error_handler_off           few_handler_off
#define gsl_odeiv2_step_rk8pd               few_rk8pd
#define gsl_odeiv2_step_alloc               few_alloc
#define gsl_odeiv2_step_free                few_free
#define gsl_odeiv2_step_apply               few_apply
#define gsl_integration_glfixed_table_alloc few_gl_alloc
#define gsl_integration_glfixed_table_free  few_gl_free
#define gsl_integration_glfixed_point       few_gl_point
#include "../core/gsl_few.c"

void *few_step_alloc(size_t dim);
int few_step_apply(void *step, double t, double h, double y[], double yerr[], const double in[],
                   double out[], int (*f)(double t, const double y[], double dydt[], void *params),
                   void *params);
void few_step_free(void *step);
void *few_table_alloc(size_t n);
void few_table_free(void *table);
void few_point(size_t i, double *x, double *w, const void *table);

void *few_step_alloc(size_t dim) { return few_alloc(few_rk8pd, dim); }

int few_step_apply(void *step, double t, double h, double y[], double yerr[], const double in[],
                   double out[], int (*f)(double t, const double y[], double dydt[], void *params),
                   void *params) {
  const gsl_odeiv2_step *of = step;
  const gsl_odeiv2_system system = {f, NULL, of->dim, params};
  return few_apply(step, t, h, y, yerr, in, out, &system);
}

void few_step_free(void *step) { few_free(step); }

void *few_table_alloc(size_t n) { return few_gl_alloc(n); }

void few_table_free(void *table) { few_gl_free(table); }

void few_point(size_t i, double *x, double *w, const void *table) {
  (void)few_gl_point(-1.0, 1.0, i, x, w, table);
}
