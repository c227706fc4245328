// The steps of a history.
#include "harness/app/history/history_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/trend/level_steps.hpp"
#include "harness/core/trend/time_noise.hpp"

namespace ulpgate::app {

namespace {

std::string time_text(double seconds) {
  for (const auto& [unit, size] : {std::pair("s", 1.0), {"ms", 1e-3}, {"us", 1e-6}})
    if (seconds >= size) return fmt::format("{:.4g} {}", seconds / size, unit);
  return fmt::format("{:.4g} ns", seconds * 1e9);
}

// The fixed work of each run: typical time of all its samples; nothing where a run has none.
std::map<std::size_t, double> baselines(const std::map<RowKey, std::vector<TimePoint>>& rows) {
  std::map<std::size_t, std::vector<double>> samples;
  for (const auto& [key, points] : rows) {
    for (const auto& p : points)
      samples[p.run].insert(samples[p.run].end(), p.times.baseline_s.begin(), p.times.baseline_s.end());
  }
  std::map<std::size_t, double> found;
  for (const auto& [run, times] : samples)
    if (!times.empty()) found[run] = typical_time(times);
  return found;
}

double median_of(const std::map<std::size_t, double>& values) {
  std::vector<double> all;
  for (const auto& [run, value] : values) all.push_back(value);
  return all.empty() ? 1 : median(std::move(all));
}

}  // namespace

std::vector<HistoryStep> accuracy_steps(HistoryFile& file, const RowKey& key,
                                        const std::vector<RowPoint>& points) {
  std::vector<HistoryStep> steps;
  const auto& runs = file.runs();
  const RowKind* kind = find_row_kind(key.kind);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& platform = runs[points[i].run].platform;
    std::size_t before = i - 1;
    for (std::size_t k = i; k-- > 0;) {
      if (runs[points[k].run].platform != platform) continue;
      before = k;
      break;
    }
    if (points[before].result == points[i].result) continue;
    const RowResult old_result = file.result(points[before].result);
    const RowResult new_result = file.result(points[i].result);
    steps.push_back({key, points[i].run, points[before].run, change_of(kind, old_result, new_result),
                     change_text(kind, old_result, new_result),
                     platform_change(runs[points[before].run].platform, platform), false});
  }
  return steps;
}

SpeedHistory::SpeedHistory(const std::vector<HistoryRun>& runs, std::map<RowKey, std::vector<TimePoint>> rows)
    : runs_(runs) {
  const auto baseline = baselines(rows);
  const double usual = median_of(baseline);
  for (const auto& [key, points] : rows) {
    for (const auto& p : points) {
      const bool repeated = p.times.seconds.size() > 1;
      double log_time = std::log(typical_time(p.times.seconds));
      if (const auto it = baseline.find(p.run); repeated && it != baseline.end())
        log_time -= std::log(it->second / usual);
      rows_[key].push_back({lane_of(runs[p.run].platform, repeated), p.run, log_time});
    }
  }
  find_noise();
}

std::size_t SpeedHistory::lane_of(const std::map<std::string, std::string>& platform, bool repeated) {
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    if (lanes_[i].platform == platform && lanes_[i].repeated == repeated) return i;
  lanes_.push_back({platform, repeated, 0});
  return lanes_.size() - 1;
}

void SpeedHistory::find_noise() {
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    std::vector<std::vector<double>> values;
    for (const auto& [key, places] : rows_) {
      values.emplace_back();
      for (const auto& p : places)
        if (p.lane == lane) values.back().push_back(p.log_time);
    }
    lanes_[lane].noise = common_scatter(values);
  }
}

double SpeedHistory::noise() const {
  double largest = 0;
  for (const auto& lane : lanes_) largest = std::max(largest, lane.noise);
  return largest;
}

std::vector<RowKey> SpeedHistory::keys() const {
  std::vector<RowKey> keys;
  for (const auto& [key, places] : rows_) keys.push_back(key);
  return keys;
}

std::vector<SpeedHistory::Level> SpeedHistory::levels(const RowKey& key) const {
  std::vector<Level> levels;
  if (const auto it = rows_.find(key); it != rows_.end())
    for (const auto& p : it->second) levels.push_back({p.run, std::exp(p.log_time)});
  return levels;
}

HistoryStep SpeedHistory::step(const RowKey& key, const Place& before, const Place& after, double from,
                               double to, double p_value) const {
  const double percent = 100 * std::expm1(to - from);
  return {key,
          after.run,
          before.run,
          to > from ? Change::worse : Change::better,
          fmt::format("time {} -> {} ({:+.1f} %, p = {:.2g})", time_text(std::exp(from)),
                      time_text(std::exp(to)), percent, p_value),
          platform_change(runs_[before.run].platform, runs_[after.run].platform),
          true};
}

namespace {

std::vector<double> values_of(const auto& places) {
  std::vector<double> values;
  for (const auto& p : places) values.push_back(p.log_time);
  return values;
}

}  // namespace

std::optional<HistoryStep> SpeedHistory::step_between_lanes(const RowKey& key,
                                                            const std::vector<Place>& places,
                                                            std::size_t lane) const {
  const auto first = std::ranges::find(places, lane, &Place::lane);
  const Lane& here = lanes_[lane];
  // The lane of the latest run before it that can be compared.
  const auto comparable = [&](const Place& p) {
    const Lane& other = lanes_[p.lane];
    return p.lane != lane && other.repeated == here.repeated && other.platform.contains(processor_fact) &&
           here.platform.contains(processor_fact) &&
           other.platform.at(processor_fact) == here.platform.at(processor_fact);
  };
  auto last = first;
  while (last != places.begin() && !comparable(*std::prev(last))) --last;
  if (last == places.begin()) return std::nullopt;
  const std::size_t other = std::prev(last)->lane;
  std::vector<Place> before;
  std::vector<Place> after;
  std::copy_if(places.begin(), last, std::back_inserter(before),
               [&](const Place& p) { return p.lane == other; });
  std::ranges::copy_if(places, std::back_inserter(after), [&](const Place& p) { return p.lane == lane; });
  const double noise = std::max(here.noise, lanes_[other].noise);
  auto old_values = values_of(before);
  auto new_values = values_of(after);
  if (const auto steps = level_steps(old_values, noise); !steps.empty())
    old_values.erase(old_values.begin(), old_values.begin() + static_cast<std::ptrdiff_t>(steps.back().at));
  if (const auto steps = level_steps(new_values, noise); !steps.empty()) new_values.resize(steps.front().at);
  LevelStep found;
  if (!is_step(old_values, new_values, noise, StepRule{}, found)) return std::nullopt;
  return step(key, before.back(), after.front(), found.before, found.after, found.p_value);
}

std::vector<HistoryStep> SpeedHistory::steps(const RowKey& key) const {
  std::vector<HistoryStep> all;
  const auto it = rows_.find(key);
  if (it == rows_.end()) return all;
  const std::vector<Place>& places = it->second;
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    std::vector<Place> mine;
    std::ranges::copy_if(places, std::back_inserter(mine), [&](const Place& p) { return p.lane == lane; });
    if (mine.empty()) continue;
    if (const auto found = step_between_lanes(key, places, lane)) all.push_back(*found);
    const auto values = values_of(mine);
    for (const auto& s : level_steps(values, lanes_[lane].noise))
      all.push_back(step(key, mine[s.at - 1], mine[s.at], s.before, s.after, s.p_value));
  }
  std::ranges::stable_sort(all, {}, &HistoryStep::run);
  return all;
}

std::vector<HistoryStep> all_steps(HistoryFile& file) {
  std::vector<HistoryStep> all;
  for (const auto& [key, points] : file.rows())
    for (auto& step : accuracy_steps(file, key, points)) all.push_back(std::move(step));
  const SpeedHistory speed(file.runs(), file.times());
  for (const auto& key : speed.keys())
    for (auto& step : speed.steps(key)) all.push_back(std::move(step));
  std::ranges::stable_sort(all, {}, [](const HistoryStep& s) { return std::pair(s.run, s.is_speed); });
  return all;
}

}  // namespace ulpgate::app
