// ulpgate scene explain: what a scene leaves out, and the time of a step with and without.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "harness/app/scene_commands/scene_commands.hpp"
#include "harness/app/scene_commands/scene_options.hpp"
#include "harness/app/scenes/watched_steps.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

double seconds_per_step(dem::DemEngine& engine, const SceneJob& job) {
  using Clock = std::chrono::steady_clock;
  take_steps(engine, 1, job);
  // Grow the count until it takes long enough to be told from the clock's grain; keep the best of three.
  double best = HUGE_VAL;
  std::uint64_t count = 1;
  for (int kept = 0; kept < 3;) {
    const auto start = Clock::now();
    take_steps(engine, count, job);
    const double taken = std::chrono::duration<double>(Clock::now() - start).count();
    if (taken < 0.05) {
      count *= 4;
      continue;
    }
    best = std::min(best, taken / static_cast<double>(count));
    ++kept;
  }
  return best;
}

void explain(const std::string& token, const SceneJob& job) {
  SceneJob with_all = job;
  with_all.all_parts = true;
  const auto lean = engine_of(token, dem::Level::own, job);
  const auto full = engine_of(token, dem::Level::own, with_all);
  show("{} in {}\n", job.loaded.scene.name, token);
  for (const auto& part : lean->explain().left_out) show("  left out: {:<12} {}\n", part.part, part.why);
  if (lean->explain().left_out.empty()) show("  nothing is left out\n");
  const std::size_t lean_bytes = lean->memory_bytes();
  const std::size_t full_bytes = full->memory_bytes();
  const double lean_ns = seconds_per_step(*lean, job) * 1e9;
  const double full_ns = seconds_per_step(*full, with_all) * 1e9;
  show("  {:<22} {:>14.1f} ns  {:>12} bytes\n", "step as it is", lean_ns, lean_bytes);
  show("  {:<22} {:>14.1f} ns  {:>12} bytes  {:.2f} times slower\n", "step with all parts", full_ns,
       full_bytes, full_ns / lean_ns);
}

}  // namespace

void add_scene_explain_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  add_scene_verb(
      scene, action, "explain", "Print what a scene leaves out, and the time of a step with and without",
      {"ulpgate scene explain pendulum3",
       "ulpgate scene explain deposition --types float,double --threads 2"},
      o,
      [o](CLI::App& verb) {
        add_model_options(verb, *o);
        add_threads_option(verb, *o);
      },
      [o] {
        const SceneTask task = make_task(*o, "scene explain");
        for (const auto& token : task.types) explain(token, task.job);
        return Standing::pass;
      });
}

}  // namespace ulpgate::app
