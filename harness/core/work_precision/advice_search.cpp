// search_advice().
#include "harness/core/work_precision/advice_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ulpgate {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// So many levels that bring less than a tenth end a curve.
constexpr int most_idle = 3;
constexpr double improvement = 0.9;
// A guess may be wrong by this.
constexpr double guess_doubt = 4;
// Above it the step is too coarse to show anything, floors included.
constexpr double resolved_error = 0.1;
// Between two levels the error is looked for where it is within this of the one wanted, or within what three
// levels would bring if they brought as much as the last.
constexpr double near_error = 64;
constexpr double hopeful_levels = 3;
// A disturbance of the machine may make a run so much longer than it is: between two levels it is not cut
// below this, since what it then tells would be the wrong half to look in.
constexpr double disturbance = 3;

struct Progress {
  int next = 0;
  double expected_s = 0;
  double least_error = infinite;
  int idle = 0;
  std::optional<CurveEnd> end;
  // Of the last two levels that do not meet the error, and of the one that does.
  int failing = -1;
  double failing_error = infinite;
  double error_before = infinite;
  // What its first level would take by the last level that fails and what is finer: the least that one tells,
  // as disturbances only add time.
  double first_s = infinite;
};

void note_error(Progress& p, double error) {
  if (error < improvement * p.least_error) {
    p.idle = 0;
  } else if (p.least_error < resolved_error) {
    ++p.idle;
  }
  p.least_error = std::min(p.least_error, error);
}

class Search {
 public:
  Search(const std::vector<AdviceCurve>& curves, const AdviceLimits& limits, const MeasureQuarter& measure)
      : curves_(curves), limits_(limits), measure_(measure), all_(curves.size()) {
    for (std::size_t i = 0; i < curves.size(); ++i) all_[i].expected_s = curves[i].guess_s;
  }

  [[nodiscard]] AdviceSearch run() {
    while (const auto i = cheapest()) go_on(*i);
    refine();
    for (const auto& p : all_) found_.ends.push_back(*p.end);
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::optional<std::size_t> cheapest() const {
    std::optional<std::size_t> least;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!all_[i].end && (!least || all_[i].expected_s < all_[*least].expected_s)) least = i;
    }
    return least;
  }

  [[nodiscard]] double most_s(double at_least = 0) const {
    return std::min({std::max(best_s_, at_least), limits_.most_seconds, limits_.search_s - spent_s_});
  }

  // Whether it meets the error.
  struct Look {
    double error;
    double seconds;
    bool cut;
    bool meets;
  };
  Look look(std::size_t i, int quarter, double most_s) {
    found_.points.push_back(measure_(i, quarter, most_s));
    const AdvicePoint& point = found_.points.back();
    spent_s_ += point.seconds;
    Look seen{point.certain_error(), point.seconds, point.cut, false};
    if (seen.cut) return seen;
    // One that failed may have ended early.
    if (std::isfinite(seen.error))
      all_[i].first_s = std::min(all_[i].first_s, seen.seconds / growth_to(i, quarter));
    if (seen.error < least_error_) {
      least_error_ = seen.error;
      found_.nearest = found_.points.size() - 1;
    }
    seen.meets = seen.error <= limits_.error && seen.seconds <= limits_.most_seconds;
    if (seen.meets && seen.seconds < best_s_) {
      best_s_ = seen.seconds;
      found_.best = found_.points.size() - 1;
    }
    return seen;
  }

  // Why the next level is not to be looked at.
  [[nodiscard]] std::optional<CurveEnd> end_before(const Progress& p) const {
    if (p.next == 0 && p.expected_s > guess_doubt * best_s_) return CurveEnd::untouched;
    if (spent_s_ + p.expected_s > limits_.search_s) return CurveEnd::stopped;
    if (p.next > 0 && p.expected_s >= best_s_) return CurveEnd::too_dear;
    if (p.next > 0 && p.expected_s > limits_.most_seconds) return CurveEnd::too_slow;
    return std::nullopt;
  }

  void go_on(std::size_t i) {
    Progress& p = all_[i];
    p.end = end_before(p);
    if (p.end) return;
    const double most = most_s();
    const double best = best_s_;
    const Look seen = look(i, quarters_of_level * p.next++, most);
    if (seen.cut) {
      p.end = most == best                   ? CurveEnd::too_dear
              : most == limits_.most_seconds ? CurveEnd::too_slow
                                             : CurveEnd::stopped;
      return;
    }
    p.expected_s = curves_[i].growth * seen.seconds;
    if (seen.meets) {
      p.end = CurveEnd::met;
      return;
    }
    p.failing = p.next - 1;
    p.error_before = p.failing_error;
    p.failing_error = seen.error;
    // Coarser ones may have ended early, or cost more than steps do.
    p.first_s =
        std::isfinite(seen.error) ? seen.seconds / growth_to(i, quarters_of_level * p.failing) : infinite;
    if (std::isfinite(seen.error)) note_error(p, seen.error);
    if (p.idle >= most_idle) p.end = CurveEnd::floor;
    if (p.next >= curves_[i].levels && !p.end) p.end = CurveEnd::finest;
  }

  // Whether the levels beside the last one that failed may hold the cheapest.
  [[nodiscard]] bool may_be_refined(const Progress& p) const {
    if (p.failing < 0) return false;
    if (p.end == CurveEnd::met) return true;
    if (p.end != CurveEnd::too_dear && p.end != CurveEnd::too_slow) return false;
    if (!std::isfinite(p.failing_error)) return false;
    const double brought = std::isfinite(p.error_before) ? p.error_before / p.failing_error : 1;
    return p.failing_error <= limits_.error * std::max(near_error, std::pow(brought, hopeful_levels));
  }

  [[nodiscard]] double growth_to(std::size_t i, int quarter) const {
    return std::pow(curves_[i].growth, static_cast<double>(quarter) / quarters_of_level);
  }

  // Of a quarter beyond the last level that failed.
  [[nodiscard]] double expected_s(std::size_t i, int quarters) const {
    return all_[i].first_s * growth_to(i, quarters_of_level * all_[i].failing + quarters);
  }

  void refine() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (may_be_refined(all_[i])) order.push_back(i);
    // What promises most makes the rest too dear.
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return expected_s(i, 1); });
    for (const auto i : order) refine(i);
  }

  void refine(std::size_t i) {
    const int base = quarters_of_level * all_[i].failing;
    int failing = 0;
    int beyond = quarters_of_level;
    while (beyond - failing > 1) {
      const int middle = (failing + beyond) / 2;
      const double expected = expected_s(i, middle);
      if (spent_s_ + expected > limits_.search_s) return;
      bool enough = expected >= best_s_ || expected > limits_.most_seconds;
      if (!enough) {
        const Look seen = look(i, base + middle, most_s(disturbance * expected));
        enough = seen.meets || seen.cut;
      }
      (enough ? beyond : failing) = middle;
    }
  }

  const std::vector<AdviceCurve>& curves_;
  const AdviceLimits& limits_;
  const MeasureQuarter& measure_;
  std::vector<Progress> all_;
  AdviceSearch found_;
  double best_s_ = infinite;
  double least_error_ = infinite;
  double spent_s_ = 0;
};

}  // namespace

double AdvicePoint::certain_error() const {
  if (cut || outcome.failure != WorkFailure::none || !outcome.error()) return infinite;
  double error = *outcome.error();
  if (wanted == Wanted::on_the_way) error = std::max(error, outcome.largest_error.value_or(0));
  return std::isnan(error) ? infinite : error + outcome.reference_error.value_or(0);
}

std::string_view to_string(CurveEnd end) {
  constexpr std::array<std::string_view, 7> names = {
      "meets the error",
      "more steps take longer than the best",
      "more steps take longer than a run may",
      "its error falls no further",
      "its finest step is reached",
      "its first steps would be far dearer than the best",
      "the time for the search was over",
  };
  return names.at(static_cast<std::size_t>(end));
}

AdviceSearch search_advice(const std::vector<AdviceCurve>& curves, const AdviceLimits& limits,
                           const MeasureQuarter& measure) {
  return Search(curves, limits, measure).run();
}

}  // namespace ulpgate
