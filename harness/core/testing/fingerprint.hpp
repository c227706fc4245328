// Fingerprint: one number that stands for many exact values, for tests that pin them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "reference/types/exchange.hpp"

namespace ulpgate::testing {

// FNV-1a over the bytes of words, the low one first.  Values count as sign, exponent and significand: the
// same in every type that holds them, and on every machine.
class Fingerprint {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i, word >>= 8U) {
      hash_ ^= word & 0xffU;
      hash_ *= 0x100000001b3ULL;
    }
  }
  void add_position(__int128 x) {
    add(static_cast<std::uint64_t>(x));
    add(static_cast<std::uint64_t>(x >> 64));
  }
  void add_value(mpfr_srcptr x) {
    add(mpfr_signbit(x) != 0 ? 1 : 0);
    if (mpfr_regular_p(x) == 0) return add(mpfr_nan_p(x) != 0 ? 2 : mpfr_inf_p(x) != 0 ? 3 : 4);
    mpz_t z;
    mpz_init(z);
    mpfr_exp_t exponent = mpfr_get_z_2exp(z, x);
    // Without the zeros that the precision of x appends.
    const mp_bitcnt_t zeros = mpz_scan1(z, 0);
    mpz_tdiv_q_2exp(z, z, zeros);
    exponent += static_cast<mpfr_exp_t>(zeros);
    add(static_cast<std::uint64_t>(exponent));
    for (std::size_t i = 0; i < mpz_size(z); ++i) add(mpz_getlimbn(z, static_cast<mp_size_t>(i)));
    mpz_clear(z);
  }
  template <RealType Real>
  void add_value(const Real& x) {
    MpfrValue v(std::numeric_limits<Real>::digits);
    to_mpfr(v.get(), x);
    add_value(v.get());
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

// As it stands in a table.
inline std::string literal(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace ulpgate::testing
