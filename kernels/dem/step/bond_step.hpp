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

// `Axes` is 2 where everything lies in the plane z = 0.
template <int Axes, bool Damped, bool Gravity, bool Energy, RealType Real>
class BondsAlone {
 public:
  explicit BondsAlone(SimulationState<Real>& s) : s_(s) {
    for (const auto& bond : s.bonds) {
      sums_.push_back(s.bodies.radius[static_cast<std::size_t>(bond.first)] +
                      s.bodies.radius[static_cast<std::size_t>(bond.second)]);
    }
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
      // A fixed body at rest stays where it is.
      if (s.bodies.fixed[i] == 0) {
        movable_.push_back(i);
      } else if (!(s.bodies.velocity[i] == Vec3<Real>{})) {
        driven_.push_back(i);
      }
    }
  }

  // Steps of kicks v += f dt a(x) and drifts x += f dt v instead of the leapfrog; positions and velocities
  // then belong to one time, and so does the account, taken behind the last step.
  void run_flow(const std::vector<FlowPart<Real>>& flow, std::uint64_t count) {
    Bodies<Real>& b = s_.bodies;
    const auto every_axis = [](auto&& apply) {
      apply(&Vec3<Real>::x);
      apply(&Vec3<Real>::y);
      if constexpr (Axes == 3) apply(&Vec3<Real>::z);
    };
    std::vector<Real> part_of_dt;
    for (const auto& part : flow) part_of_dt.push_back(part.fraction * s_.dt);
    for (std::uint64_t n = 0; n < count; ++n) {
      for (std::size_t k = 0; k < flow.size(); ++k) {
        const Real& dt = part_of_dt[k];
        if (flow[k].kick) forces();
        for (const std::size_t i : movable_) {
          every_axis([&](auto axis) {
            if (!flow[k].kick) {
              b.position[i].*axis += dt * (b.velocity[i].*axis);
              return;
            }
            Real a = b.force[i].*axis / b.mass[i];
            if constexpr (Gravity) a += s_.gravity.*axis;
            b.velocity[i].*axis += dt * a;
          });
        }
      }
      ++s_.iteration;
    }
    if constexpr (Energy) {
      forces();
      s_.energies.kinetic = s_.energies.potential = Real(0);
      for (const std::size_t i : movable_) {
        s_.energies.kinetic += kinetic_energy(b.mass[i], b.velocity[i]);
        if constexpr (Gravity)
          s_.energies.potential += potential_energy(b.mass[i], s_.gravity, b.position[i]);
      }
    }
    std::fill(b.force.begin(), b.force.end(), Vec3<Real>{});
  }

  // Parameters are copied into locals: as numbers of the state they could change with every number written.
  void run(std::uint64_t count) {
    const Real dt = s_.dt;
    const Real lambda = s_.damping;
    const Vec3<Real> gravity = s_.gravity;
    const Real zero{0};
    Bodies<Real>& b = s_.bodies;
    Vec3<Real>* const position = b.position.data();
    Vec3<Real>* const velocity = b.velocity.data();
    Vec3<Real>* const force = b.force.data();
    const Real* const mass = b.mass.data();
    const std::size_t bonds = s_.bonds.size();
    const auto axis = [&](Real& x, Real& v, const Real& f, const Real& g, const Real& m) {
      Real a = f / m;
      if constexpr (Gravity) a += g;
      if constexpr (Damped) a = damped(a, v, dt, lambda);
      v += dt * a;
      x += dt * v;
    };
    for (std::uint64_t n = 0; n < count; ++n) {
      for (std::size_t i = 0; i < b.size(); ++i) {
        force[i].x = zero;
        force[i].y = zero;
        if constexpr (Axes == 3) force[i].z = zero;
      }
      if constexpr (Energy) s_.energies.elastic = zero;
      for (std::size_t k = 0; k < bonds; ++k) stretch(k, position, force);
      if constexpr (Energy) account_bodies();
      for (const std::size_t i : movable_) {
        axis(position[i].x, velocity[i].x, force[i].x, gravity.x, mass[i]);
        axis(position[i].y, velocity[i].y, force[i].y, gravity.y, mass[i]);
        if constexpr (Axes == 3) axis(position[i].z, velocity[i].z, force[i].z, gravity.z, mass[i]);
      }
      for (const std::size_t i : driven_) drift(position[i], velocity[i], dt);
      ++s_.iteration;
    }
    std::fill(b.force.begin(), b.force.end(), Vec3<Real>{});
  }

 private:
  void forces() {
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

  void account_bodies() {
    s_.energies.kinetic = s_.energies.potential = Real(0);
    for (std::size_t i = 0; i < s_.bodies.size(); ++i) account_body(s_, i, false);
  }

  SimulationState<Real>& s_;
  std::vector<Real> sums_;
  std::vector<std::size_t> movable_, driven_;
};

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
    pick(s.parts.gravity, [&](auto gravity) {
      pick(s.parts.energy, [&](auto energy) {
        constexpr int axes = third ? 3 : 2;
        if (!flow.empty()) {
          detail::BondsAlone<axes, false, gravity, energy, Real>(s).run_flow(flow, count);
          return;
        }
        pick(s.parts.damping,
             [&](auto damping) { detail::BondsAlone<axes, damping, gravity, energy, Real>(s).run(count); });
      });
    });
  });
}

}  // namespace ulpgate::dem
