// Rounding of an MPFR number to a FloatFormat.
#include "reference/types/rounding.hpp"

#include <algorithm>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

// |x| is below the spacing of the least values: the result is 0 or the least value.
void round_below_least(mpfr_ptr x, const FloatFormat& format) {
  const int sign = mpfr_signbit(x) != 0 ? -1 : 1;
  // Nearest-even: the tie at half of the least value goes to zero.
  const int against_half = mpfr_cmpabs(x, [&] {
    static thread_local MpfrValue half(MPFR_PREC_MIN);
    mpfr_set_si_2exp(half, 1, format.exponent_least() - 1, MPFR_RNDN);
    return half.get();
  }());
  if (against_half > 0) {
    mpfr_set_si_2exp(x, sign, format.exponent_least(), MPFR_RNDN);
  } else {
    mpfr_set_zero(x, sign);
  }
}

}  // namespace

void round_to_format(mpfr_ptr x, const FloatFormat& format) {
  if (!mpfr_regular_p(x)) return;
  const WideExponentRange wide;
  if (binade(x) < format.exponent_least()) return round_below_least(x, format);
  const long lost = std::max(0L, format.exponent_min - binade(x));
  const long bits = format.precision - (format.subnormals ? lost : 0);
  if (mpfr_get_prec(x) > bits) {
    const mpfr_prec_t before = mpfr_get_prec(x);
    mpfr_prec_round(x, bits, MPFR_RNDN);
    mpfr_prec_round(x, before, MPFR_RNDN);
  }
  if (binade(x) > format.exponent_max) mpfr_set_inf(x, mpfr_sgn(x));
}

void step_in_format(mpfr_ptr x, long steps, const FloatFormat& format) {
  if (mpfr_nan_p(x)) return;
  const WideExponentRange wide;
  MpfrValue work(std::max<mpfr_prec_t>(mpfr_get_prec(x), format.precision + 2));
  MpfrValue spacing(MPFR_PREC_MIN);
  for (; steps != 0; steps += steps > 0 ? -1 : 1) {
    const int direction = steps > 0 ? 1 : -1;
    if (mpfr_inf_p(x)) {
      if ((mpfr_sgn(x) > 0) == (direction > 0)) return;
      // Stepping back from infinity lands on the largest value.
      mpfr_set_ui_2exp(work, 1, format.exponent_max + 1, MPFR_RNDN);
      mpfr_set_ui_2exp(spacing, 1, format.exponent_max - (format.precision - 1), MPFR_RNDN);
      mpfr_sub(work, work, spacing, MPFR_RNDN);
      if (direction > 0) mpfr_neg(work, work, MPFR_RNDN);
    } else if (mpfr_zero_p(x)) {
      mpfr_set_si_2exp(work, direction, format.exponent_least(), MPFR_RNDN);
    } else {
      const bool toward_zero = (mpfr_sgn(x) > 0) != (direction > 0);
      long e = binade(x);
      // A power of two has the narrower spacing of the binade below on the side of zero.
      mpfr_set_ui_2exp(spacing, 1, e, MPFR_RNDN);
      if (toward_zero && mpfr_cmpabs(x, spacing) == 0) --e;
      if (e < format.exponent_min && !format.subnormals && toward_zero) {
        mpfr_set_zero(work, mpfr_sgn(x));
      } else {
        mpfr_set_ui_2exp(spacing, 1, std::max(e, format.exponent_min) - (format.precision - 1), MPFR_RNDN);
        mpfr_set(work, x, MPFR_RNDN);
        if (direction > 0) {
          mpfr_add(work, work, spacing, MPFR_RNDN);
        } else {
          mpfr_sub(work, work, spacing, MPFR_RNDN);
        }
        if (mpfr_zero_p(work)) mpfr_set_zero(work, mpfr_sgn(x));
      }
    }
    round_to_format(work, format);
    mpfr_set(x, work, MPFR_RNDN);
  }
}

}  // namespace ulpgate
