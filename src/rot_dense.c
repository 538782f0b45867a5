#include "rot_dense.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

rot_status rot_dense_insert(rot_dense *d, size_t at, double t, const double y[], const double f[]) {
  const size_t stride = 1 + 2 * d->dim;
  if (d->count == d->room) {
    const size_t room = d->room ? 2 * d->room : 64;
    double *data = realloc(d->data, room * stride * sizeof *data);
    if (!data) return ROT_ENOMEM;
    d->data = data;
    d->room = room;
  }
  double *node = d->data + at * stride;
  memmove(node + stride, node, (d->count - at) * stride * sizeof *node);
  node[0] = t;
  memcpy(node + 1, y, d->dim * sizeof *node);
  memcpy(node + 1 + d->dim, f, d->dim * sizeof *node);
  d->count++;
  return ROT_OK;
}

void rot_dense_drop(rot_dense *d, size_t count) {
  const size_t stride = 1 + 2 * d->dim;
  if (count > d->count) count = d->count;
  d->count -= count;
  if (d->data) memmove(d->data, d->data + count * stride, d->count * stride * sizeof *d->data);
}

void rot_dense_free(rot_dense *d) {
  free(d->data);
  d->data = NULL;
  d->count = d->room = 0;
}

rot_dense_form rot_dense_between(const rot_dense *d, size_t i, size_t component) {
  rot_dense_form form;
  const double *here = rot_dense_node(d, i), *next = rot_dense_node(d, i + 1);
  const size_t each = d->slopes ? 2 : 1, wanted = d->slopes ? ROT_DENSE_NODES : ROT_DENSE_VALUES;
  const size_t most = d->count < wanted ? d->count : wanted;
  size_t left = i, right = i + 1; /* the nodes not yet taken: left - 1 and right + 1 */
  memset(&form, 0, sizeof form);
  form.start = here[0];
  form.width = next[0] - here[0];
  form.base = here[1 + component];
  form.share = 2 * each;
  /* The two ends, then outward in turn: the nearest first keeps the differences stable. */
  for (size_t k = 0; k < most; k++) {
    size_t j = k == 0 ? i : i + 1;
    if (k > 1) {
      const int on_left = left > 0 && (right + 1 >= d->count || i - left < right - i - 1 ||
                                       (i - left == right - i - 1 && k % 2 == 0));
      j = on_left ? --left : ++right;
    }
    const double *node = rot_dense_node(d, j);
    for (size_t twin = 0; twin < each; twin++) {
      form.z[form.terms] = (node[0] - form.start) / form.width;
      form.c[form.terms++] = node[1 + component] - form.base;
    }
    if (each == 2) form.c[form.terms - 1] = form.width * node[1 + d->dim + component];
  }
  /* Divided differences; at a twin node the first one is the slope, put there above. */
  double value[ROT_DENSE_TERMS];
  for (size_t k = 0; k < form.terms; k++) value[k] = form.c[k - (each == 2 ? k % 2 : 0)];
  for (size_t j = 1; j < form.terms; j++) {
    for (size_t k = form.terms - 1; k >= j; k--) {
      if (j == 1 && each == 2 && k % 2 == 1) continue;
      const double above = form.c[k];
      const double below = j == 1 ? value[k - 1] : form.c[k - 1];
      form.c[k] = ((j == 1 ? value[k] : above) - below) / (form.z[k] - form.z[k - j]);
    }
  }
  return form;
}

double rot_dense_at(const rot_dense_form *form, double t, double *slope, double *share,
                    double *slope_share) {
  const double x = (t - form->start) / form->width;
  double value = 0.0, rise = 0.0, product = 1.0, product_rise = 0.0;
  double last = 0.0, last_rise = 0.0;
  for (size_t k = form->terms; k-- > 0;) {
    rise = rise * (x - form->z[k]) + value;
    value = value * (x - form->z[k]) + form->c[k];
  }
  if (share || slope_share) {
    for (size_t k = 0; k < form->terms; k++) {
      if (k + form->share >= form->terms) {
        last += fabs(form->c[k] * product);
        last_rise += fabs(form->c[k] * product_rise);
      }
      product_rise = product_rise * (x - form->z[k]) + product;
      product *= x - form->z[k];
    }
  }
  if (slope) *slope = rise / form->width;
  if (share) *share = last;
  if (slope_share) *slope_share = last_rise / fabs(form->width);
  return form->base + value;
}
