// Newton's integrator: leapfrog with velocities at half steps, numerical damping, and the rotation of bodies.
#pragma once

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

template <RealType Real>
[[nodiscard]] int sign_of(const Real& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// Non-viscous damping of one component (Cundall 1987): weakens an acceleration that speeds up, strengthens
// one that slows down, judged by the velocity half a step on.  lambda in [0, 1).
template <RealType Real>
[[nodiscard]] Real damped(const Real& a, const Real& v, const Real& dt, const Real& lambda) {
  // Of the factors, whose product may underflow.
  const int sign = sign_of(a) * sign_of(Real(v + dt * a / 2));
  if (sign == 0) return a;
  return a * (sign > 0 ? 1 - lambda : 1 + lambda);
}

template <RealType Real>
[[nodiscard]] Vec3<Real> damped(const Vec3<Real>& a, const Vec3<Real>& v, const Real& dt,
                                const Real& lambda) {
  return {damped(a.x, v.x, dt, lambda), damped(a.y, v.y, dt, lambda), damped(a.z, v.z, dt, lambda)};
}

// a = F/m + g (m/s^2).
template <RealType Real>
[[nodiscard]] Vec3<Real> acceleration(const Vec3<Real>& force, const Real& mass, const Vec3<Real>& gravity) {
  return force / mass + gravity;
}

// v += dt a, the kick of the leapfrog from v(n-1/2) to v(n+1/2).  L. Verlet, Phys. Rev. 159 (1967) 98.
template <RealType Real>
void kick(Vec3<Real>& v, const Vec3<Real>& a, const Real& dt) {
  v += dt * a;
}

// x += dt v.
template <RealType Real>
void drift(Vec3<Real>& x, const Vec3<Real>& v, const Real& dt) {
  x += dt * v;
}

// Orientation after turning with angular velocity w (rad/s, space frame) for dt: q := AngleAxis(|w| dt,
// w/|w|) q, normalised.  Exact for constant w.  A. Munjiza, J. P. Latham, N. W. M. John, Int. J. Numer. Meth.
// Eng. 56 (2003) 35.
template <RealType Real>
[[nodiscard]] Quaternion<Real> turned(const Quaternion<Real>& q, const Vec3<Real>& w, const Real& dt) {
  if (is_zero(w)) return q;
  const Real speed = norm(w);
  return normalized(from_angle_axis(Real(speed * dt), direction(w, speed)) * q);
}

template <RealType Real>
struct AsphericalState {
  Quaternion<Real> orientation;  // body -> space
  Vec3<Real> angular_momentum;   // space frame, kg m^2/s, at the half step
  Vec3<Real> angular_velocity;   // space frame, rad/s
};

// dq/dt = q (0, w_body)/2.
template <RealType Real>
[[nodiscard]] Quaternion<Real> spin_rate(const Quaternion<Real>& q, const Vec3<Real>& w_body) {
  const Quaternion<Real> r = q * Quaternion<Real>{Real(0), w_body.x, w_body.y, w_body.z};
  return {r.w / 2, r.x / 2, r.y / 2, r.z / 2};
}

template <RealType Real>
[[nodiscard]] Quaternion<Real> advanced(const Quaternion<Real>& q, const Quaternion<Real>& rate,
                                        const Real& time) {
  return {q.w + time * rate.w, q.x + time * rate.x, q.y + time * rate.y, q.z + time * rate.z};
}

template <RealType Real>
[[nodiscard]] Vec3<Real> divided(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}

// Rotation of a body with principal moments `inertia` (kg m^2, body frame), torque T (N m, space frame): the
// leapfrog for rotational motion with explicit quaternion, D. Fincham, Molecular Simulation 8 (1992) 165;
// also M. P. Allen & D. J. Tildesley, Computer Simulation of Liquids (1989), 3.3.1.
template <RealType Real>
[[nodiscard]] AsphericalState<Real> turned_aspherical(const AsphericalState<Real>& s,
                                                      const Vec3<Real>& inertia, const Vec3<Real>& torque,
                                                      const Real& dt) {
  const Quaternion<Real>& q = s.orientation;
  const Vec3<Real> l_now = s.angular_momentum + (dt / 2) * torque;
  const Vec3<Real> w_now = divided(rotate(conjugate(q), l_now), inertia);
  const Quaternion<Real> q_half = normalized(advanced(q, spin_rate(q, w_now), Real(dt / 2)));
  const Vec3<Real> l_half = s.angular_momentum + dt * torque;
  const Vec3<Real> w_half = divided(rotate(conjugate(q_half), l_half), inertia);
  const Quaternion<Real> q_next = normalized(advanced(q, spin_rate(q_half, w_half), dt));
  return {q_next, l_half, rotate(q_half, w_half)};
}

}  // namespace ulpgate::dem
