/* The status codes of GSL that the core uses. */
#ifndef ROTDYN_FEW_ERRNO_H
#define ROTDYN_FEW_ERRNO_H

enum { GSL_SUCCESS = 0, GSL_EBADFUNC = 9 };

typedef void gsl_error_handler_t(const char *reason, const char *file, int line, int gsl_errno);
gsl_error_handler_t *gsl_set_error_handler_off(void);

#endif
