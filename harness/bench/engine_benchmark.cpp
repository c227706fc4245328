// Benchmarks of the engine, every real function in every type: a bare evaluation, one judged by the screened
// reference, with the share of samples that each of its stages decides, and one judged by the full reference.
//
//   engine_benchmark --benchmark_filter='/(sin|exp)/(double|long_double)'
#include <benchmark/benchmark.h>

#include "harness/core/subject/registry.hpp"

namespace {

using ulpgate::ReferenceMode;
using ulpgate::Subject;

void bare(benchmark::State& state, const Subject* subject) {
  // As many as branch predictors do not learn: a run meets no argument twice.
  constexpr std::size_t batch = 65536;
  const auto timed = subject->timed_batch(batch);
  for (auto _ : state) timed(batch, 1);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch));
}

// Successive units of one row, as in a run: what earlier units found lets later ones skip.
void judged(benchmark::State& state, const Subject* subject, ReferenceMode mode) {
  const std::uint64_t unit = mode == ReferenceMode::full ? 256 : 4096;
  const ulpgate::StratumSource source{ulpgate::Stratum::uniform, 1, std::uint64_t{1} << 40U, nullptr};
  ulpgate::RowHint hint(subject->info().parts.size());
  std::uint64_t first = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(subject->evaluate(source, first, first + unit, mode, hint));
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
  for (const auto* real : ulpgate::subjects_of(ulpgate::SubjectKind::function)) {
    if (real->subject_class != "real") continue;
    for (const auto& type : ulpgate::all_types()) {
      const Subject* subject = ulpgate::find_subject(real->name, type.token);
      const std::string name = "/" + real->name + "/" + type.token;
      benchmark::RegisterBenchmark(("bare" + name).c_str(), bare, subject);
      benchmark::RegisterBenchmark(("screened" + name).c_str(), judged, subject, ReferenceMode::screened);
      benchmark::RegisterBenchmark(("full" + name).c_str(), judged, subject, ReferenceMode::full);
    }
  }
  return true;
}();

}  // namespace
