// ULP error, float distance and outcome of one result against its exact value.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <string_view>

#include "reference/types/exchange.hpp"
#include "reference/types/widen.hpp"

namespace ulpgate {

// What became of one evaluation.  `finite` means that the error in ULP describes it (an agreed NaN or
// infinity is finite with error 0); every other class is a mismatch that is counted and gates.
enum class Outcome {
  finite,
  nan,                // NaN where there is a value
  not_nan,            // a value where NaN is right
  inf,                // an infinity of the wrong sign, or a number where the exact value is infinite (a pole)
  zero_sign,          // both zero, the sign differs
  overflow_spurious,  // an infinity although the exact value is more than 1 ULP inside the range
  overflow_missed,    // a number more than 1 ULP away although the exact value rounds to an infinity
  underflow_spurious,  // zero although the exact value is more than 1 ULP from it
  nonzero_for_zero,    // not zero where the exact value is zero
  exception,           // the function threw
  // Of foreign functions, which run in a process of their own:
  crash,           // it ended the process
  hang,            // it did not return
  not_a_function,  // it gave another value for the same argument
  lane_dependent,  // ... beside other lanes of a vector
  environment,     // it left another rounding, precision or treatment of subnormals behind
};
inline constexpr std::array<std::string_view, 15> outcome_names = {"finite",
                                                                   "nan",
                                                                   "not_nan",
                                                                   "inf",
                                                                   "zero_sign",
                                                                   "overflow_spurious",
                                                                   "overflow_missed",
                                                                   "underflow_spurious",
                                                                   "nonzero_for_zero",
                                                                   "exception",
                                                                   "crash",
                                                                   "hang",
                                                                   "not_a_function",
                                                                   "lane_dependent",
                                                                   "environment"};
inline constexpr std::size_t outcome_count = outcome_names.size();
[[nodiscard]] inline std::string_view name_of(Outcome o) {
  return outcome_names[static_cast<std::size_t>(o)];
}

// ULP: |got - exact| / ulp(exact), in units of the spacing of the format in the binade of the exact,
// unrounded value; below the least normal number the spacing is the least positive number, subnormal where
// the format has such (Muller et al., Handbook of Floating-Point Arithmetic, 2nd ed., section 2.3.1;
// Goldberg's definition).  So a correctly rounded result is off by 1/2 ULP at most, in every format at every
// value.  A strong type: a ULP is not a double.
struct Ulp {
  double value = 0;
  friend auto operator<=>(const Ulp&, const Ulp&) = default;
};

// Both finite; got is a value of the format.  Rounded up, by a relative 2^-51 at most: it is above 1/2 where
// the error is.
[[nodiscard]] Ulp ulp_error(mpfr_srcptr got, mpfr_srcptr exact, const FloatFormat& format);

// Number of representable steps between two finite values of the format, +-0 being one value.  A format
// without subnormals has its least value one step from zero.  Unlike boost::math::float_distance it never
// throws and counts across zero in every format; above 2^53 the count is rounded to double.
[[nodiscard]] double float_distance(mpfr_srcptr a, mpfr_srcptr b, const FloatFormat& format);

struct Judgement {
  Outcome outcome = Outcome::finite;
  Ulp error;                      // 0 for an agreed NaN or infinity; meaningless for a mismatch
  double distance = 0;            // float_distance to the correctly rounded value; meaningless for a mismatch
  bool correctly_rounded = true;  // got is the format's value nearest to exact
};

// The error as it is recorded: rounded up to 40 significant bits and to a multiple of 2^-40 ULP.  A reference
// of bounded error can then prove what is recorded, and no number looks better than it is.
[[nodiscard]] Ulp recorded(Ulp error);

// Judges `got` (a value of the format, or NaN or an infinity) against the unrounded `exact`.  Where exactly
// one of the two is infinite and the exact value lies within 1 ULP of the overflow threshold 2^(emax+1),
// infinity counts as that threshold; so results on either side of overflow are measured rather than
// condemned.
[[nodiscard]] Judgement judge(mpfr_srcptr got, mpfr_srcptr exact, const FloatFormat& format);

// Typed convenience for kernels and tests: error of a Real against its reference of higher precision.
template <RealType Real, RealType Reference>
requires widens_exactly<Real, Reference>
[[nodiscard]] Judgement judge(const Real& got, const Reference& exact) {
  MpfrValue g(std::numeric_limits<Real>::digits);
  MpfrValue e(std::numeric_limits<Reference>::digits);
  to_mpfr(g.get(), got);
  to_mpfr(e.get(), exact);
  return judge(g, e, float_format<Real>());
}

}  // namespace ulpgate
