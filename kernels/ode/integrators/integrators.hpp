// The list of integrators: name, kind, order, cost and source of each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ulpgate::ode {

enum class IntegratorKind {
  splitting,      // explicit, symplectic, for q'' = a(q)
  collocation,    // implicit, symplectic
  runge_kutta,    // explicit
  extrapolation,  // explicit, of the midpoint rule
};

[[nodiscard]] std::string_view to_string(IntegratorKind kind);

struct IntegratorInfo {
  std::string name;
  IntegratorKind kind;
  std::optional<int> order;                 // empty where the method chooses it
  std::optional<int> evaluations_per_step;  // of a or f, from the second step on; empty where it iterates
  std::string citation;
};

[[nodiscard]] std::span<const IntegratorInfo> integrators();

// Throws std::invalid_argument, with the known names, for any other.
[[nodiscard]] const IntegratorInfo& find_integrator(std::string_view name);

// Stages of "gauss1" ... "gauss10".
inline constexpr int kMostGaussStages = 10;

}  // namespace ulpgate::ode
