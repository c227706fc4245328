// Exact exchange between each Real and MPFR: to_mpfr never rounds, from_mpfr rounds once, to nearest-even.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "reference/types/format.hpp"
#include "reference/types/mpfr_value.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {

namespace detail {

// Sets out = +-(hi * 2^64 + lo) * 2^exponent exactly; out must have 128 bits at least.
inline void set_words(mpfr_ptr out, bool negative, std::uint64_t hi, std::uint64_t lo, long exponent) {
  mpfr_set_uj_2exp(out, hi, 64, MPFR_RNDN);
  mpfr_t low;
  mpfr_init2(low, 64);
  mpfr_set_uj(low, lo, MPFR_RNDN);
  mpfr_add(out, out, low, MPFR_RNDN);
  mpfr_clear(low);
  mpfr_mul_2si(out, out, exponent, MPFR_RNDN);
  if (negative) mpfr_neg(out, out, MPFR_RNDN);
}

#ifdef ULPGATE_HAVE_FLOAT128
inline void quad_to_mpfr(mpfr_ptr out, const Float128Real& x) {
  const __float128 q = x.backend().value();
  const bool negative = signbitq(q) != 0;
  if (isnanq(q)) return mpfr_set_nan(out);
  if (isinfq(q)) return mpfr_set_inf(out, negative ? -1 : 1);
  if (q == 0) return mpfr_set_zero(out, negative ? -1 : 1);
  int exponent = 0;
  const __float128 significand = ldexpq(frexpq(fabsq(q), &exponent), 113);
  const auto bits = static_cast<unsigned __int128>(significand);
  set_words(out, negative, static_cast<std::uint64_t>(bits >> 64U), static_cast<std::uint64_t>(bits),
            exponent - 113L);
}

// `rounded` is a value of the binary128 format already.
inline Float128Real quad_from_mpfr(mpfr_srcptr rounded) {
  const bool negative = mpfr_signbit(rounded) != 0;
  __float128 q = 0;
  if (mpfr_nan_p(rounded)) return Float128Real(nanq(""));
  if (mpfr_inf_p(rounded)) {
    q = std::numeric_limits<double>::infinity();
  } else if (!mpfr_zero_p(rounded)) {
    mpz_t z;
    mpz_init(z);
    const long exponent = static_cast<long>(mpfr_get_z_2exp(z, rounded));
    mpz_abs(z, z);
    // At most 113 significant bits, but trailing zeros may make the integer longer than 128 bits.
    const auto shift = static_cast<long>(mpz_sizeinbase(z, 2)) - 113;
    if (shift > 0) mpz_tdiv_q_2exp(z, z, static_cast<mp_bitcnt_t>(shift));
    const std::uint64_t lo = mpz_get_ui(z);
    mpz_tdiv_q_2exp(z, z, 64);
    const std::uint64_t hi = mpz_get_ui(z);
    mpz_clear(z);
    const auto bits = (static_cast<unsigned __int128>(hi) << 64U) | lo;
    q = ldexpq(static_cast<__float128>(bits), static_cast<int>(exponent + (shift > 0 ? shift : 0)));
  }
  return Float128Real(negative ? -q : q);
}
#endif

template <CppBinFloatBacked Real>
void bin_float_to_mpfr(mpfr_ptr out, const Real& x) {
  const WideExponentRange wide;  // its exponents reach twice as far as MPFR's default
  const auto& backend = x.backend();
  using Backend = std::remove_cvref_t<decltype(backend)>;
  const bool negative = backend.sign();
  if (backend.exponent() == Backend::exponent_nan) return mpfr_set_nan(out);
  if (backend.exponent() == Backend::exponent_infinity) return mpfr_set_inf(out, negative ? -1 : 1);
  if (backend.exponent() == Backend::exponent_zero) return mpfr_set_zero(out, negative ? -1 : 1);
  mpz_t z;
  mpz_init(z);
  const auto& limbs = backend.bits();
  mpz_import(z, limbs.size(), -1, sizeof(*limbs.limbs()), 0, 0, limbs.limbs());
  mpfr_set_z_2exp(out, z, static_cast<mpfr_exp_t>(backend.exponent()) - (Backend::bit_count - 1L), MPFR_RNDN);
  mpz_clear(z);
  if (negative) mpfr_neg(out, out, MPFR_RNDN);
}

template <CppBinFloatBacked Real>
Real bin_float_from_mpfr(mpfr_srcptr rounded) {
  const bool negative = mpfr_signbit(rounded) != 0;
  Real r;
  if (mpfr_nan_p(rounded)) return std::numeric_limits<Real>::quiet_NaN();
  if (mpfr_inf_p(rounded)) {
    r = std::numeric_limits<Real>::infinity();
  } else if (mpfr_zero_p(rounded)) {
    r = 0;
  } else {
    mpz_t z;
    mpz_init(z);
    const auto exponent = static_cast<long>(mpfr_get_z_2exp(z, rounded));
    mpz_abs(z, z);
    r = 0;
    // 32 bits at a time from the top: every partial sum is exact because the total fits the significand.
    const long limbs = static_cast<long>((mpz_sizeinbase(z, 2) + 31) / 32);
    mpz_t part;
    mpz_init(part);
    for (long i = limbs - 1; i >= 0; --i) {
      mpz_tdiv_q_2exp(part, z, static_cast<mp_bitcnt_t>(32 * i));
      const auto digit = static_cast<std::uint32_t>(mpz_get_ui(part) & 0xffffffffUL);
      if (digit != 0) r += ldexp(Real(digit), static_cast<int>(32 * i));
    }
    mpz_clear(part);
    mpz_clear(z);
    // Of the least numbers the exponent of the last bit is no int: the first bit's is.
    const long first = 32 * limbs;
    r = ldexp(Real(ldexp(r, static_cast<int>(-first))), static_cast<int>(exponent + first));
  }
  return negative ? Real(-r) : r;
}

}  // namespace detail

// Sets out to x exactly; raises out's precision to that of Real if needed.
template <RealType Real>
void to_mpfr(mpfr_ptr out, const Real& x) {
  constexpr long bits = Float128Backed<Real> ? 128 : std::numeric_limits<Real>::digits;
  if (mpfr_get_prec(out) < bits) mpfr_set_prec(out, bits);
  if constexpr (std::same_as<Real, float>) {
    mpfr_set_flt(out, x, MPFR_RNDN);
  } else if constexpr (std::same_as<Real, double>) {
    mpfr_set_d(out, x, MPFR_RNDN);
  } else if constexpr (std::same_as<Real, long double>) {
    mpfr_set_ld(out, x, MPFR_RNDN);
  } else if constexpr (MpfrBacked<Real>) {
    mpfr_set(out, x.backend().data(), MPFR_RNDN);
  } else if constexpr (CppBinFloatBacked<Real>) {
    detail::bin_float_to_mpfr(out, x);
#ifdef ULPGATE_HAVE_FLOAT128
  } else {
    detail::quad_to_mpfr(out, x);
#endif
  }
}

// The Real nearest to x (ties to even, gradual underflow and overflow as in Real's format).
template <RealType Real>
[[nodiscard]] Real from_mpfr(mpfr_srcptr x) {
  const WideExponentRange wide;
  MpfrValue rounded(mpfr_get_prec(x));
  mpfr_set(rounded, x, MPFR_RNDN);
  round_to_format(rounded, float_format<Real>());
  if constexpr (std::same_as<Real, float>) {
    return mpfr_get_flt(rounded, MPFR_RNDN);
  } else if constexpr (std::same_as<Real, double>) {
    return mpfr_get_d(rounded, MPFR_RNDN);
  } else if constexpr (std::same_as<Real, long double>) {
    return mpfr_get_ld(rounded, MPFR_RNDN);
  } else if constexpr (MpfrBacked<Real>) {
    Real r;
    mpfr_set(r.backend().data(), rounded, MPFR_RNDN);
    return r;
  } else if constexpr (CppBinFloatBacked<Real>) {
    return detail::bin_float_from_mpfr<Real>(rounded);
#ifdef ULPGATE_HAVE_FLOAT128
  } else {
    return detail::quad_from_mpfr(rounded);
#endif
  }
}

}  // namespace ulpgate
