#include "maths/dense.h"

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

/* i => next node outward at a distance of at least `min`, d->count for none. Closely spaced nodes
 * beside long steps magnify the rounding of their values (1e4 times for a ratio of 5 per step). */
static size_t next_node(const rot_dense *d, size_t i, int rightward, double min) {
  const double here = rot_dense_node(d, i)[0];
  while (rightward ? i + 1 < d->count : i > 0) {
    i = rightward ? i + 1 : i - 1;
    if (fabs(rot_dense_node(d, i)[0] - here) >= min) return i;
  }
  return d->count;
}

/* Adds node i to the interpolation nodes, twice if its slope is used. */
static void take_node(rot_dense_form *form, const rot_dense *d, size_t i, size_t component) {
  const double *node = rot_dense_node(d, i);
  const double z = (node[0] - form->start) / form->width;
  form->z[form->terms] = z;
  form->c[form->terms++] = node[1 + component] - form->base;
  if (!d->slopes) return;
  form->z[form->terms] = z;
  form->c[form->terms++] = form->width * node[1 + d->dim + component];
}

rot_dense_form rot_dense_between(const rot_dense *d, size_t i, size_t component) {
  rot_dense_form form;
  const size_t each = d->slopes ? 2 : 1, max = d->slopes ? ROT_DENSE_NODES : ROT_DENSE_VALUES;
  memset(&form, 0, sizeof form);
  form.start = rot_dense_node(d, i)[0];
  form.width = rot_dense_node(d, i + 1)[0] - form.start;
  form.base = rot_dense_node(d, i)[1 + component];
  form.estimating = 2 * each;
  take_node(&form, d, i, component);
  take_node(&form, d, i + 1, component);
  /* Nodes on both sides in turn, nearest first: stable divided differences. */
  const double min = 0.25 * fabs(form.width);
  size_t left = next_node(d, i, 0, min), right = next_node(d, i + 1, 1, min), lefts = 0;
  for (size_t k = 2; k < max && (left < d->count || right < d->count); k++) {
    const int on_left = left < d->count && (right == d->count || 2 * lefts <= k - 2);
    const size_t at = on_left ? left : right;
    take_node(&form, d, at, component);
    if (on_left) {
      lefts++;
      left = next_node(d, at, 0, min);
    } else {
      right = next_node(d, at, 1, min);
    }
  }
  /* Divided differences; at a double node the first difference is the slope, set in take_node(). */
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

/* Close to the extrema of the slope of x^2 (1 - x)^2. */
static const double correction_at[ROT_DENSE_CORRECTIONS] = {0.2113, 0.7887};

double rot_dense_correction_at(const rot_dense_form *form) {
  return form->start + correction_at[form->corrections] * form->width;
}

/* (form, x) => product of (x - z) over the terms, its derivative *rise */
static double product_at(const rot_dense_form *form, double x, double *rise) {
  double product = 1.0;
  *rise = 0.0;
  for (size_t k = 0; k < form->terms; k++) {
    *rise = *rise * (x - form->z[k]) + product;
    product *= x - form->z[k];
  }
  return product;
}

void rot_dense_correct(rot_dense_form *form, double slope) {
  const double x = correction_at[form->corrections];
  double now, rise;
  if (form->corrections > 0) { /* the new term keeps the slope at the previous correction */
    const double before = correction_at[form->corrections - 1];
    form->terms--;
    const double product = product_at(form, before, &rise);
    form->z[form->terms++] = before + product / rise;
  }
  rot_dense_at(form, form->start + x * form->width, &now, NULL, NULL);
  product_at(form, x, &rise);
  form->c[form->terms++] = (slope - now) * form->width / rise;
  form->estimating = 1;
  form->corrections++;
}

double rot_dense_at(const rot_dense_form *form, double t, double *slope, double *unsure,
                    double *slope_unsure) {
  const double x = (t - form->start) / form->width;
  double value = 0.0, rise = 0.0, product = 1.0, product_rise = 0.0;
  double last = 0.0, last_rise = 0.0;
  for (size_t k = form->terms; k-- > 0;) {
    rise = rise * (x - form->z[k]) + value;
    value = value * (x - form->z[k]) + form->c[k];
  }
  if (unsure || slope_unsure) {
    double before = 1.0, before_rise = 0.0;
    for (size_t k = 0; k < form->terms; k++) {
      if (k + form->estimating >= form->terms) {
        /* The second correction is zero at the midpoint, where the error is not: half of the
         * previous product instead. */
        const int half = form->corrections > 1;
        last += fabs(form->c[k] * (half ? 0.5 * before : product));
        last_rise +=
            fabs(form->c[k] * product_rise) + (half ? fabs(form->c[k] * before_rise) : 0.0);
      }
      before = product;
      before_rise = product_rise;
      product_rise = product_rise * (x - form->z[k]) + product;
      product *= x - form->z[k];
    }
  }
  if (slope) *slope = rise / form->width;
  if (unsure) *unsure = last;
  if (slope_unsure) *slope_unsure = last_rise / fabs(form->width);
  return form->base + value;
}
