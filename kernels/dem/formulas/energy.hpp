// Energies of bodies and contacts, in joule.
#pragma once

#include "kernels/dem/formulas/contact_physics.hpp"
#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// m/2 |v|^2.
template <RealType Real>
[[nodiscard]] Real kinetic_energy(const Real& mass, const Vec3<Real>& v) {
  return mass * squared_norm(v) / 2;
}

// I/2 |w|^2 of a sphere.
template <RealType Real>
[[nodiscard]] Real rotational_energy(const Real& inertia, const Vec3<Real>& w) {
  return inertia * squared_norm(w) / 2;
}

// sum I_k w_k^2/2, both in the body frame.
template <RealType Real>
[[nodiscard]] Real rotational_energy(const Vec3<Real>& inertia, const Vec3<Real>& w_body) {
  return ((inertia.x * w_body.x * w_body.x + inertia.y * w_body.y * w_body.y) +
          inertia.z * w_body.z * w_body.z) /
         2;
}

// -m g.x, zero at the origin.
template <RealType Real>
[[nodiscard]] Real potential_energy(const Real& mass, const Vec3<Real>& gravity, const Vec3<Real>& x) {
  return -(mass * dot(gravity, x));
}

// |Fn|^2/2kn + |Fs|^2/2ks; a spring of no stiffness stores nothing.
template <RealType Real>
[[nodiscard]] Real elastic_energy(const Real& kn, const Real& ks, const Real& fn, const Vec3<Real>& shear) {
  Real energy = kn == 0 ? Real(0) : Real(fn * fn / (2 * kn));
  if (ks != 0) energy += squared_norm(shear) / (2 * ks);
  return energy;
}

// Hertz: integral of kn u^(3/2) is 2/5 kn u^(5/2); the shear part as of a spring at the present stiffness.
template <RealType Real>
[[nodiscard]] Real hertz_elastic_energy(const Real& kn, const Real& ks, const Real& overlap,
                                        const Vec3<Real>& shear) {
  using std::sqrt;
  if (!(overlap > 0)) return Real(0);
  const Real root = sqrt(overlap);
  Real energy = 2 * kn * root * overlap * overlap / 5;
  if (ks != 0) energy += squared_norm(shear) / (2 * ks * root);
  return energy;
}

}  // namespace ulpgate::dem
