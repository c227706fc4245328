// Constants and tables of DoubleDouble numbers.
#pragma once

#include <array>
#include <cstdint>

#include "reference/double_double/double_double.hpp"

namespace ulpgate::dd {

// Each entry of a DoubleDouble is within 2^-106 of itself of the exact number; all are computed by MPFR when
// the program first asks for them, so that no digit of them was typed.
struct Constants {
  // ln 2 / 64 in pieces: 36 bits, then 53 each.
  double ln2_64_1, ln2_64_2, ln2_64_3;
  double inverse_ln2_64;  // 64 / ln 2
  DoubleDouble ln2, inverse_ln2, inverse_ln10;
  // 2^(j/64) and 2^(j/64) - 1 for j = i - 32.
  std::array<DoubleDouble, 65> power, power_less_1;
  // 128 / k rounded to 11 bits for k = i + least_log_index, and the logarithm of its reciprocal.
  std::array<double, 93> log_scale;
  std::array<DoubleDouble, 93> log_of_scale;
  // pi / 2 in pieces of 53 bits, and 2 / pi.
  std::array<double, 3> half_pi;
  double inverse_half_pi;
  DoubleDouble half_pi_dd, pi_dd;
  // Sine and cosine of i / 32.
  std::array<DoubleDouble, 27> sine, cosine;
  // The angle of i / 32.
  std::array<DoubleDouble, 33> angle;
  // 1 / n!
  std::array<DoubleDouble, 28> inverse_factorial;
  // 1 / n
  std::array<DoubleDouble, 40> inverse;
  // Stirling's series, DLMF 5.11.1: stirling[k - 1] = B_2k / (2k (2k - 1)), and the logarithms of sqrt(2 pi)
  // and pi.
  std::array<DoubleDouble, 14> stirling;
  DoubleDouble log_sqrt_two_pi, log_pi;
  // 2 / sqrt(pi), 1 / sqrt(pi), and (-1)^n / (n! (2n + 1)), the coefficients of erf, DLMF 7.6.1.
  DoubleDouble two_over_sqrt_pi, inverse_sqrt_pi;
  std::array<DoubleDouble, 31> erf_series;
  // Taylor's coefficients of e^(x^2) erfc(x) at x = 1 + i/4.
  std::array<std::array<DoubleDouble, 34>, 33> scaled_erfc;
  // 2 / pi = sum of words[i] 2^(-64 (i + 1)).
  std::array<std::uint64_t, 24> two_over_pi;
};

inline constexpr int least_log_index = 90;

[[nodiscard]] const Constants& constants();

}  // namespace ulpgate::dd
