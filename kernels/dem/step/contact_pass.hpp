// ContactPass: evaluates one pair of bodies, geometry, physics of a new contact, law; any thread may take any
// pair.
#pragma once

#include "kernels/dem/formulas/energy.hpp"
#include "kernels/dem/step/facet_contacts.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct PairForce {
  std::int32_t first = 0, second = 0;  // body 1 gets -force, body 2 +force
  Vec3<Real> force;
  Vec3<Real> torque1, torque2;
};

// Of a flat body i1 and a sphere i2.
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> flat_contact(const Bodies<Real>& bodies,
                                                 const std::vector<Flat<Real>>& flats, std::size_t i1,
                                                 std::size_t i2) {
  const Flat<Real>& f = flats[static_cast<std::size_t>(bodies.flat[i1])];
  const Vec3<Real>& x = bodies.position[i2];
  const Real& r = bodies.radius[i2];
  if (bodies.shape[i1] == Shape::facet) return facet_sphere(f.facet, x, r);
  if (bodies.shape[i1] == Shape::wall) return wall_sphere(f.axis, bodies.position[i1][f.axis], x, r);
  return box_sphere(bodies.position[i1], f.half_size, f.orientation, x, r);
}

// Everything that evaluating a pair reads, and the contact arrays that it writes at its own index.
template <RealType Real>
struct ContactPass {
  const Parts& parts;
  scenes::ContactLaw law;
  bool bonded_only;
  const std::vector<scenes::MaterialValues<Real>>& materials;
  const Real& dt;
  bool first_step;
  Bodies<Real>& bodies;
  const std::vector<Flat<Real>>& flats;
  Contacts<Real>& contacts;
  std::vector<BondState<Real>>& bonds;
  const std::vector<CoarseSphere>& coarse;  // of the present positions; only where Real is not native
  FacetContacts<Real> surface;

  // Returns whether the pair exerts a force, which is then in `out`.
  bool evaluate(std::size_t p, PairForce<Real>& out) const {
    const BodyPair pair = contacts.pair[p];
    auto i1 = static_cast<std::size_t>(pair.first);
    auto i2 = static_cast<std::size_t>(pair.second);
    std::int32_t bond = contacts.bond.empty() ? -1 : contacts.bond[p];
    if (bond >= 0 && bonds[static_cast<std::size_t>(bond)].broken != 0) bond = -1;
    if (bonded_only && bond < 0 && (contacts.bond.empty() || contacts.bond[p] < 0)) return false;
    bool flat = false;
    if (parts.flats) {
      if (bodies.shape[i2] != Shape::sphere) std::swap(i1, i2);
      if (bodies.shape[i2] != Shape::sphere) return false;  // two flat bodies
      flat = bodies.shape[i1] != Shape::sphere;
    }
    Vec3<Real> normal;
    Real overlap{0};
    Real distance{0};
    if (flat) {
      const ContactGeometry<Real> g = surface.has(i1) ? surface.geometry(i1, i2) : flat_geometry(i1, i2);
      if (!(g.overlap > 0)) return surface.hands_on(p, i1, i2) ? false : lose(p, i1, i2, flat);
      normal = g.normal;
      overlap = g.overlap;
    } else {
      if constexpr (!NativeReal<Real>) {
        if (bond < 0 && coarsely_apart(i1, i2)) return lose(p, i1, i2, flat);
      }
      const Real sum = bodies.radius[i1] + bodies.radius[i2];
      const Vec3<Real> d = bodies.position[i2] - bodies.position[i1];
      const Real length2 = squared_norm(d);
      // Surely apart: spares the root of most candidates.
      if (bond < 0 && length2 * 64 > sum * sum * 65 && in_range(length2)) return lose(p, i1, i2, flat);
      using std::sqrt;
      const bool safe = in_range(length2);
      distance = safe ? Real(sqrt(length2)) : scaling::norm(d);
      overlap = sum - distance;
      if (bond < 0 && !(overlap >= 0)) return lose(p, i1, i2, flat);
      normal = safe ? d / distance : scaling::direction(d);
    }
    out.first = static_cast<std::int32_t>(i1);
    out.second = static_cast<std::int32_t>(i2);
    if (bond >= 0 && !hold(p, static_cast<std::size_t>(bond), i1, i2, overlap, distance, normal, out)) {
      if (!(overlap >= 0)) return lose(p, i1, i2, flat);
      bond = -1;
    }
    if (bond >= 0) return true;
    if (contacts.touching[p] == 0) {
      begin(p, i1, i2, flat, normal);
      surface.take_over(p, i1, i2);
    }
    collide(p, i1, i2, flat, overlap, distance, normal, out);
    return true;
  }

  // Physics of a contact of two bodies.
  [[nodiscard]] ContactPhysics<Real> physics_of(std::size_t i1, std::size_t i2, bool flat) const {
    const auto& m1 = materials[static_cast<std::size_t>(bodies.material[i1])];
    const auto& m2 = materials[static_cast<std::size_t>(bodies.material[i2])];
    const Real& r2 = bodies.radius[i2];
    const Real& r1 = flat ? r2 : bodies.radius[i1];
    switch (law) {
      case scenes::ContactLaw::viscoelastic: {
        const Real& a = bodies.fixed[i1] != 0 ? bodies.mass[i2] : bodies.mass[i1];
        const Real& b = bodies.fixed[i2] != 0 ? bodies.mass[i1] : bodies.mass[i2];
        // Of two materials the mean; the mean of equal values is exact.
        const auto mean = [](const Real& x, const Real& y) { return Real((x + y) / 2); };
        const Collision<Real>& c1 = m1.collision;
        const Collision<Real>& c2 = m2.collision;
        const Collision<Real> c{
            mean(c1.time, c2.time), mean(c1.normal, c2.normal), mean(c1.tangential, c2.tangential),
            c2.friction_angle < c1.friction_angle ? c2.friction_angle : c1.friction_angle};
        return viscoelastic_physics(c, reduced_mass(a, b));
      }
      case scenes::ContactLaw::hertz_mindlin:
        return hertz_mindlin_physics(m1.elastic, r1, m2.elastic, r2);
      case scenes::ContactLaw::frictional:
      case scenes::ContactLaw::cohesive:
        break;
    }
    return frictional_physics(m1.elastic, r1, m2.elastic, r2);
  }

  void begin(std::size_t p, std::size_t i1, std::size_t i2, bool flat, const Vec3<Real>& normal) const {
    contacts.touching[p] = 1;
    const ContactPhysics<Real> physics = physics_of(i1, i2, flat);
    contacts.kn[p] = physics.kn;
    if (parts.shear) {
      contacts.ks[p] = physics.ks;
      contacts.tan_friction[p] = physics.tan_friction;
      contacts.shear[p] = {};
      contacts.normal[p] = normal;
    }
    if (parts.viscosity) {
      contacts.cn[p] = physics.cn;
      contacts.cs[p] = physics.cs;
    }
    if (parts.energy) {
      contacts.elastic[p] = contacts.shear_elastic[p] = Real(0);
      contacts.viscous_before[p] = {};
    }
  }

  // Where two bodies that touch do so, as evaluate() has it.
  [[nodiscard]] ContactGeometry<Real> geometry(std::size_t i1, std::size_t i2, bool flat) const {
    if (flat) return flat_geometry(i1, i2);
    return sphere_sphere(bodies.position[i1], bodies.radius[i1], bodies.position[i2], bodies.radius[i2]);
  }

  // What extends the shear spring; `distance` is that of the centres of two spheres.
  [[nodiscard]] Vec3<Real> relative_velocity(std::size_t i1, std::size_t i2, bool flat, const Real& overlap,
                                             const Real& distance, const Vec3<Real>& normal) const {
    const Vec3<Real>& v1 = bodies.velocity[i1];
    const Vec3<Real>& v2 = bodies.velocity[i2];
    if (flat) {
      if (!parts.rotation) return v2 - v1;
      const Real arm = bodies.radius[i2] - overlap / 2;
      return (v2 - cross(bodies.angular_velocity[i2], arm * normal)) - v1;
    }
    const Real& r1 = bodies.radius[i1];
    const Real& r2 = bodies.radius[i2];
    if (!parts.rotation) return sphere_relative_velocity(distance, r1, r2, v1, v2);
    return sphere_relative_velocity(normal, distance, r1, r2, v1, v2, bodies.angular_velocity[i1],
                                    bodies.angular_velocity[i2]);
  }

  // Of the two surfaces where they meet; what forces work on.
  [[nodiscard]] Vec3<Real> contact_velocity(std::size_t i1, std::size_t i2, bool flat, const Real& overlap,
                                            const Vec3<Real>& normal) const {
    const Vec3<Real> v = bodies.velocity[i2] - bodies.velocity[i1];
    if (!parts.rotation) return v;
    const Real half = overlap / 2;
    const Vec3<Real> w2 = (bodies.radius[i2] - half) * bodies.angular_velocity[i2];
    const Vec3<Real> turn2 = v - cross(w2, normal);
    if (flat) return turn2;
    const Vec3<Real> w1 = (bodies.radius[i1] - half) * bodies.angular_velocity[i1];
    return turn2 - cross(w1, normal);
  }

 private:
  // Whether distances may be taken by their squares.  The broad phase is in double: no other type comes near
  // the ends of its own range.
  [[nodiscard]] static bool in_range([[maybe_unused]] const Real& length2) {
    if constexpr (NativeReal<Real>) return is_safe(length2);
    return true;
  }

  // Apart by more than any rounding to double can feign: decides nothing that Real would decide otherwise,
  // but spares it the arithmetic.
  [[nodiscard]] bool coarsely_apart(std::size_t i1, std::size_t i2) const {
    const CoarseSphere& a = coarse[i1];
    const CoarseSphere& b = coarse[i2];
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double dz = b.z - a.z;
    const double reach = a.reach + b.reach;
    return dx * dx + dy * dy + dz * dz > reach * reach;
  }

  [[nodiscard]] ContactGeometry<Real> flat_geometry(std::size_t i1, std::size_t i2) const {
    return flat_contact(bodies, flats, i1, i2);
  }

  bool lose(std::size_t p, std::size_t i1, std::size_t i2, bool flat) const {
    if (contacts.touching[p] != 0) {
      contacts.touching[p] = 0;
      if (parts.energy) account_end(p, i1, i2, flat);
    }
    return false;
  }

  // What the shear spring still held is lost with the contact, as of one that slides with no force to hold
  // it; and the forces of the step before act for half a step more, as a trapezoid ends.
  void account_end(std::size_t p, std::size_t i1, std::size_t i2, bool flat) const {
    const Vec3<Real> normal = parts.shear ? contacts.normal[p] : Vec3<Real>{};
    const Vec3<Real> v = contact_velocity(i1, i2, flat, Real(0), normal);
    if (parts.shear)
      contacts.friction_loss[p] += contacts.shear_elastic[p] - dt / 2 * dot(contacts.shear[p], v);
    contacts.viscous_loss[p] -= dt / 2 * dot(contacts.viscous_before[p], v);
    contacts.elastic[p] = contacts.shear_elastic[p] = Real(0);
  }

  [[nodiscard]] ContactPhysics<Real> stored_physics(std::size_t p) const {
    ContactPhysics<Real> physics;
    physics.kn = contacts.kn[p];
    if (parts.shear) {
      physics.ks = contacts.ks[p];
      physics.tan_friction = contacts.tan_friction[p];
    }
    if (parts.viscosity) {
      physics.cn = contacts.cn[p];
      physics.cs = contacts.cs[p];
    }
    return physics;
  }

  // Of the centres, along the normal; rotation has no part in it.
  [[nodiscard]] Real closing_speed(std::size_t i1, std::size_t i2, const Vec3<Real>& normal) const {
    return -dot(normal, bodies.velocity[i2] - bodies.velocity[i1]);
  }

  [[nodiscard]] Vec3<Real> carried_shear(std::size_t p, std::size_t i1, std::size_t i2,
                                         const Vec3<Real>& normal) const {
    const Vec3<Real> none;
    const Vec3<Real>& w1 = parts.rotation ? bodies.angular_velocity[i1] : none;
    const Vec3<Real>& w2 = parts.rotation ? bodies.angular_velocity[i2] : none;
    return rotate_shear(contacts.shear[p], contacts.normal[p], normal, w1, w2, dt);
  }

  void set_torques(std::size_t i1, std::size_t i2, bool flat, const Real& overlap, const Vec3<Real>& normal,
                   const Vec3<Real>& tangential_force, PairForce<Real>& out) const {
    const Real half = overlap / 2;
    const Vec3<Real> lever = cross(normal, tangential_force);
    out.torque2 = -((bodies.radius[i2] - half) * lever);
    if (flat) {
      out.torque1 = {};
    } else {
      out.torque1 = -((bodies.radius[i1] - half) * lever);
    }
  }

  void collide(std::size_t p, std::size_t i1, std::size_t i2, bool flat, const Real& overlap,
               const Real& distance, const Vec3<Real>& normal, PairForce<Real>& out) const {
    const ContactPhysics<Real> physics = stored_physics(p);
    if (!parts.shear) {
      Real fn{0};
      if (law == scenes::ContactLaw::viscoelastic) {
        fn = parts.viscosity ? viscoelastic_normal(physics, overlap, closing_speed(i1, i2, normal))
                             : Real(physics.kn * overlap);
      } else if (law == scenes::ContactLaw::hertz_mindlin) {
        using std::sqrt;
        fn = physics.kn * sqrt(overlap) * overlap;
      } else {
        fn = physics.kn * overlap;
      }
      out.force = fn * normal;
      if (parts.rotation) out.torque1 = out.torque2 = {};
      if (parts.energy) {
        account(p, physics, overlap, fn, {}, {}, normal, {}, contact_velocity(i1, i2, flat, overlap, normal));
      }
      return;
    }
    const Vec3<Real> velocity = relative_velocity(i1, i2, flat, overlap, distance, normal);
    const Vec3<Real> shear = carried_shear(p, i1, i2, normal);
    ContactForce<Real> f;
    switch (law) {
      case scenes::ContactLaw::viscoelastic:
        f = viscoelastic(physics, overlap, closing_speed(i1, i2, normal), normal, shear, velocity, dt);
        break;
      case scenes::ContactLaw::hertz_mindlin:
        f = hertz_mindlin(physics, overlap, normal, shear, velocity, dt);
        break;
      case scenes::ContactLaw::frictional:
      case scenes::ContactLaw::cohesive:
        f = cundall_strack(physics, overlap, normal, shear, velocity, dt);
        break;
    }
    contacts.shear[p] = f.shear;
    contacts.normal[p] = normal;
    out.force = total_force(f, normal);
    if (parts.rotation) set_torques(i1, i2, flat, overlap, normal, tangential_force(f), out);
    if (parts.energy) {
      account(p, physics, overlap, f.normal, shear, f, normal, velocity,
              contact_velocity(i1, i2, flat, overlap, normal));
    }
  }

  // Elastic energy now, and what the interval since the last step lost to friction and dashpots: trapezoids,
  // which are what the leapfrog's work is.
  void account(std::size_t p, const ContactPhysics<Real>& physics, const Real& overlap, const Real& fn,
               const Vec3<Real>& shear_before, const ContactForce<Real>& f, const Vec3<Real>& normal,
               const Vec3<Real>& velocity, const Vec3<Real>& true_velocity) const {
    if (law == scenes::ContactLaw::hertz_mindlin) {
      contacts.shear_elastic[p] = shear_energy(mindlin_stiffness(physics.ks, overlap), f.shear);
      contacts.elastic[p] =
          hertz_elastic_energy<Real>(physics.kn, Real(0), overlap, {}) + contacts.shear_elastic[p];
      if (!first_step) contacts.friction_loss[p] += f.dissipation;
      return;
    }
    const Real spring = physics.kn * overlap;
    contacts.shear_elastic[p] = shear_energy(physics.ks, f.shear);
    contacts.elastic[p] = elastic_energy<Real>(physics.kn, Real(0), spring, {}) + contacts.shear_elastic[p];
    const Vec3<Real> dashpot = (fn - spring) * normal + f.viscous;
    if (!first_step) {
      if (f.sliding && physics.ks != 0) {
        const Vec3<Real> trial = shear_before - (physics.ks * dt) * tangential(velocity, normal);
        contacts.friction_loss[p] += dot(trial - f.shear, f.shear + shear_before) / (2 * physics.ks);
      }
      contacts.viscous_loss[p] += -(dt / 2 * dot(dashpot + contacts.viscous_before[p], true_velocity));
    }
    contacts.viscous_before[p] = dashpot;
  }

  // A bond; returns false where it breaks now.
  bool hold(std::size_t p, std::size_t k, std::size_t i1, std::size_t i2, const Real& overlap,
            const Real& distance, const Vec3<Real>& normal, PairForce<Real>& out) const {
    BondState<Real>& bond = bonds[k];
    if (contacts.touching[p] == 0) begin(p, i1, i2, false, normal);
    const ContactPhysics<Real> physics = stored_physics(p);
    ContactForce<Real> f;
    Vec3<Real> shear;
    Vec3<Real> velocity;
    if (parts.shear) {
      velocity = relative_velocity(i1, i2, false, overlap, distance, normal);
      shear = carried_shear(p, i1, i2, normal);
      f = cohesive(physics, bond.strength, overlap, bond.rest_overlap, normal, shear, velocity, dt);
    } else {
      f.normal = bond_normal_force(physics.kn, overlap, bond.rest_overlap);
    }
    if (bond.breakable != 0 && -f.normal > bond.strength.tension) {
      bond.broken = 1;
      contacts.touching[p] = 0;
      if (parts.energy) {
        contacts.broken_loss[p] += contacts.elastic[p];
        contacts.elastic[p] = Real(0);
      }
      return false;
    }
    if (parts.shear) {
      contacts.shear[p] = f.shear;
      contacts.normal[p] = normal;
    }
    out.force = f.normal * normal + f.shear;
    if (parts.rotation) {
      if (parts.shear) {
        set_torques(i1, i2, false, overlap, normal, f.shear, out);
      } else {
        out.torque1 = out.torque2 = {};
      }
    }
    Real turning{0};
    if (parts.moments && bond.bending_stiffness != 0) {
      const Quaternion<Real> start;
      const RelativeRotation<Real> rotation =
          twist_and_bending(start, start, bodies.orientation[i1], bodies.orientation[i2], normal);
      const Vec3<Real> moment = bond_moment(bond.bending_stiffness, bond.bending_stiffness, rotation, normal);
      out.torque1 += moment;
      out.torque2 -= moment;
      turning =
          bond.bending_stiffness * (squared_norm(rotation.bending) + rotation.twist * rotation.twist) / 2;
    }
    if (parts.energy) {
      contacts.elastic[p] = elastic_energy(physics.kn, physics.ks, f.normal, f.shear) + turning;
      if (f.sliding && !first_step && physics.ks != 0) {
        const Vec3<Real> trial = shear - (physics.ks * dt) * tangential(velocity, normal);
        contacts.friction_loss[p] += dot(trial - f.shear, f.shear + shear) / (2 * physics.ks);
      }
    }
    return true;
  }
};

}  // namespace ulpgate::dem
