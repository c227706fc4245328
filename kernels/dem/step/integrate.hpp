// Integration of all bodies by one step, and the energy account where it is kept.
#pragma once

#include "kernels/dem/formulas/newton.hpp"
#include "kernels/dem/step/collider.hpp"

namespace ulpgate::dem {

namespace detail {

// Velocity and position of body i; returns its undamped acceleration.
template <RealType Real>
void move_body(SimulationState<Real>& s, std::size_t i) {
  Bodies<Real>& b = s.bodies;
  Vec3<Real> a = b.force[i] / b.mass[i];
  if (s.parts.gravity) a += s.gravity;
  if (s.parts.damping) a = damped(a, b.velocity[i], s.dt, s.damping);
  kick(b.velocity[i], a, s.dt);
  drift(b.position[i], b.velocity[i], s.dt);
}

template <RealType Real>
void spin_body(SimulationState<Real>& s, std::size_t i) {
  Bodies<Real>& b = s.bodies;
  Vec3<Real> a = b.torque[i] / b.inertia[i];
  if (s.parts.damping) a = damped(a, b.angular_velocity[i], s.dt, s.damping);
  kick(b.angular_velocity[i], a, s.dt);
  if (s.parts.orientation) b.orientation[i] = turned(b.orientation[i], b.angular_velocity[i], s.dt);
}

template <RealType Real>
void spin_aspherical(SimulationState<Real>& s, std::size_t k) {
  Bodies<Real>& b = s.bodies;
  const auto i = static_cast<std::size_t>(b.aspherical[k]);
  if (b.fixed[i] != 0) return;
  const Vec3<Real> torque =
      s.parts.damping ? damped(b.torque[i], b.angular_velocity[i], s.dt, s.damping) : b.torque[i];
  const AsphericalState<Real> next = turned_aspherical<Real>(
      {b.orientation[i], b.angular_momentum[k], b.angular_velocity[i]}, b.principal_inertia[k], torque, s.dt);
  b.orientation[i] = next.orientation;
  b.angular_momentum[k] = next.angular_momentum;
  b.angular_velocity[i] = next.angular_velocity;
}

template <RealType Real>
[[nodiscard]] bool is_aspherical(const Bodies<Real>& b, std::size_t i) {
  return !b.aspherical.empty() &&
         std::binary_search(b.aspherical.begin(), b.aspherical.end(), static_cast<std::int32_t>(i));
}

// Adds to the energy account what the step from the velocities before it tells; called before body i moves
// on. The interval since the step before was crossed with the velocity v(n-1/2), so that the work of a force
// on it is the mean of its values at both ends times dt v(n-1/2): exact for the leapfrog.
template <RealType Real>
void account_body(SimulationState<Real>& s, std::size_t i, bool spins) {
  Bodies<Real>& b = s.bodies;
  Energies<Real>& e = s.energies;
  const bool first = s.iteration == 0;
  const Vec3<Real>& v = b.velocity[i];
  if (b.fixed[i] != 0) {
    if (!first) e.work -= s.dt / 2 * dot(b.force[i] + b.force_before[i], v);
    b.force_before[i] = b.force[i];
    return;
  }
  Vec3<Real> a = b.force[i] / b.mass[i];
  if (s.parts.gravity) a += s.gravity;
  Vec3<Real> ad = a;
  if (s.parts.damping) {
    ad = damped(a, v, s.dt, s.damping);
    const Vec3<Real> drag = b.mass[i] * (ad - a);
    if (!first) e.damping -= s.dt / 2 * dot(drag + b.damping_before[i], v);
    b.damping_before[i] = drag;
  }
  e.kinetic += kinetic_energy<Real>(b.mass[i], v + (s.dt / 2) * ad);
  if (s.parts.gravity) e.potential += potential_energy(b.mass[i], s.gravity, b.position[i]);
  if (!spins) return;
  const Vec3<Real>& w = b.angular_velocity[i];
  Vec3<Real> r = b.torque[i] / b.inertia[i];
  if (s.parts.damping) {
    const Vec3<Real> rd = damped(r, w, s.dt, s.damping);
    const Vec3<Real> drag = b.inertia[i] * (rd - r);
    if (!first) e.damping -= s.dt / 2 * dot(drag + b.damping_torque_before[i], w);
    b.damping_torque_before[i] = drag;
    r = rd;
  }
  e.rotational += rotational_energy<Real>(b.inertia[i], w + (s.dt / 2) * r);
}

template <RealType Real>
void account(SimulationState<Real>& s) {
  Energies<Real>& e = s.energies;
  e.kinetic = e.rotational = e.elastic = e.potential = Real(0);
  for (std::size_t p = 0; p < s.contacts.size(); ++p) {
    e.elastic += s.contacts.elastic[p];
    e.friction += s.contacts.friction_loss[p];
    e.viscous += s.contacts.viscous_loss[p];
    e.broken += s.contacts.broken_loss[p];
  }
  Bodies<Real>& b = s.bodies;
  for (std::size_t i = 0; i < b.size(); ++i) {
    account_body(s, i, s.parts.rotation && !is_aspherical(b, i));
  }
  for (std::size_t k = 0; k < b.aspherical.size(); ++k) {
    const auto i = static_cast<std::size_t>(b.aspherical[k]);
    const Vec3<Real> l = b.angular_momentum[k] + (s.dt / 2) * b.torque[i];
    const Vec3<Real> l_body = rotate(conjugate(b.orientation[i]), l);
    e.rotational += rotational_energy(b.principal_inertia[k], divided(l_body, b.principal_inertia[k]));
  }
}

}  // namespace detail

// Moves every body by one step and sets the forces to 0; returns whether a body left its sweep.
template <RealType Real>
[[nodiscard]] bool integrate(SimulationState<Real>& s, int threads, Collider<Real>& collider) {
  Bodies<Real>& b = s.bodies;
  // The account is summed in the order of the bodies, on one thread.
  if (s.parts.energy) detail::account(s);
  const auto count = static_cast<std::int64_t>(b.size());
  bool left = false;
  const auto advance = [&](std::size_t i) {
    if (b.fixed[i] != 0) {
      if (b.shape[i] != Shape::facet) drift(b.position[i], b.velocity[i], s.dt);
    } else {
      detail::move_body(s, i);
      if (s.parts.rotation && !detail::is_aspherical(b, i)) detail::spin_body(s, i);
    }
    return collider.moved(b, i);
  };
  if (threads > 1) {
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : left)
    for (std::int64_t k = 0; k < count; ++k) {
      const bool gone = advance(static_cast<std::size_t>(k));
      left = left || gone;
    }
  } else {
    for (std::int64_t k = 0; k < count; ++k) left |= advance(static_cast<std::size_t>(k));
  }
  for (std::size_t k = 0; k < b.aspherical.size(); ++k) detail::spin_aspherical(s, k);
  std::fill(b.force.begin(), b.force.end(), Vec3<Real>{});
  if (s.parts.rotation) std::fill(b.torque.begin(), b.torque.end(), Vec3<Real>{});
  return left;
}

}  // namespace ulpgate::dem
