// Body<Real>: one body of a start, as the generators and the reader of numbers make it.
#pragma once

#include "kernels/dem/formulas/flat_geometry.hpp"
#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::scenes {

enum class Shape : std::uint8_t { sphere, facet, box, wall };

template <RealType Real>
struct Body {
  Shape shape = Shape::sphere;
  bool fixed = true;
  int material = 0;
  dem::Vec3<Real> position;  // of a facet its centroid, of a wall a point on it
  dem::Vec3<Real> velocity;  // of a fixed body prescribed
  dem::Vec3<Real> angular_velocity;
  Real radius{0};
  Real mass{0};
  dem::Vec3<Real> inertia;  // principal moments
  bool aspherical = false;
  dem::Quaternion<Real> orientation;
  dem::Facet<Real> facet;     // facets: vertices
  dem::Vec3<Real> half_size;  // boxes
  int axis = 0;               // walls
};

}  // namespace ulpgate::scenes
