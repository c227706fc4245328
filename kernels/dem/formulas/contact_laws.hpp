// Contact laws: the force on body 2 (body 1 gets the opposite) from overlap, velocity and stored shear.
//
// Signs: the normal points from body 1 to body 2; a positive normal force pushes the bodies apart; the shear
// force opposes the tangential velocity of body 2 against body 1.
#pragma once

#include "kernels/dem/formulas/contact_physics.hpp"
#include "kernels/dem/formulas/shear.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct ContactForce {
  Real normal{0};      // N, along the contact's normal
  Vec3<Real> shear;    // N, the elastic part, to be stored
  Vec3<Real> viscous;  // N, tangential, not stored
  bool sliding = false;
  Real dissipation{0};  // J, lost to friction in this step
};

// The part across the normal, on body 2 (N).
template <RealType Real>
[[nodiscard]] Vec3<Real> tangential_force(const ContactForce<Real>& f) {
  return f.shear + f.viscous;
}

// F = Fn n + (Fs + viscous), on body 2 (N).
template <RealType Real>
[[nodiscard]] Vec3<Real> total_force(const ContactForce<Real>& f, const Vec3<Real>& normal) {
  return f.normal * normal + tangential_force(f);
}

// Cundall & Strack, Geotechnique 29 (1979) 47: linear normal spring, incremental shear spring, Coulomb cone.
// `shear` is the stored force after rotate_shear; `velocity` the relative velocity at the contact (m/s).
template <RealType Real>
[[nodiscard]] ContactForce<Real> cundall_strack(const ContactPhysics<Real>& p, const Real& overlap,
                                                const Vec3<Real>& normal, const Vec3<Real>& shear,
                                                const Vec3<Real>& velocity, const Real& dt) {
  const Real fn = p.kn * overlap;
  const Vec3<Real> trial = shear - (p.ks * dt) * tangential(velocity, normal);
  const Friction<Real> cut = cut_to_cone(trial, Real(fn * p.tan_friction), p.ks);
  return {fn, cut.shear, {}, cut.sliding, cut.dissipation};
}

// Linear spring and dashpot, Pournin 2001; never pulls.  `closing_speed` (m/s) is the true speed of approach
// of the centres: the factor that keeps shear free of ratcheting would make the dashpot take out more than
// the bodies lose.
template <RealType Real>
[[nodiscard]] Real viscoelastic_normal(const ContactPhysics<Real>& p, const Real& overlap,
                                       const Real& closing_speed) {
  const Real fn = p.kn * overlap + p.cn * closing_speed;
  return fn > 0 ? fn : Real(0);
}

// The tangential dashpot acts only while the contact sticks.
template <RealType Real>
[[nodiscard]] ContactForce<Real> viscoelastic(const ContactPhysics<Real>& p, const Real& overlap,
                                              const Real& closing_speed, const Vec3<Real>& normal,
                                              const Vec3<Real>& shear, const Vec3<Real>& velocity,
                                              const Real& dt) {
  const Vec3<Real> vs = tangential(velocity, normal);
  const Real fn = viscoelastic_normal(p, overlap, closing_speed);
  const Friction<Real> cut = cut_to_cone<Real>(shear - (p.ks * dt) * vs, Real(fn * p.tan_friction), p.ks);
  ContactForce<Real> f{fn, cut.shear, {}, cut.sliding, cut.dissipation};
  if (!cut.sliding) f.viscous = -(p.cs * vs);
  return f;
}

// Hertz's normal force, Mindlin's tangential stiffness at the present overlap, cut at the cone.
template <RealType Real>
[[nodiscard]] ContactForce<Real> hertz_mindlin(const ContactPhysics<Real>& p, const Real& overlap,
                                               const Vec3<Real>& normal, const Vec3<Real>& shear,
                                               const Vec3<Real>& velocity, const Real& dt) {
  using std::sqrt;
  const Real root = sqrt(overlap > 0 ? overlap : Real(0));
  const Real fn = p.kn * root * overlap;
  const Real ks = p.ks * root;
  const Vec3<Real> trial = shear - (ks * dt) * tangential(velocity, normal);
  if (ks == 0) return {fn, {}, {}, false, Real(0)};
  const Friction<Real> cut = cut_to_cone(trial, Real(fn * p.tan_friction), ks);
  return {fn, cut.shear, {}, cut.sliding, cut.dissipation};
}

// A bond: linear spring that pulls as well, from its rest overlap; Fn (N), positive pushes.
template <RealType Real>
[[nodiscard]] Real bond_normal_force(const Real& kn, const Real& overlap, const Real& rest_overlap) {
  return kn * (overlap - rest_overlap);
}

// Strength of a brittle bond, N.
template <RealType Real>
struct BondStrength {
  Real tension{0};   // breaks when -Fn exceeds it
  Real adhesion{0};  // shear limit at Fn = 0
};

// Cohesive law with tension and adhesion: the shear limit is adhesion + Fn tan phi, never below 0.
template <RealType Real>
[[nodiscard]] ContactForce<Real> cohesive(const ContactPhysics<Real>& p, const BondStrength<Real>& strength,
                                          const Real& overlap, const Real& rest_overlap,
                                          const Vec3<Real>& normal, const Vec3<Real>& shear,
                                          const Vec3<Real>& velocity, const Real& dt) {
  const Real fn = bond_normal_force(p.kn, overlap, rest_overlap);
  if (p.ks == 0) return {fn, {}, {}, false, Real(0)};
  const Vec3<Real> trial = shear - (p.ks * dt) * tangential(velocity, normal);
  const Friction<Real> cut = cut_to_cone(trial, Real(strength.adhesion + fn * p.tan_friction), p.ks);
  return {fn, cut.shear, {}, cut.sliding, cut.dissipation};
}

// Moment on body 1 (N m) of a bond that twists and bends; body 2 gets the opposite.
template <RealType Real>
[[nodiscard]] Vec3<Real> bond_moment(const Real& kr, const Real& ktw, const RelativeRotation<Real>& rotation,
                                     const Vec3<Real>& normal) {
  return kr * rotation.bending + (ktw * rotation.twist) * normal;
}

// Rolling stiffness of a bond (N m/rad), kr = ktw = r1 r2 ks alpha.
template <RealType Real>
[[nodiscard]] Real bond_moment_stiffness(const Real& r1, const Real& r2, const Real& ks, const Real& alpha) {
  return r1 * r2 * ks * alpha;
}

// Torque of the shear force on a sphere whose arm to the contact is `arm` n: of body 1 arm = r1 - u/2, of
// body 2 r2 - u/2, the same sign for both.  The normal force has no arm across itself, so it is left out
// rather than left to cancel.
template <RealType Real>
[[nodiscard]] Vec3<Real> shear_torque(const Real& arm, const Vec3<Real>& normal,
                                      const Vec3<Real>& tangential_force) {
  return -(arm * cross(normal, tangential_force));
}

}  // namespace ulpgate::dem
