// LocalPolynomial: a function over a narrow interval, to well below an ULP, from a few precise values and
// arithmetic in the type itself.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "reference/types/real_types.hpp"

namespace ulpgate {

// A value as the unevaluated sum of two numbers of the type.
template <RealType Real>
struct TwoPart {
  Real high{};
  Real low{};
};

// f = f(middle) + delta: the constant is kept in two parts, and delta, which is small against it, is the
// polynomial through a few values; its rounding errors are as much smaller than an ULP of f as delta is
// smaller than f.  Nodes are those of Chebyshev on [-1, 1], Newton's divided differences give the polynomial
// (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 5.3); further values check it.
template <RealType Real>
class LocalPolynomial {
 public:
  static constexpr std::size_t nodes = 7;
  static constexpr std::size_t checks = 2;

  // The interval [low, high]; returns the arguments at which the function is wanted, the middle first.
  std::span<const Real> choose(const Real& low, const Real& high) {
    half_ = (high - low) / Real(2);
    const Real middle = low + half_;
    // cos(k pi / 7) outwards and inwards in turn, where divided differences are stable; then the checks.
    // Where the nodes lie exactly does not matter.
    constexpr std::array<double, nodes + checks> t = {0, 0.97, -0.97, 0.78, -0.78, 0.43, -0.43, 0.61, -0.89};
    for (std::size_t i = 0; i < t.size(); ++i) {
      x_[i] = middle + half_ * Real(t[i]);
      t_[i] = (x_[i] - middle) / half_;
    }
    return x_;
  }

  // Takes the values at those arguments.  False where the polynomial misses a check by more than `tolerance`.
  [[nodiscard]] bool fit(std::span<const TwoPart<Real>> values, const Real& tolerance) {
    constant_ = values[0];
    std::array<Real, nodes + checks> delta;
    for (std::size_t i = 0; i < delta.size(); ++i)
      delta[i] = (values[i].high - constant_.high) + (values[i].low - constant_.low);
    std::array<Real, nodes> c;
    for (std::size_t i = 0; i < nodes; ++i) c[i] = delta[i];
    for (std::size_t level = 1; level < nodes; ++level) {
      for (std::size_t i = nodes - 1; i >= level; --i) c[i] = (c[i] - c[i - 1]) / (t_[i] - t_[i - level]);
    }
    // From Newton's form to powers of t; the constant is 0, since the middle is a node.
    coefficients_.fill(Real(0));
    for (std::size_t i = nodes; i-- > 0;) {
      for (std::size_t k = nodes - 1; k > 0; --k)
        coefficients_[k] = coefficients_[k - 1] - t_[i] * coefficients_[k];
      coefficients_[0] = c[i] - t_[i] * coefficients_[0];
    }
    using std::abs;
    for (std::size_t i = nodes; i < nodes + checks; ++i) {
      if (!(abs(Real(difference(x_[i], values[i].high) - values[i].low)) <= tolerance)) return false;
    }
    return true;
  }

  // f(x) - got, for a `got` within a factor of two of it.
  [[nodiscard]] Real difference(const Real& x, const Real& got) const {
    const Real t = (x - x_[0]) / half_;
    Real delta = coefficients_[nodes - 1];
    for (std::size_t k = nodes - 1; k-- > 0;) delta = delta * t + coefficients_[k];
    // The first difference is exact.
    return (delta + constant_.low) - (got - constant_.high);
  }

 private:
  Real half_{};
  TwoPart<Real> constant_;
  std::array<Real, nodes + checks> x_{};
  std::array<Real, nodes + checks> t_{};
  std::array<Real, nodes> coefficients_{};
};

}  // namespace ulpgate
