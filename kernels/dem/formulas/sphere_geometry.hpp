// Geometry of a contact between two spheres: overlap, normal, contact point.
#pragma once

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// Where two bodies touch.  `overlap` (m) is positive where they penetrate; `normal` points from body 1 to
// body 2; `point` (m) lies in the middle of the overlap.  `distance` (m) is that of the centres of two
// spheres, which deep in each other cannot be had back from the overlap; a flat body has none.
template <RealType Real>
struct ContactGeometry {
  Real overlap{0};
  Vec3<Real> normal;
  Vec3<Real> point;
  Real distance{0};
};

// Two spheres of centres x1, x2 and radii r1, r2 (m).  Cundall & Strack, Geotechnique 29 (1979) 47, eqs 1-3.
// The overlap is ill-conditioned near touching: its absolute error is a few ulp of the larger of radius and
// position. Concentric spheres have no normal (NaN).
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> sphere_sphere(const Vec3<Real>& x1, const Real& r1, const Vec3<Real>& x2,
                                                  const Real& r2) {
  const Vec3<Real> d = x2 - x1;
  const Real length = norm(d);
  const Vec3<Real> normal = direction(d, length);
  const Real overlap = (r1 + r2) - length;
  return {overlap, normal, x1 + (r1 - overlap / 2) * normal, length};
}

// Velocity of body 2 relative to body 1 at the contact of two spheres whose centres are `distance` (m) apart
// (m/s), scaled so that a closed path of the pair stores no shear (granular ratcheting: Alonso-Marroquin &
// Herrmann, Phys. Rev. Lett. 92 (2004) 054301; McNamara, Garcia-Rojo & Herrmann, Phys. Rev. E 77 (2008)
// 031304).
template <RealType Real>
[[nodiscard]] Vec3<Real> sphere_relative_velocity(const Vec3<Real>& normal, const Real& distance,
                                                  const Real& r1, const Real& r2, const Vec3<Real>& v1,
                                                  const Vec3<Real>& v2, const Vec3<Real>& w1,
                                                  const Vec3<Real>& w2) {
  const Real scale = (r1 + r2) / distance;
  return (scale * (v2 - v1) - r2 * cross(w2, normal)) - r1 * cross(w1, normal);
}

// The same where nothing rotates.
template <RealType Real>
[[nodiscard]] Vec3<Real> sphere_relative_velocity(const Real& distance, const Real& r1, const Real& r2,
                                                  const Vec3<Real>& v1, const Vec3<Real>& v2) {
  const Real scale = (r1 + r2) / distance;
  return scale * (v2 - v1);
}

}  // namespace ulpgate::dem
