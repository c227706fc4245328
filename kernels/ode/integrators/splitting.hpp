// Composition methods as sequences of kicks and drifts, in the full precision of Real.
#pragma once

#include <map>
#include <mutex>
#include <stdexcept>

#include "kernels/ode/coefficients/composition_solver.hpp"
#include "reference/types/guard_digits.hpp"

namespace ulpgate::ode {

// q += fraction h v (drift) or v += fraction h a(q) (kick).
template <RealType Real>
struct Substep {
  int flow;  // kDrift or kKick
  Real fraction;
};

// Kicks and drifts of one step from the parameters of a row.  Halves of neighbouring symmetric steps are
// joined.
template <RealType Real>
[[nodiscard]] std::vector<Substep<Real>> substeps(CompositionKind kind, const std::vector<Real>& parameters) {
  if (kind == CompositionKind::symplectic_euler) return {{kKick, Real(1)}, {kDrift, Real(1)}};
  if (kind == CompositionKind::ruth3) {
    return {{kKick, Real(7) / 24},  {kDrift, Real(2) / 3},    {kKick, Real(3) / 4},
            {kDrift, -Real(2) / 3}, {kKick, -(Real(1) / 24)}, {kDrift, Real(1)}};
  }
  std::vector<Substep<Real>> sequence;
  const std::vector<Factor<Real>> factors = condition_factors(kind, parameters);
  if (kind == CompositionKind::position_extended_fr) {
    for (const Factor<Real>& f : factors) sequence.push_back({f.letter, f.weight});
    return sequence;
  }
  const int outer = kind == CompositionKind::kick_first ? kKick : kDrift;
  const int inner = outer == kKick ? kDrift : kKick;
  Real before(0);
  for (const Factor<Real>& f : factors) {
    sequence.push_back({outer, (before + f.weight) / 2});
    sequence.push_back({inner, f.weight});
    before = f.weight;
  }
  sequence.push_back({outer, before / 2});
  return sequence;
}

// The kicks and drifts of a method, solved with guard digits, rounded once and kept.  Throws
// std::invalid_argument for an unknown name.
template <RealType Real>
[[nodiscard]] const std::vector<Substep<Real>>& splitting(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, std::vector<Substep<Real>>, std::less<>> solved;
  const std::scoped_lock lock(mutex);
  if (const auto found = solved.find(name); found != solved.end()) return found->second;
  const CompositionRow* row = find_composition(name);
  if (row == nullptr) throw std::invalid_argument("no composition method '" + std::string(name) + "'");
  using Wide = Guarded<Real>;
  const std::vector<Wide> parameters = composition_parameters<Wide>(*row);
  std::vector<Substep<Real>> sequence;
  for (const Substep<Wide>& s : substeps(row->kind, parameters)) {
    sequence.push_back({s.flow, rounded<Real>(s.fraction)});
  }
  return solved.emplace(std::string(name), std::move(sequence)).first->second;
}

}  // namespace ulpgate::ode
