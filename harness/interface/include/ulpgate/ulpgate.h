/* The C interface of ulpgate: errors in ULP, exact values, numbers of any precision, and accuracy tests of
 * functions of one's own.  C99 and C++; plain data alone crosses it, so that it does not matter how its user
 * was compiled.
 *
 * Types are named "float", "double" and "long double"; numbers are passed by address.  Functions are those of
 * `ulpgate list functions`.  What returns int returns one of the exit codes of the program: 0 done, 2 an
 * argument is wrong, 3 nothing measured, 4 a resource is missing; ulpgate_last_error() then says what. */
#ifndef ULPGATE_ULPGATE_H
#define ULPGATE_ULPGATE_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define ULPGATE_API __attribute__((visibility("default")))
#else
#define ULPGATE_API
#endif

/* NOLINTBEGIN(readability-identifier-naming): C */

#ifdef __cplusplus
extern "C" {
#endif

/* "0.1.0". */
ULPGATE_API const char* ulpgate_version(void);
/* Of this thread, of its last call that failed; empty where none did. */
ULPGATE_API const char* ulpgate_last_error(void);

/* ---- errors of results ---- */

/* Of `count` results of a function at `count` points: ulp[i] is |got - exact| / ulp(exact), rounded up;
 * infinity where the result is of another kind than the exact value (NaN, infinity, a zero of the other sign,
 * ...), which outcome[i] names by its number in ulpgate_outcome_name().  args holds the arguments of a point
 * side by side.  Either output may be null. */
ULPGATE_API int ulpgate_ulp_errors(const char* function, const char* type, const void* args, const void* got,
                                   size_t count, double* ulp, unsigned char* outcome);
/* "finite", "nan", ...; null beyond the last. */
ULPGATE_API const char* ulpgate_outcome_name(int outcome);

/* The error of `got` against an exact value that is a number of the type, or against a function's at `args`;
 * writes a text of several lines that says all that is known: distance, both values in hexadecimal and 17
 * digits, the exact value, the limit, and for a function the condition number and what errors of half a unit
 * in its arguments would cost alone. */
ULPGATE_API int ulpgate_describe_value(const char* type, const void* got, const void* exact, double limit_ulp,
                                       double* ulp, char* text, size_t size);
ULPGATE_API int ulpgate_describe_call(const char* type, const void* got, const char* function,
                                      const void* args, double limit_ulp, double* ulp, char* text,
                                      size_t size);

/* The function's value at arguments that are decimal or hexadecimal numbers of any length, to `digits`
 * digits. */
ULPGATE_API int ulpgate_exact(const char* function, const char* const* args, size_t arguments, int digits,
                              char* text, size_t size);
/* How many arguments it takes; 0 where there is no such function of one real result. */
ULPGATE_API int ulpgate_arity(const char* function);

/* ---- functions of one's own, held over strata ---- */

/* Evaluates `count` points: args holds the arguments of a point side by side, results one number each, both
 * of the type that was asked for. Returns 0; anything else ends the test with that code. */
typedef int (*ulpgate_batch)(void* user, const void* args, void* results, size_t count);
/* Holds a function to what it is meant to be: over the strata of `ulpgate math`, of `samples` points (uniform
 * and stratified together, binades a half more, and edges and hard arguments), judged against MPFR at four
 * times the precision.  Writes to *json a list of objects, one a stratum: function, type, stratum, samples,
 * seed, max_ulp, mean_ulp, argmax, got, exact, correctly_rounded, mismatch, mismatch_first.  ulpgate_free()
 * takes it back. */
ULPGATE_API int ulpgate_test_function(const char* function, const char* type, ulpgate_batch evaluate,
                                      void* user, uint64_t samples, uint64_t seed, char** json);
ULPGATE_API void ulpgate_free(char* text);

/* ---- numbers of any precision ---- */

typedef struct ulpgate_wide ulpgate_wide;
enum ulpgate_operation {
  ULPGATE_ADD,
  ULPGATE_SUB,
  ULPGATE_MUL,
  ULPGATE_DIV,
  ULPGATE_POW,
  ULPGATE_HYPOT,
  ULPGATE_ATAN2,
  ULPGATE_FMOD,
  ULPGATE_REMAINDER,
  ULPGATE_FMIN,
  ULPGATE_FMAX,
  ULPGATE_COPYSIGN,
  ULPGATE_NEG,
  ULPGATE_FABS,
  ULPGATE_SQRT,
  ULPGATE_CBRT,
  ULPGATE_EXP,
  ULPGATE_EXP2,
  ULPGATE_EXPM1,
  ULPGATE_LOG,
  ULPGATE_LOG2,
  ULPGATE_LOG10,
  ULPGATE_LOG1P,
  ULPGATE_SIN,
  ULPGATE_COS,
  ULPGATE_TAN,
  ULPGATE_ASIN,
  ULPGATE_ACOS,
  ULPGATE_ATAN,
  ULPGATE_SINH,
  ULPGATE_COSH,
  ULPGATE_TANH,
  ULPGATE_ASINH,
  ULPGATE_ACOSH,
  ULPGATE_ATANH,
  ULPGATE_ERF,
  ULPGATE_ERFC,
  ULPGATE_TGAMMA,
  ULPGATE_LGAMMA,
  ULPGATE_FLOOR,
  ULPGATE_CEIL,
  ULPGATE_TRUNC,
  ULPGATE_ROUND
};
/* Zero, of the precision that this thread asked for last (bits of the significand; 212 where it did not). */
ULPGATE_API ulpgate_wide* ulpgate_wide_new(void);
ULPGATE_API void ulpgate_wide_free(ulpgate_wide* x);
ULPGATE_API void ulpgate_wide_set_precision(long bits);
ULPGATE_API long ulpgate_wide_precision(void);
ULPGATE_API void ulpgate_wide_assign(ulpgate_wide* to, const ulpgate_wide* from);
ULPGATE_API void ulpgate_wide_assign_double(ulpgate_wide* to, double from);
ULPGATE_API void ulpgate_wide_assign_long_double(ulpgate_wide* to, long double from);
/* to = operation(a) or operation(a, b); b is null for those of one argument. */
ULPGATE_API void ulpgate_wide_apply(enum ulpgate_operation operation, ulpgate_wide* to, const ulpgate_wide* a,
                                    const ulpgate_wide* b);
/* to = a b + c, rounded once. */
ULPGATE_API void ulpgate_wide_fma(ulpgate_wide* to, const ulpgate_wide* a, const ulpgate_wide* b,
                                  const ulpgate_wide* c);
/* to = x 2^n. */
ULPGATE_API void ulpgate_wide_ldexp(ulpgate_wide* to, const ulpgate_wide* x, long n);
/* -1, 0, 1; 2 where one is a NaN. */
ULPGATE_API int ulpgate_wide_compare(const ulpgate_wide* a, const ulpgate_wide* b);
ULPGATE_API int ulpgate_wide_sign_bit(const ulpgate_wide* x);
/* 0 a number, 1 an infinity, 2 a NaN. */
ULPGATE_API int ulpgate_wide_kind(const ulpgate_wide* x);
ULPGATE_API double ulpgate_wide_to_double(const ulpgate_wide* x);

/* ---- accuracy tests of kernels ---- */

/* A function of some numbers that gives some numbers, in a type of its own and in wide numbers. */
struct ulpgate_kernel {
  const char* name;
  const char* type;
  int arguments;
  int results;
  const char* const* argument_names;
  const double* low; /* of each argument: between these */
  const double* high;
  /* Of `count` points whose arguments stand side by side, as do the results. */
  void (*evaluate)(const void* args, void* results, size_t count);
  /* The same function of one point. */
  void (*evaluate_wide)(const ulpgate_wide* const* args, ulpgate_wide* const* results);
};
/* A program of its own: draws arguments, holds every result to the wide one, prints a table and reproducers.
 * Options: --help. Returns 0 passed, 1 above a limit, 2 bad usage, 77 nothing could be measured. */
ULPGATE_API int ulpgate_kernel_main(int argc, char** argv, const struct ulpgate_kernel* kernels,
                                    size_t count);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
