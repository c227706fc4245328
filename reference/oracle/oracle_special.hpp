// Exact values of the special functions, by series in working precisions that rise until what their roundings
// lose is little enough.
#pragma once

#include <bit>
#include <span>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::oracle {

// J_n(x), n = args[0] a non-negative integer: by its series to about |x| = 2n, by the first term of that for
// large x from some 2^600 on, both within 2^-16 ulp before the last rounding; between the two mpfr_jn.
void cyl_bessel_j(std::span<const MpfrValue> args, std::span<MpfrValue> out);
// n!, correctly rounded.
void factorial(std::span<const MpfrValue> args, std::span<MpfrValue> out);
// Associated Laguerre polynomial L_n^m(x) = sum_k (-1)^k C(n+m, n-k) x^k / k! (DLMF 18.5.12).
void laguerre(std::span<const MpfrValue> args, std::span<MpfrValue> out);
// Of an x whose last bit is 2^last, last < 0, the last term of that sum alone has its last bit at
// 2^(n last) / 2^v, v = n - popcount(n) the number of twos in n! (Legendre): the polynomial ends there, or in
// no bit at all, and no number that ends elsewhere is its value.
[[nodiscard]] constexpr long last_bit_of_laguerre(long n, long last) {
  return n * last - (n - std::popcount(static_cast<unsigned long>(n)));
}
// Whether `value`, a rounded L_n^m(x), is another number than that.
[[nodiscard]] bool is_rounded_laguerre(std::span<const MpfrValue> args, mpfr_srcptr value);
// Y_n^m(theta, phi), theta the polar angle, with the Condon-Shortley phase (DLMF 14.30.1); 0 for |m| > n.
// out[0] is the real part, out[1] the imaginary part.
void spherical_harmonic(std::span<const MpfrValue> args, std::span<MpfrValue> out);

}  // namespace ulpgate::oracle
