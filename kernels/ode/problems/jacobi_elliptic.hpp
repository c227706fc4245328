// Jacobi's elliptic functions sn, cn, dn in any precision, by the arithmetic-geometric mean.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct JacobiElliptic {
  Real sn, cn, dn;
};

// K(k), the quarter period, for modulus 0 <= k < 1: pi / (2 AGM(1, k')).  M. Abramowitz, I. A. Stegun (1964),
// 17.6.3.
template <RealType Real>
[[nodiscard]] Real complete_elliptic_k(const Real& k) {
  using std::abs, std::acos, std::sqrt;
  if (!(k >= 0 && k < 1)) throw std::invalid_argument("complete_elliptic_k: the modulus is not in [0, 1)");
  Real a(1);
  Real b = sqrt((1 - k) * (1 + k));
  // The mean converges quadratically: at half the digits one more step completes it.
  const Real half_way = sqrt(std::numeric_limits<Real>::epsilon()) / 4;
  for (bool last = false; !last;) {
    last = abs(a - b) < half_way;
    const Real mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return acos(Real(-1)) / (2 * a);
}

// sn(u, k), cn, dn for modulus 0 <= k < 1, by the descending Landen transformation.  M. Abramowitz, I. A.
// Stegun (1964), 16.4.  The phase is doubled once per step of the mean, so about log2(digits) bits are lost
// for moderate u; and as many as u has periods.
template <RealType Real>
[[nodiscard]] JacobiElliptic<Real> jacobi_elliptic(const Real& u, const Real& k) {
  using std::abs, std::asin, std::cos, std::sin, std::sqrt;
  if (!(k >= 0 && k < 1)) throw std::invalid_argument("jacobi_elliptic: the modulus is not in [0, 1)");
  std::vector<Real> ratios;  // c_n / a_n, n = 1, 2, ...
  Real a(1);
  Real b = sqrt((1 - k) * (1 + k));
  Real scale(1);
  // Not below the spacing of the numbers: rounding may keep a and b one apart for ever.
  const Real settled = 2 * std::numeric_limits<Real>::epsilon();
  for (Real c = k; abs(c) > settled * a;) {
    c = (a - b) / 2;
    const Real mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
    scale *= 2;
    ratios.push_back(c / a);
  }
  Real phase = scale * a * u;
  for (std::size_t n = ratios.size(); n-- > 0;) {
    phase = (phase + asin(ratios[n] * sin(phase))) / 2;
  }
  const Real sn = sin(phase);
  // k'^2 + k^2 cn^2 has no cancellation, unlike 1 - k^2 sn^2.
  const Real cn = cos(phase);
  const Real dn = sqrt((1 - k) * (1 + k) + k * k * cn * cn);
  return {sn, cn, dn};
}

}  // namespace ulpgate::ode
