// LedgerEntry: the energy of one collision step by step, and how much of it the method may make from nothing.
//
// Gained.  The leapfrog turns v(n-1/2) into v(n+1/2), which changes m*/2 |v|^2 of the relative velocity by
// m* (v+ - v-).(v+ + v-)/2 exactly.  Without the part of the kick that other forces have, summed over the
// steps inside, that is the work of the contact W, every rounding of the kicks included; a passive contact
// has W <= 0 when it is over.
//
// Bound by the step.  A linear spring does W = sum kn q(n) (q(n-1) - q(n+1))/2 on the overlap q, which
// telescopes whatever the other forces are: W = kn/2 (|q(e-1)| |q(e)| - |q(b)| |q(b-1)|), b and e the first
// and last + 1 step inside.  As |q(e-1)| + |q(e)| = h = dt |v| at the exit, W <= kn h^2/8 = (z^2/4) m*/2 v^2
// with z = dt sqrt(kn/m*), and an isolated elastic collision has |W| <= (z^2/4)/(1 - z^2/4) of its energy,
// reached when it begins on a step and ends between two.  From z = 2 on nothing is bounded.  Hertz's force
// has less than F(h) h/8 at the exit; its trapezoids overrate the integral by h^2 F''/12 an interval on the
// way out, in sum at most z^2/6 m*/2 v^2.
//   Around it, each with the remainder of Taylor's series that makes it: the normal turns, so that q(n+1) -
// q(n) is not dt n.v; the dashpots see a velocity half a step old, which pulls the wrong way in the step in
// which it turns round, by at most c dt |v+ - v-|^2/16; the stored shear is turned by a first-order rotation
// before it is extended, but did its work unturned; a spring that swings through 0 between two steps gives
// k (dt v)^2/8 as the normal one does at its end.
//
// Bound by the law.  The shear spring is extended by a velocity free of ratcheting, which is not the one
// that its force works on; Mindlin's spring holds its force while its stiffness follows the overlap, which
// makes energy where it softens (D. Elata & J. G. Berryman, Mech. Mater. 24 (1996) 229).
//
// Bound by rounding, 16 u K with K = condition * energy: coordinates that are off by u |x| move the overlap
// by that (force F, stiffness S), before as much as within a step; velocities are off by u |v|.
#pragma once

#include "kernels/dem/step/collision_record.hpp"
#include "kernels/dem/step/integrate.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct LedgerEntry {
  BodyPair pair{};
  std::int32_t one = 0, two = 0;  // its bodies in the order of the normal
  std::uint8_t flat = 0;          // `one` is flat
  std::uint64_t begin_step = 0, end_step = 0;
  // Parts of a step, by which it began before begin_step and ended after end_step - 1.
  Real begin_part{0}, end_part{0};
  Real mass{0};  // reduced, kg
  Real velocity_before{0}, velocity_after{0}, largest_overlap{0};
  Real energy_before{0}, energy_after{0}, energy_largest{0};
  Real gained{0}, gained_rest{0};                          // a sum and what it has lost to rounding
  Real sensitivity{0}, step_bound{0}, law_bound{0};        // J
  Real stiffest{0}, fastest{0};                            // N/m, m/s along the normal
  Vec3<Real> velocity, spin1, spin2;                       // before the kick of the step seen last
  Vec3<Real> other, other_spin1, other_spin2;              // accelerations by all but this contact
  Vec3<Real> force, torque1, torque2;                      // by this contact
  Vec3<Real> normal, shear;                                // of that step
  Real overlap{0}, arm1{0}, arm2{0}, stiffness{0}, ks{0};  // ks: at the present overlap
  Real cn{0}, cs{0};

  // Calls visit(name, field) on everything that is state.
  template <class Visit>
  void each_field(Visit visit) {
    visit("first", pair.first);
    visit("second", pair.second);
    visit("one", one);
    visit("two", two);
    visit("flat", flat);
    visit("begin_step", begin_step);
    visit("end_step", end_step);
    for (Real* x : {&begin_part,
                    &end_part,
                    &mass,
                    &velocity_before,
                    &velocity_after,
                    &largest_overlap,
                    &energy_before,
                    &energy_after,
                    &energy_largest,
                    &gained,
                    &gained_rest,
                    &sensitivity,
                    &step_bound,
                    &law_bound,
                    &stiffest,
                    &fastest,
                    &overlap,
                    &arm1,
                    &arm2,
                    &stiffness,
                    &ks,
                    &cn,
                    &cs}) {
      visit("number", *x);
    }
    for (Vec3<Real>* v : {&velocity, &spin1, &spin2, &other, &other_spin1, &other_spin2, &force, &torque1,
                          &torque2, &normal, &shear}) {
      visit("vector", *v);
    }
  }
};

namespace detail {

// |x| + |y| + |z|, which is no less than the length.
template <RealType Real>
[[nodiscard]] Real size_of(const Vec3<Real>& v) {
  using std::abs;
  return abs(v.x) + abs(v.y) + abs(v.z);
}

// The energy of collisions in one state of a simulation, before its bodies are moved.
template <RealType Real>
class CollisionEnergy {
 public:
  using Entry = LedgerEntry<Real>;

  explicit CollisionEnergy(const SimulationState<Real>& s) : s_(s), b_(s.bodies) {}

  // Notes what pair p of the contacts does in this step, whose force is `f`; `fresh`: it did nothing before.
  void look(const ContactPass<Real>& pass, std::size_t p, const PairForce<Real>& f, bool fresh, Entry& e) {
    e.one = f.first;
    e.two = f.second;
    const std::size_t i1 = one(e);
    const std::size_t i2 = two(e);
    e.flat = b_.shape[i1] != Shape::sphere ? 1 : 0;
    e.mass = reduced(i1, i2);
    const bool flat = e.flat != 0;
    const ContactGeometry<Real> g = pass.geometry(i1, i2, flat);
    const Vec3<Real> velocity = b_.velocity[i2] - b_.velocity[i1];
    const bool hertz = s_.law == scenes::ContactLaw::hertz_mindlin;
    using std::sqrt;
    const Real root = hertz ? Real(sqrt(g.overlap > 0 ? g.overlap : Real(0))) : Real(1);
    const Real ks = s_.parts.shear ? Real(s_.contacts.ks[p] * root) : Real(0);
    if (s_.parts.shear) bound_shear(pass, p, g, ks, fresh, e);
    if (flat && !fresh) {
      // A face gives way to an edge or another face: the normal turns at once.
      e.step_bound += larger(size_of(f.force), size_of(e.force)) * s_.dt * size_of(velocity) *
                      size_of(g.normal - e.normal);
    }
    e.normal = g.normal;
    e.overlap = g.overlap;
    e.velocity = velocity;
    e.force = f.force;
    e.ks = ks;
    e.stiffness = s_.contacts.kn[p] * root * (hertz ? Real(3) / 2 : Real(1));
    e.cn = s_.parts.viscosity ? s_.contacts.cn[p] : Real(0);
    e.cs = s_.parts.viscosity ? s_.contacts.cs[p] : Real(0);
    e.other = other_acceleration(i2, f.force) - other_acceleration(i1, -f.force);
    if (s_.parts.rotation) {
      e.arm1 = flat ? Real(0) : Real(b_.radius[i1] - g.overlap / 2);
      e.arm2 = b_.radius[i2] - g.overlap / 2;
      e.spin1 = b_.angular_velocity[i1];
      e.spin2 = b_.angular_velocity[i2];
      e.torque1 = f.torque1;
      e.torque2 = f.torque2;
      e.other_spin1 = other_spin(i1, f.torque1);
      e.other_spin2 = other_spin(i2, f.torque2);
    }
    e.largest_overlap = larger(e.largest_overlap, g.overlap);
    e.stiffest = larger(e.stiffest, e.stiffness);
    if (fresh) begin(e);
  }

  // Takes the kick of the step seen last into the account of the collision; velocities are those after it.
  void kicked(Entry& e) {
    const std::size_t i1 = one(e);
    const std::size_t i2 = two(e);
    const Real& m = e.mass;
    const Vec3<Real> after = b_.velocity[i2] - b_.velocity[i1];
    const Vec3<Real> change = after - e.velocity;
    const Vec3<Real> mean = (after + e.velocity) / Real(2);
    using std::abs;
    add(e, Real(m * dot(change - s_.dt * e.other, mean)));
    const Real moved = s_.dt * size_of(mean);
    e.sensitivity += m * size_of(mean) * (size_of(b_.velocity[i1]) + size_of(b_.velocity[i2])) +
                     moved * (size_of(e.force) + m * size_of(e.other)) +
                     reach(e) * (size_of(e.force) + e.stiffness * s_.dt * abs(dot(e.normal, mean)));
    if (s_.parts.rotation) {
      spun(i1, e.spin1, e.other_spin1, e.torque1, e);
      spun(i2, e.spin2, e.other_spin2, e.torque2, e);
    }
    bound_turns(after, change, mean, e);
    e.energy_largest = larger(e.energy_largest, energy(e));
    e.fastest = larger(e.fastest, abs(dot(e.normal, after)));
  }

  // The bodies are apart; the kick of the last step inside has been taken.
  void end(std::uint64_t step, Entry& e) {
    using std::abs;
    const Vec3<Real> v = b_.velocity[two(e)] - b_.velocity[one(e)];
    e.end_step = step;
    e.velocity_after = dot(e.normal, v);
    e.end_part = part_of_step(e.overlap, e.velocity_after);
    e.energy_after = energy(e);
    const Real z2 = e.stiffest * s_.dt * s_.dt / e.mass;
    Real h = s_.dt * abs(e.velocity_after);
    if (e.flat == 0) h += s_.dt * s_.dt * squared_norm(tangential(v, e.normal)) / (2 * distance(e));
    if (z2 < 4) e.step_bound += force_at(h, e) * h / 8;
    if (s_.law == scenes::ContactLaw::hertz_mindlin)
      e.step_bound += z2 / 6 * e.mass * e.fastest * e.fastest / 2;
    if (s_.parts.shear) {
      const Vec3<Real> slip = surface_velocity(v, present_spin(one(e)), present_spin(two(e)), e);
      e.step_bound += e.ks * s_.dt * s_.dt * squared_norm(slip) / 8;
    }
    e.sensitivity += e.energy_largest;
  }

 private:
  [[nodiscard]] static std::size_t one(const Entry& e) { return static_cast<std::size_t>(e.one); }
  [[nodiscard]] static std::size_t two(const Entry& e) { return static_cast<std::size_t>(e.two); }
  [[nodiscard]] static Real larger(const Real& a, const Real& b) { return a < b ? b : a; }

  static void add(Entry& e, const Real& work) {
    // The part that a sum loses, kept beside it: A. Neumaier, ZAMM 54 (1974) 39.
    using std::abs;
    const Real sum = e.gained + work;
    const bool small = abs(work) < abs(e.gained);
    e.gained_rest += small ? Real((e.gained - sum) + work) : Real((work - sum) + e.gained);
    e.gained = sum;
  }

  [[nodiscard]] Real reduced(std::size_t i1, std::size_t i2) const {
    if (b_.fixed[i1] != 0) return b_.mass[i2];
    if (b_.fixed[i2] != 0) return b_.mass[i1];
    return reduced_mass(b_.mass[i1], b_.mass[i2]);
  }

  [[nodiscard]] Vec3<Real> present_spin(std::size_t i) const {
    return s_.parts.rotation ? b_.angular_velocity[i] : Vec3<Real>{};
  }

  [[nodiscard]] Real spin_energy(std::size_t i) const {
    if (b_.fixed[i] != 0) return Real(0);
    if (!is_aspherical(b_, i)) return rotational_energy<Real>(b_.inertia[i], b_.angular_velocity[i]);
    const auto found = std::lower_bound(b_.aspherical.begin(), b_.aspherical.end(), static_cast<int>(i));
    const auto k = static_cast<std::size_t>(found - b_.aspherical.begin());
    return dot(b_.angular_momentum[k], b_.angular_velocity[i]) / 2;
  }

  [[nodiscard]] Real energy(const Entry& e) const {
    Real sum = kinetic_energy<Real>(e.mass, b_.velocity[two(e)] - b_.velocity[one(e)]);
    if (s_.parts.rotation) sum += spin_energy(one(e)) + spin_energy(two(e));
    return sum;
  }

  // What accelerates body i besides `force`, that of the contact on it.
  [[nodiscard]] Vec3<Real> other_acceleration(std::size_t i, const Vec3<Real>& force) const {
    if (b_.fixed[i] != 0) return {};
    Vec3<Real> a = (b_.force[i] - force) / b_.mass[i];
    if (s_.parts.gravity) a += s_.gravity;
    if (!s_.parts.damping) return a;
    Vec3<Real> all = b_.force[i] / b_.mass[i];
    if (s_.parts.gravity) all += s_.gravity;
    return a + (damped(all, b_.velocity[i], s_.dt, s_.damping) - all);
  }

  [[nodiscard]] Vec3<Real> other_spin(std::size_t i, const Vec3<Real>& torque) const {
    if (b_.fixed[i] != 0 || is_aspherical(b_, i)) return {};
    const Vec3<Real> a = (b_.torque[i] - torque) / b_.inertia[i];
    if (!s_.parts.damping) return a;
    const Vec3<Real> all = b_.torque[i] / b_.inertia[i];
    return a + (damped(all, b_.angular_velocity[i], s_.dt, s_.damping) - all);
  }

  // The energy of spin that the torque of the contact gave body i in the kick.  A body of three moments
  // gains and loses some on its own, so that of it only the work of the torque counts.
  void spun(std::size_t i, const Vec3<Real>& before, const Vec3<Real>& other, const Vec3<Real>& torque,
            Entry& e) {
    if (b_.fixed[i] != 0) return;
    const Vec3<Real>& after = b_.angular_velocity[i];
    const Vec3<Real> mean = (after + before) / Real(2);
    const bool aspherical = is_aspherical(b_, i);
    add(e, aspherical ? Real(s_.dt * dot(torque, mean))
                      : Real(b_.inertia[i] * dot((after - before) - s_.dt * other, mean)));
    e.sensitivity += s_.dt * size_of(torque) * size_of(mean);
    if (!aspherical)
      e.sensitivity += b_.inertia[i] * size_of(mean) * (size_of(after) + s_.dt * size_of(other));
  }

  // By how much the overlap is off where every coordinate and radius is off by a part 1 of itself, m.
  [[nodiscard]] Real reach(const Entry& e) const {
    using std::abs;
    const Vec3<Real>& x2 = b_.position[two(e)];
    const Vec3<Real>& x1 = e.flat != 0 ? x2 : b_.position[one(e)];
    Real sum = b_.radius[two(e)] + (e.flat != 0 ? b_.radius[two(e)] : b_.radius[one(e)]);
    for (std::size_t k = 0; k < 3; ++k) sum += abs(e.normal[k]) * (abs(x1[k]) + abs(x2[k]));
    return sum;
  }

  [[nodiscard]] Real distance(const Entry& e) const {
    return b_.radius[one(e)] + b_.radius[two(e)] - e.overlap;
  }

  // Of the surfaces where they meet, from the geometry of the step seen last.
  [[nodiscard]] static Vec3<Real> surface_velocity(const Vec3<Real>& v, const Vec3<Real>& w1,
                                                   const Vec3<Real>& w2, const Entry& e) {
    return tangential<Real>(v - e.arm2 * cross(w2, e.normal) - e.arm1 * cross(w1, e.normal), e.normal);
  }

  // The normal force of the springs at an overlap of h.
  [[nodiscard]] Real force_at(const Real& h, const Entry& e) const {
    using std::sqrt;
    if (s_.law != scenes::ContactLaw::hertz_mindlin) return e.stiffness * h;
    const Real kn = e.overlap > 0 ? Real(2 * e.stiffness / (3 * sqrt(e.overlap))) : Real(0);
    return kn * sqrt(h) * h;
  }

  // The part of a step in which a speed along the normal crosses an overlap: 1 where it never does.
  [[nodiscard]] Real part_of_step(const Real& overlap, const Real& speed) const {
    const Real path = s_.dt * speed;
    return path > overlap ? Real(overlap / path) : Real(1);
  }

  void begin(Entry& e) {
    e.velocity_before = dot(e.normal, e.velocity);
    e.energy_before = energy(e);
    const Real closing = -e.velocity_before;
    e.begin_part = closing > 0 ? part_of_step(e.overlap, closing) : Real(0);
    if (e.overlap > s_.dt * closing) {
      // They were inside each other before anybody looked: the spring's energy is part of what there is, and
      // to give it back makes none.
      const bool hertz = s_.law == scenes::ContactLaw::hertz_mindlin;
      const Real spring = force_at(e.overlap, e);
      const Real stored = hertz ? Real(2 * spring * e.overlap / 5) : Real(spring * e.overlap / 2);
      e.energy_before += stored;
      add(e, -stored);
      e.step_bound += spring * s_.dt * size_of(e.velocity) / 2;
    }
    e.energy_largest = e.energy_before;
    e.fastest = closing > 0 ? closing : Real(0);
  }

  // Terms of the bound that come from the stored shear between the step before and this one.
  void bound_shear(const ContactPass<Real>& pass, std::size_t p, const ContactGeometry<Real>& g,
                   const Real& ks, bool fresh, Entry& e) {
    using std::abs;
    const std::size_t i1 = one(e);
    const std::size_t i2 = two(e);
    const bool flat = e.flat != 0;
    const Real& dt = s_.dt;
    const Vec3<Real> shear = s_.contacts.shear[p];
    const Vec3<Real> slip = tangential(pass.contact_velocity(i1, i2, flat, g.overlap, g.normal), g.normal);
    const Vec3<Real> taken =
        tangential(pass.relative_velocity(i1, i2, flat, g.overlap, g.distance, g.normal), g.normal);
    const Real now = norm(shear);
    const Real before = fresh ? Real(0) : norm(e.shear);
    e.law_bound += dt * (before + now) / 2 * norm(Vec3<Real>(taken - slip));
    if (!fresh && before > 0) {
      const Vec3<Real> w1 = present_spin(i1);
      const Vec3<Real> w2 = present_spin(i2);
      const Real turn = norm(cross(e.normal, g.normal)) + dt / 2 * abs(dot(e.normal, w1 + w2));
      e.step_bound += dt / 2 * before * turn * norm(slip);
      e.step_bound += dt / 4 * before * abs(g.overlap - e.overlap) * (norm(w1) + norm(w2));
      if (e.ks > 0) e.step_bound += before * before * turn * turn / e.ks;
      if (dot(e.shear, e.shear - (ks * dt) * taken) < 0)
        e.step_bound += ks * dt * dt * squared_norm(taken) / 8;
      if (s_.law == scenes::ContactLaw::hertz_mindlin && e.ks > 0 && ks > 0)
        e.law_bound += before * before / 2 * abs(1 / ks - 1 / e.ks);
    }
    e.shear = shear;
  }

  // Terms of the bound that come from velocities that turn within the step.
  void bound_turns(const Vec3<Real>& after, const Vec3<Real>& change, const Vec3<Real>& mean, Entry& e) {
    using std::abs;
    const Real& dt = s_.dt;
    const Vec3<Real>& n = e.normal;
    const Real normal_change = dot(n, change);
    if (e.cn > 0 && dot(n, e.velocity) * dot(n, mean) < 0)
      e.step_bound += e.cn * dt * normal_change * normal_change / 16;
    const Vec3<Real> across_before = tangential(e.velocity, n);
    const Vec3<Real> across_after = tangential(after, n);
    if (e.cs > 0) {
      const Vec3<Real> slip = surface_velocity(e.velocity, e.spin1, e.spin2, e);
      const Vec3<Real> next = surface_velocity(after, present_spin(one(e)), present_spin(two(e)), e);
      if (dot(slip, slip + next) < 0) e.step_bound += e.cs * dt * squared_norm(Vec3<Real>(next - slip)) / 16;
    }
    if (e.flat != 0) return;
    // Twice the remainders of |d + dt v| = |d| + dt n.v + ..., for what follows them.
    const Real d = distance(e);
    const Real fn = abs(dot(e.force, n));
    const Real odd = abs(dot(across_after - across_before, across_after + across_before));
    const Real cubic = abs(dot(n, after)) * squared_norm(across_after) +
                       abs(dot(n, e.velocity)) * squared_norm(across_before);
    e.step_bound += fn * dt * dt / (2 * d) * (odd + dt / d * cubic);
  }

  const SimulationState<Real>& s_;
  const Bodies<Real>& b_;
};

}  // namespace detail

}  // namespace ulpgate::dem
