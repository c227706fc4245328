// Bodies of the rows of kernels.def: each reads its state in the order of the row and calls the kernel that
// steps use.
#pragma once

#include "kernels/dem/bounds.hpp"
#include "kernels/dem/contact_laws.hpp"
#include "kernels/dem/critical_step.hpp"
#include "kernels/dem/energy.hpp"
#include "kernels/dem/flat_geometry.hpp"
#include "kernels/dem/kernel_info.hpp"
#include "kernels/dem/newton.hpp"
#include "kernels/dem/sphere_body.hpp"

namespace ulpgate::dem {

// Reads the inputs of a state one after the other.
template <RealType Real>
class StateReader {
 public:
  explicit StateReader(const Real* at) : at_(at) {}
  [[nodiscard]] Real number() { return *at_++; }
  [[nodiscard]] Vec3<Real> vector() {
    at_ += 3;
    return {at_[-3], at_[-2], at_[-1]};
  }
  [[nodiscard]] Quaternion<Real> quaternion() {
    at_ += 4;
    return {at_[-4], at_[-3], at_[-2], at_[-1]};
  }

 private:
  const Real* at_;
};

template <RealType Real>
class ResultWriter {
 public:
  explicit ResultWriter(Real* at) : at_(at) {}
  void put(const Real& x) { *at_++ = x; }
  void put(const Vec3<Real>& v) {
    put(v.x);
    put(v.y);
    put(v.z);
  }
  void put(const Quaternion<Real>& q) {
    put(q.w);
    put(q.x);
    put(q.y);
    put(q.z);
  }
  void put(const ContactGeometry<Real>& g) {
    put(g.overlap);
    put(g.normal);
    put(g.point);
  }
  void put(const Bounds<Real>& b) {
    put(b.low);
    put(b.high);
  }

 private:
  Real* at_;
};

template <KernelId Id, RealType Real>
struct KernelBody;

// in.number() and the like must be called in the order of the row, so each goes into a variable of its own.
#define ULPGATE_KERNEL(name, ...)                                                        \
  template <RealType Real>                                                               \
  struct KernelBody<KernelId::name, Real> {                                              \
    static void evaluate(StateReader<Real>& in, ResultWriter<Real>& out) { __VA_ARGS__ } \
  };
#define ULPGATE_N(x) const Real x = in.number();
#define ULPGATE_V(x) const Vec3<Real> x = in.vector();
#define ULPGATE_Q(x) const Quaternion<Real> x = in.quaternion();

ULPGATE_KERNEL(sphere_sphere, ULPGATE_V(x1) ULPGATE_N(r1) ULPGATE_V(x2) ULPGATE_N(r2)
                                  out.put(dem::sphere_sphere(x1, r1, x2, r2));)
ULPGATE_KERNEL(facet_sphere, ULPGATE_V(a) ULPGATE_V(b) ULPGATE_V(c) ULPGATE_V(x) ULPGATE_N(r)
                                 out.put(dem::facet_sphere(Facet<Real>{a, b, c}, x, r));)
ULPGATE_KERNEL(wall_sphere,
               ULPGATE_N(height) ULPGATE_V(x) ULPGATE_N(r) out.put(dem::wall_sphere(1, height, x, r));)
ULPGATE_KERNEL(box_sphere, ULPGATE_V(centre) ULPGATE_V(half) ULPGATE_Q(q) ULPGATE_V(x) ULPGATE_N(r)
                               out.put(dem::box_sphere(centre, half, q, x, r));)
ULPGATE_KERNEL(sphere_relative_velocity,
               ULPGATE_V(n) ULPGATE_N(u) ULPGATE_N(r1) ULPGATE_N(r2) ULPGATE_V(v1) ULPGATE_V(v2) ULPGATE_V(w1)
                   ULPGATE_V(w2) out.put(dem::sphere_relative_velocity(n, u, r1, r2, v1, v2, w1, w2));)
ULPGATE_KERNEL(point_relative_velocity,
               ULPGATE_V(arm1) ULPGATE_V(arm2) ULPGATE_V(v1) ULPGATE_V(v2) ULPGATE_V(w1) ULPGATE_V(w2)
                   out.put(dem::point_relative_velocity(arm1, arm2, v1, v2, w1, w2));)
ULPGATE_KERNEL(rotate_shear, ULPGATE_V(shear) ULPGATE_V(old) ULPGATE_V(n) ULPGATE_V(w1) ULPGATE_V(w2)
                                 ULPGATE_N(dt) out.put(dem::rotate_shear(shear, old, n, w1, w2, dt));)
ULPGATE_KERNEL(cut_to_cone, ULPGATE_V(trial) ULPGATE_N(limit) ULPGATE_N(ks) const Friction<Real> f =
                                dem::cut_to_cone(trial, limit, ks);
               out.put(f.shear); out.put(f.dissipation);)
ULPGATE_KERNEL(twist_and_bending, ULPGATE_Q(s1) ULPGATE_Q(s2) ULPGATE_Q(q1) ULPGATE_Q(q2) ULPGATE_V(n)
                                      const RelativeRotation<Real>
                                          r = dem::twist_and_bending(s1, s2, q1, q2, n);
               out.put(r.twist); out.put(r.bending);)
ULPGATE_KERNEL(frictional_physics, ULPGATE_N(e1) ULPGATE_N(nu1) ULPGATE_N(phi1) ULPGATE_N(r1) ULPGATE_N(e2)
                                       ULPGATE_N(nu2) ULPGATE_N(phi2) ULPGATE_N(r2) const ContactPhysics<Real>
                                           p = dem::frictional_physics(Elastic<Real>{e1, nu1, phi1}, r1,
                                                                       Elastic<Real>{e2, nu2, phi2}, r2);
               out.put(p.kn); out.put(p.ks); out.put(p.tan_friction);)
ULPGATE_KERNEL(viscoelastic_physics,
               ULPGATE_N(m1) ULPGATE_N(m2) ULPGATE_N(tc) ULPGATE_N(en) ULPGATE_N(et) ULPGATE_N(phi)
                   const ContactPhysics<Real>
                       p = dem::viscoelastic_physics(Collision<Real>{tc, en, et, phi}, reduced_mass(m1, m2));
               out.put(p.kn); out.put(p.ks); out.put(p.cn); out.put(p.cs); out.put(p.tan_friction);)
ULPGATE_KERNEL(hertz_mindlin_physics,
               ULPGATE_N(e1) ULPGATE_N(nu1) ULPGATE_N(r1) ULPGATE_N(e2) ULPGATE_N(nu2) ULPGATE_N(r2)
                   const ContactPhysics<Real>
                       p = dem::hertz_mindlin_physics(Elastic<Real>{e1, nu1, Real(0)}, r1,
                                                      Elastic<Real>{e2, nu2, Real(0)}, r2);
               out.put(p.kn); out.put(p.ks);)

// Writes a law's force; `viscous` apart where the law has one.
template <RealType Real>
void put_force(ResultWriter<Real>& out, const ContactForce<Real>& f, const Vec3<Real>& normal, bool viscous) {
  out.put(f.normal);
  out.put(f.shear);
  if (viscous) out.put(f.viscous);
  out.put(total_force(f, normal));
  out.put(f.dissipation);
}

ULPGATE_KERNEL(cundall_strack, ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(friction) ULPGATE_N(u) ULPGATE_V(n)
                                   ULPGATE_V(shear) ULPGATE_V(v) ULPGATE_N(dt) const ContactPhysics<Real>
                                       p{kn, ks, Real(0), Real(0), friction};
               put_force(out, dem::cundall_strack(p, u, n, shear, v, dt), n, false);)
ULPGATE_KERNEL(viscoelastic, ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(cn) ULPGATE_N(cs) ULPGATE_N(friction)
                                 ULPGATE_N(u) ULPGATE_N(closing) ULPGATE_V(n) ULPGATE_V(shear) ULPGATE_V(v)
                                     ULPGATE_N(dt) const ContactPhysics<Real>
                                         p{kn, ks, cn, cs, friction};
               put_force(out, dem::viscoelastic(p, u, closing, n, shear, v, dt), n, true);)
ULPGATE_KERNEL(hertz_mindlin, ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(friction) ULPGATE_N(u) ULPGATE_V(n)
                                  ULPGATE_V(shear) ULPGATE_V(v) ULPGATE_N(dt) const ContactPhysics<Real>
                                      p{kn, ks, Real(0), Real(0), friction};
               put_force(out, dem::hertz_mindlin(p, u, n, shear, v, dt), n, false);)
ULPGATE_KERNEL(cohesive,
               ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(friction) ULPGATE_N(adhesion) ULPGATE_N(u) ULPGATE_N(u0)
                   ULPGATE_V(n) ULPGATE_V(shear) ULPGATE_V(v) ULPGATE_N(dt) const ContactPhysics<Real>
                       p{kn, ks, Real(0), Real(0), friction};
               const BondStrength<Real> strength{Real(0), adhesion};
               put_force(out, dem::cohesive(p, strength, u, u0, n, shear, v, dt), n, false);)
ULPGATE_KERNEL(bond_moment,
               ULPGATE_N(kr) ULPGATE_N(ktw) ULPGATE_N(twist) ULPGATE_V(bending) ULPGATE_V(n)
                   out.put(dem::bond_moment(kr, ktw, RelativeRotation<Real>{twist, bending}, n));)
ULPGATE_KERNEL(shear_torque, ULPGATE_N(r) ULPGATE_N(u) ULPGATE_V(n) ULPGATE_V(shear)
                                 out.put(dem::shear_torque(Real(r - u / 2), n, shear));)
ULPGATE_KERNEL(translation, ULPGATE_V(force) ULPGATE_N(mass) ULPGATE_V(gravity) Vec3<Real> v = in.vector();
               Vec3<Real> x = in.vector();
               ULPGATE_N(dt) ULPGATE_N(lambda) const Vec3<Real> a = damped(acceleration(force, mass, gravity),
                                                                           v, dt, lambda);
               kick(v, a, dt); drift(x, v, dt); out.put(a); out.put(v); out.put(x);)
ULPGATE_KERNEL(rotation_spherical, ULPGATE_V(torque) ULPGATE_N(inertia) Vec3<Real> w = in.vector();
               ULPGATE_Q(q) ULPGATE_N(dt) ULPGATE_N(lambda)
                   kick(w, damped(torque / inertia, w, dt, lambda), dt);
               out.put(w); out.put(turned(q, w, dt));)
ULPGATE_KERNEL(rotation_aspherical,
               ULPGATE_V(torque) ULPGATE_V(inertia) ULPGATE_V(momentum) ULPGATE_Q(q) ULPGATE_N(dt)
                   const AsphericalState<Real>
                       next = turned_aspherical(AsphericalState<Real>{q, momentum, {}}, inertia, torque, dt);
               out.put(next.angular_momentum); out.put(next.angular_velocity); out.put(next.orientation);)
ULPGATE_KERNEL(sphere_bounds,
               ULPGATE_V(x) ULPGATE_N(r) ULPGATE_N(sweep) out.put(dem::sphere_bounds(x, r, sweep));)
ULPGATE_KERNEL(facet_bounds, ULPGATE_V(a) ULPGATE_V(b) ULPGATE_V(c) ULPGATE_N(sweep)
                                 out.put(dem::facet_bounds(Facet<Real>{a, b, c}, sweep));)
ULPGATE_KERNEL(sphere_body, ULPGATE_N(r) ULPGATE_N(density) const Real m = sphere_mass(r, density);
               out.put(m); out.put(sphere_inertia(m, r));)
ULPGATE_KERNEL(critical_step_waves, ULPGATE_N(r) ULPGATE_N(density) ULPGATE_N(young) ULPGATE_N(poisson)
                                        out.put(p_wave_step(r, density, young));
               out.put(rayleigh_step(r, density, young, poisson));)
ULPGATE_KERNEL(critical_step_stiffness, ULPGATE_N(mass) ULPGATE_N(inertia) ULPGATE_N(kn) ULPGATE_N(ks)
                                            ULPGATE_V(n) ULPGATE_N(r)
                                                out.put(stiffness_step(mass, axis_stiffness(kn, ks, n)));
               out.put(stiffness_step(inertia, axis_rotation_stiffness(ks, r, n)));)
ULPGATE_KERNEL(body_energy, ULPGATE_N(mass) ULPGATE_N(inertia) ULPGATE_V(v) ULPGATE_V(w) ULPGATE_V(gravity)
                                ULPGATE_V(x) out.put(kinetic_energy(mass, v));
               out.put(rotational_energy(inertia, w)); out.put(potential_energy(mass, gravity, x));)
ULPGATE_KERNEL(elastic_energy, ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(fn) ULPGATE_V(shear)
                                   out.put(dem::elastic_energy(kn, ks, fn, shear));)
ULPGATE_KERNEL(hertz_elastic_energy, ULPGATE_N(kn) ULPGATE_N(ks) ULPGATE_N(u) ULPGATE_V(shear)
                                         out.put(dem::hertz_elastic_energy(kn, ks, u, shear));)

#undef ULPGATE_N
#undef ULPGATE_V
#undef ULPGATE_Q
#undef ULPGATE_KERNEL

}  // namespace ulpgate::dem
