// The step where bonds alone make the forces and nothing rotates: rods between nodes, the elastic pendulum.
//
// The same operations as the general step, without lists of contacts: for every bond d = x2 - x1, length, n =
// d/length, u = (r1 + r2) - length, Fn = kn (u - u0); then every body.  No memory is taken in a step.
#pragma once

#include "kernels/dem/step/integrate.hpp"

namespace ulpgate::dem {

// One kick or drift of a composition method: the fraction of the step that it covers.
template <RealType Real>
struct FlowPart {
  bool kick;
  Real fraction;
};

namespace detail {

// What bonds and bodies are, whatever of them a scene needs.
template <RealType Real>
struct BondedBodies {
  explicit BondedBodies(const SimulationState<Real>& s) {
    for (const auto& bond : s.bonds) {
      sums.push_back(s.bodies.radius[static_cast<std::size_t>(bond.first)] +
                     s.bodies.radius[static_cast<std::size_t>(bond.second)]);
    }
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
      // A fixed body at rest stays where it is.
      if (s.bodies.fixed[i] == 0) {
        movable.push_back(i);
      } else if (!(s.bodies.velocity[i] == Vec3<Real>{})) {
        driven.push_back(i);
      }
    }
  }

  std::vector<Real> sums;  // of the radii of a bond's bodies
  std::vector<std::size_t> movable, driven;
};

// Forces of bonds.  `Axes` is 2 where everything lies in the plane z = 0.
template <int Axes, bool Energy, RealType Real>
class BondForces {
 public:
  BondForces(SimulationState<Real>& s, const std::vector<Real>& sums) : s_(s), sums_(sums) {}

  // Of all bonds, from nothing.
  void all() {
    std::fill(s_.bodies.force.begin(), s_.bodies.force.end(), Vec3<Real>{});
    if constexpr (Energy) s_.energies.elastic = Real(0);
    for (std::size_t k = 0; k < s_.bonds.size(); ++k)
      stretch(k, s_.bodies.position.data(), s_.bodies.force.data());
  }

  void stretch(std::size_t k, const Vec3<Real>* position, Vec3<Real>* force) {
    using std::sqrt;
    BondState<Real>& bond = s_.bonds[k];
    if (bond.broken != 0) return loose(k);
    const auto i = static_cast<std::size_t>(bond.first);
    const auto j = static_cast<std::size_t>(bond.second);
    const Real dx = position[j].x - position[i].x;
    const Real dy = position[j].y - position[i].y;
    Real length2 = dx * dx + dy * dy;
    if constexpr (Axes == 3) {
      const Real dz = position[j].z - position[i].z;
      length2 += dz * dz;
      const Real length = sqrt(length2);
      const Real fn = pull(k, length);
      if (bond.broken != 0) return loose(k);
      push(force[i].z, force[j].z, fn, Real(dz / length));
      push(force[i].x, force[j].x, fn, Real(dx / length));
      push(force[i].y, force[j].y, fn, Real(dy / length));
    } else {
      const Real length = sqrt(length2);
      const Real fn = pull(k, length);
      if (bond.broken != 0) return loose(k);
      push(force[i].x, force[j].x, fn, Real(dx / length));
      push(force[i].y, force[j].y, fn, Real(dy / length));
    }
  }

 private:
  static void push(Real& first, Real& second, const Real& fn, const Real& n) {
    const Real f = fn * n;
    first -= f;
    second += f;
  }

  // The normal force; marks the bond broken where it pulls too hard.
  Real pull(std::size_t k, const Real& length) {
    BondState<Real>& bond = s_.bonds[k];
    Real fn = s_.contacts.kn[k] * ((sums_[k] - length) - bond.rest_overlap);
    if (bond.breakable != 0 && -fn > bond.strength.tension) {
      bond.broken = 1;
      s_.contacts.touching[k] = 0;
      if constexpr (Energy) s_.energies.broken += s_.contacts.elastic[k];
    } else if constexpr (Energy) {
      s_.contacts.elastic[k] = elastic_energy<Real>(s_.contacts.kn[k], Real(0), fn, {});
      s_.energies.elastic += s_.contacts.elastic[k];
    }
    return fn;
  }

  // A broken bond is a frictionless contact.
  void loose(std::size_t k) {
    Bodies<Real>& b = s_.bodies;
    const BondState<Real>& bond = s_.bonds[k];
    const auto i = static_cast<std::size_t>(bond.first);
    const auto j = static_cast<std::size_t>(bond.second);
    const Vec3<Real> d = b.position[j] - b.position[i];
    const Real length = norm(d);
    const Real overlap = sums_[k] - length;
    s_.contacts.touching[k] = overlap >= 0 ? 1 : 0;
    if (!(overlap >= 0)) return;
    const Real fn = s_.contacts.kn[k] * overlap;
    const Vec3<Real> f = fn * (d / length);
    b.force[i] -= f;
    b.force[j] += f;
    if constexpr (Energy) s_.energies.elastic += elastic_energy<Real>(s_.contacts.kn[k], Real(0), fn, {});
  }

  SimulationState<Real>& s_;
  const std::vector<Real>& sums_;
};

// Steps of kicks v += f dt a(x) and drifts x += f dt v instead of the leapfrog; positions and velocities
// then belong to one time, and so does the account, taken behind the last step.
template <int Axes, bool Gravity, RealType Real>
void run_flow(SimulationState<Real>& s, const std::vector<FlowPart<Real>>& flow, std::uint64_t count) {
  const BondedBodies<Real> bonded(s);
  BondForces<Axes, false, Real> forces(s, bonded.sums);
  Bodies<Real>& b = s.bodies;
  const auto every_axis = [](auto&& apply) {
    apply(&Vec3<Real>::x);
    apply(&Vec3<Real>::y);
    if constexpr (Axes == 3) apply(&Vec3<Real>::z);
  };
  std::vector<Real> part_of_dt;
  for (const auto& part : flow) part_of_dt.push_back(part.fraction * s.dt);
  for (std::uint64_t n = 0; n < count; ++n) {
    for (std::size_t k = 0; k < flow.size(); ++k) {
      const Real& dt = part_of_dt[k];
      if (flow[k].kick) forces.all();
      for (const std::size_t i : bonded.movable) {
        every_axis([&](auto axis) {
          if (!flow[k].kick) {
            b.position[i].*axis += dt * (b.velocity[i].*axis);
            return;
          }
          Real a = b.force[i].*axis / b.mass[i];
          if constexpr (Gravity) a += s.gravity.*axis;
          b.velocity[i].*axis += dt * a;
        });
      }
    }
    ++s.iteration;
  }
  if (s.parts.energy) {
    // No bond of what has such an account breaks.
    BondForces<Axes, true, Real>(s, bonded.sums).all();
    s.energies.kinetic = s.energies.potential = Real(0);
    for (const std::size_t i : bonded.movable) {
      s.energies.kinetic += kinetic_energy(b.mass[i], b.velocity[i]);
      if constexpr (Gravity) s.energies.potential += potential_energy(b.mass[i], s.gravity, b.position[i]);
    }
  }
  std::fill(b.force.begin(), b.force.end(), Vec3<Real>{});
}

// The leapfrog; what it has is known when it is compiled (std::true_type) or when it runs (bool).  Parameters
// are copied into locals: as numbers of the state they could change with every number written.
template <int Axes, bool Energy, class Damping, class Gravity, RealType Real>
void run_leapfrog(SimulationState<Real>& s, std::uint64_t count, Damping has_damping, Gravity has_gravity) {
  const BondedBodies<Real> bonded(s);
  BondForces<Axes, Energy, Real> forces(s, bonded.sums);
  const Real dt = s.dt;
  const Real lambda = s.damping;
  const Vec3<Real> gravity = s.gravity;
  const Real zero{0};
  Bodies<Real>& b = s.bodies;
  Vec3<Real>* const position = b.position.data();
  Vec3<Real>* const velocity = b.velocity.data();
  Vec3<Real>* const force = b.force.data();
  const Real* const mass = b.mass.data();
  const std::size_t bonds = s.bonds.size();
  const auto axis = [&](Real& x, Real& v, const Real& f, const Real& g, const Real& m) {
    Real a = f / m;
    if (has_gravity) a += g;
    if (has_damping) a = damped(a, v, dt, lambda);
    v += dt * a;
    x += dt * v;
  };
  for (std::uint64_t n = 0; n < count; ++n) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      force[i].x = zero;
      force[i].y = zero;
      if constexpr (Axes == 3) force[i].z = zero;
    }
    if constexpr (Energy) s.energies.elastic = zero;
    for (std::size_t k = 0; k < bonds; ++k) forces.stretch(k, position, force);
    if constexpr (Energy) {
      s.energies.kinetic = s.energies.potential = Real(0);
      for (std::size_t i = 0; i < b.size(); ++i) account_body(s, i, false);
    }
    for (const std::size_t i : bonded.movable) {
      axis(position[i].x, velocity[i].x, force[i].x, gravity.x, mass[i]);
      axis(position[i].y, velocity[i].y, force[i].y, gravity.y, mass[i]);
      if constexpr (Axes == 3) axis(position[i].z, velocity[i].z, force[i].z, gravity.z, mass[i]);
    }
    for (const std::size_t i : bonded.driven) drift(position[i], velocity[i], dt);
    ++s.iteration;
  }
  std::fill(b.force.begin(), b.force.end(), Vec3<Real>{});
}

}  // namespace detail

// Whether the energy account of such a simulation is that of its last step alone, with no sum over steps.
template <RealType Real>
[[nodiscard]] bool account_forgets(const SimulationState<Real>& s) {
  if (s.parts.damping) return false;
  for (const auto& bond : s.bonds) {
    if (bond.breakable != 0) return false;
  }
  // A fixed body at rest takes no work.
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    if (s.bodies.fixed[i] != 0 && !(s.bodies.velocity[i] == Vec3<Real>{})) return false;
  }
  return true;
}

// Takes `count` steps of a simulation whose parts say bonds_alone(), by the leapfrog where `flow` is empty.
// Any other flow needs account_forgets().
template <RealType Real>
void run_bonds_alone(SimulationState<Real>& s, std::uint64_t count,
                     const std::vector<FlowPart<Real>>& flow = {}) {
  if (s.parts.energy && count > 1 && account_forgets(s)) {
    s.parts.energy = false;
    run_bonds_alone(s, count - 1, flow);
    s.parts.energy = true;
    count = 1;
  }
  const auto pick = [](bool on, auto&& next) { on ? next(std::true_type{}) : next(std::false_type{}); };
  pick(s.parts.third_axis, [&](auto third) {
    constexpr int axes = third ? 3 : 2;
    if (flow.empty() && s.parts.energy) {
      // An account of every step: next to it a branch costs nothing.
      detail::run_leapfrog<axes, true>(s, count, s.parts.damping, s.parts.gravity);
      return;
    }
    pick(s.parts.gravity, [&](auto gravity) {
      if (!flow.empty()) {
        detail::run_flow<axes, gravity>(s, flow, count);
        return;
      }
      pick(s.parts.damping,
           [&](auto damping) { detail::run_leapfrog<axes, false>(s, count, damping, gravity); });
    });
  });
}

}  // namespace ulpgate::dem
