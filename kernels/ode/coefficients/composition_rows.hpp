// The published composition methods: one row of cited coefficients each.
#pragma once

#include <span>
#include <string_view>

namespace ulpgate::ode {

enum class CompositionKind {
  symplectic_euler,     // one kick, one drift, no parameters
  ruth3,                // kicks 7/24, 3/4, -1/24 and drifts 2/3, -2/3, 1 in turn
  kick_first,           // palindrome of kick-drift-kick steps; parameters: weights, outermost to central
  drift_first,          // the same of drift-kick-drift steps
  position_extended_fr  // drift xi, kick (1-2 lambda)/2, drift chi, kick lambda, drift 1-2(chi+xi), and back
};

// Published digits are where the solver starts, not what is used.
struct CompositionRow {
  std::string_view name;
  int order;
  int evaluations_per_step;
  CompositionKind kind;
  std::span<const std::string_view> published;
  std::string_view citation;
};

[[nodiscard]] std::span<const CompositionRow> composition_rows();

// nullptr where no composition has this name.
[[nodiscard]] const CompositionRow* find_composition(std::string_view name);

}  // namespace ulpgate::ode
