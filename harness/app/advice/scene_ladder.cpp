// SceneLadder: a scene at several steps that all end at the same time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/advice/work_precision_job.hpp"
#include "harness/app/shell/selection.hpp"

namespace ulpgate::app {

namespace {

constexpr double longest_default_s = 1;
constexpr double most_default_body_steps = 2e6;

// The job's step in s, to the digits of a double.
double dt_of(const SceneJob& job) {
  const auto engine = engine_of(rough_type(), dem::Level::own, job);
  engine->step(1);
  return engine->time_s();
}

struct Rung {
  std::string dt;
  double dt_s;
  std::uint64_t steps;
};

SceneJob job_at(SceneRequest request, const std::string& dt) {
  request.dt = dt;
  request.steps = "1";
  return make_job(request);
}

std::uint64_t whole_steps(double until_s, double dt_s, const std::string& dt) {
  const double steps = std::round(until_s / dt_s);
  if (!(steps >= 1) || steps > static_cast<double>(most_steps))
    throw Failure(Standing::bad_input, fmt::format("--until {:g}: {:g} steps of {} s: a run takes 1 to {}",
                                                   until_s, steps, dt, most_steps));
  return static_cast<std::uint64_t>(steps);
}

std::vector<Rung> rungs_of_list(const SceneRequest& base, const std::string& list, double until_s) {
  std::vector<Rung> rungs;
  for (const auto& dt : split(list, ',')) {
    const double dt_s = dt_of(job_at(base, dt));
    rungs.push_back({dt, dt_s, whole_steps(until_s, dt_s, dt)});
  }
  if (rungs.empty()) throw Failure(Standing::bad_input, fmt::format("--dt '{}': names no step", list));
  std::ranges::stable_sort(rungs, {}, &Rung::steps);
  for (const auto& rung : rungs) {
    const double end = static_cast<double>(rung.steps) * rung.dt_s;
    const double first = static_cast<double>(rungs.front().steps) * rungs.front().dt_s;
    if (std::fabs(end - first) <= 1e-9 * first) continue;
    throw Failure(
        Standing::bad_input,
        fmt::format("--dt '{}': {} steps of {} end at {} s and {} of {} at {} s: errors are of one time; "
                    "give another --until",
                    list, rungs.front().steps, rungs.front().dt, first, rung.steps, rung.dt, end));
  }
  return rungs;
}

std::vector<Rung> halved_rungs(const SceneRequest& base, const std::string& own, double until_s, int coarser,
                               int finer) {
  std::vector<Rung> rungs;
  const double dt_s = dt_of(job_at(base, own));
  // A run of few steps of the scene's own has none so coarse.
  while (coarser > 0 && until_s < std::ldexp(dt_s, coarser) * 8) --coarser;
  const std::uint64_t coarsest = whole_steps(until_s, std::ldexp(dt_s, coarser), scaled_dt(own, coarser));
  for (int k = coarser; k >= -finer; --k)
    rungs.push_back({scaled_dt(own, k), std::ldexp(dt_s, k), coarsest << static_cast<unsigned>(coarser - k)});
  return rungs;
}

}  // namespace

double default_until_s(const SceneJob& job) {
  const double dt_s = dt_of(job);
  const auto engine = engine_of(rough_type(), dem::Level::own, job);
  const double steps = std::min(static_cast<double>(job.steps),
                                most_default_body_steps / static_cast<double>(engine->bodies()));
  return std::min(longest_default_s, dt_s * std::max(1.0, std::floor(steps)));
}

SceneLadder scene_ladder(const std::string& name, const std::vector<std::string>& overrides,
                         const std::string& dt, const std::string& until, int coarser, int finer) {
  SceneLadder ladder;
  SceneRequest base;
  base.name = name;
  base.overrides = overrides;
  SceneRequest whole = base;
  if (!until.empty()) whole.until = until;
  const SceneJob job = make_job(whole);
  const double until_s = until.empty() ? default_until_s(job) : dt_of(job) * static_cast<double>(job.steps);
  const auto rungs = dt.empty() ? halved_rungs(base, job.loaded.scene.dt, until_s, coarser, finer)
                                : rungs_of_list(base, dt, until_s);
  for (const auto& rung : rungs) {
    ladder.dts.push_back(rung.dt);
    ladder.steps.push_back(rung.steps);
  }
  ladder.scene = base;
  ladder.scene.dt = rungs.front().dt;
  ladder.scene.steps = std::to_string(rungs.front().steps);
  ladder.until_s = static_cast<double>(rungs.front().steps) * rungs.front().dt_s;
  ladder.end = fmt::format("{:.12g}", ladder.until_s);
  ladder.instants = instants_of(job, dt_of(job), ladder.steps, ladder.until_s);
  return ladder;
}

std::vector<std::string> admitted(const SceneLadder& ladder, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (const auto& name : names)
    if (admits(ladder.scene, rough_type(), name)) found.push_back(name);
  return found;
}

std::unique_ptr<SceneSetting> scene_setting(const SceneLadder& ladder, std::size_t k, const std::string& type,
                                            const std::string& integrator, const SharedReference& reference) {
  SceneRequest scene = ladder.scene;
  scene.dt = ladder.dts[k];
  scene.steps = std::to_string(ladder.steps[k]);
  scene.integrator = integrator;
  WorkSetting s{WorkSubject::scene,
                make_job(scene).loaded.scene.name,
                type,
                integrator,
                ladder.end,
                ladder.dts[k],
                ladder.steps[k],
                ladder.until_s / static_cast<double>(ladder.steps[k])};
  return std::make_unique<SceneSetting>(std::move(s), std::move(scene), ladder.instants, reference);
}

}  // namespace ulpgate::app
