// Errors of an integrator at doubling numbers of steps, against an exact solution.
#pragma once

#include <vector>

#include "kernels/ode/integrators/integrate.hpp"
#include "kernels/ode/problems/problems.hpp"

namespace ulpgate::ode {

// Largest |a_i - b_i|; NaN where there is one.
template <RealType Real>
[[nodiscard]] Real largest_difference(std::span<const Real> a, std::span<const Real> b) {
  using std::abs;
  Real largest(0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Real difference = abs(a[i] - b[i]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

// Largest component of the error at time t after `steps` equal steps.
template <RealType Real>
[[nodiscard]] Real error_at(std::string_view name, const SolvedProblem<Real>& solved, const Real& t,
                            long steps, const StopFlag& stop = {}) {
  return largest_difference<Real>(integrate<Real>(name, solved.problem, t, steps, stop), solved.exact(t));
}

struct Rung {
  long steps;
  double error;
  double order;  // log2 of the ratio to the error at half the steps; 0 on the first rung
};

// From `first` steps, doubled until the error falls below `floor` or the steps exceed `last`.
template <RealType Real>
[[nodiscard]] std::vector<Rung> error_ladder(std::string_view name, const SolvedProblem<Real>& solved,
                                             const Real& t, long first, long last, const Real& floor) {
  using std::log2;
  std::vector<Rung> ladder;
  Real before(0);
  for (long steps = first; steps <= last; steps *= 2) {
    const Real error = error_at(name, solved, t, steps);
    if (!(error >= floor)) break;
    const Real order = before > 0 ? Real(log2(Real(before / error))) : Real(0);
    ladder.push_back({steps, static_cast<double>(error), static_cast<double>(order)});
    before = error;
  }
  return ladder;
}

}  // namespace ulpgate::ode
