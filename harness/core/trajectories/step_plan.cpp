// step_plan(), graded_times(), graded_plan().
#include "harness/core/trajectories/step_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kernels/ode/error_control/adaptive.hpp"
#include "kernels/ode/error_control/gragg_stepper.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"

namespace ulpgate {

namespace {

constexpr double first_step = 1e-6;
constexpr std::uint64_t most_attempts = 1'000'000;
constexpr double tolerance_of_times = 1e-9;

class Planner {
 public:
  Planner(std::string_view problem, double tolerance) {
    for (const auto& c : ode::initial_value_cases<double>()) {
      if (c.name != problem) continue;
      name_ = c.name;
      if (c.stiff) {
        stepper_ = ode::make_newton_stepper<double>(c.problem, ode::CollocationNodes::radau, 3);
      } else {
        stepper_ = std::make_unique<ode::GraggStepper<double>>(c.problem, 4);
      }
      // Components of E5 fall below the range of double; what is that small asks for no steps.
      // Components of an orbit pass through 0, and concentrations that begin there rise as a power of time
      // that the method need not follow.
      double size = 0;
      for (const double x : c.problem.start) size = std::max(size, std::abs(x));
      const double absolute = c.name == "e5" ? 1e-36 : c.stiff ? 1e-8 * tolerance * size : tolerance;
      control_ = {tolerance, absolute, most_attempts};
      return;
    }
    throw std::invalid_argument("no initial value problem is called '" + std::string(problem) + "'");
  }

  // The steps over a time, from the state that the last call ended in.
  [[nodiscard]] std::vector<double> steps_over(double time, double first, const ode::StopFlag& stop) {
    auto run = ode::integrate_adaptively<double>(*stepper_, time, first, control_, stop);
    if (run.end != ode::AdaptiveEnd::reached)
      throw std::runtime_error("no steps for " + name_ + ": " + std::string(to_string(run.end)));
    return std::move(run.steps);
  }

 private:
  std::string name_;
  std::unique_ptr<ode::ErrorStepper<double>> stepper_;
  ode::StepControl control_;
};

[[nodiscard]] StepPlan planned(std::string_view problem, std::string_view end, double tolerance) {
  StepPlan plan{Planner(problem, tolerance).steps_over(ode::end_time<double>(end), first_step, {})};
  plan.steps.pop_back();
  return plan;
}

// A number of 24 bits: differences of such times are exact in double.
[[nodiscard]] double short_number(double x) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(m, 24)), exponent - 24);
}

[[nodiscard]] std::vector<double> times_of(std::string_view problem, std::string_view end) {
  const auto steps =
      Planner(problem, tolerance_of_times).steps_over(ode::end_time<double>(end), first_step, {});
  std::vector<double> times;
  double t = 0;
  std::size_t taken = 0;
  for (std::size_t k = 1; k < graded_times_count; ++k) {
    while (taken < k * steps.size() / graded_times_count) t += steps[taken++];
    const double time = short_number(t);
    if (time > (times.empty() ? 0 : times.back())) times.push_back(time);
  }
  return times;
}

// The same steps, each changed by less than the last place of `time`, so that their sums are exact in double
// and the last of them is `time`.
[[nodiscard]] std::vector<double> with_exact_sums(const std::vector<double>& steps, double time) {
  std::vector<double> exact;
  double t = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // What is rounded beyond 2 times `time` is a multiple of one last place, and so are the differences.
    const double next = i + 1 == steps.size() ? time : (t + steps[i] + 2 * time) - 2 * time;
    if (next > t) exact.push_back(next - t);
    t = next;
  }
  return exact;
}

[[nodiscard]] GradedPlan graded(std::string_view problem, std::string_view end, double tolerance,
                                const ode::StopFlag& stop) {
  std::vector<double> times = graded_times(problem, end);
  times.push_back(ode::end_time<double>(end));
  Planner planner(problem, tolerance);
  GradedPlan made;
  double before = 0;
  double first = first_step;
  for (const double time : times) {
    const auto steps = planner.steps_over(time - before, std::min(first, time - before), stop);
    // The last one was cut short; a step too long is tried again.
    first = std::max(first, *std::ranges::max_element(steps) * (steps.size() == 1 ? 2 : 1));
    if (steps.size() > 2) first = steps[steps.size() - 2];
    for (const double h : with_exact_sums(steps, time - before)) made.plan.steps.push_back(h);
    made.behind.push_back(made.plan.steps.size());
    before = time;
  }
  made.plan.steps.pop_back();
  return made;
}

// What `make` gives for a key, made once.
template <class Value, class Key, class Make>
[[nodiscard]] const Value& kept(std::map<Key, std::unique_ptr<const Value>>& known, std::mutex& mutex,
                                const Key& key, Make&& make) {
  const std::scoped_lock lock(mutex);
  auto& value = known[key];
  if (!value) value = std::make_unique<const Value>(make());
  return *value;
}

using PlanKey = std::tuple<std::string, std::string, double>;

}  // namespace

const StepPlan& step_plan(std::string_view problem, std::string_view end, double tolerance) {
  static std::mutex mutex;
  static std::map<PlanKey, std::unique_ptr<const StepPlan>> known;
  return kept(known, mutex, PlanKey{problem, end, tolerance},
              [&] { return planned(problem, end, tolerance); });
}

const std::vector<double>& graded_times(std::string_view problem, std::string_view end) {
  static std::mutex mutex;
  static std::map<PlanKey, std::unique_ptr<const std::vector<double>>> known;
  return kept(known, mutex, PlanKey{problem, end, 0.0}, [&] { return times_of(problem, end); });
}

const GradedPlan& graded_plan(std::string_view problem, std::string_view end, double tolerance,
                              const ode::StopFlag& stop) {
  if (!(tolerance >= finest_tolerance && tolerance <= coarsest_tolerance))
    throw std::invalid_argument("steps are planned for tolerances from 1e-13 to 1e-3");
  static std::mutex mutex;
  static std::map<PlanKey, std::unique_ptr<const GradedPlan>> known;
  return kept(known, mutex, PlanKey{problem, end, tolerance},
              [&] { return graded(problem, end, tolerance, stop); });
}

}  // namespace ulpgate
