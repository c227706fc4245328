// Rows of problems and integrators, and what is known of them.
#include "harness/core/trajectories/trajectory_cases.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

// How a problem is integrated: by the steps of a plan, or by equal ones.
struct Row {
  std::string problem;
  std::string end;
  std::string integrator;
  double tolerance = 0;     // of the plan; 0: equal steps
  std::uint64_t steps = 0;  // equal ones
  bool stiff = false;
  double cost = 1;
  std::vector<KnownVerdict> known;
};

constexpr int checkpoints = 16;
// Relative perturbation of every component behind every step: far above the roundings of 62 digits, and far
// below what would leave the linear regime of a chaotic orbit.
constexpr double perturbation = 0x1p-130;
// Beyond this multiple of the largest component of the start, and of the state on the way of the reference, a
// solution has nothing to do with its problem.
constexpr double lost_multiple = 1e8;
// And so has one whose conserved quantity has changed by this multiple of itself.
constexpr double lost_invariant = 10;

[[nodiscard]] Trajectory run_row(const TrajectoryEngine& engine, const Row& row, int parts,
                                 const TrajectoryOptions& options, const ode::StopFlag& stop) {
  if (row.tolerance > 0)
    return engine.planned_steps(row.problem, row.integrator, row.end,
                                step_plan(row.problem, row.end, row.tolerance), parts, options, stop);
  return engine.equal_steps(row.problem, row.integrator, row.end,
                            row.steps * static_cast<std::uint64_t>(parts), options, stop);
}

[[nodiscard]] double largest_of(const std::vector<double>& sizes) {
  double largest = 0;
  for (const double x : sizes) largest = x > largest || std::isnan(x) ? x : largest;
  return largest;
}

// What does not depend on the type under test, computed once for each row.
struct RowTruth {
  std::vector<double> condition;  // at the checkpoints
  double stepping_error = 0;
  bool judged = false;  // the exact method reaches the end; otherwise nothing can be compared
};

class RowRun {
 public:
  RowRun(const Row& row, std::string_view token, const ode::StopFlag& stop)
      : row_(row), token_(token), stop_(stop) {}

  [[nodiscard]] StressRow judge() const {
    const TrajectoryEngine& engine = *find_trajectory_engine(token_);
    StressRow out;
    const Trajectory own = run_row(engine, row_, 1, {0, 0, checkpoints}, stop_);
    out.figures["steps"] = static_cast<double>(own.steps);
    out.figures["evaluations"] = static_cast<double>(own.evaluations);
    if (own.largest_invariant_error && std::isfinite(*own.largest_invariant_error))
      out.figures["invariant_error"] = *own.largest_invariant_error;
    if (lost(own, out)) return out;
    const auto& reference = reference_of(engine.significand_bits());
    const RowTruth& truth = truth_of();
    if (!truth.judged || reference.state.empty()) {
      out.verdict = StressVerdict::wrong_outcome;
      out.why = "the method in exact arithmetic does not reach the end, this type does";
      return out;
    }
    compare(own, reference, truth, unit_roundoff(engine.significand_bits()), out);
    return out;
  }

 private:
  // Refused or diverged.
  [[nodiscard]] bool lost(const Trajectory& own, StressRow& out) const {
    if (!own.refusal.empty()) {
      out.verdict = StressVerdict::refused;
      out.why = own.refusal;
      out.first_wrong = "step " + std::to_string(own.steps + 1);
      return true;
    }
    if (!own.finite) {
      out.verdict = StressVerdict::diverged;
      out.why = "the state is not finite";
      out.first_wrong = "step " + std::to_string(own.first_not_finite);
      return true;
    }
    const bool energy = own.largest_invariant_error && !(*own.largest_invariant_error <= lost_invariant);
    const bool size = !(largest_of(own.sizes) <= lost_multiple);
    if (!energy && !size) return false;
    out.verdict = StressVerdict::diverged;
    out.why = energy ? "the conserved quantity has changed by more than ten times itself"
                     : "a component has grown beyond 1e8";
    out.first_wrong = "step " + std::to_string(own.steps) + " or before";
    return true;
  }

  [[nodiscard]] std::string worst_component(const std::vector<std::string>& own,
                                            const std::vector<std::string>& exact,
                                            const std::vector<double>& sizes) const {
    std::size_t worst = 0;
    double largest = -1;
    for (std::size_t i = 0; i < own.size(); ++i) {
      // Of a norm the share of each component.
      const double off = row_.stiff ? distance({own[i]}, {exact[i]}, {sizes[i]})
                                    : relative_distance({own[i]}, {exact[i]}) * sizes[i];
      if (off <= largest) continue;
      largest = off;
      worst = i;
    }
    return std::to_string(worst + 1);
  }

  [[nodiscard]] double distance(const std::vector<std::string>& a, const std::vector<std::string>& b,
                                const std::vector<double>& sizes) const {
    // Concentrations count each for itself, an orbit as a whole.
    return row_.stiff ? componentwise_distance(a, b, sizes) : relative_distance(a, b);
  }

  void compare(const Trajectory& own, const Trajectory& reference, const RowTruth& truth, double roundoff,
               StressRow& out) const {
    for (std::size_t k = 0; k < own.checkpoints.size(); ++k) {
      const double error = distance(own.checkpoints[k], reference.checkpoints[k], reference.sizes);
      out.error = error;
      out.condition = std::max(1.0, truth.condition[k]);
      out.verdict = judge_stress(error, *out.condition, roundoff);
      if (out.first_wrong.empty() && out.verdict == StressVerdict::unstable) {
        out.first_wrong = "between steps " + std::to_string(own.steps * k / checkpoints) + " and " +
                          std::to_string(own.steps * (k + 1) / checkpoints);
      }
    }
    if (out.verdict == StressVerdict::unstable)
      out.why = "component " +
                worst_component(own.checkpoints.back(), reference.checkpoints.back(), reference.sizes) +
                " is farthest off at the end, where rounding is felt more than the problem makes it";
    out.stepping_error = truth.stepping_error;
    const double whole = std::max(*out.error, truth.stepping_error);
    out.correct_digits = whole > 0 ? std::max(0.0, -std::log10(whole)) : -std::log10(roundoff);
  }

  // The method at twice the digits, at the same steps.
  [[nodiscard]] const Trajectory& reference_of(int bits) const {
    static std::mutex mutex;
    static std::map<std::pair<std::string, const TrajectoryEngine*>, std::unique_ptr<const Trajectory>> known;
    const TrajectoryEngine& engine = reference_trajectory_engine(bits);
    const std::pair key{this->key(), &engine};
    {
      const std::scoped_lock lock(mutex);
      if (const auto found = known.find(key); found != known.end()) return *found->second;
    }
    // Two threads may both compute it: the same bits, and no thread waits for another.  A job queues its rows
    // so that they seldom do.
    auto run = std::make_unique<const Trajectory>(run_row(engine, row_, 1, {0, 0, checkpoints}, stop_));
    const std::scoped_lock lock(mutex);
    return *known.emplace(key, std::move(run)).first->second;
  }

  [[nodiscard]] const RowTruth& truth_of() const {
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<const RowTruth>> known;
    {
      const std::scoped_lock lock(mutex);
      if (const auto found = known.find(key()); found != known.end()) return *found->second;
    }
    auto truth = std::make_unique<const RowTruth>(make_truth());
    const std::scoped_lock lock(mutex);
    return *known.emplace(key(), std::move(truth)).first->second;
  }

  [[nodiscard]] RowTruth make_truth() const {
    constexpr int bits = 64;  // any type's: the engine of 62 digits
    const TrajectoryEngine& engine = reference_trajectory_engine(bits);
    const Trajectory& exact = reference_of(bits);
    RowTruth truth;
    if (exact.state.empty()) return truth;
    truth.condition.assign(exact.checkpoints.size(), 0);
    for (const std::uint64_t seed : {1U, 2U}) {
      const Trajectory moved = run_row(engine, row_, 1, {perturbation, seed, checkpoints}, stop_);
      for (std::size_t k = 0; k < exact.checkpoints.size(); ++k) {
        const double d = moved.state.empty()
                             ? HUGE_VAL
                             : distance(moved.checkpoints[k], exact.checkpoints[k], exact.sizes);
        truth.condition[k] = std::max(truth.condition[k], d / perturbation);
      }
    }
    const Trajectory halved = run_row(engine, row_, 2, {}, stop_);
    truth.stepping_error =
        halved.state.empty() ? HUGE_VAL : distance(exact.state, halved.state, halved.sizes);
    truth.judged = true;
    return truth;
  }

  [[nodiscard]] std::string key() const {
    return row_.problem + " " + row_.end + " " + row_.integrator + " " + std::to_string(row_.tolerance) +
           " " + std::to_string(row_.steps);
  }

  const Row& row_;
  std::string_view token_;
  const ode::StopFlag& stop_;
};

#include "harness/core/trajectories/trajectory_rows.inc"

[[nodiscard]] std::string title_of(const Row& row) {
  return row.problem + " to t = " + row.end + " by " + row.integrator + ", " +
         (row.tolerance > 0 ? "steps planned for a relative tolerance"
                            : std::to_string(row.steps) + " equal steps");
}

}  // namespace

std::vector<StressCase> trajectory_cases() {
  std::vector<StressCase> cases;
  for (const Row& row : rows()) {
    StressCase c;
    c.kind = "trajectory";
    c.name = row.problem;
    c.form = row.integrator + "_to_" + row.end.substr(0, row.end.find(' '));
    c.title = title_of(row);
    c.known = row.known;
    c.cost = row.cost;
    c.run = [row](std::string_view token, const ode::StopFlag& stop) -> std::optional<StressRow> {
      return RowRun(row, token, stop).judge();
    };
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace ulpgate
