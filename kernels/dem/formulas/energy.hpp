// Energies of bodies and contacts, in joule.
#pragma once

#include "kernels/dem/formulas/contact_physics.hpp"
#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// m/2 |v|^2.
template <RealType Real>
[[nodiscard]] Real kinetic_energy(const Real& mass, const Vec3<Real>& v) {
  return half_square(mass, v);
}

// I/2 |w|^2 of a sphere.
template <RealType Real>
[[nodiscard]] Real rotational_energy(const Real& inertia, const Vec3<Real>& w) {
  return half_square(inertia, w);
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

// |Fs|^2/2ks, ks the stiffness of the shear spring now (N/m); a spring of no stiffness stores nothing.
template <RealType Real>
[[nodiscard]] Real shear_energy(const Real& ks, const Vec3<Real>& shear) {
  return ks == 0 ? Real(0) : Real(squared_norm(shear) / (2 * ks));
}

// |Fn|^2/2kn + |Fs|^2/2ks.
template <RealType Real>
[[nodiscard]] Real elastic_energy(const Real& kn, const Real& ks, const Real& fn, const Vec3<Real>& shear) {
  return (kn == 0 ? Real(0) : Real(fn * fn / (2 * kn))) + shear_energy(ks, shear);
}

// Mindlin's spring at an overlap u has the stiffness ks u^(1/2), of a coefficient ks in N/m^(3/2).
template <RealType Real>
[[nodiscard]] Real mindlin_stiffness(const Real& ks, const Real& overlap) {
  using std::sqrt;
  return overlap > 0 ? Real(ks * sqrt(overlap)) : Real(0);
}

// Hertz: integral of kn u^(3/2) is 2/5 kn u^(5/2); the shear part as of a spring at the present stiffness.
template <RealType Real>
[[nodiscard]] Real hertz_elastic_energy(const Real& kn, const Real& ks, const Real& overlap,
                                        const Vec3<Real>& shear) {
  using std::sqrt;
  if (!(overlap > 0)) return Real(0);
  return 2 * kn * sqrt(overlap) * overlap * overlap / 5 + shear_energy(mindlin_stiffness(ks, overlap), shear);
}

}  // namespace ulpgate::dem
