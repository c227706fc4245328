// State of a simulation: arrays of bodies, contacts and bonds; arrays of parts that are left out stay empty.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/dem/formulas/contact_laws.hpp"
#include "kernels/dem/mesh/facet_mesh.hpp"
#include "kernels/dem/step/broad_phase.hpp"
#include "kernels/dem/step/parts.hpp"

namespace ulpgate::dem {

using scenes::Shape;

template <RealType Real>
struct Bodies {
  std::vector<Shape> shape;
  std::vector<std::uint8_t> fixed;  // 1: moves with its prescribed velocity, whatever the forces
  std::vector<std::int32_t> material;
  std::vector<std::int32_t> flat;  // index into `flats`; only with Parts::flats
  std::vector<Vec3<Real>> position, velocity, force;
  std::vector<Real> radius, mass;
  // Parts::rotation
  std::vector<Vec3<Real>> angular_velocity, torque;
  std::vector<Real> inertia;
  // Parts::orientation
  std::vector<Quaternion<Real>> orientation;
  // bodies that are no spheres to the integrator
  std::vector<std::int32_t> aspherical;                         // their numbers
  std::vector<Vec3<Real>> principal_inertia, angular_momentum;  // of those
  // Parts::energy, forces of the step before
  std::vector<Vec3<Real>> damping_before, damping_torque_before, force_before;

  [[nodiscard]] std::size_t size() const { return shape.size(); }
};

// What a flat body has beyond its position.
template <RealType Real>
struct Flat {
  Facet<Real> facet;             // facet
  Vec3<Real> half_size;          // box
  Quaternion<Real> orientation;  // box
  std::size_t axis = 0;          // wall
};

// A sphere's place in double, for decisions that rounding cannot change; `reach` exceeds the radius by a
// margin far above the rounding of centre and radius.
struct CoarseSphere {
  double x = 0, y = 0, z = 0;
  double reach = 0;
};

// One entry a pair of bodies that may touch, sorted by their numbers.
template <RealType Real>
struct Contacts {
  std::vector<BodyPair> pair;
  std::vector<std::uint8_t> touching;
  std::vector<std::uint8_t> touched_before;  // before this step; Parts::shared_edges
  std::vector<std::int32_t> bond;  // index into `bonds`, -1 where none; only where the scene has bonds
  std::vector<Real> kn;
  std::vector<Real> ks, tan_friction;     // Parts::shear
  std::vector<Real> cn, cs;               // Parts::viscosity
  std::vector<Vec3<Real>> shear, normal;  // Parts::shear
  // Parts::energy: of this step
  std::vector<Real> elastic, friction_loss, viscous_loss, broken_loss;
  std::vector<Real> shear_elastic;         // the part of `elastic` that the shear spring has
  std::vector<Vec3<Real>> viscous_before;  // force on body 2 in the step before

  [[nodiscard]] std::size_t size() const { return pair.size(); }
  // Calls visit on every array of values that a touching pair carries from step to step.
  template <class Visit>
  void each_array(Visit visit) {
    visit(kn);
    visit(ks);
    visit(tan_friction);
    visit(cn);
    visit(cs);
    visit(shear);
    visit(normal);
    visit(elastic);
    visit(shear_elastic);
    visit(viscous_before);
  }
};

template <RealType Real>
struct BondState {
  std::int32_t first = 0, second = 0;
  std::uint8_t broken = 0;
  std::uint8_t breakable = 0;
  Real rest_overlap{0};  // m
  BondStrength<Real> strength;
  Real bending_stiffness{0};  // N m/rad, also of twist
};

// Energies in joule.  State energies belong to the positions of the last step taken, with velocities averaged
// over the two half steps around it; the others have been summed up to it.
template <RealType Real>
struct Energies {
  Real kinetic{0}, rotational{0}, elastic{0}, potential{0};
  Real friction{0}, damping{0}, viscous{0}, broken{0};
  Real work{0};  // done on the bodies by those of prescribed velocity

  // What stays constant: stored + lost - work.
  [[nodiscard]] Real sum() const {
    return (kinetic + rotational + elastic + potential) + (friction + damping + viscous + broken) - work;
  }
};

}  // namespace ulpgate::dem
