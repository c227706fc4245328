// The step where bonds alone make the forces and nothing rotates: rods between nodes, the elastic pendulum.
//
// The same operations as the general step, without lists of contacts: for every bond d = x2 - x1, length, n =
// d/length, u = (r1 + r2) - length, Fn = kn (u - u0); then every body.  No memory is taken in a step.
#pragma once

#include "kernels/dem/integrate.hpp"

namespace ulpgate::dem {

namespace detail {

// `Axes` is 2 where everything lies in the plane z = 0.
template <int Axes, bool Damped, bool Gravity, RealType Real>
class BondsAlone {
 public:
  explicit BondsAlone(SimulationState<Real>& s) : s_(s) {
    for (const auto& bond : s.bonds) {
      sums_.push_back(s.bodies.radius[static_cast<std::size_t>(bond.first)] +
                      s.bodies.radius[static_cast<std::size_t>(bond.second)]);
    }
  }

  void step() {
    Bodies<Real>& b = s_.bodies;
    const std::size_t bonds = s_.bonds.size();
    if (s_.parts.energy) s_.energies.elastic = Real(0);
    for (std::size_t k = 0; k < bonds; ++k) stretch(k);
    if (s_.parts.energy) account_bodies();
    const std::size_t count = b.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (b.fixed[i] != 0) {
        drift(b.position[i], b.velocity[i], s_.dt);
      } else {
        axis(b.position[i].x, b.velocity[i].x, b.force[i].x, s_.gravity.x, b.mass[i]);
        axis(b.position[i].y, b.velocity[i].y, b.force[i].y, s_.gravity.y, b.mass[i]);
        if constexpr (Axes == 3)
          axis(b.position[i].z, b.velocity[i].z, b.force[i].z, s_.gravity.z, b.mass[i]);
      }
      b.force[i].x = Real(0);
      b.force[i].y = Real(0);
      if constexpr (Axes == 3) b.force[i].z = Real(0);
    }
    ++s_.iteration;
  }

 private:
  void axis(Real& x, Real& v, const Real& force, const Real& gravity, const Real& mass) const {
    Real a = force / mass;
    if constexpr (Gravity) a += gravity;
    if constexpr (Damped) a = damped(a, v, s_.dt, s_.damping);
    v += s_.dt * a;
    x += s_.dt * v;
  }

  void stretch(std::size_t k) {
    using std::sqrt;
    Bodies<Real>& b = s_.bodies;
    BondState<Real>& bond = s_.bonds[k];
    if (bond.broken != 0) return loose(k);
    const auto i = static_cast<std::size_t>(bond.first);
    const auto j = static_cast<std::size_t>(bond.second);
    const Vec3<Real>& p = b.position[i];
    const Vec3<Real>& q = b.position[j];
    const Real dx = q.x - p.x;
    const Real dy = q.y - p.y;
    Real length2 = dx * dx + dy * dy;
    if constexpr (Axes == 3) {
      const Real dz = q.z - p.z;
      length2 += dz * dz;
      const Real length = sqrt(length2);
      const Real fn = pull(k, length);
      if (bond.broken != 0) return loose(k);
      push(b.force[i].z, b.force[j].z, fn, Real(dz / length));
      push(b.force[i].x, b.force[j].x, fn, Real(dx / length));
      push(b.force[i].y, b.force[j].y, fn, Real(dy / length));
    } else {
      const Real length = sqrt(length2);
      const Real fn = pull(k, length);
      if (bond.broken != 0) return loose(k);
      push(b.force[i].x, b.force[j].x, fn, Real(dx / length));
      push(b.force[i].y, b.force[j].y, fn, Real(dy / length));
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
    const Real overlap = sums_[k] - length;
    Real fn = s_.contacts.kn[k] * (overlap - bond.rest_overlap);
    if (bond.breakable != 0 && -fn > bond.strength.tension) {
      bond.broken = 1;
      s_.contacts.touching[k] = 0;
      if (s_.parts.energy) s_.energies.broken += s_.contacts.elastic[k];
    } else if (s_.parts.energy) {
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
    if (s_.parts.energy) s_.energies.elastic += elastic_energy<Real>(s_.contacts.kn[k], Real(0), fn, {});
  }

  void account_bodies() {
    s_.energies.kinetic = s_.energies.potential = Real(0);
    for (std::size_t i = 0; i < s_.bodies.size(); ++i) account_body(s_, i, false);
  }

  SimulationState<Real>& s_;
  std::vector<Real> sums_;
};

template <int Axes, bool Damped, bool Gravity, RealType Real>
void run_bonds_alone_as(SimulationState<Real>& s, std::uint64_t count) {
  BondsAlone<Axes, Damped, Gravity, Real> run(s);
  for (std::uint64_t i = 0; i < count; ++i) run.step();
}

}  // namespace detail

// Takes `count` steps of a simulation whose parts say bonds_alone().
template <RealType Real>
void run_bonds_alone(SimulationState<Real>& s, std::uint64_t count) {
  const auto pick_gravity = [&]<int Axes, bool Damped>() {
    if (s.parts.gravity) {
      detail::run_bonds_alone_as<Axes, Damped, true>(s, count);
    } else {
      detail::run_bonds_alone_as<Axes, Damped, false>(s, count);
    }
  };
  const auto pick_damping = [&]<int Axes>() {
    if (s.parts.damping) {
      pick_gravity.template operator()<Axes, true>();
    } else {
      pick_gravity.template operator()<Axes, false>();
    }
  };
  if (s.parts.third_axis) {
    pick_damping.template operator()<3>();
  } else {
    pick_damping.template operator()<2>();
  }
}

}  // namespace ulpgate::dem
