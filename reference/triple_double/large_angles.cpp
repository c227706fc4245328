// Large angles.
#include "reference/triple_double/large_angles.hpp"

#include <array>
#include <bit>
#include <cmath>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

constexpr std::size_t window_words = 7;
// Enough behind the last bit of the largest number.
constexpr std::size_t table_words = (16384 + 64) / 64 + window_words + 1;

// 2 / pi = sum of words[i] 2^(-64 (i + 1)).
std::array<std::uint64_t, table_words> two_over_pi() {
  std::array<std::uint64_t, table_words> words{};
  MpfrValue x(64 * static_cast<mpfr_prec_t>(table_words) + 64);
  mpfr_const_pi(x, MPFR_RNDN);
  mpfr_ui_div(x, 2, x, MPFR_RNDN);
  MpfrValue whole(64);
  for (std::uint64_t& word : words) {
    mpfr_mul_2ui(x, x, 64, MPFR_RNDN);
    mpfr_set(whole, x, MPFR_RNDZ);
    mpfr_trunc(whole, whole);
    word = mpfr_get_ui(whole, MPFR_RNDZ);
    mpfr_sub(x, x, whole, MPFR_RNDN);
  }
  return words;
}

// Words from the most significant on, moved to the left; to the right where `bits` is negative.
template <std::size_t n>
void shift(std::array<std::uint64_t, n>& words, int bits) {
  for (; bits <= -64; bits += 64) {
    for (std::size_t i = n; i-- > 1;) words[i] = words[i - 1];
    words[0] = 0;
  }
  if (bits > 0) {
    for (std::size_t i = 0; i < n; ++i)
      words[i] = words[i] << bits | (i + 1 < n ? words[i + 1] >> (64 - bits) : 0);
  } else if (bits < 0) {
    for (std::size_t i = n; i-- > 0;)
      words[i] = words[i] >> -bits | (i > 0 ? words[i - 1] << (64 + bits) : 0);
  }
}

// 53 bits of the fraction from bit `first` on, as a number.
template <std::size_t n>
double bits_from(const std::array<std::uint64_t, n>& fraction, int first) {
  const auto word = static_cast<std::size_t>(first / 64);
  const int skip = first % 64;
  if (word >= n) return 0;
  std::uint64_t bits = fraction[word] << skip;
  if (skip > 0 && word + 1 < n) bits |= fraction[word + 1] >> (64 - skip);
  return std::ldexp(static_cast<double>(bits >> 11U), -first - 53);
}

}  // namespace

QuarterTurns quarter_turns(std::uint64_t high, std::uint64_t low, int exponent) {
  using Wide = unsigned __int128;
  static const auto table = two_over_pi();
  const int scale = exponent - 112;
  const int skip = scale > 2 ? scale - 2 : 0;
  const auto word = static_cast<std::size_t>(skip / 64);
  const auto offset = static_cast<unsigned>(skip % 64);
  std::array<std::uint64_t, window_words> window{};
  for (std::size_t i = 0; i < window_words; ++i) {
    window[i] = table[word + i] << offset;
    if (offset != 0) window[i] |= table[word + i + 1] >> (64 - offset);
  }
  // The product's point stands behind its second word.
  std::array<std::uint64_t, window_words + 2> product{};
  const std::array<std::uint64_t, 2> number = {high, low};
  for (std::size_t j = 2; j-- > 0;) {
    Wide carry = 0;
    for (std::size_t i = window_words; i-- > 0;) {
      const Wide p = static_cast<Wide>(number[j]) * window[i] + product[i + j + 1] + carry;
      product[i + j + 1] = static_cast<std::uint64_t>(p);
      carry = p >> 64U;
    }
    product[j] += static_cast<std::uint64_t>(carry);
  }
  shift(product, scale - skip);
  std::uint64_t whole = product[1];
  std::array<std::uint64_t, window_words> fraction{};
  for (std::size_t i = 0; i < window_words; ++i) fraction[i] = product[i + 2];
  const bool down = (fraction[0] >> 63U) != 0;
  if (down) {
    ++whole;
    // Less by a unit of the last word, which is nothing.
    for (std::uint64_t& w : fraction) w = ~w;
  }
  int leading = 0;
  for (std::size_t i = 0; i < window_words && leading == static_cast<int>(64 * i); ++i)
    leading += std::countl_zero(fraction[i]);
  TripleDouble f{bits_from(fraction, leading), bits_from(fraction, leading + 53),
                 bits_from(fraction, leading + 106)};
  if (down) f = {-f.hi, -f.mid, -f.lo};
  return {f, static_cast<int>(whole & 3U)};
}

}  // namespace ulpgate
