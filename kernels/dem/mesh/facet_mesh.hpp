// FacetMesh<Real>: facets with corners in common as one surface, which a sphere touches once in each point.
//
// A contact counts where the nearest point of its facet is nearest to the centre among all points of the
// surface around it, a local minimum of the distance.  Which these are does not depend on how the surface is
// cut: on a plane it is one point; over a convex edge one point, of the edge; in a concave one a point of
// each face.  A facet's nearest point is one within its face.  On an edge or a corner it is one if it is also
// the nearest point of every facet that shares this edge or corner; then it counts for the lowest number.
//
// Rounding.  Near a seam two facets may both claim the centre, or neither.  A nearest point closer to an edge
// or corner than `blur`, some 32 roundings of the coordinates and of the tilt of a normal, counts as lying
// there; of facets that meet there in one such point a face goes before an edge, an edge before a corner and
// then the lower number: a total order.  So a seam whose facets are tilted against each other by no more than
// rounding is flat.
//
// Every decision is a function of the positions alone, the same in whatever thread asks.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kernels/dem/formulas/flat_geometry.hpp"
#include "kernels/dem/mesh/mesh_topology.hpp"

namespace ulpgate::dem {

template <RealType Real>
class FacetMesh {
 public:
  FacetMesh() = default;
  // `bodies`: the number of each facet's body, ascending.  measure() must follow.
  FacetMesh(const MeshTopology& topology, std::vector<std::int32_t> bodies)
      : corners_(topology.corners), bodies_(std::move(bodies)) {
    find_repeated();
    list_by_corner();
  }

  // Takes the facets (m) as they are now; `facet_of(k)` is facet k.
  template <class FacetOf>
  void measure(FacetOf facet_of) {
    facets_.clear();
    for (std::size_t k = 0; k < corners_.size(); ++k) facets_.push_back(measured(facet_of(k)));
  }

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] std::int32_t body_of(std::size_t facet) const { return bodies_[facet]; }
  [[nodiscard]] std::size_t memory() const {
    return facets_.capacity() * sizeof(Measured) + corners_.capacity() * sizeof(corners_[0]) +
           (start_.capacity() + facets_at_.capacity() + bodies_.capacity()) * sizeof(std::int32_t) +
           repeated_.capacity();
  }

  // Of a facet with a sphere of centre x and radius r (m), in the unit of the facet.
  [[nodiscard]] FacetContact<Real> contact(std::size_t facet, const Vec3<Real>& x, const Real& r) const {
    const Measured& m = facets_[facet];
    if (m.exponent == 0) return facet_contact(m.facet, m.normal, x, r);
    return facet_contact(m.facet, m.normal, in_unit(m.exponent, x), in_unit(m.exponent, r));
  }
  // In metres: what facet_sphere() gives.
  [[nodiscard]] ContactGeometry<Real> geometry(std::size_t facet, const FacetContact<Real>& c) const {
    const int exponent = facets_[facet].exponent;
    return exponent == 0 ? c.geometry : in_metres(exponent, c.geometry);
  }
  // Whether the contact `c` of a facet with this sphere counts.
  [[nodiscard]] bool counts(std::size_t facet, const FacetContact<Real>& c, const Vec3<Real>& x,
                            const Real& r) const {
    return nearer(facet, c, x, r) < 0;
  }
  // Of a facet that does not count, the one that does in its place; -1 where it counts itself.
  [[nodiscard]] std::int32_t successor(std::size_t facet, const Vec3<Real>& x, const Real& r) const {
    std::int32_t found = -1;
    // Each is nearer than the one before, but for rounding.
    for (int i = 0; i < longest_way; ++i) {
      const std::int32_t next = nearer(facet, contact(facet, x, r), x, r);
      if (next < 0) return found;
      found = next;
      facet = static_cast<std::size_t>(next);
    }
    return -1;
  }
  // Facets that share a corner with this one, ascending.
  [[nodiscard]] std::vector<std::size_t> around(std::size_t facet) const {
    std::vector<std::size_t> list;
    for (const std::int32_t corner : corners_[facet]) {
      for (const std::int32_t other : at(corner)) list.push_back(static_cast<std::size_t>(other));
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    std::erase(list, facet);
    return list;
  }

 private:
  using Corners = std::array<std::int32_t, 3>;
  static constexpr int longest_way = 16;  // facets that a sphere may cross in a step and keep its spring

  // In a unit of 2^exponent m, of its own size where squares of areas in metres would leave the type.
  struct Measured {
    int exponent = 0;
    Facet<Real> facet;
    Vec3<Real> normal;
    std::array<Real, 3> edge;  // lengths of ab, bc, ca
    Real blur{0};
    Real blur_of_radius{0};  // more of it for each unit of a sphere's radius
  };

  [[nodiscard]] static Measured measured(const Facet<Real>& given) {
    using std::abs;
    const bool safe = is_safe(squared_norm(cross(given.b - given.a, given.c - given.a)));
    const int exponent = safe ? 0 : size_exponent(given);
    const Facet<Real> t = exponent == 0 ? given : in_unit(exponent, given);
    Measured m{exponent, t,      facet_normal(t), {norm(t.b - t.a), norm(t.c - t.b), norm(t.a - t.c)},
               Real(0),  Real(0)};
    Real size{0};
    for (const Vec3<Real>& corner : {t.a, t.b, t.c}) {
      for (std::size_t i = 0; i < 3; ++i) size = std::max<Real>(size, abs(corner[i]));
    }
    const Real longest = std::max<Real>(m.edge[0], std::max<Real>(m.edge[1], m.edge[2]));
    size = std::max<Real>(size, longest);
    const Real altitude = norm(cross(t.b - t.a, t.c - t.a)) / longest;
    m.blur = 16 * std::numeric_limits<Real>::epsilon() * size;
    m.blur_of_radius = m.blur / altitude;
    return m;
  }

  // Facets of which one has the corners of another: only the lowest number is there.
  void find_repeated() {
    std::vector<std::pair<Corners, std::size_t>> sorted;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      sorted.emplace_back(corners_[k], k);
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    repeated_.assign(corners_.size(), 0);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first == sorted[i - 1].first) repeated_[sorted[i].second] = 1;
    }
  }

  void list_by_corner() {
    std::size_t points = 0;
    for (const Corners& corners : corners_) {
      for (const std::int32_t corner : corners)
        points = std::max(points, static_cast<std::size_t>(corner) + 1);
    }
    start_.assign(points + 1, 0);
    const auto each = [&](auto visit) {
      for (std::size_t k = 0; k < corners_.size(); ++k) {
        if (repeated_[k] != 0) continue;
        for (const std::int32_t corner : corners_[k]) visit(static_cast<std::size_t>(corner), k);
      }
    };
    each([&](std::size_t corner, std::size_t) { ++start_[corner + 1]; });
    for (std::size_t i = 0; i < points; ++i) start_[i + 1] += start_[i];
    facets_at_.resize(static_cast<std::size_t>(start_.back()));
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    each([&](std::size_t corner, std::size_t k) {
      facets_at_[static_cast<std::size_t>(next[corner]++)] = static_cast<std::int32_t>(k);
    });
  }

  // Facets with this corner, ascending.
  [[nodiscard]] std::span<const std::int32_t> at(std::int32_t corner) const {
    const auto i = static_cast<std::size_t>(corner);
    return {facets_at_.data() + start_[i], facets_at_.data() + start_[i + 1]};
  }

  // Which corners of facet k the other one has as well.
  [[nodiscard]] FacetCorners shared(std::size_t k, std::size_t other) const {
    FacetCorners found = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const auto& theirs = corners_[other];
      if (std::find(theirs.begin(), theirs.end(), corners_[k][i]) != theirs.end())
        found = static_cast<FacetCorners>(found | 1U << i);
    }
    return found;
  }

  // The corners between which the nearest point of a contact lies: of an edge or of a corner where it is
  // within the blur of it.
  [[nodiscard]] FacetCorners corners_of(std::size_t k, const FacetContact<Real>& c, const Real& r) const {
    const Measured& m = facets_[k];
    const Facet<Real>& t = m.facet;
    const Real reach = m.exponent == 0 ? r : in_unit(m.exponent, r);
    const Real blur = m.blur + reach * m.blur_of_radius;
    const Vec3<Real>& q = c.nearest.place;
    FacetCorners corners = c.nearest.corners;
    if (corners == whole_face) {
      std::array<Real, 3> areas = c.areas;
      if (areas[0] < 0 || areas[1] < 0 || areas[2] < 0) {
        // The face by one rounding, outside by another.
        areas = {norm(cross(t.b - t.a, q - t.a)), norm(cross(t.c - t.b, q - t.b)),
                 norm(cross(t.a - t.c, q - t.c))};
      }
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < 3; ++i) {
        if (areas[i] * m.edge[nearest] < areas[nearest] * m.edge[i]) nearest = i;
      }
      if (!(areas[nearest] <= blur * m.edge[nearest])) return whole_face;
      constexpr FacetCorners ends[] = {3, 6, 5};
      corners = ends[nearest];
    }
    const Vec3<Real>* const places[] = {&t.a, &t.b, &t.c};
    for (unsigned i = 0; i < 3; ++i) {
      const auto end = static_cast<FacetCorners>(1U << i);
      if ((corners & end) != 0 && norm(q - *places[i]) <= blur) return end;
    }
    return corners;
  }

  // A facet that has the nearest point of facet k as well, and another point that is nearer, or goes before k
  // at the same point; -1 where there is none.
  [[nodiscard]] std::int32_t nearer(std::size_t k, const FacetContact<Real>& c, const Vec3<Real>& x,
                                    const Real& r) const {
    if (repeated_[k] != 0) return first_of_same(k);
    const FacetCorners place = corners_of(k, c, r);
    if (place == whole_face) return -1;
    const std::int32_t corner = corners_[k][static_cast<std::size_t>(std::countr_zero(place))];
    for (const std::int32_t number : at(corner)) {
      const auto other = static_cast<std::size_t>(number);
      if (other == k || (place & ~shared(k, other)) != 0) continue;
      const FacetContact<Real> theirs = contact(other, x, r);
      const bool elsewhere = (corners_of(other, theirs, r) & ~shared(other, k)) != 0;
      if (elsewhere || goes_before(other, theirs, k, c)) return number;
    }
    return -1;
  }

  [[nodiscard]] static bool goes_before(std::size_t one, const FacetContact<Real>& of_one, std::size_t two,
                                        const FacetContact<Real>& of_two) {
    const int corners_of_one = std::popcount(of_one.nearest.corners);
    const int corners_of_two = std::popcount(of_two.nearest.corners);
    return corners_of_one != corners_of_two ? corners_of_one > corners_of_two : one < two;
  }

  [[nodiscard]] std::int32_t first_of_same(std::size_t k) const {
    for (const std::int32_t other : at(corners_[k][0])) {
      if (shared(k, static_cast<std::size_t>(other)) == whole_face) return other;
    }
    return -1;
  }

  std::vector<Corners> corners_;
  std::vector<std::int32_t> bodies_;
  std::vector<Measured> facets_;
  std::vector<std::uint8_t> repeated_;
  std::vector<std::int32_t> start_, facets_at_;  // facets by corner
};

}  // namespace ulpgate::dem
