// Critical time steps of explicit integration, in seconds.  Multiply by a safety factor below 1.
#pragma once

#include <boost/math/constants/constants.hpp>

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// Time of a pressure wave across a radius, r sqrt(rho/E).
template <RealType Real>
[[nodiscard]] Real p_wave_step(const Real& radius, const Real& density, const Real& young) {
  using std::sqrt;
  return radius * sqrt(density / young);
}

// Rayleigh wave: pi r sqrt(rho/G)/(0.1631 nu + 0.8766), G = E/(2 (1 + nu)); C. Thornton & C. W. Randall
// (1988). The fit's coefficients are exact ratios.
template <RealType Real>
[[nodiscard]] Real rayleigh_step(const Real& radius, const Real& density, const Real& young,
                                 const Real& poisson) {
  using std::sqrt;
  const Real shear_modulus = young / (2 * (1 + poisson));
  const Real fit = (1631 * poisson + 8766) / 10000;
  return boost::math::constants::pi<Real>() * radius * sqrt(density / shear_modulus) / fit;
}

// A contact's share of a body's stiffness along each axis (N/m): (kn - ks) n_w^2 + ks.
template <RealType Real>
[[nodiscard]] Vec3<Real> axis_stiffness(const Real& kn, const Real& ks, const Vec3<Real>& n) {
  const Real difference = kn - ks;
  return {difference * (n.x * n.x) + ks, difference * (n.y * n.y) + ks, difference * (n.z * n.z) + ks};
}

// The same for rotation (N m/rad): ks (1 - n_w^2) r^2.
template <RealType Real>
[[nodiscard]] Vec3<Real> axis_rotation_stiffness(const Real& ks, const Real& radius, const Vec3<Real>& n) {
  const Real k = ks * radius * radius;
  return {k * (1 - n.x * n.x), k * (1 - n.y * n.y), k * (1 - n.z * n.z)};
}

// 0.8 sqrt(2) min over the axes of sqrt(inertia/K); 0 where no axis has a stiffness (no limit).
template <RealType Real>
[[nodiscard]] Real stiffness_step(const Real& inertia, const Vec3<Real>& stiffness) {
  using std::sqrt;
  Real largest = stiffness.x;
  if (stiffness.y > largest) largest = stiffness.y;
  if (stiffness.z > largest) largest = stiffness.z;
  if (!(largest > 0)) return Real(0);
  return 4 * sqrt(2 * inertia / largest) / 5;
}

// A symmetric matrix of three rows, as the sum of springs.
template <RealType Real>
struct SymmetricMatrix {
  Real xx{0}, yy{0}, zz{0}, xy{0}, yz{0}, zx{0};

  // += along n n^T + across (1 - n n^T), n of length 1.
  void add_spring(const Real& along, const Real& across, const Vec3<Real>& n) {
    const Real difference = along - across;
    xx += difference * (n.x * n.x) + across;
    yy += difference * (n.y * n.y) + across;
    zz += difference * (n.z * n.z) + across;
    xy += difference * (n.x * n.y);
    yz += difference * (n.y * n.z);
    zx += difference * (n.z * n.x);
  }
};

// What no eigenvalue exceeds: q + 2 p, q the mean of the diagonal and p^2 = |A - q|^2/6.  H. Wolkowicz,
// G. P. H. Styan, Linear Algebra Appl. 29 (1980) 471, theorem 2.1.  It is the eigenvalue itself for springs
// along one line and for isotropic ones, and 4/3 of it at most where the smallest is 0; the closed form of
// the eigenvalue loses half of the digits where the two largest are equal.
template <RealType Real>
[[nodiscard]] Real eigenvalue_bound(const SymmetricMatrix<Real>& m) {
  using std::sqrt;
  const Real mean = (m.xx + m.yy + m.zz) / 3;
  const Real dx = m.xx - mean;
  const Real dy = m.yy - mean;
  const Real dz = m.zz - mean;
  const Real off = m.yz * m.yz + m.zx * m.zx + m.xy * m.xy;
  return mean + 2 * sqrt((dx * dx + dy * dy + dz * dz + 2 * off) / 6);
}

}  // namespace ulpgate::dem
