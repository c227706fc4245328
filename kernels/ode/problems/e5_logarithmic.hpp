// The problem E5 in variables that change no faster than time itself.
//
// y1 decays as exp(-7.89e-10 t), to below 1e-3400 at t = 1e13, and y4 with it: a method that follows them
// relatively takes tens of thousands of steps for two components that move nothing else any more.  With
// w = log y1, v = y4 / y1 and y3 = y2 - y4, which the equations keep, every component varies as a power of t.
#pragma once

#include <cmath>

#include "kernels/ode/problems/problem.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode {

// State (w, y2, v).
template <RealType Real>
[[nodiscard]] Problem<Real> e5_logarithmic() {
  using std::log;
  const Real a = real<Real>("7.89e-10");
  const Real b = real<Real>("1.1e7");
  const Real c = real<Real>("1.13e9");
  const Real d = real<Real>("1.13e3");
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    using std::exp;
    const T y1 = exp(y[0]);
    const T y3 = y[1] - y[2] * y1;
    const T decay = a + b * y3;  // -w'
    out[0] = -decay;
    out[1] = a * y1 - c * y[1] * y3;
    out[2] = b * y3 - d * y[2] + y[2] * decay;
  };
  return autonomous_problem<Real>({log(real<Real>("1.76e-3")), Real(0), Real(0)}, f);
}

// (y1, y2, y3, y4) of such a state.
template <RealType Real>
[[nodiscard]] std::vector<Real> e5_components(std::span<const Real> y) {
  using std::exp;
  const Real y1 = exp(y[0]);
  const Real y4 = y[2] * y1;
  return {y1, y[1], y[1] - y4, y4};
}

}  // namespace ulpgate::ode
