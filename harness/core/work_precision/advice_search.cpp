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

struct Progress {
  int next = 0;
  double expected_s = 0;
  double least_error = infinite;
  int idle = 0;
  std::optional<CurveEnd> end;
};

void note_error(Progress& p, double error) {
  if (error < improvement * p.least_error) {
    p.idle = 0;
  } else if (p.least_error < resolved_error) {
    ++p.idle;
  }
  p.least_error = std::min(p.least_error, error);
}

std::optional<std::size_t> cheapest(const std::vector<Progress>& all) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].end && (!found || all[i].expected_s < all[*found].expected_s)) found = i;
  }
  return found;
}

}  // namespace

double AdvicePoint::certain_error() const {
  if (cut || outcome.failure != WorkFailure::none || !outcome.error()) return infinite;
  const double error = std::max(*outcome.error(), outcome.largest_error.value_or(0));
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
                           const MeasureLevel& measure) {
  AdviceSearch search;
  std::vector<Progress> all(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) all[i].expected_s = curves[i].guess_s;
  double best_s = infinite;
  double least_error = infinite;
  double spent_s = 0;
  while (const auto i = cheapest(all)) {
    Progress& p = all[*i];
    if (p.next == 0 && p.expected_s > guess_doubt * best_s) {
      p.end = CurveEnd::untouched;
      continue;
    }
    if (spent_s + p.expected_s > limits.search_s) {
      p.end = CurveEnd::stopped;
      continue;
    }
    if (p.next > 0 && p.expected_s >= best_s) {
      p.end = CurveEnd::too_dear;
      continue;
    }
    if (p.next > 0 && p.expected_s > limits.most_seconds) {
      p.end = CurveEnd::too_slow;
      continue;
    }
    const double most_s = std::min({best_s, limits.most_seconds, limits.search_s - spent_s});
    AdvicePoint point = measure(*i, p.next, most_s);
    const double error = point.certain_error();
    search.points.push_back(point);
    spent_s += point.seconds;
    if (point.cut) {
      p.end = most_s == best_s                ? CurveEnd::too_dear
              : most_s == limits.most_seconds ? CurveEnd::too_slow
                                              : CurveEnd::stopped;
      ++p.next;
      continue;
    }
    if (error < least_error) {
      least_error = error;
      search.nearest = search.points.size() - 1;
    }
    ++p.next;
    p.expected_s = 2 * point.seconds;
    if (error <= limits.error && point.seconds <= limits.most_seconds) {
      p.end = CurveEnd::met;
      if (point.seconds < best_s) {
        best_s = point.seconds;
        search.best = search.points.size() - 1;
      }
      continue;
    }
    if (std::isfinite(error)) note_error(p, error);
    if (p.idle >= most_idle) p.end = CurveEnd::floor;
    if (p.next >= curves[*i].levels && !p.end) p.end = CurveEnd::finest;
  }
  for (const auto& p : all) search.ends.push_back(*p.end);
  return search;
}

}  // namespace ulpgate
