// NarrowArguments<Real>: a sequence of arguments that leaves no wide gap anywhere, for scans of millions.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {

// Argument a of point n is made of the word u = offset + n * step mod 2^64, where step / 2^64 is the fraction
// of an irrational number that rationals approximate badly: the first N points cut the circle into gaps of at
// most 3 / N (Kronecker; the three-gap theorem).  Half of the circle belongs to the ordinary magnitudes 1/4
// to 128 or the nine greatest that the domain has, a quarter to 2^-31 to 2^31, a quarter to all exponents;
// every signed binade of such a band has an equal arc, with evenly spread significands.  So of N points no
// interval of relative width 6 / N * (signed binades of the band) / (share of the band) is missed.
template <class Real>
class NarrowArguments {
  static_assert(std::same_as<Real, float> || std::same_as<Real, double>);

 public:
  // A real function of at most three arguments.
  NarrowArguments(const FunctionInfo& f, std::uint64_t seed)
      : arity_(static_cast<std::size_t>(f.arity)), power_(f.id == FunctionId::pow) {
    const ExponentRange all = sampled_exponents(f, float_format<Real>());
    const RandomStream stream(seed, f.name, name_of(Stratum::narrow));
    for (std::size_t a = 0; a < arity_; ++a) {
      stream.fill(0, a, {&offsets_[a], 1});
      const Sides sides = sides_of(f.domain[a], all);
      bands_[a] = {band(sides, -2, 6), band(sides, -31, 30), band(sides, all.least, all.greatest)};
    }
  }

  // Writes points n .. n + count - 1 to out, one argument after the other.
  void fill(std::uint64_t n, std::size_t count, Real* out) const {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t a = 0; a < arity_; ++a) {
        const std::uint64_t u = offsets_[a] + (n + i) * steps[a];
        const bool ordinary = (u >> 63U) == 0;
        const Band& band = ordinary ? bands_[a][0] : bands_[a][(u >> 62U) == 2 ? 1 : 2];
        *out = power_ && a == 1 ? exponent_of_power(u, out[-1]) : in_band(band, ordinary ? u << 1U : u << 2U);
        ++out;
      }
    }
  }

 private:
  static constexpr int digits = std::numeric_limits<Real>::digits;
  static constexpr long exponent_min = std::numeric_limits<Real>::min_exponent - 1;
  static constexpr long exponent_max = std::numeric_limits<Real>::max_exponent - 1;
  // The fractions of the golden section, sqrt(2) and sqrt(3).
  static constexpr std::array<std::uint64_t, 3> steps = {0x9e3779b97f4a7c15U, 0x6a09e667f3bcc909U,
                                                         0xbb67ae8584caa73bU};

  // The exponents that a domain has on either side of zero; none where least > greatest.
  struct Sides {
    ExponentRange positive;
    ExponentRange negative;
  };
  struct Band {
    long least_positive = 0;
    long least_negative = 0;
    std::uint64_t positives = 0;  // binades
    std::uint64_t negatives = 0;
  };

  static Sides sides_of(DomainMap map, ExponentRange all) {
    constexpr ExponentRange none{1, 0};
    const ExponentRange below_one{all.least, -1};
    switch (map) {
      case DomainMap::GT0:
        return {all, none};
      case DomainMap::GT1:
        return {{0, all.greatest}, none};
      case DomainMap::PM1:
        return {below_one, below_one};
      case DomainMap::GTM1:
        return {all, below_one};
      default:
        return {all, all};
    }
  }

  // The band [least, greatest] moved into what a side has, and cut to it.
  static ExponentRange within(ExponentRange side, long least, long greatest) {
    if (side.least > side.greatest) return side;
    const long width = greatest - least;
    const long top = std::clamp(greatest, std::min(side.least + width, side.greatest), side.greatest);
    return {std::max(top - width, side.least), top};
  }
  static Band band(const Sides& sides, long least, long greatest) {
    const ExponentRange p = within(sides.positive, least, greatest);
    const ExponentRange n = within(sides.negative, least, greatest);
    return {p.least, n.least, static_cast<std::uint64_t>(p.greatest - p.least + 1),
            static_cast<std::uint64_t>(n.greatest - n.least + 1)};
  }

  static Real in_band(const Band& band, std::uint64_t v) {
    const auto product = static_cast<unsigned __int128>(v) * (band.positives + band.negatives);
    const auto binade = static_cast<std::uint64_t>(product >> 64U);
    const bool negative = binade >= band.positives;
    const long exponent = negative ? band.least_negative + static_cast<long>(binade - band.positives)
                                   : band.least_positive + static_cast<long>(binade);
    return number(negative, exponent, static_cast<std::uint64_t>(product));
  }

  // 1.fraction times 2^exponent; a subnormal number keeps the leading bits.
  static Real number(bool negative, long exponent, std::uint64_t fraction) {
    using Bits = std::conditional_t<std::same_as<Real, float>, std::uint32_t, std::uint64_t>;
    auto bits = static_cast<Bits>(fraction >> (65 - digits));
    if (exponent >= exponent_min) {
      bits |= static_cast<Bits>(exponent + exponent_max) << (digits - 1);
    } else {
      bits = static_cast<Bits>(bits | Bits{1} << (digits - 1)) >> (exponent_min - exponent);
    }
    bits |= static_cast<Bits>(negative) << (sizeof(Real) * 8 - 1);
    return std::bit_cast<Real>(bits);
  }

  // |y log2 x| from 2^-20 to a little beyond the range of exponents.
  static Real exponent_of_power(std::uint64_t u, Real x) {
    const long e =
        x > 0 ? static_cast<long>(std::bit_cast<std::uint64_t>(static_cast<double>(x)) >> 52U) - 1023 : 0;
    const auto magnitude = static_cast<long>(std::bit_width(static_cast<unsigned long>(std::labs(e))));
    constexpr auto limit = static_cast<long>(std::bit_width(static_cast<unsigned long>(exponent_max)));
    const auto count = static_cast<std::uint64_t>(limit - magnitude + 21);
    return in_band({-20, -20, count, count}, u);
  }

  std::size_t arity_;
  bool power_;
  std::array<std::uint64_t, 3> offsets_{};
  std::array<std::array<Band, 3>, 3> bands_{};
};

}  // namespace ulpgate
