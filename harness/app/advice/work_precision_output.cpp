// Records of work and precision.
#include "harness/app/advice/work_precision_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/app/reading/json_fields.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

namespace {

Json setting_json(const char* what, const WorkSetting& s) {
  Json j = {{"what", what}, {"subject", to_string(s.subject)}, {"name", s.name}, {"type", s.type}};
  if (s.integrator.empty()) return j;
  j["integrator"] = s.integrator;
  j["end"] = s.end;
  if (s.planned()) j["planned"] = true;
  return j;
}

Json step_json(Json j, const WorkSetting& s) {
  if (s.integrator.empty()) return j;
  j["steps"] = s.steps;
  j["dt"] = s.dt_value;
  if (!s.dt.empty()) j["dt_text"] = s.dt;
  return j;
}

Json row_json(const WorkPrecisionRow& row, const std::optional<ErrorRegime>& regime) {
  const WorkOutcome& o = row.outcome;
  Json j = step_json(setting_json("work_precision", row.setting), row.setting);
  j["failure"] = o.failure == WorkFailure::none ? Json(nullptr) : Json(to_string(o.failure));
  if (!o.why.empty()) j["why"] = o.why;
  if (!row.setting.integrator.empty()) j["steps_taken"] = o.steps;
  j["evaluations"] = o.evaluations;
  j["final_error"] = number_or_null(o.final_error);
  j["largest_error"] = number_or_null(o.largest_error);
  if (o.largest_error_ulp) j["largest_error_ulp"] = *o.largest_error_ulp;
  j["energy_error"] = number_or_null(o.energy_error);
  j["reference_error"] = number_or_null(o.reference_error);
  if (o.instants) j["instants"] = *o.instants;
  if (o.t_s) {
    j["t_s"] = *o.t_s;
    j["t_s_to_the_end"] = o.t_s_to_the_end;
  }
  if (o.growth_rate) j["growth_rate"] = *o.growth_rate;
  j["correct_digits"] = number_or_null(o.correct_digits);
  if (regime) j["regime"] = to_string(*regime);
  return j;
}

double roundoff_of(const std::string& token) {
  return std::ldexp(1.0, -find_type(token)->significand_bits);
}

ErrorFit fit_of(const std::vector<WorkPrecisionRow>& rows, const std::vector<std::size_t>& which,
                FittedError error) {
  std::vector<FitPoint> points;
  for (const auto i : which) {
    const WorkOutcome& o = rows[i].outcome;
    const auto& e = error == FittedError::final ? o.final_error : o.energy_error;
    const bool good = o.failure == WorkFailure::none && e;
    points.push_back(
        {rows[i].setting.dt_value, static_cast<double>(rows[i].setting.steps), good ? *e : std::nan("")});
  }
  return fit_error(points, roundoff_of(rows[which.front()].setting.type));
}

Json fit_json(const WorkSetting& s, FittedError which, const ErrorFit& fit, const std::string& plan) {
  Json j = setting_json("work_precision_fit", s);
  j["error"] = to_string(which);
  j["constant"] = number_or_null(fit.constant);
  j["order"] = number_or_null(fit.order);
  j["walk"] = number_or_null(fit.walk);
  j["drift"] = number_or_null(fit.drift);
  j["residual"] = number_or_null(fit.residual);
  j["bad"] = fit.bad;
  j["best_dt"] = number_or_null(fit.best_dt);
  j["best_error"] = number_or_null(fit.best_error);
  j["crossing_dt"] = number_or_null(fit.crossing_dt);
  j["plan"] = plan;
  return j;
}

// Of all rows those on the front of their subject.
std::set<std::size_t> fronts_of(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times) {
  std::map<std::string, std::vector<std::size_t>> subjects;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WorkSetting& s = rows[i].setting;
    subjects[fmt::format("{}/{}/{}", to_string(s.subject), s.name, s.end)].push_back(i);
  }
  std::set<std::size_t> fronts;
  for (const auto& [name, members] : subjects) {
    std::vector<WorkPoint> points;
    for (const auto i : members) {
      const auto time = times.summary(rows[i].setting.key());
      points.push_back({rows[i].outcome.error().value_or(HUGE_VAL), time ? time->minimum_s : HUGE_VAL});
    }
    for (const auto k : pareto_front(points)) fronts.insert(members[k]);
  }
  return fronts;
}

std::string fit_line(FittedError which, const ErrorFit& fit) {
  std::string text = fmt::format("  {} ", which == FittedError::final ? "final error:" : "energy error:");
  if (!fit.residual) return text + "no fit\n";
  std::string branches;
  const auto add = [&](const std::string& branch) { branches += (branches.empty() ? "" : ", ") + branch; };
  if (fit.order) add(fmt::format("{:.3g} dt^{:.2f}", *fit.constant, *fit.order));
  if (fit.walk) add(fmt::format("{:.3g} sqrt(n) u", *fit.walk));
  if (fit.drift) add(fmt::format("{:.3g} n u", *fit.drift));
  text += fmt::format("max({}), off by {:.2f} decades{}; ", branches, *fit.residual,
                      fit.bad ? " (not of this form)" : "");
  text += fmt::format("least {:.2e} at dt = {:.3g}", *fit.best_error, *fit.best_dt);
  if (fit.crossing_dt) return text + fmt::format(", rounding takes over at dt = {:.2g}\n", *fit.crossing_dt);
  return text + (fit.order ? ", rounding not reached\n" : ", rounding alone\n");
}

std::string shown_error(const std::optional<double>& x) {
  return x ? fmt::format("{:.3e}", *x) : "-";
}

void print_row(const WorkPrecisionRow& row, const std::optional<TimeSummary>& time, bool on_front,
               const std::optional<ErrorRegime>& regime) {
  const WorkOutcome& o = row.outcome;
  const std::string seconds = time ? shown_time(time->minimum_s) : "-";
  const std::string front = on_front ? "  *" : "";
  if (row.setting.integrator.empty()) {
    show("{:<16} {:<16} {:>12} ULP  relative {:>10}  {:>10} an evaluation{}{}\n", row.setting.name,
         row.setting.type, o.largest_error_ulp ? fmt::format("{:.4f}", *o.largest_error_ulp) : "-",
         shown_error(o.largest_error), seconds, front,
         o.why.empty() ? "" : fmt::format("  {}: {}", to_string(o.failure), o.why));
    return;
  }
  const std::string step =
      row.setting.dt.empty() ? fmt::format("{:.3g}", row.setting.dt_value) : row.setting.dt;
  if (o.failure != WorkFailure::none) {
    show("  {:>9} dt {:<10} {}: {}\n", row.setting.steps, step, to_string(o.failure), o.why);
    return;
  }
  show("  {:>9} dt {:<10} error {:>10}  largest {:>10}  energy {:>10}  {:>10} evaluations  {:>10}  {}{}{}\n",
       row.setting.steps, step, shown_error(o.final_error), shown_error(o.largest_error),
       shown_error(o.energy_error), o.evaluations, seconds, regime ? to_string(*regime) : "",
       o.t_s ? fmt::format("  t_s {}{:.3g} s", o.t_s_to_the_end ? ">= " : "", *o.t_s) : "", front);
}

}  // namespace

std::string_view to_string(FittedError which) {
  return which == FittedError::final ? "final_error" : "energy_error";
}

std::vector<WorkCurve> curves_of(const std::vector<WorkPrecisionRow>& rows) {
  std::vector<WorkCurve> curves;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].setting.integrator.empty()) continue;
    const auto [at, fresh] = known.emplace(rows[i].setting.curve(), curves.size());
    if (fresh) curves.emplace_back();
    curves[at->second].rows.push_back(i);
  }
  for (auto& c : curves) {
    c.final_fit = fit_of(rows, c.rows, FittedError::final);
    c.energy_fit = fit_of(rows, c.rows, FittedError::energy);
  }
  return curves;
}

std::string row_lines(const std::vector<WorkPrecisionRow>& rows, const std::string& plan) {
  std::vector<std::optional<ErrorRegime>> regimes(rows.size());
  for (const auto& c : curves_of(rows)) {
    for (std::size_t k = 0; k < c.rows.size(); ++k) regimes[c.rows[k]] = c.final_fit.regimes[k];
  }
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Json j = row_json(rows[i], regimes[i]);
    j["plan"] = plan;
    text += j.dump() + "\n";
  }
  return text;
}

std::string fit_lines(const std::vector<WorkPrecisionRow>& rows, const std::string& plan) {
  std::string text;
  for (const auto& c : curves_of(rows)) {
    const WorkSetting& s = rows[c.rows.front()].setting;
    text += fit_json(s, FittedError::final, c.final_fit, plan).dump() + "\n";
    if (c.energy_fit.residual) text += fit_json(s, FittedError::energy, c.energy_fit, plan).dump() + "\n";
  }
  return text;
}

std::string timing_lines(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times,
                         const std::string& plan) {
  const auto fronts = fronts_of(rows, times);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto time = times.summary(rows[i].setting.key());
    if (!time) continue;
    Json j = step_json(setting_json("work_precision_timing", rows[i].setting), rows[i].setting);
    j["key"] = rows[i].setting.key();
    j["seconds"] = time->minimum_s;
    j["median_s"] = time->median_s;
    j["spread_s"] = time->spread_s;
    j["repeats"] = time->repeats;
    j["noise_floor"] = times.noise();
    j["on_front"] = fronts.contains(i);
    j["samples_s"] = times.samples_s.at(rows[i].setting.key());
    j["plan"] = plan;
    text += j.dump() + "\n";
  }
  return text;
}

SettingTimes read_times(const std::filesystem::path& file, const std::string& plan) {
  SettingTimes times;
  if (!std::filesystem::exists(file)) return times;
  for (const auto& line : read_lines(file)) {
    const Json j = Json::parse(line, nullptr, false);
    if (!j.is_object() || j.value("plan", "") != plan) continue;
    const auto key = j.find("key");
    const auto samples = j.find("samples_s");
    if (key == j.end() || samples == j.end() || !key->is_string() || !samples->is_array()) continue;
    const bool numbers =
        std::ranges::all_of(*samples, [](const Json& x) { return x.is_number() && x.get<double>() > 0; });
    if (numbers) times.samples_s[key->get<std::string>()] = samples->get<std::vector<double>>();
  }
  return times;
}

std::string shown_time(double seconds) {
  for (const auto& [unit, size] : {std::pair("s", 1.0), {"ms", 1e-3}, {"us", 1e-6}})
    if (seconds >= size) return fmt::format("{:.3g} {}", seconds / size, unit);
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

void print_work_precision(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times) {
  const auto fronts = fronts_of(rows, times);
  const auto print = [&](std::size_t i, const std::optional<ErrorRegime>& regime) {
    print_row(rows[i], times.summary(rows[i].setting.key()), fronts.contains(i), regime);
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].setting.integrator.empty()) print(i, std::nullopt);
  for (const auto& c : curves_of(rows)) {
    const WorkSetting& s = rows[c.rows.front()].setting;
    show("{} to {}: {} {}\n", s.name, s.end, s.integrator, s.type);
    for (std::size_t k = 0; k < c.rows.size(); ++k) print(c.rows[k], c.final_fit.regimes[k]);
    show("{}", fit_line(FittedError::final, c.final_fit));
    if (c.energy_fit.residual) show("{}", fit_line(FittedError::energy, c.energy_fit));
  }
  if (!fronts.empty()) {
    show(
        "*: on the Pareto front of error and time (a gain in error of 2 % or less is none); times are good "
        "to {:.1f} % (a baseline's median over its "
        "minimum)\n",
        100 * times.noise());
  }
}

}  // namespace ulpgate::app
