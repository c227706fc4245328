// Bounding boxes of bodies, enlarged by a sweep length.
#pragma once

#include "kernels/dem/formulas/flat_geometry.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct Bounds {
  Vec3<Real> low, high;  // m
};

// centre -+ (r + sweep).
template <RealType Real>
[[nodiscard]] Bounds<Real> sphere_bounds(const Vec3<Real>& centre, const Real& r, const Real& sweep) {
  const Real reach = r + sweep;
  const Vec3<Real> half{reach, reach, reach};
  return {centre - half, centre + half};
}

template <RealType Real>
[[nodiscard]] Bounds<Real> facet_bounds(const Facet<Real>& t, const Real& sweep) {
  Bounds<Real> box;
  for (std::size_t i = 0; i < 3; ++i) {
    Real low = t.a[i];
    Real high = t.a[i];
    for (const Vec3<Real>* p : {&t.b, &t.c}) {
      if ((*p)[i] < low) low = (*p)[i];
      if ((*p)[i] > high) high = (*p)[i];
    }
    box.low[i] = low - sweep;
    box.high[i] = high + sweep;
  }
  return box;
}

// Half sizes of the axis-aligned box about an oriented one: |R| h.
template <RealType Real>
[[nodiscard]] Bounds<Real> box_bounds(const Vec3<Real>& centre, const Vec3<Real>& h,
                                      const Quaternion<Real>& q, const Real& sweep) {
  using std::abs;
  const Vec3<Real> ex = rotate(q, Vec3<Real>{h.x, Real(0), Real(0)});
  const Vec3<Real> ey = rotate(q, Vec3<Real>{Real(0), h.y, Real(0)});
  const Vec3<Real> ez = rotate(q, Vec3<Real>{Real(0), Real(0), h.z});
  Vec3<Real> half;
  for (std::size_t i = 0; i < 3; ++i) half[i] = ((abs(ex[i]) + abs(ey[i])) + abs(ez[i])) + sweep;
  return {centre - half, centre + half};
}

}  // namespace ulpgate::dem
