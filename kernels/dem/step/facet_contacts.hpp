// FacetContacts: contacts of spheres with facets that are one surface, and how they go from one facet to the
// next.
#pragma once

#include <cstddef>

#include "kernels/dem/step/state.hpp"

namespace ulpgate::dem {

// A sphere that leaves a facet for its neighbour stays in contact with the surface: where both are of one
// material the new contact goes on with the springs of the old one, and nothing of them is lost.  Any thread
// may ask: what is read of another pair, no thread writes in this step.
template <RealType Real>
struct FacetContacts {
  const FacetMesh<Real>* mesh;  // null: every facet acts on its own
  const Bodies<Real>& bodies;
  Contacts<Real>& contacts;

  // Whether body i is a facet of a surface.
  [[nodiscard]] bool has(std::size_t i) const { return mesh != nullptr && bodies.shape[i] == Shape::facet; }

  // Of a facet i1 of a surface and a sphere i2: no overlap where the contact is another facet's.
  [[nodiscard]] ContactGeometry<Real> geometry(std::size_t i1, std::size_t i2) const {
    const std::size_t facet = facet_of(i1);
    const Vec3<Real>& x = bodies.position[i2];
    const Real& r = bodies.radius[i2];
    const FacetContact<Real> c = mesh->contact(facet, x, r);
    if (c.geometry.overlap > 0 && !mesh->counts(facet, c, x, r)) return {};
    return mesh->geometry(facet, c);
  }

  // The pair whose contact facet i1 goes on with in this step; -1 where there is none, or i1 is no facet of a
  // surface.
  [[nodiscard]] std::ptrdiff_t taken_from(std::size_t i1, std::size_t i2) const {
    return has(i1) ? predecessor(facet_of(i1), i2) : -1;
  }

  // Ends the contact of pair p where another facet goes on with it; false where none does.
  bool hands_on(std::size_t p, std::size_t i1, std::size_t i2) const {
    if (contacts.touching[p] == 0 || !has(i1)) return false;
    const Vec3<Real>& x = bodies.position[i2];
    const Real& r = bodies.radius[i2];
    const std::int32_t successor = mesh->successor(facet_of(i1), x, r);
    if (successor < 0) return false;
    const auto next = static_cast<std::size_t>(successor);
    if (!(mesh->contact(next, x, r).geometry.overlap > 0)) return false;
    if (pair_of(next, i2) < 0 || predecessor(next, i2) != static_cast<std::ptrdiff_t>(p)) return false;
    contacts.touching[p] = 0;
    if (!contacts.elastic.empty()) contacts.elastic[p] = Real(0);
    return true;
  }

  // Gives the new contact p the springs of the one that it goes on with, if there is one.
  void take_over(std::size_t p, std::size_t i1, std::size_t i2) const {
    const std::ptrdiff_t from = taken_from(i1, i2);
    if (from < 0) return;
    const auto q = static_cast<std::size_t>(from);
    if (!contacts.shear.empty()) {
      contacts.shear[p] = contacts.shear[q];
      contacts.normal[p] = contacts.normal[q];
    }
    if (!contacts.viscous_before.empty()) contacts.viscous_before[p] = contacts.viscous_before[q];
  }

 private:
  [[nodiscard]] std::size_t facet_of(std::size_t i) const { return static_cast<std::size_t>(bodies.flat[i]); }

  // The pair of a facet and a body among the contacts; -1 where there is none.
  [[nodiscard]] std::ptrdiff_t pair_of(std::size_t facet, std::size_t body) const {
    const std::int32_t i = mesh->body_of(facet);
    const auto j = static_cast<std::int32_t>(body);
    const BodyPair pair{std::min(i, j), std::max(i, j)};
    const auto found = std::lower_bound(contacts.pair.begin(), contacts.pair.end(), pair);
    return found != contacts.pair.end() && *found == pair ? found - contacts.pair.begin() : -1;
  }
  [[nodiscard]] bool touched_before(std::ptrdiff_t p) const {
    return p >= 0 && contacts.touched_before[static_cast<std::size_t>(p)] != 0;
  }
  [[nodiscard]] std::int32_t material_of(std::size_t facet) const {
    return bodies.material[static_cast<std::size_t>(mesh->body_of(facet))];
  }

  // Of a facet that did not touch the sphere before this step: the pair of the lowest one around it that did,
  // and whose successor it is.
  [[nodiscard]] std::ptrdiff_t predecessor(std::size_t facet, std::size_t sphere) const {
    if (touched_before(pair_of(facet, sphere))) return -1;
    for (const std::size_t other : mesh->around(facet)) {
      const std::ptrdiff_t p = pair_of(other, sphere);
      if (!touched_before(p) || material_of(other) != material_of(facet)) continue;
      const std::int32_t next = mesh->successor(other, bodies.position[sphere], bodies.radius[sphere]);
      if (next == static_cast<std::int32_t>(facet)) return p;
    }
    return -1;
  }
};

}  // namespace ulpgate::dem
