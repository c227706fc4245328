/* Functions that do what foreign code should not, each at one argument or always; a library of the tests. */
#define _GNU_SOURCE
#include <fenv.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

double good_sin(double x) {
  return sin(x);
}
float good_sinf(float x) {
  return sinf(x);
}
long double good_sinl(long double x) {
  return sinl(x);
}

double crash_at_one(double x) {
  if (x == 1) *(volatile int*)8 = 1;
  return sin(x);
}
double exit_at_one(double x) {
  if (x == 1) _exit(3);
  return sin(x);
}
double hang_at_one(double x) {
  for (volatile int spin = 1; x == 1 && spin;) continue;
  return sin(x);
}
double sleep_at_one(double x) {
  while (x == 1) pause();
  return sin(x);
}
double hang_always(double x) {
  for (volatile int spin = 1; spin;) continue;
  return x;
}
double rounds_up_from_one(double x) {
  if (x == 1) fesetround(FE_UPWARD);
  return sin(x);
}
/* Every second call is off by a unit in the last place. */
double every_second_call(double x) {
  static int calls;
  const double y = sin(x);
  return ++calls % 2 == 0 && y == y ? nextafter(y, 2) : y;
}
/* What was called last decides. */
double last_argument(double x) {
  static double last = 0;
  const double y = last > x ? sin(x) : nextafter(sin(x), 2);
  last = x;
  return y;
}

void arrays_sin(long n, const double* x, double* y) {
  for (long i = 0; i < n; ++i) y[i] = sin(x[i]);
}
void arrays_crash_at_one(long n, const double* x, double* y) {
  for (long i = 0; i < n; ++i) {
    if (x[i] == 1) abort();
    y[i] = sin(x[i]);
  }
}
void arrays_pow(long n, const double* x, const double* y, double* z) {
  for (long i = 0; i < n; ++i) z[i] = pow(x[i], y[i]);
}
double sign_lgamma(double x, int* sign) {
  return lgamma_r(x, sign);
}

typedef double v2d __attribute__((vector_size(16)));
v2d vector_sin(v2d x) {
  return (v2d){sin(x[0]), sin(x[1])};
}
/* A neighbour that is no number spoils both. */
v2d vector_spoiled(v2d x) {
  const double bad = x[0] - x[0] + (x[1] - x[1]);
  return (v2d){sin(x[0]) + bad, sin(x[1]) + bad};
}
v2d vector_crash_at_one(v2d x) {
  if (x[0] == 1 || x[1] == 1) abort();
  return vector_sin(x);
}
void vector_sincos(v2d x, double* s, double* c) {
  for (int i = 0; i < 2; ++i) sincos(x[i], s + i, c + i);
}
/* As the vector ABI's "vvv": pointers in vectors, of floats two for as many lanes. */
typedef long v2l __attribute__((vector_size(16)));
typedef float v4f __attribute__((vector_size(16)));
void pointers_sincos(v2d x, v2l s, v2l c) {
  for (int i = 0; i < 2; ++i) sincos(x[i], (double*)s[i], (double*)c[i]);
}
void pointers_sincosf(v4f x, v2l s, v2l t, v2l c, v2l d) {
  for (int i = 0; i < 2; ++i) {
    sincosf(x[i], (float*)s[i], (float*)c[i]);
    sincosf(x[i + 2], (float*)t[i], (float*)d[i]);
  }
}
