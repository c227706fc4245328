// SceneJob: options to scene, steps and plan.
#include "harness/app/scenes/scene_job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/orders/order_engine.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/scene_steps.hpp"

namespace ulpgate::app {

namespace {

constexpr std::string_view leapfrog = "leapfrog";

void check_integrator(const std::string& name) {
  std::vector<std::string> splitting;
  for (const auto& i : ode::integrators()) {
    if (i.kind == ode::IntegratorKind::splitting) splitting.push_back(i.name);
  }
  if (std::ranges::find(splitting, name) == splitting.end())
    unknown_name("integrator of scenes", name, splitting);
}

}  // namespace

SceneJob make_job(const SceneOptions& o) {
  SceneJob job;
  auto overrides = o.overrides;
  if (!o.dt.empty()) overrides.push_back("dt=" + o.dt);
  if (!o.until.empty()) overrides.push_back("until=" + o.until);
  job.loaded = load_scene(o.name, overrides);
  scenes::Scene& scene = job.loaded.scene;
  // A record of a run keeps the energy account unless the scene's author left it out on purpose for a
  // comparison.
  if ((o.record || o.series) && !scene.records("energy")) {
    scene.record.emplace_back("energy");
    job.loaded.text += "\n# record energy";
  }
  job.steps = o.steps != 0 ? o.steps : scenes::steps_until_end(scene);
  if (job.steps == 0) throw Failure(ExitCode::bad_input, fmt::format("{}: no step to take", o.name));
  job.record_every = scenes::steps_between_records(scene);
  for (const auto& time : split(o.snapshots, ',')) {
    try {
      job.snapshot_steps.push_back(scenes::steps_for(scene, time));
    } catch (const scenes::ExpressionError& e) {
      throw Failure(ExitCode::bad_input, fmt::format("--snapshots: {}", e.what()));
    }
  }
  check_integrator(o.integrator);
  const std::string integrator = o.integrator == leapfrog ? "" : "integrator " + o.integrator + "\n";
  job.plan_text = fmt::format("ulpgate scene plan\n{}steps {}\nscene {:016x}\n{}\n", integrator, job.steps,
                              fnv1a(job.loaded.text), job.loaded.text);
  job.plan = fmt::format("{:016x}", fnv1a(job.plan_text));
  return job;
}

std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level, const SceneJob& job,
                                          const SceneOptions& o, bool all_parts) {
  auto engine = dem::make_engine(token, level, job.loaded.scene, {all_parts, o.threads});
  if (o.integrator == leapfrog) return engine;
  try {
    engine->set_flow(find_order_engine(token)->flow(o.integrator));
  } catch (const std::invalid_argument& e) {
    throw Failure(ExitCode::bad_input, fmt::format("--integrator {}: {}", o.integrator, e.what()));
  }
  return engine;
}

}  // namespace ulpgate::app
