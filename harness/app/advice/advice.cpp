// advise().
#include "harness/app/advice/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/app/advice/deadline.hpp"
#include "harness/app/advice/work_precision_records.hpp"
#include "harness/app/machine/environment.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;

// What meets the error within this of the least time is timed again beside it: noise shall not choose.
constexpr double rival = 1.5;
constexpr unsigned rival_rounds = 5;
// A wider type errs by this part or less: then the narrower one's rounding made the difference.
constexpr double rounding_share = 0.5;
// An order measured lower than the method's by more, and by a quarter, was lost.
constexpr double order_slack = 0.5;
// e-folds of the error in the second half of a run; powers of time give some two.
constexpr double chaotic_folds = 4;
// A wider type's run may be this much longer than the setting that it explains, or this long.
constexpr double longest_explanation_s = 60;
constexpr double wider_slowdown = 40;
// Measuring an error takes a run and more; a run that may last so long is ended after this.
constexpr double allowance = 3;
constexpr double least_allowance_s = 0.05;

class Advisor {
 public:
  Advisor(const AdviceCase& c, const AdviceOptions& o) : case_(c), o_(o), progress_("advise") {
    if (!o.records.empty()) known_ = read_work_precision(o.records);
  }

  [[nodiscard]] Advice run() {
    prepare();
    std::vector<AdviceCurve> curves;
    for (const auto& choice : case_.choices()) curves.push_back(case_.curve(choice));
    advice_.search = search_advice(
        curves, {o_.error, o_.time_s, o_.search_s},
        [&](std::size_t curve, int quarter, double most_s) { return measured(curve, quarter, most_s); });
    advice_.best = advice_.search.best;
    advice_.nearest = advice_.search.nearest;
    if (advice_.best) retime_rivals();
    if (const auto which = advice_.best ? advice_.best : advice_.nearest) explain(*which);
    return std::move(advice_);
  }

 private:
  void prepare() {
    const WorkPlace place(o_.name, "", "what errors are measured against");
    const ode::StopFlag stop(interrupt_flag(), &Heartbeat::mine().steps());
    try {
      case_.prepare(stop);
    } catch (const ode::Stopped&) {
      throw Failure(Standing::incomplete, "interrupted");
    } catch (const Failure&) {
      throw;
    } catch (const std::runtime_error& e) {
      throw Failure(Standing::incomplete,
                    fmt::format("{}: nothing to measure against: {}", o_.name, e.what()));
    }
  }

  AdvicePoint measured(std::size_t curve, int quarter, double most_s) {
    const std::size_t at = look(case_.choices()[curve], quarter, allowance * most_s + least_allowance_s);
    const AdvicePlace& place = advice_.places[at];
    progress_.update(spent_s_, o_.search_s);
    return {curve, quarter, place.row.outcome, place.seconds, place.cut, case_.wanted()};
  }

  // From the records, or measured now.
  std::size_t look(const AdviceCase::Choice& choice, int quarter, double most_s) {
    if (interrupted()) throw Failure(Standing::incomplete, "interrupted");
    auto m = setting_of(choice, quarter);
    if (!m) {
      advice_.places.push_back({{}, 0, "", true});
      settings_.push_back(nullptr);
      return advice_.places.size() - 1;
    }
    const auto it = known_.find(m->setting().key());
    AdvicePlace place;
    const bool recorded =
        it != known_.end() && (it->second.seconds || it->second.row.outcome.failure != WorkFailure::none);
    if (recorded) {
      place = {it->second.row, it->second.seconds.value_or(0), it->second.place, false};
    } else {
      place = measure(*m, most_s);
    }
    advice_.places.push_back(std::move(place));
    settings_.push_back(std::move(m));
    return advice_.places.size() - 1;
  }

  // Null where there are no such steps: no plan leads to the end.
  [[nodiscard]] std::unique_ptr<SettingMeasurement> setting_of(const AdviceCase::Choice& choice,
                                                               int quarter) const {
    try {
      return case_.setting(choice, quarter);
    } catch (const Failure&) {
      throw;
    } catch (const std::runtime_error&) {
      return nullptr;
    }
  }

  AdvicePlace measure(SettingMeasurement& m, double most_s) {
    const WorkPlace place(m.setting().key(), "", "advise");
    const auto start = Clock::now();
    const Deadline deadline(most_s);
    const ode::StopFlag stop(deadline.flag(), &Heartbeat::mine().steps());
    try {
      static_cast<void>(in_checked_environment([&] { return m.proceed(1, stop); }));
      double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (m.outcome().failure == WorkFailure::none) {
        seconds = in_checked_environment([&] { return sample_of(m, stop); });
        advice_.times.samples_s[m.setting().key()] = {seconds};
      }
      spent_s_ += seconds;
      return {m.row(), seconds, "", false};
    } catch (const ode::Stopped&) {
      if (interrupted()) throw Failure(Standing::incomplete, "interrupted");
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      spent_s_ += seconds;
      WorkOutcome cut;
      cut.failure = WorkFailure::refused;
      cut.why = fmt::format("ended after {:.2g} s: others are faster, or it may take no longer", seconds);
      return {{m.setting(), cut}, seconds, "", true};
    }
  }

  [[nodiscard]] bool meets(std::size_t i) const {
    const AdvicePoint& p = advice_.search.points[i];
    return p.certain_error() <= o_.error;
  }

  void retime_rivals() {
    std::vector<std::size_t> rivals;
    std::vector<const SettingMeasurement*> again;
    const double best_s = advice_.places[*advice_.best].seconds;
    for (std::size_t i = 0; i < advice_.search.points.size(); ++i) {
      if (!meets(i) || advice_.places[i].seconds > rival * best_s) continue;
      rivals.push_back(i);
      if (advice_.places[i].place.empty() && !advice_.places[i].cut) again.push_back(settings_[i].get());
    }
    if (!again.empty() && !time_settings(again, rival_rounds, advice_.times, {}))
      throw Failure(Standing::incomplete, "interrupted");
    for (const auto i : rivals) {
      const auto time = advice_.times.summary(advice_.places[i].row.setting.key());
      if (time) advice_.places[i].seconds = time->minimum_s;
      if (advice_.places[i].seconds < advice_.places[*advice_.best].seconds) advice_.best = i;
    }
  }

  void explain(std::size_t which) {
    const AdvicePoint point = advice_.search.points[which];
    const auto choice = case_.choices()[point.curve];
    const double error = advice_.places[which].row.outcome.error().value_or(HUGE_VAL);
    std::string text = rounding_or_stepping(choice, point, which, error);
    if (const auto order = order_between(point, which, error)) {
      advice_.measured_order = order;
      const auto method = ode::find_integrator(choice.integrator).order;
      text += fmt::format("; order {:.2f} measured from coarser steps", *order);
      // Where rounding makes the error, halving tells nothing of the method.
      if (!text.starts_with("rounding") && method &&
          *order < *method - std::max(order_slack, 0.25 * *method) && *order > 0)
        text += fmt::format(", where the method has {}: {}", *method, case_.kink_words(choice.integrator));
    }
    const auto& row = advice_.places[which].row;
    const double until = row.setting.dt_value * static_cast<double>(row.setting.steps);
    const double folds = row.outcome.growth_rate.value_or(0) * until / 2;
    if (folds > chaotic_folds) {
      text += fmt::format("; chaos: errors grow e-fold every {:.3g} s, {:.2g} times in the second half",
                          1 / *row.outcome.growth_rate, std::exp(folds));
    }
    if (row.outcome.reference_error.value_or(0) > o_.error) {
      text +=
          fmt::format("; what it is measured against is itself good to {:.1e} only: give a shorter --until",
                      *row.outcome.reference_error);
    }
    advice_.limit = text;
  }

  std::string rounding_or_stepping(const AdviceCase::Choice& choice, const AdvicePoint& point,
                                   std::size_t which, double error) {
    const auto wide = wider_type(choice.type);
    if (!wide) return "time-stepping or rounding: no wider type is built to tell them apart";
    const double seconds = advice_.places[which].seconds;
    if (seconds * wider_slowdown > std::max(longest_explanation_s, o_.time_s))
      return fmt::format("time-stepping or rounding: a run in {} to tell them apart would be too long",
                         *wide);
    const std::size_t other =
        look({*wide, choice.integrator, choice.steps}, point.quarter, longest_explanation_s);
    const WorkOutcome& o = advice_.places[other].row.outcome;
    if (advice_.places[other].cut)
      return fmt::format("time-stepping or rounding: a run in {} to tell them apart takes too long", *wide);
    if (o.failure != WorkFailure::none || !o.error())
      return fmt::format("nothing is known: {} with the same steps {}: {}", *wide, to_string(o.failure),
                         o.why);
    if (*o.error() <= rounding_share * error)
      return fmt::format("rounding: {} with the same steps errs by {:.2e}", *wide, *o.error());
    return fmt::format("time-stepping: {} with the same steps errs by {:.2e} as well", *wide, *o.error());
  }

  // Between this setting and the one of its curve that has next to half its steps.
  [[nodiscard]] std::optional<double> order_between(const AdvicePoint& point, std::size_t which,
                                                    double error) const {
    const auto steps_of = [&](std::size_t i) {
      return static_cast<double>(advice_.places[i].row.setting.steps);
    };
    constexpr double most = 0.75;
    std::optional<std::size_t> coarser;
    for (std::size_t i = 0; i < advice_.search.points.size(); ++i) {
      const AdvicePoint& p = advice_.search.points[i];
      const double share = steps_of(i) / steps_of(which);
      if (p.curve != point.curve || share > most || !p.outcome.error() || !(*p.outcome.error() > 0)) continue;
      if (!coarser || steps_of(i) > steps_of(*coarser)) coarser = i;
    }
    if (!coarser || !(error > 0)) return std::nullopt;
    return std::log(*advice_.search.points[*coarser].outcome.error() / error) /
           std::log(steps_of(which) / steps_of(*coarser));
  }

  const AdviceCase& case_;
  const AdviceOptions& o_;
  Progress progress_;
  std::map<std::string, KnownSetting> known_;
  std::vector<std::unique_ptr<SettingMeasurement>> settings_;  // of the places
  double spent_s_ = 0;
  Advice advice_;
};

}  // namespace

Advice advise(const AdviceCase& advice_case, const AdviceOptions& o) {
  const InterruptGuard guard;
  return Advisor(advice_case, o).run();
}

std::vector<WorkPrecisionRow> measured_rows(const Advice& advice) {
  std::vector<WorkPrecisionRow> rows;
  for (const auto& p : advice.places) {
    const bool again = std::ranges::any_of(rows, [&](const auto& r) { return r.setting == p.row.setting; });
    if (p.place.empty() && !p.cut && !again) rows.push_back(p.row);
  }
  return rows;
}

}  // namespace ulpgate::app
