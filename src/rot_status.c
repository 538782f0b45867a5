#include "rot_status.h"

#include <math.h>
#include <string.h>

static const struct {
  const char *text, *kind;
} table[] = {
#define X(code, text, kind) {text, kind},
    ROT_STATUS_LIST(X)
#undef X
};

const char *rot_status_text(rot_status status) {
  return (unsigned)status < ROT_STATUS_COUNT ? table[status].text : "unknown status";
}

const char *rot_status_kind(rot_status status) {
  return (unsigned)status < ROT_STATUS_COUNT ? table[status].kind : "internal";
}

const char *rot_method_name(rot_method method) {
  static const char *const names[] = {
#define X(code, name) name,
      ROT_METHOD_LIST(X)
#undef X
  };
  return (unsigned)method < ROT_METHOD_COUNT ? names[method] : "unknown method";
}

void rot_info_clear(rot_info *info) {
  memset(info, 0, sizeof *info);
  info->omega_high = -INFINITY;
  info->omega_low = INFINITY;
}

static double relative(double error, double largest) {
  return error > 0 ? (largest > 0 ? error / largest : 1.0) : (error == 0 ? 0.0 : error);
}

double rot_info_error(const rot_info *info) {
  double theta = relative(info->theta_error, info->theta_max);
  double omega = relative(info->omega_error, info->omega_max);
  return theta >= omega || theta != theta ? theta : omega;
}

rot_status rot_poll(const rot_hooks *hooks, double fraction) {
  return hooks && hooks->poll ? hooks->poll(hooks->ctx, fraction) : ROT_OK;
}
