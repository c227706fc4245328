// Benchmarks of the DEM: every kernel of every type on typical states, and steps of the scenes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "harness/app/scenes/scene_files.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/dem/engine/engine.hpp"

namespace {

constexpr std::size_t batch = 256;

void kernel(benchmark::State& state, const ulpgate::Subject* subject) {
  const auto timed = subject->timed_batch(batch);
  for (auto _ : state) timed(batch, 1);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch));
}

// Steps from the start of the scene on; a scene that changes its character does so in every type alike. Short
// ones are taken many at a time, as a run does between two looks at the scene.
void scene(benchmark::State& state, const std::string& token, const std::string& name, bool all_parts) {
  const auto loaded = ulpgate::app::load_scene(name, {});
  const auto engine =
      ulpgate::dem::make_engine(token, ulpgate::dem::Level::own, loaded.scene, {all_parts, 1});
  engine->step(1);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  engine->step(1);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const auto steps = static_cast<std::uint64_t>(std::clamp(1e-4 / seconds, 1.0, 256.0));
  for (auto _ : state) engine->step(steps);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps));
}

[[maybe_unused]] const bool registered = [] {
  for (const auto& subject : ulpgate::all_subjects()) {
    if (subject->info().kind != ulpgate::SubjectKind::kernel) continue;
    benchmark::RegisterBenchmark(("kernel/" + subject->name() + "/" + subject->type().token).c_str(), kernel,
                                 subject.get());
  }
  for (const auto& type : ulpgate::all_types()) {
    const std::string& token = type.token;
    for (const auto& builtin : ulpgate::app::builtin_scenes()) {
      const std::string name = "scene/" + std::string(builtin.name) + "/" + token;
      benchmark::RegisterBenchmark(name.c_str(), scene, token, std::string(builtin.name), false);
      benchmark::RegisterBenchmark((name + "/all_parts").c_str(), scene, token, std::string(builtin.name),
                                   true);
    }
  }
  return true;
}();

}  // namespace
