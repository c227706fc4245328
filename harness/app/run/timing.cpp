// Timing.
#include "harness/app/run/timing.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

#include "harness/app/shell/progress.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/subject/registry.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_of(const TimedBatch& batch, std::size_t count, int rounds) {
  const auto start = Clock::now();
  for (int i = 0; i < rounds; ++i) {
    Heartbeat::mine().beat(WorkPhase::none);
    batch(count);
  }
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr std::size_t batch_size = 512;

// `batch` holds batch_size points.
TimingRecord measure(std::string_view what, const std::string& token, const TimedBatch& batch) {
  constexpr double enough_s = 5e-4;
  constexpr int repeats = 7;
  // The warm-up finds how much one repeat must hold: a part of the batch for slow types, many rounds for fast
  // ones.
  const double first_s = seconds_of(batch, 32, 1);
  const std::size_t count = first_s > 2e-3 ? 32 : batch_size;
  int rounds = 1;
  while (seconds_of(batch, count, rounds) < enough_s) rounds *= 2;
  double best_s = seconds_of(batch, count, rounds);
  for (int i = 1; i < repeats; ++i) best_s = std::min(best_s, seconds_of(batch, count, rounds));
  const double evaluations = static_cast<double>(count) * rounds;
  return {std::string(what), token, 1e9 * best_s / evaluations, repeats, count};
}

}  // namespace

std::vector<TimingRecord> measure_times(const PlanRequest& request) {
  std::vector<TimingRecord> records;
  Progress progress("timing");
  for (const auto& token : request.types) {
    for (const auto& name : request.subjects) {
      const WorkPlace place(name, token, "timing");
      records.push_back(measure(name, token, find_subject(name, token)->timed_batch(batch_size)));
      progress.update(static_cast<double>(records.size()),
                      static_cast<double>(request.types.size() * request.subjects.size()));
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
