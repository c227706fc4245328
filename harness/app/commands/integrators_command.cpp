// ulpgate integrators: the order of every integrator, measured on exactly solved problems, and its energy
// drift.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/orders/order_engine.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

namespace {

struct IntegratorOptions {
  std::string integrators = "all";
  std::string types = "double";
  std::string problems = "all";
  long most_steps = 2048;
  long drift_units = 0;
  long steps_per_unit = 64;
  double tolerance = 0.25;
  std::string out;
  bool json = false;
};

std::vector<std::string> names_of_integrators() {
  std::vector<std::string> names;
  for (const auto& i : ode::integrators()) names.push_back(i.name);
  return names;
}

std::vector<std::string> chosen(const std::string& text, const std::string& what,
                                const std::vector<std::string>& known) {
  if (text == "all") return known;
  const auto names = split(text, ',');
  for (const auto& name : names) {
    if (std::ranges::find(known, name) == known.end()) unknown_name(what, name, known);
  }
  return names;
}

Json number_or_null(const std::optional<double>& x) {
  return x ? Json(*x) : Json(nullptr);
}

struct Outcome {
  std::string text;  // lines of orders.jsonl
  std::vector<std::string> wrong;
};

void measure_order(const OrderEngine& engine, const ode::IntegratorInfo& info, const std::string& problem,
                   const IntegratorOptions& o, Outcome& outcome) {
  const OrderLadder ladder = engine.ladder(info.name, problem, o.most_steps);
  for (const auto& rung : ladder.rungs) {
    // A method that chooses its order has none to be held against.
    if (!info.order) break;
    const Json j = {{"what", "order"},      {"integrator", info.name},
                    {"order", *info.order}, {"type", engine.token()},
                    {"problem", problem},   {"t_end", ladder.t_end},
                    {"dt", rung.dt},        {"steps", rung.steps},
                    {"error", rung.error},  {"measured_order", number_or_null(rung.order)}};
    outcome.text += j.dump() + "\n";
  }
  double least = HUGE_VAL;
  for (const auto& rung : ladder.rungs) least = std::min(least, rung.error);
  const std::string measured =
      ladder.measured_order ? fmt::format("{:.3f}", *ladder.measured_order) : "at the floor at once";
  if (!o.json) {
    fmt::print(
        "{:<20} {:<16} {:<12} order {:>5}  measured {:<20}  least error {:.2e} at {} steps on t = {:.2g}\n",
        info.name, engine.token(), problem, info.order ? std::to_string(*info.order) : "free", measured,
        least, ladder.rungs.back().steps, ladder.t_end);
  }
  // Only an order that is too low is wrong: symmetry may give more.  With few rungs above the floor it is not
  // yet asymptotic, and nothing is judged.
  if (info.order && ladder.measured_order && ladder.rungs.size() >= 6 &&
      *ladder.measured_order < *info.order - std::max(o.tolerance, 0.05 * *info.order))
    outcome.wrong.push_back(fmt::format("{} {} {}: order {:.3f} measured, {} expected", info.name,
                                        engine.token(), problem, *ladder.measured_order, *info.order));
}

void measure_drift(const OrderEngine& engine, const ode::IntegratorInfo& info, const std::string& problem,
                   const IntegratorOptions& o, Outcome& outcome) {
  const EnergyDrift drift = engine.drift(info.name, problem, o.steps_per_unit, o.drift_units);
  const Json j = {{"what", "drift"},
                  {"integrator", info.name},
                  {"type", engine.token()},
                  {"problem", problem},
                  {"dt", 1.0 / static_cast<double>(o.steps_per_unit)},
                  {"t_end", o.drift_units},
                  {"max_energy_error", drift.largest()},
                  {"energy_slope", number_or_null(drift.slope())}};
  outcome.text += j.dump() + "\n";
  if (!o.json) {
    fmt::print("{:<20} {:<16} {:<12} largest energy error {:.3e} over {} units of {} steps, slope {}\n",
               info.name, engine.token(), problem, drift.largest(), o.drift_units, o.steps_per_unit,
               drift.slope() ? fmt::format("{:.2f}", *drift.slope()) : "-");
  }
}

ExitCode run_integrators(const IntegratorOptions& o) {
  const auto types = select_types(o.types);
  const auto integrators = chosen(o.integrators, "integrator", names_of_integrators());
  const InterruptGuard guard;
  Outcome outcome;
  Progress progress("integrators");
  double done = 0;
  const double all = static_cast<double>(types.size() * integrators.size());
  for (const auto& token : types) {
    const OrderEngine& engine = *find_order_engine(token);
    const auto problems = chosen(o.problems, "problem", engine.problems());
    for (const auto& name : integrators) {
      const auto& info = ode::find_integrator(name);
      for (const auto& problem : problems) {
        if (interrupted()) throw Failure(ExitCode::incomplete, "interrupted; nothing is written");
        if (!engine.applies(name, problem)) continue;
        if (o.drift_units != 0) {
          measure_drift(engine, info, problem, o, outcome);
        } else {
          measure_order(engine, info, problem, o, outcome);
        }
      }
      // Minutes may pass until the next line.
      std::fflush(stdout);
      progress.update(++done, all);
    }
  }
  if (outcome.text.empty())
    throw Failure(ExitCode::incomplete,
                  "no integrator applies to the problem: splitting methods need q'' = a(q)");
  if (o.json) fmt::print("{}", outcome.text);
  if (!o.out.empty()) {
    make_directory(o.out);
    const std::filesystem::path out = o.out;
    const std::string plan =
        fmt::format("ulpgate integrators plan\nintegrators {}\nproblems {}\nmost_steps {}\ndrift {} {}\n",
                    o.integrators, o.problems, o.most_steps, o.drift_units, o.steps_per_unit);
    write_file(out / (o.drift_units != 0 ? "drift.jsonl" : "orders.jsonl"), outcome.text);
    const Json context = make_scene_context(fmt::format("{:016x}", fnv1a(plan)), plan, types, 1, true);
    write_file(out / "context.json", context.dump(2) + "\n");
  }
  for (const auto& line : outcome.wrong) fmt::print("FAIL {}\n", line);
  return outcome.wrong.empty() ? ExitCode::pass : ExitCode::regression;
}

}  // namespace

void add_integrators_command(CLI::App& app, Action& action) {
  auto* verb = app.add_subcommand(
      "integrators", "Measure the order or the energy drift of integrators on exactly solved problems");
  auto o = std::make_shared<IntegratorOptions>();
  verb->add_option("--integrators", o->integrators, "all or names (`ulpgate list integrators`)")
      ->capture_default_str();
  verb->add_option("--type,--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  verb->add_option("--problems", o->problems, "all, or of oscillator, pendulum, kepler, rigid_body")
      ->capture_default_str();
  verb->add_option("--most-steps", o->most_steps, "steps double from 1 up to this")
      ->capture_default_str()
      ->check(CLI::Range(8L, 1L << 24));
  verb->add_option("--tolerance", o->tolerance, "an order lower by more, and by 5 %, is a failure")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--drift", o->drift_units,
                   "measure the energy error along that many units of time instead")
      ->check(CLI::Range(1L, 1L << 40));
  verb->add_option("--steps-per-unit", o->steps_per_unit,
                   "with --drift: steps in a unit of time; a power of two keeps the step exact")
      ->capture_default_str()
      ->check(CLI::Range(1L, 1L << 30));
  verb->add_option("--out", o->out, "directory of orders.jsonl (drift.jsonl) and context.json");
  verb->add_flag("--json", o->json, "print the records");
  verb->callback([=, &action] { action = [=] { return run_integrators(*o); }; });
}

}  // namespace ulpgate::app
