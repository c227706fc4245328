// The list of integrators: name, kind, order, cost and source of each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ulpgate::ode {

enum class IntegratorKind {
  splitting,           // explicit, symplectic, for q'' = a(q)
  collocation,         // implicit, symplectic, its stages by fixed-point iteration
  collocation_newton,  // implicit, its stages by Newton's iteration: for stiff problems
  rosenbrock,          // linearly implicit, for autonomous problems with their Jacobian
  runge_kutta,         // explicit
  extrapolation,       // explicit, of the midpoint rule
};

[[nodiscard]] std::string_view to_string(IntegratorKind kind);

struct IntegratorInfo {
  std::string name;
  IntegratorKind kind;
  std::optional<int> order;                 // empty where the method chooses it
  std::optional<int> evaluations_per_step;  // of a or f, from the second step on; empty where it iterates
  std::string citation;
  int stages = 0;  // of a collocation
};

[[nodiscard]] std::span<const IntegratorInfo> integrators();

// Throws std::invalid_argument, with the known names, for any other.
[[nodiscard]] const IntegratorInfo& find_integrator(std::string_view name);

// Stages of "gauss1" ... "gauss10".
inline constexpr int kMostGaussStages = 10;

// Whether a method can take steps that are long beside the fastest motion of a stiff problem.
[[nodiscard]] constexpr bool is_for_stiff(IntegratorKind kind) {
  return kind == IntegratorKind::collocation_newton || kind == IntegratorKind::rosenbrock;
}

}  // namespace ulpgate::ode
