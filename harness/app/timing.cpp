// Timing.
#include "harness/app/timing.hpp"

#include <algorithm>
#include <chrono>

#include "harness/app/crash_report.hpp"
#include "harness/app/progress.hpp"
#include "harness/app/records.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_of(TimedBatch& batch, std::size_t count, int rounds) {
  const auto start = Clock::now();
  for (int i = 0; i < rounds; ++i) batch.run(count);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

TimingRecord measure(const TypeEngine& engine, const FunctionInfo& f) {
  constexpr std::size_t batch_size = 512;
  constexpr double enough_s = 5e-4;
  constexpr int repeats = 7;
  const auto batch = engine.timed_batch(f, batch_size);
  // The warm-up finds how much one repeat must hold: a part of the batch for slow types, many rounds for fast
  // ones.
  const double first_s = seconds_of(*batch, 32, 1);
  const std::size_t count = first_s > 2e-3 ? 32 : batch_size;
  int rounds = 1;
  while (seconds_of(*batch, count, rounds) < enough_s) rounds *= 2;
  double best_s = seconds_of(*batch, count, rounds);
  for (int i = 1; i < repeats; ++i) best_s = std::min(best_s, seconds_of(*batch, count, rounds));
  const double evaluations = static_cast<double>(count) * rounds;
  return {std::string(f.name), engine.descriptor().token, 1e9 * best_s / evaluations, repeats, count};
}

}  // namespace

std::vector<TimingRecord> measure_times(const PlanRequest& request) {
  std::vector<TimingRecord> records;
  Progress progress("timing");
  for (const auto& token : request.types) {
    for (const auto id : request.functions) {
      const CrashPlace place(info_of(id).name, token, "timing");
      records.push_back(measure(*find_engine(token), info_of(id)));
      progress.update(static_cast<double>(records.size()),
                      static_cast<double>(request.types.size() * request.functions.size()));
    }
  }
  return records;
}

std::string timing_text(const std::vector<TimingRecord>& records) {
  std::string text;
  for (const auto& r : records) {
    const Json j = {{"what", r.what},
                    {"type", r.type},
                    {"ns_per_eval", r.ns_per_eval},
                    {"repeats", r.repeats},
                    {"batch", r.batch}};
    text += j.dump() + "\n";
  }
  return text;
}

}  // namespace ulpgate::app
