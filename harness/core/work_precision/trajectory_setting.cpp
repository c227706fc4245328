// TrajectorySetting.
#include "harness/core/work_precision/trajectory_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"

namespace ulpgate {

namespace {

// A state so many times as large as the solution has nothing to do with it any more.
constexpr double diverged_error = 1e3;
// Of an implicit method or one that chooses its order.
constexpr double iterations = 8;

double decimal_digits(int significand_bits) {
  return significand_bits * std::numbers::log10e_v<double> * std::numbers::ln2_v<double>;
}

// "1e-6": the shortest text of that double.
std::string tolerance_text(double tolerance) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), tolerance, std::chars_format::scientific);
  std::string found(text.data(), end.ptr);
  const std::size_t zero = found.find("e-0");
  return zero == std::string::npos ? found : found.replace(zero, 3, "e-");
}

const GradedPlan& plan_of(const WorkSetting& s) {
  const std::string_view text = std::string_view(s.dt).substr(plan_mark.size());
  double tolerance = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), tolerance);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size())
    throw std::invalid_argument(fmt::format("'{}' is no tolerance", text));
  return graded_plan(s.name, s.end, tolerance);
}

// The largest absolute value of each component at any of the times.
std::vector<double> sizes_of(const TruePath& truth) {
  std::vector<double> sizes(truth.states.back().size(), 0);
  for (const auto& state : truth.states) {
    for (std::size_t i = 0; i < sizes.size(); ++i)
      sizes[i] = std::max(sizes[i], std::fabs(std::strtod(state[i].c_str(), nullptr)));
  }
  return sizes;
}

}  // namespace

ProblemTruths shared_truths(const std::string& problem, const std::string& end, int digits) {
  const auto at = [=](bool graded) {
    return std::make_shared<Shared<TruePath>>([=](const ode::StopFlag& stop) {
      ComparedTimes times{compared_parts, {}};
      if (graded) times.graded = graded_times(problem, end);
      return true_path(problem, end, times, digits, stop);
    });
  };
  return {at(false), at(true)};
}

WorkSetting equal_setting(const std::string& problem, const std::string& type, const std::string& integrator,
                          const std::string& end, std::uint64_t steps) {
  return {WorkSubject::trajectory,
          problem,
          type,
          integrator,
          end,
          "",
          steps,
          ode::end_time<double>(end) / static_cast<double>(steps)};
}

WorkSetting planned_setting(const std::string& problem, const std::string& type,
                            const std::string& integrator, const std::string& end, double tolerance) {
  WorkSetting s =
      equal_setting(problem, type, integrator, end, graded_plan(problem, end, tolerance).behind.back());
  s.dt = std::string(plan_mark) + tolerance_text(tolerance);
  return s;
}

double evaluations_of_step(std::string_view integrator) {
  const auto& info = ode::find_integrator(integrator);
  return info.evaluations_per_step.value_or(iterations * std::max(info.stages, 4));
}

TrajectorySetting::TrajectorySetting(WorkSetting setting, const TrajectoryEngine& engine, SharedTruth truth,
                                     double budget)
    : SettingMeasurement(std::move(setting)), engine_(engine), truth_(std::move(truth)), budget_(budget) {
  if (this->setting().planned()) plan_ = &plan_of(this->setting());
}

Trajectory TrajectorySetting::run(std::uint64_t instants, const ode::StopFlag& stop) const {
  const WorkSetting& s = setting();
  TrajectoryOptions options;
  if (plan_ == nullptr) {
    options.checkpoints = static_cast<int>(instants);
    return engine_.equal_steps(s.name, s.integrator, s.end, s.steps, options, stop);
  }
  if (instants > 0) options.behind = plan_->behind;
  return engine_.planned_steps(s.name, s.integrator, s.end, plan_->plan, 1, options, stop);
}

SettingMeasurement::Work TrajectorySetting::prepare() const {
  return [this](const ode::StopFlag& stop) { static_cast<void>(run(0, stop)); };
}

WorkOutcome TrajectorySetting::measure(const ode::StopFlag& stop) {
  const double expected = evaluations_of_step(setting().integrator) * static_cast<double>(setting().steps);
  if (expected > budget_) {
    throw std::runtime_error(
        fmt::format("about {:.3g} evaluations are more than the budget of {:.3g}", expected, budget_));
  }
  const TruePath& truth = truth_->get(stop);
  // Those of the times at which a step ends.
  const std::uint64_t times = truth.states.size();
  const Trajectory got = run(plan_ == nullptr ? std::gcd(setting().steps, times) : times, stop);
  WorkOutcome o;
  o.steps = got.steps;
  o.evaluations = got.evaluations;
  if (!got.refusal.empty()) {
    o.failure = WorkFailure::refused;
    o.why = got.refusal;
    return o;
  }
  const double far = got.finite ? relative_distance(got.state, truth.states.back()) : HUGE_VAL;
  // Written so that an error that is no number has diverged.
  if (!(far <= diverged_error)) {
    o.failure = WorkFailure::diverged;
    if (!got.finite) o.steps = got.first_not_finite;
    o.why = got.finite ? fmt::format("the state is off by {:.3g} times the solution", far)
                       : fmt::format("the state is not finite behind step {}", got.first_not_finite);
    return o;
  }
  judge(got, truth, o);
  return o;
}

void TrajectorySetting::judge(const Trajectory& got, const TruePath& truth, WorkOutcome& o) const {
  const std::vector<double> sizes = sizes_of(truth);
  const std::size_t every = truth.states.size() / got.checkpoints.size();
  double error = 0;
  double largest = 0;
  for (std::size_t k = 0; k < got.checkpoints.size(); ++k) {
    const auto& wanted = truth.states[(k + 1) * every - 1];
    error = truth.norm == ErrorNorm::componentwise ? componentwise_distance(got.checkpoints[k], wanted, sizes)
                                                   : relative_distance(got.checkpoints[k], wanted);
    if (!(error <= largest)) largest = error;
  }
  o.final_error = error;
  o.largest_error = largest;
  o.instants = got.checkpoints.size();
  o.reference_error = truth.error;
  if (got.largest_invariant_error && std::isfinite(*got.largest_invariant_error))
    o.energy_error = got.largest_invariant_error;
  o.correct_digits =
      correct_digits_of(std::max(error, truth.error), decimal_digits(engine_.significand_bits()));
}

}  // namespace ulpgate
