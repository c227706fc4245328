// The steps of a history: which run changed which row, and what else changed with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/app/history/history_file.hpp"

namespace ulpgate::app {

// Records are deterministic: any other figure is a step.  A run is held to the one before it on the same
// platform, and the first run of a platform to the run before it, so that two platforms may take turns.  In
// the order of runs.
[[nodiscard]] std::vector<HistoryStep> accuracy_steps(HistoryFile& file, const RowKey& key,
                                                      const std::vector<RowPoint>& points);

// Levels of time.  Runs of one platform, in order; each run's time is typical_time of its repeats, over the
// run's baseline as far as that differs from the other runs'.  The noise is common to all rows of that
// platform.  A platform's first level is held to the last one of the platform before it where the processor
// is the same.
class SpeedHistory {
 public:
  SpeedHistory(const std::vector<HistoryRun>& runs, std::map<RowKey, std::vector<TimePoint>> rows);

  struct Level {
    std::size_t run = 0;
    double seconds = 0;  // corrected by the baseline
  };
  [[nodiscard]] std::vector<Level> levels(const RowKey& key) const;
  [[nodiscard]] std::vector<HistoryStep> steps(const RowKey& key) const;
  [[nodiscard]] std::vector<RowKey> keys() const;
  // Of equal work from run to run, as a difference of logarithms: the largest of the platforms'.
  [[nodiscard]] double noise() const;

 private:
  // Runs whose times can stand beside each other without a question: of one platform, with or without
  // repeats.
  struct Lane {
    std::map<std::string, std::string> platform;
    bool repeated = false;
    double noise = 0;
  };
  struct Place {
    std::size_t lane = 0;
    std::size_t run = 0;
    double log_time = 0;
  };
  std::size_t lane_of(const std::map<std::string, std::string>& platform, bool repeated);
  void find_noise();
  [[nodiscard]] HistoryStep step(const RowKey& key, const Place& before, const Place& after, double from,
                                 double to, double p_value) const;
  [[nodiscard]] std::optional<HistoryStep> step_between_lanes(const RowKey& key,
                                                              const std::vector<Place>& places,
                                                              std::size_t lane) const;

  const std::vector<HistoryRun>& runs_;
  std::vector<Lane> lanes_;
  std::map<RowKey, std::vector<Place>> rows_;
};

// All of them, by run; the accuracy of a run before its speed.
[[nodiscard]] std::vector<HistoryStep> all_steps(HistoryFile& file);

}  // namespace ulpgate::app
