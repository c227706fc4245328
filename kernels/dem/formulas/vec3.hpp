// Vec3 and Quaternion of any Real, with the order of every sum spelled out.
//
// Eigen's fixed-size reductions choose their own order of summation; a trajectory that must repeat to the
// last bit in every type and on any number of threads states it here: sums run left to right.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/dem/formulas/safe_range.hpp"

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
[[nodiscard]] inline Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <RealType Real>
[[nodiscard]] inline Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <RealType Real>
[[nodiscard]] inline Real squared_norm(const Vec3<Real>& a) {
  return dot(a, a);
}

template <RealType Real>
[[nodiscard]] bool is_zero(const Vec3<Real>& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

// Whether `squares` is the squared_norm of `a` to the last digits: the roots of it are then those of |a|.
template <RealType Real>
[[nodiscard]] bool squares_hold(const Vec3<Real>& a, const Real& squares) {
  return is_safe(squares) || is_zero(a);
}

// vector * 2^exponent; the largest component of `vector` is in [1/2, 1).
template <RealType Real>
struct ScaledVec3 {
  Vec3<Real> vector;
  int exponent = 0;

  [[nodiscard]] Vec3<Real> value() const {
    using std::ldexp;
    return {ldexp(vector.x, exponent), ldexp(vector.y, exponent), ldexp(vector.z, exponent)};
  }
};

// The exponent is 0 where the largest component is 0 or no number.
template <RealType Real>
[[nodiscard]] ScaledVec3<Real> scaled(const Vec3<Real>& a) {
  using std::abs, std::frexp;
  Real largest = abs(a.x);
  for (const Real& c : {a.y, a.z}) {
    if (abs(c) > largest) largest = abs(c);
  }
  if (!(largest > 0) || largest > largest_number<Real>()) return {a, 0};
  int exponent = 0;
  (void)frexp(largest, &exponent);
  return {ScaledVec3<Real>{a, -exponent}.value(), exponent};
}

// norm(), direction() and half_square() of any vector; out of line, so that those of ordinary ones stay
// small.
namespace scaling {

template <RealType Real>
[[nodiscard, gnu::noinline]] Real norm(const Vec3<Real>& a) {
  using std::ldexp, std::sqrt;
  const ScaledVec3<Real> s = scaled(a);
  return ldexp(Real(sqrt(squared_norm(s.vector))), s.exponent);
}

template <RealType Real>
[[nodiscard, gnu::noinline]] Vec3<Real> direction(const Vec3<Real>& a) {
  using std::sqrt;
  const Vec3<Real> s = scaled(a).vector;
  return s / Real(sqrt(squared_norm(s)));
}

template <RealType Real>
[[nodiscard, gnu::noinline]] Real half_square(const Real& factor, const Vec3<Real>& a) {
  using std::ldexp;
  const ScaledVec3<Real> s = scaled(a);
  return ldexp(Real(factor * squared_norm(s.vector) / 2), 2 * s.exponent);
}

}  // namespace scaling

// |a|, whose squared_norm is `squares`.
template <RealType Real>
[[nodiscard]] inline Real norm(const Vec3<Real>& a, const Real& squares) {
  using std::sqrt;
  return squares_hold(a, squares) ? Real(sqrt(squares)) : scaling::norm(a);
}
template <RealType Real>
[[nodiscard]] inline Real norm(const Vec3<Real>& a) {
  return norm(a, squared_norm(a));
}

// a/|a| of a vector of length `length`; of 0 it is NaN.
template <RealType Real>
[[nodiscard]] inline Vec3<Real> direction(const Vec3<Real>& a, const Real& length) {
  // Below the normal range a length has few digits, and it may be infinite where the vector is not.
  return length >= least_normal<Real>() && length <= largest_number<Real>() ? a / length
                                                                            : scaling::direction(a);
}

// factor |a|^2/2.
template <RealType Real>
[[nodiscard]] Real half_square(const Real& factor, const Vec3<Real>& a) {
  const Real squares = squared_norm(a);
  return squares_hold(a, squares) ? Real(factor * squares / 2) : scaling::half_square(factor, a);
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
  return angle * direction(u, length);
}

}  // namespace ulpgate::dem
