// ULP error, float distance and outcome of one result against its exact value.
#include "reference/ulp/ulp.hpp"

#include <algorithm>
#include <cmath>

namespace ulpgate {

namespace {

// Exponent of the spacing of the format at a value in binade e.  Between 0 and the least normal number it is
// the least positive number, whichever that is.
long spacing_exponent(long e, const FloatFormat& f) {
  if (e < f.exponent_min) return f.exponent_least();
  return std::min(e, f.exponent_max) - (f.precision - 1);
}

double scaled_difference(mpfr_srcptr got, mpfr_srcptr exact, long exponent) {
  static thread_local MpfrValue difference(96);
  // Away from zero: an error that no double holds is still an error, and one above 1/2 ULP stays above it.
  mpfr_sub(difference, got, exact, MPFR_RNDA);
  mpfr_mul_2si(difference, difference, -exponent, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference, MPFR_RNDA));
}

// Position of |x| among the non-negative values of the format, as an exact integer in out.
void ordinal(mpfr_ptr out, mpfr_srcptr x, const FloatFormat& f) {
  if (mpfr_zero_p(x)) {
    mpfr_set_zero(out, 1);
    return;
  }
  const long e = std::max(binade(x), f.exponent_min);
  mpfr_abs(out, x, MPFR_RNDN);
  mpfr_mul_2si(out, out, f.precision - 1 - e, MPFR_RNDN);
  MpfrValue binades(f.precision + 64);
  mpfr_set_si_2exp(binades, e - f.exponent_min, f.precision - 1, MPFR_RNDN);
  mpfr_add(out, out, binades, MPFR_RNDN);
  if (!f.subnormals) {
    mpfr_set_ui_2exp(binades, 1, f.precision - 1, MPFR_RNDN);
    mpfr_sub_ui(binades, binades, 1, MPFR_RNDN);
    mpfr_sub(out, out, binades, MPFR_RNDN);
  }
}

// The overflow threshold 2^(emax+1) with the sign of x.
mpfr_srcptr threshold(mpfr_srcptr x, const FloatFormat& f) {
  static thread_local MpfrValue value(MPFR_PREC_MIN);
  mpfr_set_si_2exp(value, mpfr_signbit(x) != 0 ? -1 : 1, f.exponent_max + 1, MPFR_RNDN);
  return value;
}

Judgement mismatch(Outcome outcome) {
  return {outcome, {}, 0, false};
}

Judgement judge_got_zero(mpfr_srcptr got, mpfr_srcptr exact, mpfr_srcptr rounded, const FloatFormat& f) {
  const bool sign_differs = mpfr_signbit(got) != mpfr_signbit(exact);
  if (mpfr_zero_p(rounded)) {
    if (sign_differs) return mismatch(Outcome::zero_sign);
    return {Outcome::finite, ulp_error(got, exact, f), 0, true};
  }
  const Ulp error = ulp_error(got, exact, f);
  if (error.value > 1) return mismatch(Outcome::underflow_spurious);
  if (sign_differs) return mismatch(Outcome::zero_sign);
  return {Outcome::finite, error, float_distance(got, rounded, f), false};
}

}  // namespace

Ulp ulp_error(mpfr_srcptr got, mpfr_srcptr exact, const FloatFormat& format) {
  const WideExponentRange wide;
  const long spacing =
      mpfr_regular_p(exact) ? spacing_exponent(binade(exact), format) : format.exponent_least();
  return {scaled_difference(got, exact, spacing)};
}

double float_distance(mpfr_srcptr a, mpfr_srcptr b, const FloatFormat& format) {
  if (mpfr_equal_p(a, b)) return 0;
  const WideExponentRange wide;
  static thread_local MpfrValue x;
  static thread_local MpfrValue y;
  // Enough for precision - 1 bits below and 63 bits of exponent above.
  mpfr_set_prec(x, format.precision + 66);
  mpfr_set_prec(y, format.precision + 66);
  ordinal(x, a, format);
  ordinal(y, b, format);
  if (mpfr_signbit(a) != 0) mpfr_neg(x, x, MPFR_RNDN);
  if (mpfr_signbit(b) != 0) mpfr_neg(y, y, MPFR_RNDN);
  mpfr_sub(x, x, y, MPFR_RNDN);
  return std::fabs(mpfr_get_d(x, MPFR_RNDN));
}

Ulp recorded(Ulp error) {
  if (!(error.value > 0) || !std::isfinite(error.value)) return error;
  int exponent = 0;
  std::frexp(error.value, &exponent);
  const int unit = std::max(exponent, 0) - 40;
  return {std::ldexp(std::ceil(std::ldexp(error.value, -unit)), unit)};
}

Judgement judge(mpfr_srcptr got, mpfr_srcptr exact, const FloatFormat& format) {
  const WideExponentRange wide;
  if (mpfr_nan_p(exact)) return mpfr_nan_p(got) ? Judgement{} : mismatch(Outcome::not_nan);
  if (mpfr_nan_p(got)) return mismatch(Outcome::nan);
  if (mpfr_inf_p(exact)) {
    const bool same = mpfr_inf_p(got) && mpfr_sgn(got) == mpfr_sgn(exact);
    return same ? Judgement{} : mismatch(Outcome::inf);
  }
  if (mpfr_zero_p(exact)) {
    if (!mpfr_zero_p(got)) return mismatch(mpfr_inf_p(got) ? Outcome::inf : Outcome::nonzero_for_zero);
    return mpfr_signbit(got) == mpfr_signbit(exact) ? Judgement{} : mismatch(Outcome::zero_sign);
  }

  static thread_local MpfrValue rounded;
  mpfr_set_prec(rounded, mpfr_get_prec(exact));
  mpfr_set(rounded, exact, MPFR_RNDN);
  round_to_format(rounded, format);

  if (mpfr_inf_p(got)) {
    if (mpfr_sgn(got) != mpfr_sgn(exact)) return mismatch(Outcome::inf);
    if (mpfr_inf_p(rounded)) return {};
    const Ulp error = ulp_error(threshold(exact, format), exact, format);
    if (error.value > 1) return mismatch(Outcome::overflow_spurious);
    return {Outcome::finite, error, 1, false};
  }
  if (mpfr_inf_p(rounded)) {
    const Ulp error = ulp_error(got, exact, format);
    if (error.value > 1) return mismatch(Outcome::overflow_missed);
    return {Outcome::finite, error, float_distance(got, threshold(exact, format), format), false};
  }
  if (mpfr_zero_p(got)) return judge_got_zero(got, exact, rounded, format);
  const bool nearest = mpfr_equal_p(got, rounded) != 0;
  return {Outcome::finite, ulp_error(got, exact, format), nearest ? 0 : float_distance(got, rounded, format),
          nearest};
}

}  // namespace ulpgate
