// Positions<Real>: the values of a type as integers in their order, exactly and back.
#pragma once

#include <bit>
#include <cstring>

#include "harness/core/search/search_space.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate {

template <RealType Real>
inline constexpr bool fits_128_bits = NativeReal<Real> || Float128Backed<Real>;

namespace detail {
template <RealType Real>
consteval auto pick_position() {
  if constexpr (fits_128_bits<Real>) {
    return std::type_identity<__int128>{};
  } else {
    // Significand, exponent and some room, in whole words.
    constexpr unsigned bits = (static_cast<unsigned>(std::numeric_limits<Real>::digits) + 48 + 63) / 64 * 64;
    return std::type_identity<WidePosition<bits>>{};
  }
}
}  // namespace detail
template <RealType Real>
using PositionOf = typename decltype(detail::pick_position<Real>())::type;

// IEEE types: every finite value has a position.  The others: the values with exponents from `least` up;
// between 2^least and zero lie positions that all stand for zero.
template <RealType Real>
class Positions {
 public:
  using Position = PositionOf<Real>;

  // Values below 2^least are taken as zero.
  explicit Positions(long least) : least_(least) {
    MpfrValue v(2);
    mpfr_set_si_2exp(v, 1, least, MPFR_RNDN);
    floor_ = from_mpfr<Real>(v);
  }

  [[nodiscard]] Position of(const Real& x) const {
    const bool negative = x < Real(0);
    const Position m = magnitude(negative ? Real(-x) : x);
    return negative ? Position(-m) : m;
  }
  [[nodiscard]] Real at(const Position& p) const {
    const bool negative = p < 0;
    const Real x = value(negative ? Position(-p) : p);
    if (x < floor_) return Real(0);
    return negative ? Real(-x) : x;
  }

 private:
  static constexpr int p = std::numeric_limits<Real>::digits;

  [[nodiscard]] Position magnitude(const Real& x) const {
    if constexpr (std::same_as<Real, float>) {
      return static_cast<Position>(std::bit_cast<std::uint32_t>(x) & 0x7fffffffU);
    } else if constexpr (std::same_as<Real, double>) {
      return static_cast<Position>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63U));
    } else if constexpr (std::same_as<Real, long double>) {
      // The significand's leading bit is explicit: it and the exponent say the same.
      std::uint64_t significand = 0;
      std::uint16_t exponent = 0;
      std::memcpy(&significand, &x, sizeof significand);
      std::memcpy(&exponent, reinterpret_cast<const char*>(&x) + sizeof significand, sizeof exponent);
      return (static_cast<Position>(exponent & 0x7fffU) << 63) |
             static_cast<Position>(significand & ~(std::uint64_t{1} << 63U));
#ifdef ULPGATE_HAVE_FLOAT128
    } else if constexpr (Float128Backed<Real>) {
      unsigned __int128 bits = 0;
      const __float128 q = x.backend().value();
      std::memcpy(&bits, &q, sizeof bits);
      return static_cast<Position>(bits << 1U >> 1U);
#endif
    } else {
      if (!(x >= floor_)) return 0;
      MpfrValue v(p);
      to_mpfr(v.get(), x);
      mpz_t z;
      mpz_init(z);
      mpfr_get_z_2exp(z, v);
      // p bits, the leading one set; it counts as the first binade.
      const auto short_of = p - static_cast<int>(mpz_sizeinbase(z, 2));
      if (short_of > 0) mpz_mul_2exp(z, z, static_cast<mp_bitcnt_t>(short_of));
      if (short_of < 0) mpz_tdiv_q_2exp(z, z, static_cast<mp_bitcnt_t>(-short_of));
      Position m = binade(v) - least_;
      m <<= p - 1;
      for (std::size_t i = 0; i < mpz_size(z); ++i)
        m += Position(mpz_getlimbn(z, static_cast<mp_size_t>(i))) << static_cast<int>(64 * i);
      mpz_clear(z);
      return m;
    }
  }

  [[nodiscard]] Real value(const Position& m) const {
    if constexpr (std::same_as<Real, float>) {
      return std::bit_cast<float>(static_cast<std::uint32_t>(m));
    } else if constexpr (std::same_as<Real, double>) {
      return std::bit_cast<double>(static_cast<std::uint64_t>(m));
    } else if constexpr (std::same_as<Real, long double>) {
      const auto exponent = static_cast<std::uint16_t>(m >> 63);
      auto significand = static_cast<std::uint64_t>(m) & ~(std::uint64_t{1} << 63U);
      if (exponent > 0) significand |= std::uint64_t{1} << 63U;
      long double x = 0;
      std::memcpy(&x, &significand, sizeof significand);
      std::memcpy(reinterpret_cast<char*>(&x) + sizeof significand, &exponent, sizeof exponent);
      return x;
#ifdef ULPGATE_HAVE_FLOAT128
    } else if constexpr (Float128Backed<Real>) {
      const auto bits = static_cast<unsigned __int128>(m);
      __float128 q = 0;
      std::memcpy(&q, &bits, sizeof q);
      return Real(q);
#endif
    } else {
      const Position binades = m >> (p - 1);
      if (binades == 0) return Real(0);
      Position significand = m - (binades << (p - 1)) + (Position(1) << (p - 1));
      mpz_t z;
      mpz_t part;
      mpz_inits(z, part, nullptr);
      for (int i = 0; significand != 0; ++i) {
        mpz_set_ui(part, static_cast<unsigned long>(significand & ~std::uint64_t{0}));
        mpz_mul_2exp(part, part, mp_bitcnt_t{64} * static_cast<mp_bitcnt_t>(i));
        mpz_add(z, z, part);
        significand >>= 64;
      }
      MpfrValue v(p);
      mpfr_set_z_2exp(v, z, static_cast<long>(binades) - 1 + least_ - (p - 1), MPFR_RNDN);
      mpz_clears(z, part, nullptr);
      return from_mpfr<Real>(v);
    }
  }

  long least_;
  Real floor_{};
};

}  // namespace ulpgate
