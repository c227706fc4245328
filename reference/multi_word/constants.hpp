// Constants and tables of DoubleDouble or TripleDouble numbers.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "reference/multi_word/double_double.hpp"
#include "reference/multi_word/triple_double.hpp"

namespace ulpgate::multi_word {

// The terms first to last of a series, of which those from `from_double` on are taken in double, and of
// triples those from `from_pair` on in pairs.
struct Terms {
  std::size_t first, from_pair, from_double, last;
};

inline constexpr int least_log_index = 90;

// Each entry of a Word is within half of its last part's ulp of the exact number; all are computed by MPFR
// when the program first asks for them, so that no digit of them was typed.
template <class Word>
struct Constants {
  static constexpr std::size_t words = std::is_same_v<Word, DoubleDouble> ? 2 : 3;
  // ln 2 / 64 in pieces: 36 or 32 bits, of which multiples up to 2^17 or 2^21 are doubles, then 53 each.
  static constexpr int first_bits = words == 2 ? 36 : 32;
  std::array<double, words + 1> ln2_64;
  double inverse_ln2_64;  // 64 / ln 2
  Word ln2, inverse_ln2, inverse_ln10;
  // 2^(j/64) and 2^(j/64) - 1 for j = i - 32.
  std::array<Word, 65> power, power_less_1;
  // 128 / k rounded to 11 bits for k = i + least_log_index, and the logarithm of its reciprocal.
  std::array<double, 93> log_scale;
  std::array<Word, 93> log_of_scale;
  // pi / 2 in pieces of 53 bits, and 2 / pi.
  std::array<double, words + 1> half_pi;
  double inverse_half_pi;
  Word half_pi_word, pi_word;
  // Sine and cosine of i / 32, and the angle whose tangent is that.
  std::array<Word, 27> sine, cosine;
  std::array<Word, 33> angle;
  // 1 / k!; (-1)^k / (2k + 1)!; (-1)^k / (2k)!
  std::array<Word, 18> inverse_factorial;
  std::array<Word, 12> sine_series, cosine_series;
  // (-1)^(k + 1) / k; 1 / (2k + 1); (-1)^k / (2k + 1)
  std::array<Word, 24> log_series;
  std::array<Word, 18> atanh_series, atan_series;
  // Stirling's series, DLMF 5.11.1: stirling[k - 1] = B_2k / (2k (2k - 1)), and the logarithms of sqrt(2 pi)
  // and pi.
  std::array<Word, 20> stirling;
  Word log_sqrt_two_pi, log_pi;
  // 2 / sqrt(pi), 1 / sqrt(pi), and (-1)^n / (n! (2n + 1)), the coefficients of erf, DLMF 7.6.1.
  Word two_over_sqrt_pi, inverse_sqrt_pi;
  std::array<Word, 40> erf_series;
  // Taylor's coefficients of e^(x^2) erfc(x) at x = 1 + i/4.
  std::array<std::array<Word, words == 2 ? 34 : 47>, words == 2 ? 33 : 41> scaled_erfc;
  // 2 / pi = sum of words[i] 2^(-64 (i + 1)).
  std::array<std::uint64_t, 24> two_over_pi;
};

template <class Word>
[[nodiscard]] const Constants<Word>& constants();

}  // namespace ulpgate::multi_word
