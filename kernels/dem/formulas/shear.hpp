// Tangential part of a contact: shear rotation, shear increment, Coulomb's cone, and the twist and bending of
// a bond.
#pragma once

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// Turns the stored shear force with the contact plane: by the change of the normal, then by the mean spin of
// the pair about it.  Both are first order in the step.  Cundall, Int. J. Rock Mech. Min. Sci. 25 (1988) 107.
template <RealType Real>
[[nodiscard]] Vec3<Real> rotate_shear(const Vec3<Real>& shear, const Vec3<Real>& normal_old,
                                      const Vec3<Real>& normal, const Vec3<Real>& w1, const Vec3<Real>& w2,
                                      const Real& dt) {
  const Vec3<Real> tilt = cross(normal_old, normal);
  const Vec3<Real> spin = ((dt / 2) * dot(normal_old, w1 + w2)) * normal_old;
  const Vec3<Real> tilted = shear - cross(shear, tilt);
  return tilted - cross(tilted, spin);
}

// The part of v in the plane of the unit normal.
template <RealType Real>
[[nodiscard]] Vec3<Real> tangential(const Vec3<Real>& v, const Vec3<Real>& normal) {
  return v - dot(normal, v) * normal;
}

template <RealType Real>
struct Friction {
  Vec3<Real> shear;  // N, on the cone or inside it
  bool sliding = false;
  Real dissipation{0};  // J
};

// cut_to_cone() where the square of the force is out of range.
template <RealType Real>
[[nodiscard, gnu::noinline]] Friction<Real> cut_by_length(const Vec3<Real>& trial, const Real& limit,
                                                          const Real& ks) {
  const Real size = norm(trial);
  if (!(size > limit)) return {trial, false, Real(0)};
  return {limit * direction(trial, size), true, (size - limit) / ks * limit};
}

// Cuts a trial shear force to the cone |Fs| <= limit (N).  `dissipation` = (Fs_trial - Fs).Fs / ks (J): the
// slip times the force on it.  A limit of 0 leaves exactly no shear.
template <RealType Real>
[[nodiscard]] Friction<Real> cut_to_cone(const Vec3<Real>& trial, const Real& limit, const Real& ks) {
  using std::sqrt;
  if (!(limit > 0)) return {{}, true, Real(0)};
  const Real size2 = squared_norm(trial);
  if (!squares_hold(trial, size2)) return cut_by_length(trial, limit, ks);
  if (!(size2 > limit * limit)) return {trial, false, Real(0)};
  const Vec3<Real> shear = (limit / sqrt(size2)) * trial;
  return {shear, true, dot(trial - shear, shear) / ks};
}

template <RealType Real>
struct RelativeRotation {
  Real twist{0};       // rad, about the normal
  Vec3<Real> bending;  // rad, across it
};

// Rotation of body 2 against body 1 since the bond was made with orientations q1_start, q2_start, as rotation
// vector of angle in (-pi, pi], split along and across the normal.  Unlike a sum of increments it is exact
// for any step. Y. Wang, Acta Geotechnica 4 (2009) 117.
template <RealType Real>
[[nodiscard]] RelativeRotation<Real> twist_and_bending(const Quaternion<Real>& q1_start,
                                                       const Quaternion<Real>& q2_start,
                                                       const Quaternion<Real>& q1, const Quaternion<Real>& q2,
                                                       const Vec3<Real>& normal) {
  const Quaternion<Real> turned1 = q1 * conjugate(q1_start);
  const Quaternion<Real> turned2 = q2 * conjugate(q2_start);
  const Vec3<Real> rotation = rotation_vector(turned2 * conjugate(turned1));
  const Real twist = dot(rotation, normal);
  return {twist, rotation - twist * normal};
}

}  // namespace ulpgate::dem
