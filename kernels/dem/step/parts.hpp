// Parts: what a scene's step consists of, derived from the scene, and why each part left out is not needed.
#pragma once

#include <string>
#include <vector>

#include "kernels/dem/mesh/mesh_topology.hpp"
#include "kernels/scenes/reader/assemble.hpp"

namespace ulpgate::dem {

// Which parts run.  A part may be left out only where it contributes exactly nothing, to the last bit.
struct Parts {
  bool collider = true;
  bool shear = true;        // stored shear force, cone
  bool rotation = true;     // angular velocities and torques
  bool orientation = true;  // quaternions
  bool viscosity = true;
  bool gravity = true;
  bool damping = true;
  bool flats = true;         // facets, boxes, walls
  bool shared_edges = true;  // facets with corners in common act as one surface
  bool moments = true;       // twist and bending of bonds
  bool third_axis = true;    // z
  bool energy = true;        // energy account

  struct LeftOut {
    std::string part;
    std::string why;
  };
  std::vector<LeftOut> left_out;

  // Bonds alone make the forces: the step needs no list of contacts.
  [[nodiscard]] bool bonds_alone() const {
    return !collider && !shear && !rotation && !flats && !orientation;
  }
};

// `mesh`: of the scene.  `all`: everything is switched on, nothing is left out.
template <RealType Real>
[[nodiscard]] Parts derive_parts(const scenes::Scene& scene, const scenes::Assembly<Real>& a,
                                 const MeshTopology& mesh, bool all) {
  Parts p;
  if (all) return p;
  const auto leave = [&](bool& part, const char* name, std::string why) {
    part = false;
    p.left_out.push_back({name, std::move(why)});
  };
  bool slips_never = true;  // no tangential force
  bool damps_never = true;  // no dashpot
  bool moments = false;
  for (const auto& m : a.materials) {
    const bool adheres = scene.law == scenes::ContactLaw::cohesive && m.adhesion != 0;
    const bool stiff = scene.law == scenes::ContactLaw::viscoelastic ||
                       scene.law == scenes::ContactLaw::hertz_mindlin || m.elastic.poisson != 0;
    if (stiff && (m.elastic.friction_angle != 0 || adheres)) slips_never = false;
    if (m.collision.normal != 1 || m.collision.tangential != 1) damps_never = false;
    if (m.moments && m.elastic.poisson != 0) moments = true;
  }
  if (scene.law != scenes::ContactLaw::cohesive) moments = false;
  int movable = 0;
  bool flats = false;
  bool spins = false;
  bool flat_z = true;
  for (const auto& b : a.bodies) {
    if (!b.fixed) ++movable;
    if (b.shape != scenes::Shape::sphere) flats = true;
    if (b.aspherical || !(b.angular_velocity == Vec3<Real>{})) spins = true;
    if (b.position.z != 0 || b.velocity.z != 0) flat_z = false;
  }
  if (scene.between == scenes::ContactsBetween::bonded) {
    leave(p.collider, "collider", "only bonded bodies touch, so no new contact can appear");
  } else if (a.bodies.size() < 2 || movable == 0) {
    leave(p.collider, "collider", "no two bodies can meet");
  }
  if (slips_never) {
    leave(p.shear, "shear",
          "no pair of materials has friction, adhesion and a shear stiffness: no tangential force");
  }
  if (!moments) leave(p.moments, "moments", "no bond resists twist or bending");
  if (slips_never && !moments && !spins) {
    leave(p.rotation, "rotation", "no torque can act and nothing spins at the start");
  }
  if (!moments && !spins && !scene.records("orientation")) {
    leave(p.orientation, "orientation", "no force depends on it and it is not recorded");
  }
  if (scene.law != scenes::ContactLaw::viscoelastic) {
    leave(p.viscosity, "viscosity", "the contact law has no dashpot");
  } else if (damps_never) {
    leave(p.viscosity, "viscosity", "every restitution is 1");
  }
  if (a.gravity == Vec3<Real>{}) leave(p.gravity, "gravity", "it is 0");
  if (a.damping == 0) leave(p.damping, "damping", "it is 0");
  if (!flats) leave(p.flats, "flats", "there are no facets, boxes or walls");
  if (mesh.corners.empty()) {
    p.shared_edges = false;
    if (flats) leave(p.shared_edges, "shared edges", "no two facets have a corner in common");
  } else if (scene.shared_edges == scenes::SharedEdges::each) {
    leave(p.shared_edges, "shared edges", "contacts.shared_edges is 'each': every facet acts on its own");
  }
  if (!scene.records("energy")) leave(p.energy, "energy", "it is not recorded");
  if (flat_z && a.gravity.z == 0 && p.bonds_alone()) {
    leave(p.third_axis, "third axis", "every body lies and moves in the plane z = 0");
  }
  return p;
}

}  // namespace ulpgate::dem
