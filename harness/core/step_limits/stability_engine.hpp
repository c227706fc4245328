// StabilityEngine: one step of a real integrator on the linear test problems, behind an interface that knows
// no number type.
#pragma once

#include <string>
#include <string_view>

namespace ulpgate {

// What one step does to a linear problem.  Numbers are computed in the type and only then rounded to double,
// so that an excess of one unit of rounding is seen in every type.
struct StepFactor {
  // Of a symplectic step |trace|/2 - 1 of the step matrix: it is stable where this is not positive.  Of any
  // other the spectral radius - 1.
  double excess = 0;
  double growth = 0;       // spectral radius - 1
  double half_trace = 0;   // of the step matrix; of the real axis the factor itself
  double determinant = 1;  // of the step matrix
  double norm = 0;         // its largest entry in magnitude
  std::string refusal;     // the error's text where the integrator refused the step; empty: it did not
};

class StabilityEngine {
 public:
  StabilityEngine() = default;
  StabilityEngine(const StabilityEngine&) = delete;
  StabilityEngine& operator=(const StabilityEngine&) = delete;
  virtual ~StabilityEngine() = default;

  [[nodiscard]] virtual int significand_bits() const = 0;
  // One step of size z on q'' = -q, from (1, 0) and from (0, 1): the matrix of z = omega dt.
  // Throws std::invalid_argument for an unknown integrator.
  [[nodiscard]] virtual StepFactor oscillator(std::string_view integrator, double z) const = 0;
  // One step of size z on y' = -y from 1.  Also throws std::invalid_argument for a splitting method.
  [[nodiscard]] virtual StepFactor decay(std::string_view integrator, double z) const = 0;
};

// Null where `token` was not built in.
[[nodiscard]] const StabilityEngine* find_stability_engine(std::string_view token);

}  // namespace ulpgate
