// Lengths, angles, areas and orientations.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

// Heron's area of a triangle from its sides; units of length squared.
template <RealType Real>
[[nodiscard]] Real triangle_area_heron(const Real& a, const Real& b, const Real& c) {
  using std::sqrt;
  const Real s((a + b + c) / 2);
  return Real(sqrt(Real(s * (s - a) * (s - b) * (s - c))));
}

// The same for a >= b >= c with the brackets of W. Kahan, Miscalculating area and angles of a needle-like
// triangle (1986).
template <RealType Real>
[[nodiscard]] Real triangle_area_kahan(const Real& a, const Real& b, const Real& c) {
  using std::sqrt;
  return Real(sqrt(Real((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)))) / 4);
}

template <RealType Real>
[[nodiscard]] Real norm_naive(std::span<const Real> v) {
  using std::sqrt;
  Real squares(0);
  for (const Real& c : v) squares += c * c;
  return Real(sqrt(squares));
}

// Components divided by the largest of them first; 0 of the zero vector.
template <RealType Real>
[[nodiscard]] Real norm_scaled(std::span<const Real> v) {
  using std::abs;
  using std::sqrt;
  Real largest(0);
  for (const Real& c : v) {
    if (largest < abs(c)) largest = abs(c);
  }
  if (largest == 0) return largest;
  Real squares(0);
  for (const Real& c : v) {
    const Real q(c / largest);
    squares += q * q;
  }
  return Real(largest * sqrt(squares));
}

template <RealType Real>
[[nodiscard]] Real norm_hypot(const Real& x, const Real& y) {
  using std::hypot;
  return Real(hypot(x, y));
}

// Angle between (x0, x1, x2) and (x3, x4, x5) in radians, from the arc cosine.
template <RealType Real>
[[nodiscard]] Real angle_by_arc_cosine(std::span<const Real> x) {
  using std::acos;
  const Real dot(x[0] * x[3] + x[1] * x[4] + x[2] * x[5]);
  return Real(acos(Real(dot / (norm_naive(x.first(3)) * norm_naive(x.subspan(3))))));
}

// The same from atan2(|u x v|, u v).
template <RealType Real>
[[nodiscard]] Real angle_by_arc_tangent(std::span<const Real> x) {
  using std::atan2;
  const std::array<Real, 3> cross{Real(x[1] * x[5] - x[2] * x[4]), Real(x[2] * x[3] - x[0] * x[5]),
                                  Real(x[0] * x[4] - x[1] * x[3])};
  const Real dot(x[0] * x[3] + x[1] * x[4] + x[2] * x[5]);
  return Real(atan2(norm_naive(std::span<const Real>(cross)), dot));
}

template <RealType Real>
[[nodiscard]] int sign_of(const Real& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

// On which side of the line from q to r the point p lies: +1 left, -1 right, 0 on it; the determinant of
// differences.
template <RealType Real>
[[nodiscard]] int orientation_naive(const Real& px, const Real& py, const Real& qx, const Real& qy,
                                    const Real& rx, const Real& ry) {
  const Real left((qx - px) * (ry - py));
  const Real right((qy - py) * (rx - px));
  return sign_of(Real(left - right));
}

// A sum of terms without any error: components of growing size that do not overlap, of which the last that is
// not 0 has the sign (J. R. Shewchuk, Discrete Comput. Geom. 18, 1997, grow-expansion).
template <RealType Real>
class Expansion {
 public:
  void add(Real q) {
    for (Real& c : components_) {
      const Real sum(q + c);
      const Real virtual_c(sum - q);
      const Real virtual_q(sum - virtual_c);
      c = (q - virtual_q) + (c - virtual_c);
      q = sum;
    }
    components_.push_back(q);
  }

  // a b, by the splitting of T. J. Dekker (Numer. Math. 18, 1971): no fused multiply-add is needed, which
  // software types do without.
  void add_product(const Real& a, const Real& b) {
    const Real product(a * b);
    const auto [ah, al] = split(a);
    const auto [bh, bl] = split(b);
    add(Real(((ah * bh - product) + ah * bl + al * bh) + al * bl));
    add(product);
  }

  [[nodiscard]] int sign() const {
    for (auto c = components_.rbegin(); c != components_.rend(); ++c) {
      if (*c != 0) return sign_of(*c);
    }
    return 0;
  }

 private:
  static std::array<Real, 2> split(const Real& a) {
    using std::ldexp;
    const Real t(ldexp(a, (std::numeric_limits<Real>::digits + 1) / 2) + a);
    const Real high(t - (t - a));
    return {high, Real(a - high)};
  }

  std::vector<Real> components_;
};

// The sign of the six products qx ry - qy rx + px qy - py qx + py rx - px ry, summed without error.
template <RealType Real>
[[nodiscard]] int orientation_exact(const Real& px, const Real& py, const Real& qx, const Real& qy,
                                    const Real& rx, const Real& ry) {
  Expansion<Real> sum;
  sum.add_product(qx, ry);
  sum.add_product(Real(-qy), rx);
  sum.add_product(px, qy);
  sum.add_product(Real(-py), qx);
  sum.add_product(py, rx);
  sum.add_product(Real(-px), ry);
  return sum.sign();
}

// Signs at the side x side points (1/2 + i spacing, 1/2 + j spacing), j the faster, against the line from
// (12, 12) to (24, 24) (L. Kettner et al., Classroom examples of robustness problems, ESA 2004).
template <RealType Real, class Orientation>
[[nodiscard]] std::vector<Real> orientation_grid(const Real& spacing, long side, Orientation orientation) {
  std::vector<Real> signs;
  const Real half(Real(1) / 2);
  for (long i = 0; i < side; ++i) {
    for (long j = 0; j < side; ++j) {
      signs.emplace_back(orientation(Real(half + Real(i) * spacing), Real(half + Real(j) * spacing), Real(12),
                                     Real(12), Real(24), Real(24)));
    }
  }
  return signs;
}

}  // namespace ulpgate::formulas
