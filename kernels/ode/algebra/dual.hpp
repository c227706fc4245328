// Dual numbers a + b eps, eps^2 = 0: the derivative of a formula along one direction, exact up to rounding.
//
// R. E. Wengert, Commun. ACM 7 (1964) 463.
#pragma once

#include <cmath>

#include "reference/types/real_types.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct Dual {
  Real value{0};
  Real slope{0};

  Dual() = default;
  explicit Dual(int v) : value(v) {}
  explicit Dual(const Real& v) : value(v) {}
  Dual(const Real& v, const Real& s) : value(v), slope(s) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.slope + a.slope * b.value};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real quotient = a.value / b.value;
    return {quotient, (a.slope - quotient * b.slope) / b.value};
  }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }

  friend Dual operator+(const Real& a, const Dual& b) { return {a + b.value, b.slope}; }
  friend Dual operator+(const Dual& a, const Real& b) { return {a.value + b, a.slope}; }
  friend Dual operator-(const Real& a, const Dual& b) { return {a - b.value, -b.slope}; }
  friend Dual operator-(const Dual& a, const Real& b) { return {a.value - b, a.slope}; }
  friend Dual operator*(const Real& a, const Dual& b) { return {a * b.value, a * b.slope}; }
  friend Dual operator*(const Dual& a, const Real& b) { return {a.value * b, a.slope * b}; }
  friend Dual operator/(const Dual& a, const Real& b) { return {a.value / b, a.slope / b}; }
  friend Dual operator/(const Real& a, const Dual& b) {
    const Real quotient = a / b.value;
    return {quotient, -(quotient * b.slope) / b.value};
  }

  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const Real root = sqrt(a.value);
    return {root, a.slope / (2 * root)};
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    const Real power = exp(a.value);
    return {power, a.slope * power};
  }
  friend Dual sin(const Dual& a) {
    using std::cos, std::sin;
    return {sin(a.value), a.slope * cos(a.value)};
  }
};

}  // namespace ulpgate::ode
