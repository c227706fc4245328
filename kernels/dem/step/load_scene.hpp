// Makes the state of a simulation from a scene.
#pragma once

#include "kernels/dem/step/simulation_state.hpp"

namespace ulpgate::dem {

namespace detail {

template <RealType Real>
void load_bodies(SimulationState<Real>& s, const scenes::Assembly<Real>& a) {
  Bodies<Real>& b = s.bodies;
  const Parts& parts = s.parts;
  for (const scenes::Body<Real>& body : a.bodies) {
    b.shape.push_back(body.shape);
    b.fixed.push_back(body.fixed ? 1 : 0);
    b.material.push_back(body.material);
    b.position.push_back(body.position);
    b.velocity.push_back(body.velocity);
    b.radius.push_back(body.radius);
    b.mass.push_back(body.mass);
    if (parts.rotation) {
      b.angular_velocity.push_back(body.angular_velocity);
      b.inertia.push_back(body.inertia.x);
    }
    if (parts.orientation) b.orientation.push_back(body.orientation);
    if (body.aspherical && parts.rotation) {
      b.aspherical.push_back(static_cast<std::int32_t>(b.size() - 1));
      b.principal_inertia.push_back(body.inertia);
      const Vec3<Real> w = rotate(conjugate(body.orientation), body.angular_velocity);
      b.angular_momentum.push_back(rotate(
          body.orientation, Vec3<Real>{body.inertia.x * w.x, body.inertia.y * w.y, body.inertia.z * w.z}));
    }
    if (parts.flats) {
      b.flat.push_back(body.shape == Shape::sphere ? -1 : static_cast<std::int32_t>(s.flats.size()));
      if (body.shape != Shape::sphere) {
        s.flats.push_back(
            {body.facet, body.half_size, body.orientation, static_cast<std::size_t>(body.axis)});
      }
    }
  }
  b.force.resize(b.size());
  if (parts.rotation) b.torque.resize(b.size());
  if (parts.energy) {
    b.force_before.resize(b.size());
    if (parts.damping) {
      b.damping_before.resize(b.size());
      if (parts.rotation) b.damping_torque_before.resize(b.size());
    }
  }
}

// Facets stand first among the flat bodies, in the order of their numbers.
template <RealType Real>
void load_mesh(SimulationState<Real>& s, const MeshTopology& topology) {
  std::vector<std::int32_t> bodies;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    if (s.bodies.shape[i] == Shape::facet) bodies.push_back(static_cast<std::int32_t>(i));
  }
  s.mesh = FacetMesh<Real>(topology, std::move(bodies));
  measure_mesh(s);
}

template <RealType Real>
void load_bonds(SimulationState<Real>& s, const scenes::Assembly<Real>& a) {
  const auto smaller = [](const Real& x, const Real& y) { return y < x ? y : x; };
  for (const scenes::Bond& bond : a.bonds) {
    const auto i = static_cast<std::size_t>(bond.first);
    const auto j = static_cast<std::size_t>(bond.second);
    const scenes::Body<Real>& b1 = a.bodies[i];
    const scenes::Body<Real>& b2 = a.bodies[j];
    const auto& m1 = a.materials[static_cast<std::size_t>(b1.material)];
    const auto& m2 = a.materials[static_cast<std::size_t>(b2.material)];
    BondState<Real> state;
    state.first = bond.first;
    state.second = bond.second;
    // In this order, which the reference trajectory of the pendulum has.
    state.rest_overlap = (-norm(b2.position - b1.position) + b1.radius) + b2.radius;
    state.breakable = m1.breakable || m2.breakable ? 1 : 0;
    const Real r = smaller(b1.radius, b2.radius);
    const Real cohesion = !m1.breakable   ? m2.cohesion
                          : !m2.breakable ? m1.cohesion
                                          : smaller(m1.cohesion, m2.cohesion);
    state.strength.tension = cohesion * (r * r);
    state.strength.adhesion = smaller(m1.adhesion, m2.adhesion) * (r * r);
    if (s.parts.moments && m1.moments && m2.moments) {
      const ContactPhysics<Real> physics = frictional_physics(m1.elastic, b1.radius, m2.elastic, b2.radius);
      state.bending_stiffness = bond_moment_stiffness(b1.radius, b2.radius, physics.ks,
                                                      smaller(m1.moment_stiffness, m2.moment_stiffness));
    }
    s.bonds.push_back(state);
  }
  // The bonds are contacts from the start; the collider adds others.
  resize_contacts(s, s.bonds.size());
  for (std::size_t k = 0; k < s.bonds.size(); ++k) {
    s.contacts.pair[k] = {s.bonds[k].first, s.bonds[k].second};
    s.contacts.bond[k] = static_cast<std::int32_t>(k);
  }
  const ContactPass<Real> pass = contact_pass_of(s, {});
  for (std::size_t k = 0; k < s.bonds.size(); ++k) {
    const auto i = static_cast<std::size_t>(s.bonds[k].first);
    const auto j = static_cast<std::size_t>(s.bonds[k].second);
    const Vec3<Real> d = s.bodies.position[j] - s.bodies.position[i];
    pass.begin(k, i, j, false, direction(d, norm(d)));
  }
}

}  // namespace detail

// `all_parts`: nothing is left out.  Throws what scenes::assemble throws.
template <RealType Real>
[[nodiscard]] SimulationState<Real> load_scene(const scenes::Scene& scene, bool all_parts, bool allow_large) {
  const scenes::Assembly<Real> a = scenes::assemble<Real>(scene, allow_large);
  SimulationState<Real> s;
  const MeshTopology mesh = mesh_topology(scene);
  s.parts = derive_parts(scene, a, mesh, all_parts);
  s.law = scene.law;
  s.bonded_only = scene.between == scenes::ContactsBetween::bonded;
  s.materials = a.materials;
  s.gravity = a.gravity;
  s.damping = a.damping;
  s.dt = a.dt;
  s.sweep = a.sweep;
  if (s.sweep == 0) {
    for (const auto& b : a.bodies) {
      if (b.shape == Shape::sphere && (s.sweep == 0 || b.radius / 2 < s.sweep)) s.sweep = b.radius / 2;
    }
  }
  detail::load_bodies(s, a);
  if (s.parts.shared_edges && scene.shared_edges == scenes::SharedEdges::once) detail::load_mesh(s, mesh);
  detail::load_bonds(s, a);
  return s;
}

}  // namespace ulpgate::dem
