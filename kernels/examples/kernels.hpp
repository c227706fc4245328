// Kernels as other projects have them: templates of a number type.
#pragma once

#include <array>
#include <cmath>

template <class Real>
Real length(Real x, Real y) {
  using std::sqrt;
  return sqrt(x * x + y * y);
}

template <class Real>
Real versine(Real x) {
  using std::cos;
  return Real(1) - cos(x);
}

// What a rounded sum of two numbers lost, exactly (Knuth's TwoSum: The Art of Computer Programming 2, 4.2.2).
template <class Real>
Real lost_of_sum(Real a, Real b) {
  const Real sum = a + b;
  const Real part = sum - a;
  return (a - (sum - part)) + (b - part);
}

// As good as a sum in twice the precision, rounded once.
template <class Real>
Real compensated_sum(Real a, Real b, Real c) {
  const Real sum = a + b;
  const Real all = sum + c;
  return all + (lost_of_sum(a, b) + lost_of_sum(sum, c));
}

template <class Real>
std::array<Real, 2> rotated(Real x, Real y, Real angle) {
  using std::cos;
  using std::sin;
  const Real c = cos(angle);
  const Real s = sin(angle);
  return {c * x - s * y, s * x + c * y};
}
