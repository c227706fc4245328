// Arguments<Real>: point k of a stratum of a function, made once, in RealHP<1>, by an exact rule from random
// words.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate {

namespace detail {

// The Real nearest to v, |v| < 2^71: for double and wider types both parts are exact, and so is their sum
// before its one rounding.
template <NativeReal Real>
[[nodiscard]] Real rounded_once(__int128 v) {
  if constexpr (std::same_as<Real, float>) {
    // Rounded to odd first, 56 bits with all that the last rounding asks for; the conversion of all 128 takes
    // four times as long.
    const auto odd = static_cast<std::int64_t>(v >> 16U) |
                     static_cast<std::int64_t>((static_cast<std::uint64_t>(v) & 0xffffU) != 0);
    constexpr std::int64_t enough = std::int64_t{1} << 28U;
    if (odd >= enough || odd < -enough) return static_cast<Real>(odd) * Real(0x1p16);
    return static_cast<Real>(v);
  } else {
    const auto high = static_cast<std::int64_t>(v >> 32U);
    const auto low = static_cast<std::uint32_t>(v);
    return static_cast<Real>(high) * Real(0x1p32) + static_cast<Real>(low);
  }
}

// The Real nearest to 200 f - 100, f = 0.words in base 2^64.  The integer 200 F - 100 * 2^(64 n) is exact and
// rounded once, so the value depends on the words alone, not on a library's distribution.
template <RealType Real>
Real on_minus_100_100(std::span<const std::uint64_t> words) {
  if constexpr (std::same_as<Real, double>) {
    Real value;
    on_minus_100_100(words.first(1), &value);
    return value;
  } else if constexpr (NativeReal<Real>) {
    const __int128 v =
        static_cast<__int128>(200) * static_cast<__int128>(words[0]) - (static_cast<__int128>(100) << 64U);
    return rounded_once<Real>(v) * Real(0x1p-64);  // exact
  } else {
    mpz_t z;
    mpz_t offset;
    mpz_inits(z, offset, nullptr);
    mpz_import(z, words.size(), 1, sizeof(std::uint64_t), 0, 0, words.data());
    mpz_mul_ui(z, z, 200);
    mpz_ui_pow_ui(offset, 2, 64 * words.size());
    mpz_submul_ui(z, offset, 100);
    MpfrValue v(static_cast<mpfr_prec_t>(64 * words.size() + 8));
    mpfr_set_z_2exp(v, z, -64 * static_cast<mpfr_exp_t>(words.size()), MPFR_RNDN);
    mpz_clears(z, offset, nullptr);
    return from_mpfr<Real>(v);
  }
}

template <RealType Real>
inline constexpr std::size_t words_per_value =
    NativeReal<Real> ? 1 : (static_cast<std::size_t>(std::numeric_limits<Real>::digits) + 8 + 63) / 64;

// Replaces the random fraction f by (cell + f) / cells, long division in base 2^64.
inline void into_cell(std::span<std::uint64_t> words, std::uint64_t cell, std::uint64_t cells) {
  unsigned __int128 remainder = cell;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const unsigned __int128 dividend = (remainder << 64U) | words[i];
    const unsigned __int128 quotient = dividend / cells;
    words[i] = static_cast<std::uint64_t>(quotient);
    if (i + 1 < words.size()) remainder = dividend - quotient * cells;
  }
}

// The same of many single words, by a reciprocal: Moeller and Granlund, "Improved division by invariant
// integers", IEEE Trans. Comput. 60 (2011), algorithm 4.
class Cells {
 public:
  explicit Cells(std::uint64_t cells)
      : shift_(static_cast<unsigned>(std::countl_zero(cells))),
        divisor_(cells << shift_),
        reciprocal_(static_cast<std::uint64_t>(~static_cast<unsigned __int128>(0) / divisor_)) {}

  [[nodiscard]] std::uint64_t into(std::uint64_t word, std::uint64_t cell) const {
    using Wide = unsigned __int128;
    const Wide u = ((static_cast<Wide>(cell) << 64U) | word) << shift_;
    const auto high = static_cast<std::uint64_t>(u >> 64U);
    const auto low = static_cast<std::uint64_t>(u);
    const Wide q = static_cast<Wide>(reciprocal_) * high + u;
    std::uint64_t quotient = static_cast<std::uint64_t>(q >> 64U) + 1;
    std::uint64_t remainder = low - quotient * divisor_;
    if (remainder > static_cast<std::uint64_t>(q)) {
      --quotient;
      remainder += divisor_;
    }
    return quotient + (remainder >= divisor_ ? 1U : 0U);
  }

 private:
  unsigned shift_;
  std::uint64_t divisor_;
  std::uint64_t reciprocal_;
};

// A fixed permutation of [0, n) for every argument: argument 0 walks the cells in order, the others by a
// stride near the golden section, so that pairs of cells fill the square evenly.
inline std::uint64_t cell_stride(std::size_t argument, std::uint64_t n) {
  if (argument == 0 || n < 3) return 1;
  auto stride = static_cast<std::uint64_t>(0.6180339887498949 * static_cast<double>(n)) + 2 * argument;
  while (std::gcd(stride, n) != 1) ++stride;
  return stride;
}
inline std::uint64_t permuted_cell(std::uint64_t k, std::uint64_t stride, std::uint64_t n) {
  return stride == 1 ? k : static_cast<std::uint64_t>(static_cast<unsigned __int128>(k) * stride % n);
}

template <RealType Real>
const Real& pi() {
  static const Real value = [] {
    MpfrValue v(std::numeric_limits<Real>::digits + 64);
    mpfr_const_pi(v, MPFR_RNDN);
    return from_mpfr<Real>(v);
  }();
  return value;
}

// fmod(x, 2), x >= 0, without its division where a half of x has an integer part that is a machine's.
template <RealType Real>
Real modulo_2(const Real& x) {
  if constexpr (NativeReal<Real>) {
    if (x < Real(0x1p60F)) return x - 2 * static_cast<Real>(static_cast<std::int64_t>(x / 2));
  }
  using std::fmod;
  return fmod(x, Real(2));
}

// The domain maps, in the arithmetic of Real itself.
template <RealType Real>
[[gnu::always_inline]] inline Real map_to_domain(DomainMap map, const Real& x) {
  using std::abs;
  using std::floor;
  using std::fmod;
  switch (map) {
    case DomainMap::ALL:
      return x;
    case DomainMap::PM1:
      return modulo_2(Real(abs(x))) - Real(1);
    case DomainMap::GTM1:
      return abs(x) - Real(1);
    case DomainMap::GT1:
      return abs(x) + Real(1);
    case DomainMap::GT0:
      return abs(x);
    case DomainMap::NZ:
      return x == Real(0) ? Real(1) : x;
    case DomainMap::UINT:
      return abs(Real(floor(x)));
    case DomainMap::INT:
      return floor(x);
    case DomainMap::MODPI:
      return fmod(Real(abs(x)), pi<Real>());
    case DomainMap::MOD2PI:
      return fmod(Real(abs(x)), Real(Real(2) * pi<Real>()));
  }
  return x;
}

// Maps `count` numbers, `step` apart.
template <DomainMap map, RealType Real>
void map_each_to_domain(Real* x, std::size_t count, std::size_t step) {
  for (std::size_t i = 0; i < count; ++i) x[i * step] = map_to_domain(map, x[i * step]);
}
// The map is chosen once for all of them.
template <RealType Real, DomainMap... maps>
void map_all_to_one_of(DomainMap map, Real* x, std::size_t count, std::size_t step) {
  static_cast<void>(((map == maps && (map_each_to_domain<maps>(x, count, step), true)) || ...));
}
template <RealType Real>
void map_all_to_domain(DomainMap map, Real* x, std::size_t count, std::size_t step) {
  using enum DomainMap;
  map_all_to_one_of<Real, PM1, GTM1, GT1, GT0, NZ, UINT, INT, MODPI, MOD2PI>(map, x, count, step);
}

// The k-th bit pattern of binary32, each once: blocks of 2^20 neighbours, far from each other and from 1.0
// on. The largest errors are then known early, while a plateau of equal tiny errors at the start would send
// all its samples to the last stage of the reference.
[[nodiscard]] constexpr std::uint32_t exhaustive_pattern(std::uint64_t k) {
  const auto block = static_cast<std::uint32_t>(k >> 20U);
  return (((block * 2477U + 0x3f8U) & 0xfffU) << 20U) | static_cast<std::uint32_t>(k & 0xfffffU);
}

// Floats of this pattern and those behind it, in steps that become vectors.
inline void fill_neighbours(std::uint32_t pattern, std::size_t count, float* out) {
  constexpr std::uint32_t step = 8;
  std::size_t i = 0;
  for (; i + step <= count; i += step, pattern += step)
    for (std::uint32_t j = 0; j < step; ++j) out[i + j] = std::bit_cast<float>(pattern + j);
  for (std::uint32_t j = 0; j < count - i; ++j) out[i + j] = std::bit_cast<float>(pattern + j);
}

}  // namespace detail

template <RealType Real>
class Arguments {
 public:
  Arguments(const FunctionInfo& f, const StratumSource& source)
      : function_(f),
        source_(source),
        stream_(source.seed, f.name, name_of(source.stratum)),
        cells_(std::max<std::uint64_t>(source.count, 1)) {
    for (std::size_t i = 0; i < strides_.size(); ++i) strides_[i] = detail::cell_stride(i, source.count);
  }

  // Writes the values of points k .. k + count - 1 to out, `arity` of them a point.
  void make_all(std::uint64_t k, std::size_t count, Real* out) const {
    if constexpr (std::same_as<Real, float>) {
      if (source_.stratum == Stratum::exhaustive) {
        // Of one block mostly, and there neighbours.
        if ((k & 0xfffffU) + count <= 0x100000U) {
          detail::fill_neighbours(detail::exhaustive_pattern(k), count, out);
        } else {
          for (std::size_t i = 0; i < count; ++i)
            out[i] = std::bit_cast<float>(detail::exhaustive_pattern(k + i));
        }
        return;
      }
    }
    if constexpr (NativeReal<Real>) {
      if (source_.list == nullptr && source_.stratum != Stratum::binades) return draw_all(k, count, out);
    }
    for (std::size_t i = 0; i < count; ++i) make(k + i, out + i * static_cast<std::size_t>(function_.arity));
  }

  // Writes the `arity` values of point k to out.
  void make(std::uint64_t k, Real* out) const {
    const auto arity = static_cast<std::size_t>(function_.arity);
    if constexpr (std::same_as<Real, float>) {
      if (source_.stratum == Stratum::exhaustive) {
        out[0] = std::bit_cast<float>(detail::exhaustive_pattern(k));
        return;
      }
    }
    if (source_.list != nullptr) {
      for (std::size_t i = 0; i < arity; ++i) out[i] = from_mpfr<Real>((*source_.list)[k][i]);
      return;
    }
    for (std::size_t i = 0; i < arity; ++i) {
      const DomainMap map = function_.domain[i];
      if (source_.stratum == Stratum::binades && map != DomainMap::UINT && map != DomainMap::INT) {
        out[i] = in_binade(k, i, map, out);
      } else {
        out[i] = on_interval(k, i, map);
      }
    }
  }

 private:
  static constexpr std::size_t drawn_at_once = 256;
  // As on_interval, for many points.
  void draw_all(std::uint64_t k, std::size_t count, Real* out) const {
    const auto arity = static_cast<std::size_t>(function_.arity);
    std::array<std::uint64_t, drawn_at_once> words;
    for (std::size_t first = 0; first < count; first += words.size()) {
      const std::span some = std::span(words).first(std::min(words.size(), count - first));
      for (std::size_t argument = 0; argument < arity; ++argument) {
        stream_.first_words(k + first, argument, some);
        if (source_.stratum == Stratum::stratified) into_cells(k + first, argument, some);
        Real* to = out + first * arity + argument;
        on_minus_100_100(some, to, arity);
        detail::map_all_to_domain(function_.domain[argument], to, some.size(), arity);
      }
    }
  }

  // Of the points from k on.
  void into_cells(std::uint64_t k, std::size_t argument, std::span<std::uint64_t> words) const {
    const std::uint64_t stride = strides_[argument];
    std::uint64_t cell = detail::permuted_cell(k, stride, source_.count);
    for (std::uint64_t& word : words) {
      word = cells_.into(word, cell);
      // The next point's, without a division.
      const std::uint64_t left = source_.count - cell;
      cell = stride < left ? cell + stride : stride - left;
    }
  }

  // At most drawn_at_once of them, `step` apart.
  static void on_minus_100_100(std::span<const std::uint64_t> words, Real* out, std::size_t step) {
    if constexpr (std::same_as<Real, double>) {
      if (step == 1) return detail::on_minus_100_100(words, out);
      std::array<double, drawn_at_once> values;
      detail::on_minus_100_100(words, values.data());
      for (std::size_t i = 0; i < words.size(); ++i) out[i * step] = values[i];
    } else {
      for (std::size_t i = 0; i < words.size(); ++i)
        out[i * step] = detail::on_minus_100_100<Real>(words.subspan(i, 1));
    }
  }

  Real on_interval(std::uint64_t k, std::size_t argument, DomainMap map) const {
    std::uint64_t words[detail::words_per_value<Real>];
    stream_.fill(k, argument, words);
    if (source_.stratum == Stratum::stratified) {
      detail::into_cell(words, detail::permuted_cell(k, strides_[argument], source_.count), source_.count);
    }
    return detail::map_to_domain(map, detail::on_minus_100_100<Real>(words));
  }

  // A random significand in a binade; argument 0 walks all binades evenly, the others are drawn.
  Real in_binade(std::uint64_t k, std::size_t argument, DomainMap map, const Real* before) const {
    constexpr std::size_t significand_words =
        (static_cast<std::size_t>(std::numeric_limits<Real>::digits) + 63) / 64;
    std::uint64_t words[significand_words + 2];
    stream_.fill(k, argument, words);
    const std::uint64_t choice = argument == 0 ? k * 0x9e3779b97f4a7c15ULL : words[significand_words];
    const std::uint64_t extra = words[significand_words + 1];
    bool negative = (extra & 1U) != 0;
    if (map == DomainMap::GT0 || map == DomainMap::GT1 || map == DomainMap::MODPI ||
        map == DomainMap::MOD2PI) {
      negative = false;
    }
    ExponentRange range = sampled_exponents(function_, float_format<Real>());
    if (map == DomainMap::PM1 || (map == DomainMap::GTM1 && negative)) range.greatest = -1;
    if (map == DomainMap::GT1) range.least = 0;
    if (map == DomainMap::MODPI || map == DomainMap::MOD2PI) range.greatest = 2;
    // Two independent exponents rarely interact: every other point takes arguments of similar size, and pow
    // an exponent for which the result stays near the range.
    if (argument == 1 && (extra & 2U) != 0) narrow(range, before[0]);
    const auto span = static_cast<std::uint64_t>(range.greatest - range.least + 1);
    const long exponent =
        range.least + static_cast<long>((static_cast<unsigned __int128>(choice) * span) >> 64U);

    constexpr long p = std::numeric_limits<Real>::digits;
    mpz_t z;
    mpz_init(z);
    mpz_import(z, significand_words, 1, sizeof(std::uint64_t), 0, 0, words);
    mpz_fdiv_r_2exp(z, z, p - 1);
    mpz_setbit(z, p - 1);
    // A subnormal keeps the leading bits only.
    const long lost = float_format<Real>().subnormals ? float_format<Real>().exponent_min - exponent : 0;
    if (lost > 0) {
      mpz_fdiv_q_2exp(z, z, static_cast<mp_bitcnt_t>(lost));
      mpz_mul_2exp(z, z, static_cast<mp_bitcnt_t>(lost));
    }
    MpfrValue v(p);
    mpfr_set_z_2exp(v, z, exponent - (p - 1), MPFR_RNDN);
    mpz_clear(z);
    if (negative) mpfr_neg(v, v, MPFR_RNDN);
    const Real x = from_mpfr<Real>(v);
    const bool angle = map == DomainMap::MODPI || map == DomainMap::MOD2PI;
    return angle ? detail::map_to_domain(map, x) : x;
  }

  void narrow(ExponentRange& range, const Real& first) const {
    MpfrValue v(std::numeric_limits<Real>::digits);
    to_mpfr(v.get(), first);
    if (!mpfr_regular_p(v)) return;
    const long e = binade(v);
    if (function_.id == FunctionId::pow) {
      // |y log2 x| about emax: log2|y| up to log2(emax) - log2|log2 x|.
      long magnitude = 0;
      for (long rest = std::max(std::labs(e), 1L); rest > 1; rest /= 2) ++magnitude;
      long limit = 0;
      for (long rest = float_format<Real>().exponent_max + 1; rest > 1; rest /= 2) ++limit;
      range.greatest = std::min(range.greatest, limit - magnitude + 1);
      range.least = std::max(range.least, -20L);
    } else {
      constexpr long reach = std::numeric_limits<Real>::digits + 2;
      range.least = std::max(range.least, std::min(e - reach, range.greatest));
      range.greatest = std::min(range.greatest, std::max(e + reach, range.least));
    }
  }

  FunctionInfo function_;
  StratumSource source_;
  RandomStream stream_;
  detail::Cells cells_;                             // of the stratified points, one each
  std::array<std::uint64_t, max_arity> strides_{};  // of the cells, by argument
};

}  // namespace ulpgate
