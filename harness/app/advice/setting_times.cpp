// The clock.
#include "harness/app/advice/setting_times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/app/machine/environment.hpp"
#include "harness/app/run/baseline.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/core/trend/interleaved_order.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "harness/core/watch/stopwatch.hpp"

namespace ulpgate::app {

namespace {

// A sample of less is of too few ticks.
constexpr double least_sample_s = 2e-3;
constexpr int baseline_operations = 400'000;
constexpr auto keep_interval = std::chrono::seconds(5);

class TimedRounds {
 public:
  TimedRounds(const std::vector<const SettingMeasurement*>& settings, unsigned repeats, SettingTimes& times,
              const std::function<void()>& keep)
      : repeats_(repeats), times_(times), keep_(keep), progress_("timing") {
    for (const auto* s : settings)
      if (s->outcome().failure == WorkFailure::none) settings_.push_back(s);
  }

  void run() {
    const std::size_t all = settings_.size() * (repeats_ + 1);
    for (unsigned round = 0; round <= repeats_; ++round) {
      std::size_t done = settings_.size() * round;
      for (const auto i : interleaved_order(settings_.size(), round)) {
        if (interrupted()) throw ode::Stopped();
        time_one(*settings_[i], round);
        progress_.update(static_cast<double>(++done), static_cast<double>(all));
      }
    }
  }

 private:
  void time_one(const SettingMeasurement& setting, unsigned round) {
    auto& samples = times_.samples_s[setting.setting().key()];
    const WorkPlace place(setting.setting().key(), "", "timing");
    const ode::StopFlag stop(interrupt_flag(), &Heartbeat::mine().steps());
    if (round == 0) {
      // The warm-up counts for what is timed once.
      if (!samples.empty()) return;
      const double first_s = in_checked_environment([&] { return sample_of(setting, stop); });
      if (first_s * static_cast<double>(setting.parts_of_repeat()) > single_run_s) add(samples, first_s);
      return;
    }
    const bool once =
        !samples.empty() && samples.front() * static_cast<double>(setting.parts_of_repeat()) > single_run_s;
    if (once || samples.size() >= round) return;
    times_.baseline_s.push_back(baseline_sample_s(baseline_operations));
    add(samples, in_checked_environment([&] { return sample_of(setting, stop); }));
  }

  void add(std::vector<double>& samples, double seconds) {
    samples.push_back(seconds);
    if (!keep_ || Clock::now() - kept_ < keep_interval) return;
    kept_ = Clock::now();
    keep_();
  }

  unsigned repeats_;
  SettingTimes& times_;
  const std::function<void()>& keep_;
  Progress progress_;
  std::vector<const SettingMeasurement*> settings_;
  Clock::time_point kept_ = Clock::now();
};

}  // namespace

std::optional<TimeSummary> SettingTimes::summary(const std::string& key) const {
  const auto it = samples_s.find(key);
  if (it == samples_s.end() || it->second.empty()) return std::nullopt;
  return summarize_times(it->second);
}

double sample_of(const SettingMeasurement& setting, const ode::StopFlag& stop) {
  double seconds = 0;
  std::uint64_t runs = 0;
  auto work = setting.prepare();
  while (true) {
    const auto start = Clock::now();
    work(stop);
    seconds += seconds_since(start);
    ++runs;
    if (seconds >= least_sample_s) break;
    // What a run wears out is made anew where no clock sees it.
    if (setting.parts_of_repeat() == 1) work = setting.prepare();
  }
  return seconds / static_cast<double>(runs * setting.parts_of_repeat());
}

bool time_settings(const std::vector<const SettingMeasurement*>& settings, unsigned repeats,
                   SettingTimes& times, const std::function<void()>& keep) {
  const InterruptGuard guard;
  try {
    TimedRounds(settings, repeats, times, keep).run();
    return true;
  } catch (const ode::Stopped&) {
    return false;
  }
}

}  // namespace ulpgate::app
