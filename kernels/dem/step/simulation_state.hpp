// SimulationState<Real>: everything that a step reads and writes, and its visit by an archive.
#pragma once

#include "kernels/dem/step/archive.hpp"
#include "kernels/dem/step/contact_pass.hpp"
#include "kernels/dem/step/state.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct SimulationState {
  Parts parts;
  scenes::ContactLaw law = scenes::ContactLaw::frictional;
  bool bonded_only = false;
  std::vector<scenes::MaterialValues<Real>> materials;
  Vec3<Real> gravity;
  Real damping{0};
  Real dt{0};
  Real sweep{0};
  Bodies<Real> bodies;
  std::vector<Flat<Real>> flats;
  FacetMesh<Real> mesh;  // Parts::shared_edges
  std::vector<BondState<Real>> bonds;
  Contacts<Real> contacts;
  Energies<Real> energies;
  std::uint64_t iteration = 0;
};

template <RealType Real>
[[nodiscard]] ContactPass<Real> contact_pass_of(SimulationState<Real>& s,
                                                const std::vector<CoarseSphere>& coarse) {
  return {s.parts,     s.law,   s.bonded_only,
          s.materials, s.dt,    s.iteration == 0,
          s.bodies,    s.flats, s.contacts,
          s.bonds,     coarse,  {s.mesh.empty() ? nullptr : &s.mesh, s.bodies, s.contacts}};
}

// Takes the facets' corners as they are now.
template <RealType Real>
void measure_mesh(SimulationState<Real>& s) {
  s.mesh.measure([&](std::size_t k) { return s.flats[k].facet; });
}

template <RealType Real>
void clear_losses(Contacts<Real>& c) {
  std::fill(c.friction_loss.begin(), c.friction_loss.end(), Real(0));
  std::fill(c.viscous_loss.begin(), c.viscous_loss.end(), Real(0));
  std::fill(c.broken_loss.begin(), c.broken_loss.end(), Real(0));
}

// Gives the arrays of contacts that the parts need `count` entries.
template <RealType Real>
void resize_contacts(SimulationState<Real>& s, std::size_t count) {
  Contacts<Real>& c = s.contacts;
  const Parts& parts = s.parts;
  c.pair.resize(count);
  c.touching.resize(count);
  if (!s.bonds.empty()) c.bond.resize(count, -1);
  c.kn.resize(count);
  if (parts.shear) {
    c.ks.resize(count);
    c.tan_friction.resize(count);
    c.shear.resize(count);
    c.normal.resize(count);
  }
  if (parts.viscosity) {
    c.cn.resize(count);
    c.cs.resize(count);
  }
  if (parts.energy) {
    c.elastic.resize(count, Real(0));
    c.shear_elastic.resize(count, Real(0));
    c.friction_loss.resize(count, Real(0));
    c.viscous_loss.resize(count, Real(0));
    c.broken_loss.resize(count, Real(0));
    c.viscous_before.resize(count);
  }
}

// One list of every field of the state, for saving and for restoring.  Only touching contacts and bonds are
// state: the other candidates follow from the positions.
template <RealType Real, class Archive>
void visit_state(Archive& a, SimulationState<Real>& s) {
  a.field("iteration", s.iteration);
  a.constant("dt", s.dt);
  a.constant("gravity", s.gravity);
  a.constant("lambda", s.damping);
  for (auto& m : s.materials) {
    a.constant("elastic.young", m.elastic.young);
    a.constant("elastic.poisson", m.elastic.poisson);
    a.constant("elastic.friction_angle", m.elastic.friction_angle);
    a.constant("elastic.stiffness", m.elastic.stiffness);
    a.constant("collision.time", m.collision.time);
    a.constant("collision.normal", m.collision.normal);
    a.constant("collision.tangential", m.collision.tangential);
    a.constant("collision.friction_angle", m.collision.friction_angle);
  }
  Bodies<Real>& b = s.bodies;
  a.constant("radius", b.radius);
  a.constant("mass", b.mass);
  a.constant("inertia", b.inertia);
  a.constant("principal_inertia", b.principal_inertia);
  for (auto& f : s.flats) {
    a.constant("facet.a", f.facet.a);
    a.constant("facet.b", f.facet.b);
    a.constant("facet.c", f.facet.c);
    a.constant("half_size", f.half_size);
    a.constant("flat_orientation", f.orientation);
  }
  a.field("position", b.position);
  a.field("velocity", b.velocity);
  a.field("angular_velocity", b.angular_velocity);
  a.field("orientation", b.orientation);
  a.field("angular_momentum", b.angular_momentum);
  a.field("damping_before", b.damping_before);
  a.field("damping_torque_before", b.damping_torque_before);
  a.field("force_before", b.force_before);
  for (auto& bond : s.bonds) {
    a.field("broken", bond.broken);
    a.constant("rest_overlap", bond.rest_overlap);
    a.constant("tension", bond.strength.tension);
    a.constant("adhesion", bond.strength.adhesion);
    a.constant("bending_stiffness", bond.bending_stiffness);
  }
  Energies<Real>& e = s.energies;
  for (Real* x : {&e.kinetic, &e.rotational, &e.elastic, &e.potential, &e.friction, &e.damping, &e.viscous,
                  &e.broken, &e.work}) {
    a.field("energy", *x);
  }
  Contacts<Real>& c = s.contacts;
  std::vector<std::size_t> kept;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.touching[p] != 0 || (!c.bond.empty() && c.bond[p] >= 0)) kept.push_back(p);
  }
  std::size_t count = kept.size();
  a.field("contacts", count);
  if constexpr (Archive::reading) {
    resize_contacts(s, count);
    kept.resize(count);
    for (std::size_t p = 0; p < count; ++p) {
      kept[p] = p;
    }
  }
  for (const std::size_t p : kept) {
    a.field("pair", c.pair[p].first);
    a.field("with", c.pair[p].second);
    a.field("touching", c.touching[p]);
    if (!c.bond.empty()) a.field("bond", c.bond[p]);
    a.constant("kn", c.kn[p]);
    if (s.parts.shear) {
      a.constant("ks", c.ks[p]);
      a.constant("tan_friction", c.tan_friction[p]);
      a.field("shear", c.shear[p]);
      a.field("normal", c.normal[p]);
    }
    if (s.parts.viscosity) {
      a.constant("cn", c.cn[p]);
      a.constant("cs", c.cs[p]);
    }
    if (s.parts.energy) {
      a.field("elastic", c.elastic[p]);
      a.field("shear_elastic", c.shear_elastic[p]);
      a.field("viscous_before", c.viscous_before[p]);
    }
  }
  if constexpr (Archive::reading) {
    const auto bodies = b.size();
    const bool sized = b.position.size() == bodies && b.velocity.size() == bodies &&
                       b.radius.size() == bodies && b.mass.size() == bodies &&
                       (!s.parts.rotation || b.angular_velocity.size() == bodies) &&
                       (!s.parts.orientation || b.orientation.size() == bodies) &&
                       b.angular_momentum.size() == b.aspherical.size();
    if (!sized) throw ArchiveError("the state has another number of bodies than the scene");
    for (const BodyPair& pair : c.pair) {
      const auto n = static_cast<std::int32_t>(bodies);
      if (pair.first < 0 || pair.second <= pair.first || pair.second >= n)
        throw ArchiveError("a pair names no bodies");
    }
  }
}

// Bytes of the numbers in the arrays.
template <RealType Real>
[[nodiscard]] std::size_t memory_of(const SimulationState<Real>& s) {
  const auto bytes = [](const auto&... arrays) {
    return (std::size_t{0} + ... + (arrays.size() * sizeof(arrays[0])));
  };
  const Bodies<Real>& b = s.bodies;
  const Contacts<Real>& c = s.contacts;
  return bytes(b.shape, b.fixed, b.material, b.flat, b.position, b.velocity, b.force, b.radius, b.mass,
               b.angular_velocity, b.torque, b.inertia, b.orientation, b.aspherical, b.principal_inertia,
               b.angular_momentum, b.damping_before, b.damping_torque_before, b.force_before) +
         bytes(c.pair, c.touching, c.bond, c.kn, c.ks, c.tan_friction, c.cn, c.cs, c.shear, c.normal,
               c.elastic, c.shear_elastic, c.friction_loss, c.viscous_loss, c.broken_loss, c.viscous_before) +
         bytes(s.flats, s.bonds, s.materials, c.touched_before) + s.mesh.memory();
}

}  // namespace ulpgate::dem
