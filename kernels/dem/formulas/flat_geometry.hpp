// Geometry of a sphere against flat bodies: facet (triangle), wall (axis-aligned plane) and oriented box.
//
// In all of them body 1 is the flat body and body 2 the sphere: the normal points from the nearest point to
// the centre.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/dem/formulas/sphere_geometry.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct Facet {
  Vec3<Real> a, b, c;  // vertices, m
};

// Where on a facet a point lies, as the corners it is between: bits 1, 2, 4 for a, b, c.  One corner, the two
// of an edge, or all three of the face.
using FacetCorners = std::uint8_t;
inline constexpr FacetCorners whole_face = 7;

template <RealType Real>
struct FacetPoint {
  Vec3<Real> place;  // m
  FacetCorners corners = 0;
};

// The point of a triangle nearest to p, by the Voronoi regions of vertices, edges and face.
// C. Ericson, Real-Time Collision Detection (2005), section 5.1.5.
template <RealType Real>
[[nodiscard]] FacetPoint<Real> nearest_facet_point(const Facet<Real>& t, const Vec3<Real>& p) {
  const Vec3<Real> ab = t.b - t.a;
  const Vec3<Real> ac = t.c - t.a;
  const Vec3<Real> ap = p - t.a;
  const Real d1 = dot(ab, ap);
  const Real d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {t.a, 1};
  const Vec3<Real> bp = p - t.b;
  const Real d3 = dot(ab, bp);
  const Real d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {t.b, 2};
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {t.a + (d1 / (d1 - d3)) * ab, 3};
  const Vec3<Real> cp = p - t.c;
  const Real d5 = dot(ab, cp);
  const Real d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {t.c, 4};
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {t.a + (d2 / (d2 - d6)) * ac, 5};
  const Real va = d3 * d6 - d5 * d4;
  const Real along_bc = d4 - d3;
  const Real against_bc = d5 - d6;
  if (va <= 0 && along_bc >= 0 && against_bc >= 0) {
    return {t.b + (along_bc / (along_bc + against_bc)) * (t.c - t.b), 6};
  }
  // The face: subtract the part of ap along the unit normal, which keeps the distance well conditioned.
  const Vec3<Real> across = cross(ab, ac);
  const Vec3<Real> n = direction(across, norm(across));
  return {p - dot(n, ap) * n, whole_face};
}

template <RealType Real>
[[nodiscard]] Vec3<Real> nearest_on_facet(const Facet<Real>& t, const Vec3<Real>& p) {
  return nearest_facet_point(t, p).place;
}

// From the nearest point of the flat body; `away` is the normal to take where the centre lies on that point.
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> from_nearest(const Vec3<Real>& nearest, const Vec3<Real>& x,
                                                 const Real& r, const Vec3<Real>& away) {
  const Vec3<Real> d = x - nearest;
  const Real distance = norm(d);
  const Vec3<Real> normal = distance == 0 ? away : direction(d, distance);
  const Real overlap = r - distance;
  return {overlap, normal, x - (r - overlap / 2) * normal};
}

// A contact of a facet, and where on the facet it is.
template <RealType Real>
struct FacetContact {
  ContactGeometry<Real> geometry;
  FacetPoint<Real> nearest;
  // Twice the areas of the triangles that the foot of the centre makes with the edges ab, bc and ca, m^2;
  // behind a negative one, which tells that the foot lies outside, they are 0.
  std::array<Real, 3> areas{};
};

// The unit normal of a triangle whose corners run to the left seen from its tip.
template <RealType Real>
[[nodiscard]] Vec3<Real> facet_normal(const Facet<Real>& t) {
  const Vec3<Real> across = cross(t.b - t.a, t.c - t.a);
  return direction(across, norm(across));
}

// A face contact takes the triangle's own normal n (on the sphere's side), so it does not tilt by rounding.
template <RealType Real>
[[nodiscard]] FacetContact<Real> facet_contact(const Facet<Real>& t, const Vec3<Real>& n, const Vec3<Real>& x,
                                               const Real& r) {
  using std::abs;
  FacetContact<Real> c;
  const Real height = dot(n, x - t.a);
  const Vec3<Real> foot = x - height * n;
  // Whether the foot is left of an edge seen from the normal.
  const auto left_of = [&](std::size_t k, const Vec3<Real>& from, const Vec3<Real>& to) {
    c.areas[k] = dot(cross(to - from, foot - from), n);
    return c.areas[k] >= 0;
  };
  if (left_of(0, t.a, t.b) && left_of(1, t.b, t.c) && left_of(2, t.c, t.a)) {
    const Vec3<Real> normal = height < 0 ? -n : n;
    const Real overlap = r - abs(height);
    c.geometry = {overlap, normal, x - (r - overlap / 2) * normal};
    c.nearest = {foot, whole_face};
  } else {
    c.nearest = nearest_facet_point(t, x);
    c.geometry = from_nearest(c.nearest.place, x, r, n);
  }
  return c;
}

// The exponent of two of the longest component of a triangle's edges.
template <RealType Real>
[[nodiscard]] int size_exponent(const Facet<Real>& t) {
  using std::abs;
  Vec3<Real> longest;
  for (const Vec3<Real>& edge : {t.b - t.a, t.c - t.b, t.a - t.c}) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (abs(edge[i]) > longest[i]) longest[i] = abs(edge[i]);
    }
  }
  return scaled(longest).exponent;
}

// In units of 2^exponent m.
template <RealType Real>
[[nodiscard]] Real in_unit(int exponent, const Real& length) {
  using std::ldexp;
  return ldexp(length, -exponent);
}
template <RealType Real>
[[nodiscard]] Vec3<Real> in_unit(int exponent, const Vec3<Real>& v) {
  return ScaledVec3<Real>{v, -exponent}.value();
}
template <RealType Real>
[[nodiscard]] Facet<Real> in_unit(int exponent, const Facet<Real>& t) {
  return {in_unit(exponent, t.a), in_unit(exponent, t.b), in_unit(exponent, t.c)};
}
// Back from them.
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> in_metres(int exponent, const ContactGeometry<Real>& g) {
  return {in_unit(-exponent, g.overlap), g.normal, in_unit(-exponent, g.point)};
}

template <RealType Real>
[[nodiscard]] ContactGeometry<Real> facet_sphere(const Facet<Real>& t, const Vec3<Real>& x, const Real& r);

// facet_sphere() in units of 2^exponent m.
template <RealType Real>
[[nodiscard, gnu::noinline]] ContactGeometry<Real> facet_sphere_in_unit(int exponent, const Facet<Real>& t,
                                                                        const Vec3<Real>& x, const Real& r) {
  const ContactGeometry<Real> g =
      facet_sphere<Real>(in_unit(exponent, t), in_unit(exponent, x), in_unit(exponent, r));
  return in_metres(exponent, g);
}

template <RealType Real>
[[nodiscard]] ContactGeometry<Real> facet_sphere(const Facet<Real>& t, const Vec3<Real>& x, const Real& r) {
  const Vec3<Real> across = cross(t.b - t.a, t.c - t.a);
  const Real squares = squared_norm(across);
  // A fourth power of lengths: beyond its range the facet is looked at in a unit of its own size.
  if (!is_safe(squares)) {
    if (const int e = size_exponent(t); e != 0) return facet_sphere_in_unit(e, t, x, r);
  }
  return facet_contact(t, direction(across, norm(across, squares)), x, r).geometry;
}

// The infinite plane {coordinate `axis` = position}; the normal points to the sphere's side.
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> wall_sphere(std::size_t axis, const Real& position, const Vec3<Real>& x,
                                                const Real& r) {
  using std::abs;
  const Real height = x[axis] - position;
  Vec3<Real> normal;
  normal[axis] = height < 0 ? Real(-1) : Real(1);
  const Real overlap = r - abs(height);
  return {overlap, normal, x - (r - overlap / 2) * normal};
}

// A box of centre c, half sizes h (m) and orientation q.  A centre inside the box leaves through the nearest
// face.
template <RealType Real>
[[nodiscard]] ContactGeometry<Real> box_sphere(const Vec3<Real>& c, const Vec3<Real>& h,
                                               const Quaternion<Real>& q, const Vec3<Real>& x,
                                               const Real& r) {
  using std::abs;
  const Vec3<Real> local = rotate(conjugate(q), x - c);
  Vec3<Real> nearest = local;
  bool inside = true;
  std::size_t face = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (local[i] > h[i]) nearest[i] = h[i];
    if (local[i] < -h[i]) nearest[i] = -h[i];
    inside = inside && abs(local[i]) <= h[i];
    if (h[i] - abs(local[i]) < h[face] - abs(local[face])) face = i;
  }
  if (!inside) {
    const Vec3<Real> d = local - nearest;
    const Real distance = norm(d);
    const Vec3<Real> normal = rotate(q, direction(d, distance));
    const Real overlap = r - distance;
    return {overlap, normal, x - (r - overlap / 2) * normal};
  }
  Vec3<Real> n;
  n[face] = local[face] < 0 ? Real(-1) : Real(1);
  const Vec3<Real> normal = rotate(q, n);
  const Real overlap = r + (h[face] - abs(local[face]));
  return {overlap, normal, x - (r - overlap / 2) * normal};
}

// Velocity of body 2 relative to body 1 (m/s) where both surfaces meet, arms c = contact point - centre.
template <RealType Real>
[[nodiscard]] Vec3<Real> point_relative_velocity(const Vec3<Real>& arm1, const Vec3<Real>& arm2,
                                                 const Vec3<Real>& v1, const Vec3<Real>& v2,
                                                 const Vec3<Real>& w1, const Vec3<Real>& w2) {
  return (v2 + cross(w2, arm2)) - (v1 + cross(w1, arm1));
}

}  // namespace ulpgate::dem
