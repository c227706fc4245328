// Benchmarks of the engine, every real function in every type: a bare evaluation, one judged by the screened
// reference, with the share of samples that each of its stages decides, and one judged by the full reference.
//
//   engine_benchmark --benchmark_filter='/(sin|exp)/(double|long_double)'
#include <benchmark/benchmark.h>

#include "harness/core/subject/type_engine.hpp"

namespace {

using ulpgate::FunctionInfo;
using ulpgate::ReferenceMode;
using ulpgate::TypeEngine;

void bare(benchmark::State& state, const TypeEngine* engine, const FunctionInfo* f) {
  constexpr std::size_t batch = 256;
  const auto timed = engine->timed_batch(*f, batch);
  for (auto _ : state) timed->run(batch);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch));
}

// Successive units of one row, as in a run: what earlier units found lets later ones skip.
void judged(benchmark::State& state, const TypeEngine* engine, const FunctionInfo* f, ReferenceMode mode) {
  const std::uint64_t unit = mode == ReferenceMode::full ? 256 : 4096;
  const ulpgate::StratumSource source{ulpgate::Stratum::uniform, 1, std::uint64_t{1} << 40U, nullptr};
  ulpgate::RowHint hint(f->parts);
  std::uint64_t first = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(engine->evaluate(*f, source, first, first + unit, mode, hint));
    first += unit;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(first));
  for (std::size_t s = 0; s < ulpgate::stage_count; ++s) {
    const auto decided = static_cast<double>(hint.decided[s].load());
    if (decided > 0)
      state.counters[std::string(ulpgate::stage_names[s])] = decided / static_cast<double>(first);
  }
}

[[maybe_unused]] const bool registered = [] {
  for (const auto& f : ulpgate::all_functions()) {
    if (f.function_class != ulpgate::FunctionClass::real) continue;
    for (const auto& engine : ulpgate::all_engines()) {
      const std::string name = "/" + std::string(f.name) + "/" + engine->descriptor().token;
      benchmark::RegisterBenchmark(("bare" + name).c_str(), bare, engine.get(), &f);
      benchmark::RegisterBenchmark(("screened" + name).c_str(), judged, engine.get(), &f,
                                   ReferenceMode::screened);
      benchmark::RegisterBenchmark(("full" + name).c_str(), judged, engine.get(), &f, ReferenceMode::full);
    }
  }
  return true;
}();

}  // namespace
