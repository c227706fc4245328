// Collocation methods: Runge-Kutta tableaux made of their nodes.
//
// J. C. Butcher, Math. Comp. 18 (1964) 50 (Gauss) and 233 (Radau); E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II (1996), IV.5 (Radau IIA); E. Hairer, C. Lubich, G. Wanner, Geometric Numerical
// Integration (2006), II.1.3.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/types/guard_digits.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct CollocationTableau {
  std::vector<Real> c;               // nodes in (0, 1]
  std::vector<Real> b;               // weights
  std::vector<std::vector<Real>> a;  // a[i][j]: weight of stage j in stage i
};

namespace detail {

// P_s(x) and P_s'(x) for |x| < 1 by the three-term recurrence.
template <RealType Real>
[[nodiscard]] std::pair<Real, Real> legendre(int s, const Real& x) {
  Real before(1);
  Real value = x;
  for (int k = 2; k <= s; ++k) {
    const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, Real(s * (before - x * value) / (1 - x * x))};
}

template <RealType Real>
[[nodiscard]] Real legendre_root(int s, int i) {
  using std::abs, std::acos, std::cos, std::ldexp;
  // Within a few percent of the root: M. Abramowitz, I. A. Stegun (1964), 22.16.6.
  const Real pi = acos(Real(-1));
  Real x = cos(pi * (4 * i + 3) / (4 * s + 2));
  const Real settled = ldexp(Real(1), -std::numeric_limits<Real>::digits + 8);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const auto [value, slope] = legendre(s, x);
    const Real step = value / slope;
    x -= step;
    if (abs(step) < settled) return x;
  }
  throw std::logic_error("the nodes of Gauss-Legendre quadrature were not found");
}

// a_ij, the integral of the Lagrange polynomial l_j of the nodes from 0 to c_i, which the Gauss rule of as
// many points gives exactly: l_j has degree s - 1.
template <RealType Real>
[[nodiscard]] std::vector<std::vector<Real>> integrals_of_lagrange(const std::vector<Real>& nodes,
                                                                   const std::vector<Real>& rule_nodes,
                                                                   const std::vector<Real>& rule_weights) {
  const std::size_t s = nodes.size();
  std::vector<std::vector<Real>> a(s, std::vector<Real>(s, Real(0)));
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t k = 0; k < s; ++k) {
      const Real at = nodes[i] * rule_nodes[k];
      for (std::size_t j = 0; j < s; ++j) {
        Real lagrange(1);
        for (std::size_t m = 0; m < s; ++m) {
          if (m != j) lagrange *= (at - nodes[m]) / (nodes[j] - nodes[m]);
        }
        a[i][j] += nodes[i] * rule_weights[k] * lagrange;
      }
    }
  }
  return a;
}

// The roots of (P_{s-1} - P_s) / (1 - x), which lie in (-1, 1), increasing.
//
// Newton's iteration for a polynomial whose roots are all real rises monotonically from below the least of
// them to it; each root that is found is divided out (H. J. Maehly, Z. Angew. Math. Phys. 5 (1954) 260).
template <RealType Real>
[[nodiscard]] std::vector<Real> radau_roots(int s) {
  using std::abs, std::ldexp;
  std::vector<Real> roots;
  const Real settled = ldexp(Real(1), -std::numeric_limits<Real>::digits + 8);
  while (static_cast<int>(roots.size()) < s - 1) {
    // The least root is near -1 + 2.9/s^2 (Abramowitz, Stegun 22.16.6).
    Real x = roots.empty() ? Real(-1 + Real(1) / (4 * s * s)) : Real(roots.back() + ldexp(Real(1), -20));
    bool found = false;
    for (int iteration = 0; iteration < 400 && !found; ++iteration) {
      const auto [p, p_slope] = legendre(s, x);
      Real q(1);
      Real q_slope(0);
      if (s > 2) {
        const auto pair = legendre(s - 1, x);
        q = pair.first;
        q_slope = pair.second;
      } else {
        q = x;
        q_slope = Real(1);
      }
      const Real value = q - p;
      if (value == 0) break;
      Real logarithmic = (q_slope - p_slope) / value + 1 / (1 - x);
      for (const Real& r : roots) logarithmic -= 1 / (x - r);
      const Real step = 1 / logarithmic;
      x -= step;
      found = abs(step) < settled;
    }
    if (!(x > -1 && x < 1)) throw std::logic_error("the nodes of Radau quadrature were not found");
    roots.push_back(x);
  }
  return roots;
}

}  // namespace detail

// The tableau in Real itself; its last digits carry the rounding of the recurrences.
template <RealType Real>
[[nodiscard]] CollocationTableau<Real> compute_gauss_tableau(int stages) {
  const auto s = static_cast<std::size_t>(stages);
  CollocationTableau<Real> t{std::vector<Real>(s), std::vector<Real>(s), {}};
  for (std::size_t i = 0; i < s; ++i) {
    const Real x = -detail::legendre_root<Real>(stages, static_cast<int>(i));
    const Real slope = detail::legendre(stages, x).second;
    t.c[i] = (1 + x) / 2;
    t.b[i] = 1 / ((1 - x * x) * slope * slope);
  }
  t.a = detail::integrals_of_lagrange(t.c, t.c, t.b);
  return t;
}

// The tableau of Radau IIA, of 2 stages and more: c_s = 1, the last row of a is b.
template <RealType Real>
[[nodiscard]] CollocationTableau<Real> compute_radau_tableau(int stages) {
  const CollocationTableau<Real> gauss = compute_gauss_tableau<Real>(stages);
  CollocationTableau<Real> t;
  for (const Real& x : detail::radau_roots<Real>(stages)) t.c.push_back((1 + x) / 2);
  t.c.push_back(Real(1));
  t.a = detail::integrals_of_lagrange(t.c, gauss.c, gauss.b);
  t.b = t.a.back();
  return t;
}

namespace detail {

// A tableau computed with guard digits, rounded once.
template <RealType Real>
[[nodiscard]] CollocationTableau<Real> rounded_tableau(const CollocationTableau<Guarded<Real>>& wide) {
  CollocationTableau<Real> t;
  for (const auto& x : wide.c) t.c.push_back(rounded<Real>(x));
  for (const auto& x : wide.b) t.b.push_back(rounded<Real>(x));
  for (const auto& row : wide.a) {
    t.a.emplace_back();
    for (const auto& x : row) t.a.back().push_back(rounded<Real>(x));
  }
  return t;
}

}  // namespace detail

enum class CollocationNodes { gauss, radau };

// The tableau computed with guard digits, rounded once and kept.
template <RealType Real>
[[nodiscard]] const CollocationTableau<Real>& collocation_tableau(CollocationNodes nodes, int stages) {
  static std::mutex mutex;
  static std::map<std::pair<CollocationNodes, int>, CollocationTableau<Real>> known;
  const std::scoped_lock lock(mutex);
  const std::pair key{nodes, stages};
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const auto wide = nodes == CollocationNodes::gauss ? compute_gauss_tableau<Guarded<Real>>(stages)
                                                     : compute_radau_tableau<Guarded<Real>>(stages);
  return known.emplace(key, detail::rounded_tableau<Real>(wide)).first->second;
}
template <RealType Real>
[[nodiscard]] const CollocationTableau<Real>& gauss_tableau(int stages) {
  return collocation_tableau<Real>(CollocationNodes::gauss, stages);
}
template <RealType Real>
[[nodiscard]] const CollocationTableau<Real>& radau_tableau(int stages) {
  return collocation_tableau<Real>(CollocationNodes::radau, stages);
}

}  // namespace ulpgate::ode
