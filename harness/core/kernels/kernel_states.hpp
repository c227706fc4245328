// States<Real>: state k of a stratum, made once in RealHP<1> from random words, with no function but the
// square root.
#pragma once

#include "harness/core/arguments/sampling.hpp"
#include "kernels/dem/table/kernel_info.hpp"

namespace ulpgate {

template <RealType Real>
class States {
 public:
  using Vec3 = dem::Vec3<Real>;
  using Quaternion = dem::Quaternion<Real>;

  States(const dem::KernelInfo& kernel, const StratumSource& source)
      : kernel_(kernel), source_(source), stream_(source.seed, kernel.name, name_of(source.stratum)) {}

  // Writes the inputs of the kernel in state k to out.
  void make(std::uint64_t k, Real* out) const {
    const dem::KernelState<Real> s = Maker(*this, k).state();
    for (const auto f : kernel_.inputs) dem::each_component(s, f, [&](const Real& x) { *out++ = x; });
  }

 private:
  // Draws in a fixed order; each draw is an argument of the counter-based stream.  Two draws in one
  // expression would be in the order of the compiler's choice, which for operands of an operator is another
  // with GCC than with clang.
  class Maker {
   public:
    Maker(const States& states, std::uint64_t k) : states_(states), k_(k) {}

    dem::KernelState<Real> state() {
      dem::KernelState<Real> s{};
      make_bodies(s);
      make_motion(s);
      make_materials(s);
      make_shear(s);
      make_flats(s);
      return s;
    }

   private:
    static constexpr int digits = std::numeric_limits<Real>::digits;

    [[nodiscard]] bool is(Stratum stratum) const { return states_.source_.stratum == stratum; }
    [[nodiscard]] bool is_wide() const { return is(Stratum::uniform) || is(Stratum::stratified); }

    // In [0, 1].
    Real fraction() {
      std::uint64_t words[detail::words_per_value<Real>];
      states_.stream_.fill(k_, draw_, words);
      if (is(Stratum::stratified)) {
        const std::uint64_t n = states_.source_.count;
        detail::into_cell(words, detail::permuted_cell(k_, detail::cell_stride(draw_, n), n), n);
      }
      ++draw_;
      return (detail::on_minus_100_100<Real>(words) + Real(100)) / Real(200);
    }
    Real between(const Real& low, const Real& high) { return low + (high - low) * fraction(); }
    Real signed_one() { return between(Real(-1), Real(1)); }
    // Log-uniform: a random power of two in 2^low..2^(high-1) times [1, 2].
    Real power(int low, int high) {
      using std::ldexp;
      std::uint64_t word[1];
      states_.stream_.fill(k_, draw_++, word);
      const auto span = static_cast<std::uint64_t>(high - low);
      const int e = low + static_cast<int>((static_cast<unsigned __int128>(word[0]) * span) >> 64U);
      return ldexp(Real(Real(1) + fraction()), e);
    }
    Vec3 vector() {
      const Real x = signed_one();
      const Real y = signed_one();
      const Real z = signed_one();
      return {x, y, z};
    }
    Vec3 direction() {
      const Vec3 v = vector();
      const Real length = dem::norm(v);
      return length == 0 ? Vec3{Real(1), Real(0), Real(0)} : v / length;
    }
    Vec3 across(const Vec3& n) {
      const Vec3 t = dem::cross(n, direction());
      const Real length = dem::norm(t);
      return length == 0 ? Vec3{} : t / length;
    }
    Quaternion orientation() {
      const Real w = signed_one();
      const Vec3 v = vector();
      const Quaternion q{w, v.x, v.y, v.z};
      if (q.w == 0 && v == Vec3{}) return {};
      return dem::normalized(q);
    }
    // A rotation by about `size` rad after q.
    Quaternion turned(const Quaternion& q, const Real& size) {
      const Vec3 v = (size / 2) * vector();
      return dem::normalized(Quaternion{Real(1), v.x, v.y, v.z} * q);
    }

    void make_bodies(dem::KernelState<Real>& s) {
      s.r1 = power(-10, -3);
      s.r2 = is(Stratum::ratio) ? Real(s.r1 * power(0, 40)) : Real(s.r1 * between(Real(1) / 2, Real(2)));
      const Real smaller = s.r1 < s.r2 ? s.r1 : s.r2;
      s.overlap = smaller * relative_overlap();
      s.rest_overlap = s.overlap * between(Real(0), Real(2));
      s.normal = direction();
      const Vec3 aside = direction();
      s.normal_old = s.normal + turn() * aside;
      s.normal_old = s.normal_old / dem::norm(s.normal_old);
      s.x1 = vector();
      if (is(Stratum::far)) {
        const Vec3 away = direction();
        s.x1 = s.x1 + power(20, 40) * away;
      }
      s.x2 = s.x1 + ((s.r1 + s.r2) - s.overlap) * s.normal;
      s.arm1 = (s.r1 - s.overlap / 2) * s.normal;
      s.arm2 = -((s.r2 - s.overlap / 2) * s.normal);
      s.q1_start = orientation();
      s.q2_start = orientation();
      s.q1 = is_wide() ? orientation() : turned(s.q1_start, turn());
      s.q2 = is_wide() ? orientation() : turned(s.q2_start, turn());
      s.sweep = s.r1 * fraction();
    }

    // Overlap / smaller radius.
    Real relative_overlap() {
      if (is(Stratum::touching)) return power(2 - digits, -20 < 2 - digits ? 3 - digits : -20);
      if (is(Stratum::deep)) return between(Real(1) / 10, Real(9) / 10);
      if (is_wide()) return between(Real(0), Real(1) / 4);
      return power(-20, -7);
    }
    // Size of the change of a direction in one step, rad.
    Real turn() {
      if (is(Stratum::parallel)) return power(-digits - 4, -digits / 2);
      if (is_wide()) return fraction();
      return power(-16, -6);
    }

    void make_motion(dem::KernelState<Real>& s) {
      const Real speed = is(Stratum::slow) ? power(-60, -20) : is_wide() ? power(-10, 6) : Real(1);
      s.v1 = speed * vector();
      s.v2 = speed * vector();
      s.w1 = (speed * 10) * vector();
      s.w2 = (speed * 10) * vector();
      s.velocity = speed * vector();
      if (is(Stratum::grazing)) {
        const Vec3 little = power(-digits, -20) * s.normal;
        s.velocity = speed * (across(s.normal) + little);
        s.v2 = s.v1 + s.velocity;
      }
      if (is(Stratum::cone)) s.velocity = (speed * signed_one()) * s.normal;
      s.closing_speed = -dem::dot(s.normal, s.velocity);
      s.dt = power(-24, -13);
      s.force = vector();
      s.force = power(-6, 10) * s.force;
      s.torque = vector();
      s.torque = power(-12, 4) * s.torque;
      s.angular_momentum = vector();
      s.angular_momentum = (speed * power(-12, 0)) * s.angular_momentum;
      s.gravity = {Real(0), -(Real(981) / Real(100)), Real(0)};
      s.damping = between(Real(0), Real(3) / 10);
    }

    void make_materials(dem::KernelState<Real>& s) {
      s.density = between(Real(1000), Real(8000));
      s.mass1 = s.density * (4 * s.r1 * s.r1 * s.r1);
      s.mass2 = s.density * (4 * s.r2 * s.r2 * s.r2);
      s.inertia1 = 2 * s.mass1 * s.r1 * s.r1 / 5;
      const Real unequal = between(Real(1) / 2, Real(3) / 2);
      s.principal_inertia = {s.inertia1, s.inertia1 * unequal,
                             s.inertia1 * between(Real(1) / 2, Real(3) / 2)};
      s.young1 = power(20, 36);
      s.young2 = power(20, 36);
      s.poisson1 = between(Real(1) / 10, Real(45) / 100);
      s.poisson2 = between(Real(1) / 10, Real(45) / 100);
      s.friction1 = between(Real(1) / 10, Real(1));
      s.friction2 = between(Real(1) / 10, Real(1));
      s.kn = power(10, 24);
      s.ks = s.kn * between(Real(2) / 10, Real(9) / 10);
      s.cn = s.kn * power(-16, -8);
      s.cs = s.cn * between(Real(2) / 10, Real(9) / 10);
      s.tan_friction = between(Real(1) / 10, Real(1));
      s.adhesion = s.kn * s.overlap * fraction();
      s.bending_stiffness = s.ks * s.r1 * s.r2;
      s.collision_time = power(-12, -8);
      s.restitution_n = between(Real(1) / 100, Real(99) / 100);
      s.restitution_t = between(Real(1) / 100, Real(99) / 100);
    }

    // Across the old normal; on the cone in the stratum of that name.
    void make_shear(dem::KernelState<Real>& s) {
      const Real limit = (s.kn * s.overlap) * s.tan_friction;
      if (is(Stratum::cone)) {
        s.shear = limit * across(s.normal);
      } else {
        s.shear = across(s.normal_old);
        s.shear = (limit * between(Real(0), Real(12) / 10)) * s.shear;
      }
    }

    // A triangle, a wall and a box that sphere 2 overlaps by `overlap`; of the triangle face, edges and
    // vertices.
    void make_flats(dem::KernelState<Real>& s) {
      const Vec3 foot = s.x2 - (s.r2 - s.overlap) * s.normal;
      const Vec3 t1 = across(s.normal);
      const Vec3 t2 = dem::cross(s.normal, t1);
      const Real size = s.r2 * power(0, 4);
      // The foot's place in the triangle's plane, inside or beyond an edge by as much as the overlap allows.
      const auto corner = [&](const Real& a, const Real& b) {
        return foot + (size * a) * t1 + (size * b) * t2;
      };
      const Real shift = is_wide() ? Real(fraction() / 4) : Real(0);
      s.facet_a = corner(Real(Real(-1) / 4 + shift), Real(Real(-1) / 4 + shift));
      s.facet_b = corner(Real(1), Real(-(fraction() / 4)));
      s.facet_c = corner(Real(-(fraction() / 4)), Real(1));
      s.half_size = {s.r2 * power(0, 4), s.r2 * power(0, 4), s.r2 * power(0, 4)};
      const auto& name = states_.kernel_.name;
      if (name == "wall_sphere") s.x1.x = s.x2.x + (s.normal.x < 0 ? s.r2 - s.overlap : s.overlap - s.r2);
      if (name == "box_sphere") {
        // On the face across the box's own x axis, at a random place of it.
        const Vec3 local{s.half_size.x + (s.r2 - s.overlap), s.half_size.y * signed_one(),
                         s.half_size.z * signed_one()};
        s.x1 = s.x2 - dem::rotate(s.q1, local);
      }
    }

    const States& states_;
    std::uint64_t k_;
    std::uint64_t draw_ = 0;
  };

  const dem::KernelInfo& kernel_;
  StratumSource source_;
  RandomStream stream_;
};

}  // namespace ulpgate
