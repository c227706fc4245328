// What the bodies of a start must be to one another, in the type of the run: facets with an area, no two
// centres in one place, bonds of a length.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/scenes/reader/body.hpp"
#include "kernels/scenes/reader/memory_estimate.hpp"

namespace ulpgate::scenes {

template <RealType Real>
[[nodiscard]] bool is_finite(const dem::Vec3<Real>& v) {
  return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// Whether the triangle's normal has a direction: twice its area is more than the rounding of the square of
// its longest edge, and its square is a number, as the fourth powers of lengths in the step must be.
template <RealType Real>
[[nodiscard]] bool has_area(const dem::Facet<Real>& t) {
  using std::sqrt;
  const Real area2 = sqrt(dem::squared_norm(dem::cross(t.b - t.a, t.c - t.a)));
  Real longest{0};
  for (const dem::Vec3<Real>& edge : {t.b - t.a, t.c - t.b, t.a - t.c}) {
    const Real length2 = dem::squared_norm(edge);
    if (!(length2 <= longest)) longest = length2;
  }
  return area2 > 0 && is_finite(area2) && is_finite(longest) && 1 + area2 / (8 * longest) > 1;
}

// Throws a SceneFault that names two spheres whose centres are one point and of which one can move.
template <RealType Real>
void refuse_coincident(const std::vector<Body<Real>>& bodies) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].shape == Shape::sphere) order.push_back(i);
  }
  const auto less = [&](std::size_t i, std::size_t j) {
    const dem::Vec3<Real>& a = bodies[i].position;
    const dem::Vec3<Real>& b = bodies[j].position;
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    if (a.z != b.z) return a.z < b.z;
    // Those that move first: any two neighbours of one place then show whether one of them does.
    if (bodies[i].fixed != bodies[j].fixed) return bodies[j].fixed;
    return i < j;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Body<Real>& a = bodies[order[k - 1]];
    const Body<Real>& b = bodies[order[k]];
    if (a.position == b.position && !(a.fixed && b.fixed))
      throw SceneFault(
          "bodies " + std::to_string(std::min(order[k - 1], order[k])) + " and " +
          std::to_string(std::max(order[k - 1], order[k])) +
          ": their centres are the same point, so that no direction leads from one to the other");
  }
}

// Throws a SceneFault that names a bond whose length is 0 or no number by the operations of the step, which
// spares itself a look at whether squares are in range: a sixth of a step of rods.
template <RealType Real>
void refuse_bonds_of_no_length(const std::vector<Body<Real>>& bodies, const std::vector<Bond>& bonds) {
  for (const Bond& bond : bonds) {
    const Real length2 = dem::squared_norm(bodies[static_cast<std::size_t>(bond.second)].position -
                                           bodies[static_cast<std::size_t>(bond.first)].position);
    if (!(length2 > 0) || !is_finite(length2))
      throw SceneFault("the bond of bodies " + std::to_string(bond.first) + " and " +
                       std::to_string(bond.second) + ": its length must be positive and finite");
  }
}

// Pairs of spheres nearer than `reach` times the sum of their radii, not both fixed.  Throws SceneTooLarge
// where there are more than `most`.
template <RealType Real>
void bond_near(const std::vector<Body<Real>>& bodies, const Real& reach, bool allow_large,
               std::vector<Bond>& bonds) {
  std::vector<int> order;
  Real largest{0};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].shape != Shape::sphere) continue;
    order.push_back(static_cast<int>(i));
    if (bodies[i].radius > largest) largest = bodies[i].radius;
  }
  const auto at = [&](int i) -> const Body<Real>& { return bodies[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return at(i).position.x != at(j).position.x ? at(i).position.x < at(j).position.x : i < j;
  });
  const Real farthest = reach * (largest + largest);
  if (!is_finite(Real(farthest * farthest)))
    throw SceneFault("contacts.bond_reach: the square of the reach is beyond the type of the run");
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Body<Real>& a = at(order[k]);
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const Body<Real>& b = at(order[l]);
      // Rounding is monotonic: from here on no pair passes the test below.
      if (b.position.x - a.position.x > farthest) break;
      if (a.fixed && b.fixed) continue;
      const Real far = reach * (a.radius + b.radius);
      if (!(dem::squared_norm(b.position - a.position) < far * far)) continue;
      bonds.push_back({std::min(order[k], order[l]), std::max(order[k], order[l])});
      if (bonds.size() > pairs_allowed<Real>(allow_large))
        refuse_large("contacts.bond_reach: bonds", bonds.size(), most_pairs, bytes_of_pair<Real>,
                     allow_large);
    }
  }
}

}  // namespace ulpgate::scenes
