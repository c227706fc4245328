// Exact text in and out.
#include "reference/text/text.hpp"

#include <algorithm>
#include <cctype>

namespace ulpgate {

namespace {

// Odd rounding: the truncated value keeps a mark that bits were lost, so that a second rounding is exact.
void mark_inexact(mpfr_ptr x) {
  mpz_t z;
  mpz_init(z);
  const mpfr_exp_t exponent = mpfr_get_z_2exp(z, x);
  if (mpz_even_p(z) != 0) {
    const int sign = mpz_sgn(z) < 0 ? -1 : 1;
    mpz_abs(z, z);
    mpz_setbit(z, 0);
    if (sign < 0) mpz_neg(z, z);
    mpfr_set_z_2exp(x, z, exponent, MPFR_RNDN);
  }
  mpz_clear(z);
}

std::string lower(std::string_view text) {
  std::string s(text);
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
  return s;
}

bool only_number_characters(const std::string& s, bool hex) {
  return std::all_of(s.begin(), s.end(), [&](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.' || c == 'e' ||
           (hex && (c == 'x' || c == 'p' || (c >= 'a' && c <= 'f')));
  });
}

}  // namespace

bool parse_into(mpfr_ptr out, std::string_view text, const FloatFormat& format) {
  const std::string s = lower(text);
  std::string_view body = s;
  const bool negative = body.starts_with('-');
  if (body.starts_with('-') || body.starts_with('+')) body.remove_prefix(1);
  if (body == "inf" || body == "infinity") {
    mpfr_set_inf(out, negative ? -1 : 1);
    return true;
  }
  if (body == "nan") {
    mpfr_set_nan(out);
    return true;
  }
  if (body.empty() || !only_number_characters(s, body.starts_with("0x"))) return false;
  const WideExponentRange wide;
  mpfr_set_prec(out, format.precision + 64);
  char* end = nullptr;
  const int inexact = mpfr_strtofr(out, s.c_str(), &end, body.starts_with("0x") ? 16 : 10, MPFR_RNDZ);
  if (end != s.c_str() + s.size()) return false;
  if (inexact != 0 && mpfr_regular_p(out)) mark_inexact(out);
  round_to_format(out, format);
  return true;
}

std::string to_hexfloat(mpfr_srcptr x) {
  if (mpfr_nan_p(x)) return "nan";
  const std::string sign = mpfr_signbit(x) != 0 ? "-" : "";
  if (mpfr_inf_p(x)) return sign + "inf";
  if (mpfr_zero_p(x)) return sign + "0x0p+0";
  mpz_t z;
  mpz_init(z);
  mpfr_get_z_2exp(z, x);
  mpz_abs(z, z);
  const long exponent = binade(x);
  // Shift so that the fraction's bits fill whole hexadecimal digits behind the leading one.
  mpz_tdiv_q_2exp(z, z, mpz_scan1(z, 0));
  const auto bits = static_cast<long>(mpz_sizeinbase(z, 2));
  mpz_mul_2exp(z, z, static_cast<mp_bitcnt_t>((4 - (bits - 1) % 4) % 4));
  std::string digits(mpz_sizeinbase(z, 16) + 2, '\0');
  mpz_get_str(digits.data(), 16, z);
  mpz_clear(z);
  digits.resize(digits.find('\0'));
  std::string text = sign + "0x" + digits.substr(0, 1);
  if (digits.size() > 1) text += "." + digits.substr(1);
  return text + "p" + (exponent < 0 ? "-" : "+") + std::to_string(std::abs(exponent));
}

std::string to_decimal(mpfr_srcptr x, int digits) {
  if (mpfr_nan_p(x)) return "nan";
  if (mpfr_inf_p(x)) return mpfr_sgn(x) < 0 ? "-inf" : "inf";
  char* buffer = nullptr;
  mpfr_asprintf(&buffer, "%.*Re", digits - 1, x);
  std::string text(buffer);
  mpfr_free_str(buffer);
  return text;
}

}  // namespace ulpgate
