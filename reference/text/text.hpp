// Exact text in and out: decimal and hexfloat, round trip for every Real.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "reference/types/exchange.hpp"

namespace ulpgate {

// Parses decimal ("-1.5e-3"), hexfloat ("0x1.8p+1"), "inf" and "nan" (any sign, any case) into out, rounded
// once to the format.  Returns false, out unspecified, if any character is left over or there is no number.
[[nodiscard]] bool parse_into(mpfr_ptr out, std::string_view text, const FloatFormat& format);

// "0x1.91eb851eb851fp+1", "-0x0p+0", "inf", "-inf", "nan"; exact, canonical: the leading digit is 1, no
// trailing zeros.  Subnormals are normalised as well, so one number has one text in every format.
[[nodiscard]] std::string to_hexfloat(mpfr_srcptr x);

// Scientific decimal text with `digits` significant digits, rounded to nearest.
[[nodiscard]] std::string to_decimal(mpfr_srcptr x, int digits);

template <RealType Real>
[[nodiscard]] Real parse_real(std::string_view text) {
  if constexpr (is_instrumented_real<Real>) {
    return Real(parse_real<typename Real::Value>(text));
  } else {
    MpfrValue value(std::numeric_limits<Real>::digits + 128);
    if (!parse_into(value, text, float_format<Real>())) {
      throw std::invalid_argument("not a number: '" + std::string(text) + "'");
    }
    return from_mpfr<Real>(value);
  }
}

template <RealType Real>
[[nodiscard]] std::string to_hexfloat(const Real& x) {
  MpfrValue value(std::numeric_limits<Real>::digits);
  to_mpfr(value.get(), x);
  return to_hexfloat(value.get());
}

// Enough decimal digits that parse_real gives the same value back.
template <RealType Real>
[[nodiscard]] std::string to_decimal(const Real& x) {
  MpfrValue value(std::numeric_limits<Real>::digits);
  to_mpfr(value.get(), x);
  return to_decimal(value.get(), std::numeric_limits<Real>::max_digits10);
}

}  // namespace ulpgate
