// StabilityTheory: what one step of an integrator does to linear problems, from the coefficients in 62
// digits and in no way from the steppers.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

namespace ulpgate {

class StabilityTheory {
 public:
  StabilityTheory() = default;
  StabilityTheory(const StabilityTheory&) = delete;
  StabilityTheory& operator=(const StabilityTheory&) = delete;
  virtual ~StabilityTheory() = default;

  // On q'' = -q with z = omega dt: |trace|/2 - 1 of a symplectic step, |R(iz)| - 1 of a Runge-Kutta method of
  // stability function R, and the spectral radius - 1 of either.
  [[nodiscard]] virtual double oscillator_excess(double z) const = 0;
  [[nodiscard]] virtual double oscillator_growth(double z) const = 0;
  // The highest power of z to which a step on the oscillator is exact; nothing where it is not computed.
  [[nodiscard]] virtual std::optional<int> oscillator_order() const { return std::nullopt; }
  // |R(-z)| - 1 on y' = -y; nothing of a splitting method.
  [[nodiscard]] virtual std::optional<double> decay_excess(double z) const = 0;
};

// Splittings: the product of kicks and drifts as polynomials in z, of the coefficients that print begins.
// Explicit Runge-Kutta: R = 1 + z b^T (I - zA)^-1 1.  Extrapolation of the modified midpoint rule: its
// polynomials in Neville's scheme.  Gauss: the diagonal Pade approximant of exp, Radau IIA: the one below. E.
// Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), IV.2 and IV.3.  Null where no
// coefficients of the integrator are known here.  Throws std::invalid_argument for a name that is no
// integrator's.
[[nodiscard]] std::unique_ptr<StabilityTheory> stability_theory(std::string_view integrator);

// Limits computed elsewhere from published coefficients, good to six decimals: of the oscillator (imaginary)
// and of the decay (real axis).  `none`: the method grows at every step size.
struct KnownLimit {
  std::string_view integrator;
  std::optional<double> oscillator;
  bool oscillator_none = false;
  std::optional<double> decay;
};
// nullptr where none is known.
[[nodiscard]] const KnownLimit* known_limit(std::string_view integrator);

// A limit in print that is of the coefficients of a method in another arrangement.
struct OtherArrangement {
  std::string_view integrator;
  double printed;              // z = omega dt, to six decimals
  std::string_view own;        // how the method itself is arranged
  std::string_view other;      // and how what the printed limit is of
  int own_order, other_order;  // on the oscillator: the power of z to which the step is that of exp
};
// Of Ruth's method, nullptr for others.
[[nodiscard]] const OtherArrangement* other_arrangement(std::string_view integrator);
// The theory of the other arrangement, of the same coefficients; null where there is none.
[[nodiscard]] std::unique_ptr<StabilityTheory> theory_of_other_arrangement(std::string_view integrator);

}  // namespace ulpgate
