/* The nodes and weights of Gauss and Legendre, with the names of GSL that the core uses. */
#ifndef ROTDYN_FEW_INTEGRATION_H
#define ROTDYN_FEW_INTEGRATION_H

#include <stddef.h>

typedef struct gsl_integration_glfixed_table gsl_integration_glfixed_table;

gsl_integration_glfixed_table *gsl_integration_glfixed_table_alloc(size_t n);
void gsl_integration_glfixed_table_free(gsl_integration_glfixed_table *table);
/* Node and weight i, from the left, on [a, b]. */
int gsl_integration_glfixed_point(double a, double b, size_t i, double *xi, double *wi,
                                  const gsl_integration_glfixed_table *table);

#endif
