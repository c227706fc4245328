/* Preloaded before the C library, in place of a commit that changes it: ALTERED_FUNCTIONS is "" for the functions as
 * they are, holds "slow-exp" for an exp that does a fifth of its calls twice, "ulp-pow" for a pow whose result is the
 * next number. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double (*right_exp)(double);
static double (*right_pow)(double, double);
static int slow_exp, ulp_pow;

__attribute__((constructor)) static void read_plan(void) {
  const char *plan = getenv("ALTERED_FUNCTIONS");
  right_exp = (double (*)(double))dlsym(RTLD_NEXT, "exp");
  right_pow = (double (*)(double, double))dlsym(RTLD_NEXT, "pow");
  slow_exp = plan != NULL && strstr(plan, "slow-exp") != NULL;
  ulp_pow = plan != NULL && strstr(plan, "ulp-pow") != NULL;
}

double exp(double x) {
  static __thread unsigned count __attribute__((tls_model("initial-exec")));
  double y = right_exp(x);
  if (!slow_exp || ++count % 5 != 0) return y;
  /* Begins when the first call has its result, so that the two do not run side by side. */
  volatile double sink = right_exp(x + 0 * (y > 1 ? 1 : y));
  (void)sink;
  return y;
}

double pow(double x, double y) {
  double z = right_pow(x, y);
  /* Both ways take the same time. */
  volatile double up = nextafter(z, INFINITY);
  return ulp_pow ? up : z;
}
