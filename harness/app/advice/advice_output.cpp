// Advice in words and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/advice/advice.hpp"
#include "harness/app/advice/work_precision_output.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

Json place_json(const AdvicePlace& p) {
  const WorkSetting& s = p.row.setting;
  const WorkOutcome& o = p.row.outcome;
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json j = {{"type", s.type}, {"integrator", s.integrator}, {"steps", s.steps}, {"dt", s.dt_value}};
  if (!s.dt.empty()) j["dt_text"] = s.dt;
  if (s.planned()) j["planned"] = true;
  j["failure"] = o.failure == WorkFailure::none ? Json(nullptr) : Json(to_string(o.failure));
  if (!o.why.empty()) j["why"] = o.why;
  j["final_error"] = number(o.final_error);
  j["largest_error"] = number(o.largest_error);
  j["energy_error"] = number(o.energy_error);
  j["reference_error"] = number(o.reference_error);
  j["evaluations"] = o.evaluations;
  j["seconds"] = p.seconds;
  j["from"] = p.place.empty() ? "measured here" : p.place;
  return j;
}

std::string curve_words(const AdviceCase::Choice& choice) {
  return choice.type + " " + choice.integrator +
         (choice.steps == AdviceCase::Steps::planned ? " planned" : "");
}

// The front of what was looked at, and how each curve ended.
void print_looked_at(const Advice& advice, const AdviceCase& c) {
  std::vector<WorkPoint> points;
  for (std::size_t i = 0; i < advice.search.points.size(); ++i)
    points.push_back({advice.search.points[i].certain_error(), advice.places[i].seconds});
  show("Pareto front of the {} settings looked at (errors with that of the truth added):\n", points.size());
  for (const auto i : pareto_front(points)) {
    const WorkSetting& s = advice.places[i].row.setting;
    show("  {:<16} {:<22} {:>9} steps  error {:.2e}  {:>10}{}\n", s.type, s.integrator, s.steps,
         points[i].error, shown_time(points[i].seconds), s.planned() ? "  " + s.dt : "");
  }
  std::map<std::string, std::vector<std::string>> ends;
  for (std::size_t k = 0; k < c.choices().size(); ++k) {
    const CurveEnd end = advice.search.ends[k];
    if (end != CurveEnd::met && end != CurveEnd::too_dear)
      ends[std::string(to_string(end))].push_back(curve_words(c.choices()[k]));
  }
  for (const auto& [why, names] : ends) {
    std::string list;
    constexpr std::size_t most = 6;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) list += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > most) list += fmt::format(" and {} more", names.size() - most);
    show("  {}: {}\n", why, list);
  }
}

}  // namespace

Json advice_json(const Advice& advice, const AdviceCase& c, const AdviceOptions& o) {
  Json j = {{"what", "advice"},
            {"name", o.name},
            {"wanted_error", o.error},
            {"most_seconds", o.time_s},
            {"error_is", c.error_words()},
            {"met", advice.best.has_value()}};
  const auto which = advice.best ? advice.best : advice.nearest;
  j["setting"] = which ? place_json(advice.places[*which]) : Json(nullptr);
  j["limited_by"] = advice.limit;
  j["measured_order"] = advice.measured_order ? Json(*advice.measured_order) : Json(nullptr);
  if (which) {
    const WorkSetting& s = advice.places[*which].row.setting;
    j["contacts"] = c.contact_words(s);
    j["command"] = c.run_command(s);
    j["measure_again"] = c.measure_command(s);
  }
  j["noise_floor"] = advice.times.noise();
  j["looked_at"] = Json::array();
  for (const auto& p : advice.places) j["looked_at"].push_back(place_json(p));
  j["curves"] = Json::array();
  for (std::size_t k = 0; k < c.choices().size(); ++k) {
    j["curves"].push_back({{"type", c.choices()[k].type},
                           {"integrator", c.choices()[k].integrator},
                           {"planned", c.choices()[k].steps == AdviceCase::Steps::planned},
                           {"ended", to_string(advice.search.ends[k])}});
  }
  return j;
}

void print_advice(const Advice& advice, const AdviceCase& c, const AdviceOptions& o) {
  show("{}: wanted {:g}, {}\n", o.name, o.error, c.error_words());
  const auto which = advice.best ? advice.best : advice.nearest;
  if (!which) {
    show("no setting gave a number at all\n");
  } else {
    const AdvicePlace& p = advice.places[*which];
    const WorkSetting& s = p.row.setting;
    const WorkOutcome& w = p.row.outcome;
    show("{}: {} {}, {}\n", advice.best ? "cheapest of those measured" : "none meets it; the nearest", s.type,
         s.integrator, c.step_words(s));
    show(
        "  error {:.3e} at the end, {:.3e} the largest at {} times on the way; the truth is good to {:.1e}\n",
        w.error().value_or(HUGE_VAL), w.largest_error.value_or(HUGE_VAL), w.instants.value_or(1),
        w.reference_error.value_or(0));
    show("  {} a run (noise {:.1f} %), {} evaluations{}\n", shown_time(p.seconds), 100 * advice.times.noise(),
         w.evaluations, s.planned() ? "; finding the steps, once in double, not counted" : "");
    show("  limited by {}\n", advice.limit);
    if (const std::string contacts = c.contact_words(s); !contacts.empty()) show("  {}\n", contacts);
    show("  run:            {}\n", c.run_command(s));
    if (c.measure_command(s) != c.run_command(s)) show("  measure again:  {}\n", c.measure_command(s));
  }
  print_looked_at(advice, c);
  std::size_t recorded = 0;
  for (const auto& p : advice.places) recorded += p.place.empty() ? 0 : 1;
  show("rests on {} settings measured now and {} of records\n", advice.places.size() - recorded, recorded);
  for (const auto& p : advice.places)
    if (!p.place.empty()) show("  {}\n", p.place);
}

}  // namespace ulpgate::app
