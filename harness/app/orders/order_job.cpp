// OrderJob.
#include "harness/app/orders/order_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

namespace {

std::vector<std::string> names_of_integrators() {
  std::vector<std::string> names;
  for (const auto& i : ode::integrators()) names.push_back(i.name);
  return names;
}

// "all" or names, in the order of `known`, each once.
std::vector<std::string> select_integrators(const std::string& text) {
  const auto known = names_of_integrators();
  const auto chosen = text == "all" ? known : split(text, ',');
  for (const auto& name : chosen) {
    if (std::ranges::find(known, name) == known.end()) unknown_name("integrator", name, known);
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, "--integrators names no integrator");
  auto out = known;
  std::erase_if(out, [&](const auto& name) { return std::ranges::find(chosen, name) == chosen.end(); });
  return out;
}

std::vector<std::string> select_problems(const std::string& text, const std::vector<std::string>& known) {
  const auto chosen = text == "all" ? known : split(text, ',');
  for (const auto& name : chosen) {
    if (std::ranges::find(known, name) == known.end()) {
      throw Failure(Standing::bad_input,
                    fmt::format("unknown problem '{}'; there are {}", name, fmt::join(known, ", ")));
    }
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, "--problems names no problem");
  auto out = known;
  std::erase_if(out, [&](const auto& name) { return std::ranges::find(chosen, name) == chosen.end(); });
  return out;
}

// A guess for what a step costs: which measurements are the long ones, and the first time left.
double prior_cost_of_step(const ode::IntegratorInfo& info, const RealDescriptor& type) {
  double evaluations = info.evaluations_per_step.value_or(100);
  if (info.kind == ode::IntegratorKind::collocation) {
    // Sweeps over the stages, each of which sums over all of them.
    const double stages = *info.order / 2.0;
    evaluations = 10 * stages * (1 + stages / 4);
  }
  const double operation =
      type.format.precision <= 64 ? 1 : 20 + static_cast<double>(type.format.precision) / 10;
  return evaluations * operation;
}

}  // namespace

OrderJob make_order_job(const OrderOptions& o) {
  if (o.drift_units > (1L << 60) / o.steps_per_unit)
    throw Failure(Standing::bad_input, "--drift times --steps-per-unit: more than 2^60 steps");
  OrderJob job;
  job.types = select_types(o.types);
  const auto integrators = select_integrators(o.integrators);
  std::vector<std::string> problems;
  for (const auto& token : job.types) {
    const OrderEngine& engine = *find_order_engine(token);
    problems = select_problems(o.problems, engine.problems());
    for (const auto& name : integrators) {
      const auto& info = ode::find_integrator(name);
      const std::size_t group = job.costs.empty() ? 0 : job.costs.back().group + 1;
      for (const auto& problem : problems) {
        if (!engine.applies(name, problem)) continue;
        OrderRow row{info, token, problem};
        if (o.drift_units != 0) {
          auto drift = engine.drift(name, problem, o.steps_per_unit, o.drift_units);
          row.drift = drift.get();
          job.measurements.push_back(std::move(drift));
        } else {
          auto ladder = engine.ladder(name, problem, o.most_steps);
          row.ladder = ladder.get();
          job.measurements.push_back(std::move(ladder));
        }
        job.rows.push_back(row);
        job.costs.push_back({group, prior_cost_of_step(info, type_or_fail(token)), 0});
      }
    }
  }
  if (job.rows.empty()) {
    throw Failure(Standing::incomplete,
                  "no integrator applies to the problem: splitting methods need q'' = a(q)");
  }
  job.plan_text =
      fmt::format("ulpgate integrators plan 2\ntypes {}\nintegrators {}\nproblems {}\n",
                  fmt::join(job.types, " "), fmt::join(integrators, " "), fmt::join(problems, " "));
  job.plan_text += o.drift_units != 0
                       ? fmt::format("drift {} steps_per_unit {}\n", o.drift_units, o.steps_per_unit)
                       : fmt::format("most_steps {} tolerance {:a}\n", o.most_steps, o.tolerance);
  job.plan = fmt::format("{:016x}", fnv1a(job.plan_text));
  return job;
}

}  // namespace ulpgate::app
