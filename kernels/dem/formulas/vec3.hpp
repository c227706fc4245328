// Vec3 and Quaternion of any Real, with the order of every sum spelled out.
//
// Eigen's fixed-size reductions choose their own order of summation; a trajectory that must repeat to the
// last bit in every type and on any number of threads states it here: sums run left to right.
#pragma once

#include <cmath>
#include <cstddef>

#include "reference/types/real_types.hpp"

namespace ulpgate::dem {

template <RealType Real>
struct Vec3 {
  Real x{0}, y{0}, z{0};

  [[nodiscard]] Real& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  [[nodiscard]] const Real& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Real& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Vec3 operator*(const Vec3& a, const Real& s) { return s * a; }
  // Three true divisions: a product with the reciprocal would round twice.
  friend Vec3 operator/(const Vec3& a, const Real& s) { return {a.x / s, a.y / s, a.z / s}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

template <RealType Real>
[[nodiscard]] Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <RealType Real>
[[nodiscard]] Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <RealType Real>
[[nodiscard]] Real squared_norm(const Vec3<Real>& a) {
  return dot(a, a);
}

template <RealType Real>
[[nodiscard]] Real norm(const Vec3<Real>& a) {
  using std::sqrt;
  return sqrt(squared_norm(a));
}

// w + xi + yj + zk; unit quaternions are orientations.
template <RealType Real>
struct Quaternion {
  Real w{1}, x{0}, y{0}, z{0};

  friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {
        ((a.w * b.w - a.x * b.x) - a.y * b.y) - a.z * b.z, ((a.w * b.x + a.x * b.w) + a.y * b.z) - a.z * b.y,
        ((a.w * b.y + a.y * b.w) + a.z * b.x) - a.x * b.z, ((a.w * b.z + a.z * b.w) + a.x * b.y) - a.y * b.x};
  }
  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

template <RealType Real>
[[nodiscard]] Quaternion<Real> conjugate(const Quaternion<Real>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

template <RealType Real>
[[nodiscard]] Quaternion<Real> normalized(const Quaternion<Real>& q) {
  using std::sqrt;
  const Real length = sqrt(((q.w * q.w + q.x * q.x) + q.y * q.y) + q.z * q.z);
  return {q.w / length, q.x / length, q.y / length, q.z / length};
}

// Rotates v by the unit quaternion q: v + w t + u x t with u = (x, y, z), t = 2 u x v.
template <RealType Real>
[[nodiscard]] Vec3<Real> rotate(const Quaternion<Real>& q, const Vec3<Real>& v) {
  const Vec3<Real> u{q.x, q.y, q.z};
  const Vec3<Real> half = cross(u, v);
  const Vec3<Real> t = half + half;
  return (v + q.w * t) + cross(u, t);
}

// The rotation by `angle` (rad) about the unit vector `axis`.
template <RealType Real>
[[nodiscard]] Quaternion<Real> from_angle_axis(const Real& angle, const Vec3<Real>& axis) {
  using std::cos;
  using std::sin;
  const Real half = angle / 2;
  const Real s = sin(half);
  return {cos(half), s * axis.x, s * axis.y, s * axis.z};
}

// The rotation vector angle * axis (rad) of a unit quaternion, angle in [0, pi]; q and -q are one rotation.
template <RealType Real>
[[nodiscard]] Vec3<Real> rotation_vector(const Quaternion<Real>& q) {
  using std::atan2;
  const bool flip = q.w < 0;
  const Vec3<Real> u = flip ? Vec3<Real>{-q.x, -q.y, -q.z} : Vec3<Real>{q.x, q.y, q.z};
  const Real length = norm(u);
  if (length == 0) return {};
  const Real angle = 2 * atan2(length, flip ? Real(-q.w) : q.w);
  return angle * (u / length);
}

}  // namespace ulpgate::dem
