// The math functions as their users call them: names resolve by ADL to the library that the type really uses.
#pragma once

#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/factorials.hpp>
#include <boost/math/special_functions/laguerre.hpp>
#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <cmath>
#include <complex>

#include "kernels/math/boost_start_up.hpp"
#include "reference/functions/function_info.hpp"
#include "reference/types/complex.hpp"

namespace ulpgate::math {

// Errors of Boost.Math come back as NaN or infinity, like the C library's, so that they are judged as
// results.
using QuietPolicy = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::pole_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
    boost::math::policies::rounding_error<boost::math::policies::ignore_error>>;

// result[part] = part of f(args); args has the function's arity, result its parts.
template <FunctionId Id, RealType Real>
struct Function;

#define ULPGATE_FUNCTION(token, ...)                                  \
  template <RealType Real>                                            \
  struct Function<FunctionId::token, Real> {                          \
    static void evaluate(const Real* a, Real* result) { __VA_ARGS__ } \
  };
#define ULPGATE_COMPLEX(token, ...)                     \
  template <RealType Real>                              \
  struct Function<FunctionId::token, Real> {            \
    static void evaluate(const Real* a, Real* result) { \
      using Complex = ComplexHP<1, Real>;               \
      __VA_ARGS__                                       \
    }                                                   \
  };

#define REAL1(name, d0, hard, oracle) ULPGATE_FUNCTION(name, using std::name; result[0] = name(a[0]);)
#define REAL2(name, d0, d1, hard, oracle) \
  ULPGATE_FUNCTION(name, using std::name; result[0] = name(a[0], a[1]);)
#define REAL3(name, d0, d1, d2, hard, oracle) \
  ULPGATE_FUNCTION(name, using std::name; result[0] = name(a[0], a[1], a[2]);)
#define OPER2(name, op, d0, d1, hard, oracle) ULPGATE_FUNCTION(name, result[0] = a[0] op a[1];)
#define COMPLEX1(token, callee, oracle)                                                    \
  ULPGATE_COMPLEX(token, using std::callee; const Complex w = callee(Complex(a[0], a[1])); \
                  result[0] = w.real(); result[1] = w.imag();)
#define COMPLEX2(token, callee, oracle)                                                                     \
  ULPGATE_COMPLEX(token, using std::callee;                                                                 \
                  const Complex w = callee(Complex(a[0], a[1]), Complex(a[2], a[3])); result[0] = w.real(); \
                  result[1] = w.imag();)
#define COMPLEX_REAL(token, callee, oracle) \
  ULPGATE_COMPLEX(token, using std::callee; result[0] = callee(Complex(a[0], a[1]));)
#define POLAR(token, callee)                                                                            \
  ULPGATE_COMPLEX(token, using std::callee; const Complex w = callee(a[0], a[1]); result[0] = w.real(); \
                  result[1] = w.imag();)
#include "reference/functions/functions.def"

ULPGATE_FUNCTION(cyl_bessel_j,
                 result[0] = boost::math::cyl_bessel_j(static_cast<int>(a[0]), a[1], QuietPolicy());)
ULPGATE_FUNCTION(factorial,
                 result[0] = boost::math::factorial<Real>(static_cast<unsigned>(a[0]), QuietPolicy());)
ULPGATE_FUNCTION(laguerre,
                 result[0] = boost::math::laguerre(static_cast<unsigned>(a[0]), static_cast<unsigned>(a[1]),
                                                   a[2], QuietPolicy());)
ULPGATE_FUNCTION(spherical_harmonic, const auto n = static_cast<unsigned>(a[0]);
                 const auto m = static_cast<int>(a[1]);
                 result[0] = boost::math::spherical_harmonic_r(n, m, a[2], a[3], QuietPolicy());
                 result[1] = boost::math::spherical_harmonic_i(n, m, a[2], a[3], QuietPolicy());)

#undef ULPGATE_FUNCTION
#undef ULPGATE_COMPLEX

}  // namespace ulpgate::math
