// SceneJob: a request to scene, steps and plan.
#include "harness/app/scenes/scene_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "harness/app/shell/selection.hpp"
#include "harness/app/shell/strict_options.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/orders/order_engine.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "kernels/scenes/reader/scene_steps.hpp"

namespace ulpgate::app {

namespace {

constexpr std::string_view leapfrog = "leapfrog";

Failure refused(const std::string& option, const std::string& value, const std::string& why) {
  return {Standing::bad_input, fmt::format("{} '{}': {}", option, value, why)};
}

void check_integrator(const std::string& name) {
  std::vector<std::string> splitting;
  for (const auto& i : ode::integrators()) {
    if (i.kind == ode::IntegratorKind::splitting) {
      splitting.push_back(i.name);
    } else if (i.name == name) {
      throw refused("--integrator", name, "is no splitting method, which alone integrate scenes");
    }
  }
  if (std::ranges::find(splitting, name) == splitting.end()) unknown_name("integrator", name, splitting);
}

// Options of their own would otherwise stand twice, and the record name one of the two.
void check_overrides(const std::vector<std::string>& overrides) {
  for (const auto& text : overrides) {
    const std::string key = text.substr(0, text.find('='));
    if (key == "dt" || key == "until")
      throw Failure(Standing::bad_input, fmt::format("--set {}: use --{}", text, key));
  }
}

// An option that changes one number of the scene.
void change(LoadedScene& loaded, const std::string& key, const std::optional<std::string>& value) {
  if (!value) return;
  if (const auto error = scenes::apply_override(loaded.scene, key + "=" + *value))
    throw refused("--" + key, *value, error->message);
  loaded.text += "\n# " + key + "=" + *value;
}

std::uint64_t steps_of(const LoadedScene& loaded, const SceneRequest& request) {
  // A step of the scene that is none is refused whatever the run's length.
  const std::uint64_t steps = scenes::steps_until_end(loaded.scene);
  if (request.steps) return parse_steps("--steps", *request.steps);
  if (steps == 0 || steps > most_steps) {
    throw refused(
        request.until ? "--until" : request.name + ": run.until", loaded.scene.until,
        fmt::format("{} steps of {} s: a run takes 1 to {}",
                    steps > most_steps ? "too many" : std::to_string(steps), loaded.scene.dt, most_steps));
  }
  return steps;
}

std::vector<std::uint64_t> snapshot_steps_of(const LoadedScene& loaded, const std::string& text,
                                             std::uint64_t steps) {
  std::vector<std::uint64_t> found;
  scenes::Evaluator<double> evaluate;
  for (const auto& [name, value] : loaded.scene.constants) evaluate.define(name, evaluate(value));
  for (const auto& time : split(text, ',')) {
    try {
      const double seconds = evaluate(time);
      if (!std::isfinite(seconds) || seconds < 0)
        throw refused("--snapshots", text, fmt::format("{} s is no time of the run", time));
      found.push_back(scenes::steps_for(loaded.scene, time));
    } catch (const scenes::ExpressionError& e) {
      throw refused("--snapshots", text, e.what());
    }
    if (found.back() > steps)
      throw refused("--snapshots", text, fmt::format("{} s lies beyond the end of the run", time));
  }
  if (found.empty()) throw refused("--snapshots", text, "names no time");
  return found;
}

}  // namespace

std::uint64_t parse_steps(const std::string& option, const std::string& text) {
  std::uint64_t steps = 0;
  const char* end = text.data() + text.size();
  if (count_fault(text).empty()) std::from_chars(text.data(), end, steps);
  if (steps == 0 || steps > most_steps)
    throw refused(option, text, fmt::format("want a whole number from 1 to {}", most_steps));
  return steps;
}

SceneJob make_job(const SceneRequest& request) {
  check_overrides(request.overrides);
  SceneJob job;
  job.loaded = load_scene(request.name, request.overrides);
  scenes::Scene& scene = job.loaded.scene;
  change(job.loaded, "dt", request.dt);
  change(job.loaded, "until", request.until);
  // A record of a run keeps the energy account unless the scene's author left it out on purpose for a
  // comparison.
  if (request.energy && !scene.records("energy")) {
    scene.record.emplace_back("energy");
    job.loaded.text += "\n# record energy";
  }
  try {
    job.steps = steps_of(job.loaded, request);
    job.record_every = scenes::steps_between_records(scene);
  } catch (const scenes::SceneFault& fault) {
    throw scene_failure(request.name, fault);
  } catch (const scenes::ExpressionError& error) {
    throw Failure(Standing::bad_input, request.name + ": " + error.what());
  }
  if (request.snapshots) job.snapshot_steps = snapshot_steps_of(job.loaded, *request.snapshots, job.steps);
  check_integrator(request.integrator);
  job.variant = fmt::format("{}", fmt::join(request.overrides, ","));
  job.integrator = request.integrator;
  job.threads = request.threads;
  job.all_parts = request.all_parts;
  job.allow_large = request.allow_large;
  job.collisions = request.collisions;
  if (job.collisions && job.integrator != leapfrog)
    throw refused("--integrator", job.integrator, "takes scenes of bonds alone, which have no --collisions");
  const std::string integrator = job.integrator == leapfrog ? "" : "integrator " + job.integrator + "\n";
  job.plan_text = fmt::format("ulpgate scene plan\n{}steps {}\nscene {:016x}\n{}\n", integrator, job.steps,
                              fnv1a(job.loaded.text), job.loaded.text);
  job.plan = fmt::format("{:016x}", fnv1a(job.plan_text));
  return job;
}

Failure scene_failure(const std::string& what, const scenes::SceneFault& fault) {
  const bool large = dynamic_cast<const scenes::SceneTooLarge*>(&fault) != nullptr;
  return {Standing::bad_input, fmt::format("{}: {}{}", what, fault.what(),
                                           large ? "; --allow-large takes what memory holds" : "")};
}

void check_job(const SceneJob& job, const std::vector<std::string>& types) {
  const std::string& name = job.loaded.scene.name;
  for (const auto& token : types) {
    const auto engine = engine_of(token, dem::Level::own, job);
    if (const auto lost = engine->not_finite())
      throw Failure(Standing::bad_input,
                    fmt::format("{} in {}: {} is not finite at the start", name, token, lost->text()));
    if (job.allow_large) continue;
    const double work = static_cast<double>(engine->bodies()) * static_cast<double>(job.steps);
    if (work > most_body_steps)
      throw Failure(Standing::bad_input,
                    fmt::format("{}: {} steps of {} bodies are more than {:g} steps of a body: with "
                                "--allow-large they are taken",
                                name, job.steps, engine->bodies(), most_body_steps));
  }
  if (!job.allow_large && job.record_every != 0 && job.steps / job.record_every > most_records)
    throw Failure(Standing::bad_input,
                  fmt::format("{}: {} records are more than {}: with --allow-large they are made", name,
                              job.steps / job.record_every, most_records));
}

std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level, const SceneJob& job) {
  std::unique_ptr<dem::DemEngine> engine;
  try {
    engine = dem::make_engine(
        token, level, job.loaded.scene,
        {job.all_parts, job.threads, job.allow_large, &Heartbeat::mine().steps(), job.collisions});
  } catch (const scenes::SceneFault& fault) {
    const std::string type = level == dem::Level::own ? token : "RealHP<4> of " + token;
    throw scene_failure(fmt::format("{} in {}", job.loaded.scene.name, type), fault);
  }
  if (job.integrator == leapfrog) return engine;
  try {
    engine->set_flow(find_order_engine(token)->flow(job.integrator));
  } catch (const std::invalid_argument& e) {
    throw Failure(Standing::bad_input, fmt::format("--integrator {}: {}", job.integrator, e.what()));
  }
  return engine;
}

Velocities velocities_of(const SceneJob& job) {
  return job.integrator == leapfrog ? Velocities::half_step : Velocities::on_step;
}

std::string name_of(Velocities velocities) {
  return velocities == Velocities::half_step ? "half_step" : "on_step";
}

}  // namespace ulpgate::app
