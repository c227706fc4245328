// TrajectoryEngine: initial value problems in one type, behind an interface that knows no number type.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

// An initial value problem of kernels/ode/problems/initial_value_cases.hpp.
struct InitialValueInfo {
  std::string name;               // "robertson"
  std::vector<std::string> ends;  // end times as decimal text, the first the one that tests use
  std::size_t components;
  bool stiff;
  bool second_order;   // q'' = a(q): splitting methods apply
  bool has_invariant;  // an energy or another conserved quantity is known
};

// What a run does besides taking its steps.
struct TrajectoryOptions {
  // Behind each step every component is multiplied by 1 + or - this, the sign drawn from `seed`: what
  // roundings of that size at every step would do to an exact run.
  double perturbation = 0;
  std::uint64_t seed = 0;
  int checkpoints = 0;  // states kept on the way, behind equal shares of the steps
  // States kept instead behind these numbers of steps, which rise.
  std::span<const std::uint64_t> behind = {};
};

// Where a run of an integrator came to.
struct Trajectory {
  std::vector<std::string> state;  // at the end, exact hexfloat; empty where it was refused
  std::vector<std::vector<std::string>> checkpoints;
  std::vector<double> sizes;  // the largest |y_i| behind any step
  std::uint64_t steps = 0;
  std::uint64_t evaluations = 0;  // of the slope or of the acceleration; those of Jacobians are not counted
  // |I - I(0)| / |I(0)|, or |I| where I(0) = 0: the largest behind any step, and at the end.
  std::optional<double> largest_invariant_error;
  std::optional<double> final_invariant_error;
  bool finite = true;
  std::uint64_t first_not_finite = 0;  // the step behind which the state was not finite
  std::string refusal;                 // the error's text where the integrator refused; empty: it did not
};

// The step sizes of a run that others repeat in other types: exact numbers, in double.
struct StepPlan {
  std::vector<double> steps;  // all but the last
  // The last one leads to the end; it is made of the end and the sum of the others in 124 digits and rounded
  // once to the type.
};

class TrajectoryEngine {
 public:
  TrajectoryEngine() = default;
  TrajectoryEngine(const TrajectoryEngine&) = delete;
  TrajectoryEngine& operator=(const TrajectoryEngine&) = delete;
  virtual ~TrajectoryEngine() = default;

  [[nodiscard]] virtual int significand_bits() const = 0;
  // Throws std::invalid_argument for an unknown problem.
  [[nodiscard]] virtual bool applies(std::string_view integrator, std::string_view problem) const = 0;

  // `steps` equal steps to t = end.  A refusal of the method is in the result; throws ode::Stopped.
  [[nodiscard]] Trajectory equal_steps(std::string_view problem, std::string_view integrator,
                                       std::string_view end, std::uint64_t steps,
                                       const ode::StopFlag& stop) const {
    return equal_steps(problem, integrator, end, steps, {}, stop);
  }
  [[nodiscard]] virtual Trajectory equal_steps(std::string_view problem, std::string_view integrator,
                                               std::string_view end, std::uint64_t steps,
                                               const TrajectoryOptions& options,
                                               const ode::StopFlag& stop) const = 0;
  // The steps of a plan; each of them cut into `parts` equal ones.
  [[nodiscard]] virtual Trajectory planned_steps(std::string_view problem, std::string_view integrator,
                                                 std::string_view end, const StepPlan& plan, int parts,
                                                 const TrajectoryOptions& options,
                                                 const ode::StopFlag& stop) const = 0;
};

// Null where `token` was not built in.
[[nodiscard]] const TrajectoryEngine* find_trajectory_engine(std::string_view token);
// Tokens of the engines that serve as references, generated.
[[nodiscard]] const std::vector<std::string>& trajectory_references();
// An engine of at least twice the significand bits of a type, and of at least 200.
[[nodiscard]] const TrajectoryEngine& reference_trajectory_engine(int significand_bits);

// The problems, the same in every type.
[[nodiscard]] const std::vector<InitialValueInfo>& initial_value_problems();

// max |a_i - b_i| / max |b_i|, of states as exact texts; NaN or infinity where a is not finite.
[[nodiscard]] double relative_distance(const std::vector<std::string>& a, const std::vector<std::string>& b);
// max |a_i - b_i| / w_i, w_i the larger of |b_i| and 1e-30 sizes_i: each component counts, but for one that
// has decayed to nothing.  Components whose weight is 0 in both are left out.
[[nodiscard]] double componentwise_distance(const std::vector<std::string>& a,
                                            const std::vector<std::string>& b,
                                            const std::vector<double>& sizes);

}  // namespace ulpgate
