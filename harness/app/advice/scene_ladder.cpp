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

struct TimedRung {
  SceneRung rung;
  double dt_s;
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

std::vector<TimedRung> rungs_of_list(const SceneRequest& base, const std::string& list, double until_s) {
  std::vector<TimedRung> rungs;
  for (const auto& dt : split(list, ',')) {
    const double dt_s = dt_of(job_at(base, dt));
    rungs.push_back({{dt, whole_steps(until_s, dt_s, dt)}, dt_s});
  }
  if (rungs.empty()) throw Failure(Standing::bad_input, fmt::format("--dt '{}': names no step", list));
  std::ranges::stable_sort(rungs, {}, [](const auto& r) { return r.rung.steps; });
  const SceneRung& coarsest = rungs.front().rung;
  const double first = static_cast<double>(coarsest.steps) * rungs.front().dt_s;
  for (const auto& [rung, dt_s] : rungs) {
    const double end = static_cast<double>(rung.steps) * dt_s;
    if (std::fabs(end - first) <= 1e-9 * first) continue;
    throw Failure(
        Standing::bad_input,
        fmt::format("--dt '{}': {} steps of {} end at {} s and {} of {} at {} s: errors are of one time; "
                    "give another --until",
                    list, coarsest.steps, coarsest.dt, first, rung.steps, rung.dt, end));
  }
  return rungs;
}

std::vector<TimedRung> halved_rungs(const SceneRequest& base, const std::string& own, double until_s,
                                    int coarser, int finer) {
  std::vector<TimedRung> rungs;
  const double dt_s = dt_of(job_at(base, own));
  // A run of few steps of the scene's own has none so coarse.
  while (coarser > 0 && until_s < std::ldexp(dt_s, coarser) * 8) --coarser;
  const std::uint64_t coarsest = whole_steps(until_s, std::ldexp(dt_s, coarser), scaled_dt(own, coarser));
  for (int k = coarser; k >= -finer; --k)
    rungs.push_back(
        {{scaled_dt(own, k), coarsest << static_cast<unsigned>(coarser - k)}, std::ldexp(dt_s, k)});
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
  ladder.own_end_s = dt_of(job) * static_cast<double>(job.steps);
  const double until_s = until.empty() ? default_until_s(job) : ladder.own_end_s;
  const auto rungs = dt.empty() ? halved_rungs(base, job.loaded.scene.dt, until_s, coarser, finer)
                                : rungs_of_list(base, dt, until_s);
  std::vector<std::uint64_t> steps;
  for (const auto& [rung, dt_s] : rungs) {
    ladder.rungs.push_back(rung);
    steps.push_back(rung.steps);
  }
  ladder.scene = base;
  ladder.scene.dt = ladder.rungs.front().dt;
  ladder.scene.steps = std::to_string(steps.front());
  ladder.until_s = static_cast<double>(steps.front()) * rungs.front().dt_s;
  ladder.end = fmt::format("{:.12g}", ladder.until_s);
  ladder.instants = instants_of(job, dt_of(job), steps, ladder.until_s);
  return ladder;
}

std::vector<std::string> admitted(const SceneLadder& ladder, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (const auto& name : names)
    if (admits(ladder.scene, rough_type(), name)) found.push_back(name);
  return found;
}

SceneRung rung_between(const SceneLadder& ladder, double halvings) {
  const SceneRung& coarsest = ladder.rungs.front();
  const auto every = static_cast<double>(ladder.instants.records);
  const double wanted = static_cast<double>(coarsest.steps) * std::exp2(halvings);
  const auto steps = static_cast<std::uint64_t>(every * std::max(1.0, std::round(wanted / every)));
  for (const auto& rung : ladder.rungs)
    if (rung.steps == steps) return rung;
  return {fmt::format("{}*{}/{}", scaled_dt(coarsest.dt, 0), coarsest.steps, steps), steps};
}

std::unique_ptr<SceneSetting> scene_setting(const SceneLadder& ladder, const SceneRung& rung,
                                            const std::string& type, const std::string& integrator,
                                            const SharedReference& reference) {
  SceneRequest scene = ladder.scene;
  scene.dt = rung.dt;
  scene.steps = std::to_string(rung.steps);
  scene.integrator = integrator;
  WorkSetting s{WorkSubject::scene,
                make_job(scene).loaded.scene.name,
                type,
                integrator,
                ladder.end,
                rung.dt,
                rung.steps,
                ladder.until_s / static_cast<double>(rung.steps)};
  return std::make_unique<SceneSetting>(std::move(s), std::move(scene), ladder.instants, reference);
}

}  // namespace ulpgate::app
