/* Preloaded before the C library: one of its functions, off by some ULP in one interval.  NARROW_BUG holds
 * "FUNCTION LOW HIGH ULP"; ULP 0 gives NaN. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char function[16];
static double low = 1, high = 0;
static int ulp;

__attribute__((constructor)) static void read_plan(void) {
  const char *plan = getenv("NARROW_BUG");
  if (plan != NULL && sscanf(plan, "%15s %la %la %d", function, &low, &high, &ulp) != 4) {
    fputs("NARROW_BUG: want FUNCTION LOW HIGH ULP\n", stderr);
    exit(4);
  }
}

static int hit(const char *name, double x) { return x >= low && x <= high && strcmp(function, name) == 0; }

#define PLANT(type, name, next)                                   \
  type name(type x) {                                             \
    static type (*right)(type);                                   \
    if (right == NULL) right = (type(*)(type))dlsym(RTLD_NEXT, #name); \
    type y = right(x);                                            \
    if (!hit(#name, (double)x)) return y;                         \
    if (ulp == 0) return (type)NAN;                               \
    for (int i = 0; i < ulp; ++i) y = next(y, (type)INFINITY);    \
    return y;                                                     \
  }

PLANT(double, sin, nextafter)
PLANT(double, exp, nextafter)
PLANT(float, expf, nextafterf)
PLANT(float, log2f, nextafterf)
