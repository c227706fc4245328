// The clock: times of settings, interleaved, with a baseline between them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/core/work_precision/setting_measurement.hpp"
#include "harness/core/work_precision/time_summary.hpp"

namespace ulpgate::app {

// A run that lasts over this is timed once.
inline constexpr double single_run_s = 2;

// Seconds of one run (one evaluation of a function or a kernel), round by round, by the settings' keys.
struct SettingTimes {
  std::map<std::string, std::vector<double>> samples_s;
  std::vector<double> baseline_s;

  [[nodiscard]] std::optional<TimeSummary> summary(const std::string& key) const;
  [[nodiscard]] double noise() const { return noise_floor(baseline_s); }
};

// Times the settings that did not fail, in `repeats` rounds of one thread, each in another order, after a
// warm-up that decides what is timed once; between any two a baseline of fixed work.  What `times` holds
// already is taken for done.  `keep` is called now and then with what there is.  Returns whether all was
// timed: Ctrl-C ends it.
[[nodiscard]] bool time_settings(const std::vector<const SettingMeasurement*>& settings, unsigned repeats,
                                 SettingTimes& times, const std::function<void()>& keep);

// One sample, s.
[[nodiscard]] double sample_of(const SettingMeasurement& setting, const ode::StopFlag& stop);

}  // namespace ulpgate::app
