// Benchmarks of the engine: a bare evaluation against a judged one, screened and full, per type, for a few
// functions.
#include <benchmark/benchmark.h>

#include "harness/core/type_engine.hpp"

namespace {

constexpr std::size_t batch = 256;

void bare(benchmark::State& state, const ulpgate::TypeEngine* engine, ulpgate::FunctionInfo f) {
  const auto timed = engine->timed_batch(f, batch);
  for (auto _ : state) timed->run(batch);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch));
}

void judged(benchmark::State& state, const ulpgate::TypeEngine* engine, ulpgate::FunctionInfo f,
            ulpgate::ReferenceMode mode) {
  ulpgate::RowHint hint(f.parts);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        engine->evaluate(f, {ulpgate::Stratum::uniform, 1, batch, nullptr}, 0, batch, mode, hint));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch));
}

[[maybe_unused]] const bool registered = [] {
  using enum ulpgate::FunctionId;
  for (const auto& engine : ulpgate::all_engines()) {
    for (const auto id : {add, sin, exp, pow, tgamma}) {
      const auto& f = ulpgate::info_of(id);
      const std::string name = std::string(f.name) + "/" + engine->descriptor().token;
      benchmark::RegisterBenchmark(("bare/" + name).c_str(), bare, engine.get(), f);
      benchmark::RegisterBenchmark(("screened/" + name).c_str(), judged, engine.get(), f,
                                   ulpgate::ReferenceMode::screened);
      benchmark::RegisterBenchmark(("full/" + name).c_str(), judged, engine.get(), f,
                                   ulpgate::ReferenceMode::full);
    }
  }
  return true;
}();

}  // namespace
