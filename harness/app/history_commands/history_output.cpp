// What ulpgate history prints.
#include "harness/app/history_commands/history_output.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace ulpgate::app {

namespace {

constexpr std::size_t width = 14;
// Wider tables are read by nobody: the columns go below each other.
constexpr std::size_t most_columns = 7;

std::string date_of(const HistoryRun& run) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(run.time_s)));
}

std::string row_start(const HistoryRun& run) {
  return fmt::format("  {:<18} {:<10}", short_commit(run.commit), date_of(run));
}

// Of a column, without what all columns share: "uniform", "real.hard", "time".
std::string title_of(const RowKey& key) {
  if (key.kind == "time") return "time";
  std::string title = key.part.empty() || key.part == "value" ? "" : key.part + ".";
  title += key.setting.empty() ? key.kind : key.setting.substr(0, key.setting.find(' '));
  return title.size() <= width - 1 ? title : title.substr(0, width - 1);
}

std::string block_of(const std::vector<HistoryRun>& runs, std::span<const TrendColumn> columns) {
  std::string text = fmt::format("  {:<18} {:<10}", "commit", "date");
  for (const auto& c : columns) text += fmt::format(" {:>{}}", title_of(c.key), width);
  text += "\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto there = [&](const TrendColumn& c) { return !c.texts[i].empty(); };
    if (std::ranges::none_of(columns, there)) continue;
    text += row_start(runs[i]);
    for (const auto& c : columns)
      text += fmt::format(" {:>{}}", c.texts[i].empty() ? "-" : c.texts[i], width);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string short_commit(const std::string& commit) {
  const bool hash = commit.size() >= 40 && std::ranges::all_of(commit.substr(0, 40), [](char c) {
                      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
                    });
  return hash ? commit.substr(0, 12) + commit.substr(40) : commit;
}

std::string sparkline(std::span<const std::optional<double>> values) {
  constexpr std::array<const char*, 8> blocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  for (const auto& x : values) {
    if (!x || !std::isfinite(*x)) continue;
    least = std::min(least, *x);
    largest = std::max(largest, *x);
  }
  std::string text;
  for (const auto& x : values) {
    if (!x) {
      text += ".";
    } else if (!std::isfinite(*x)) {
      text += "!";
    } else {
      const double part = largest > least ? (*x - least) / (largest - least) : 0;
      text += blocks[std::min<std::size_t>(7, static_cast<std::size_t>(part * 8))];
    }
  }
  return text;
}

std::string trend_table(const std::vector<HistoryRun>& runs, const std::vector<TrendColumn>& columns) {
  std::string text;
  for (std::size_t first = 0; first < columns.size(); first += most_columns) {
    const auto part = std::span(columns).subspan(first, std::min(most_columns, columns.size() - first));
    text += block_of(runs, part) + "\n";
  }
  for (const auto& c : columns) {
    std::vector<std::optional<double>> shown;
    for (const auto& x : c.values)
      if (x) shown.push_back(x);
    text += fmt::format("  {}  {}{}{}\n", sparkline(shown), c.key.text(), c.unit.empty() ? "" : ", ", c.unit);
  }
  return text;
}

std::string step_line(const std::vector<HistoryRun>& runs, const HistoryStep& step) {
  const HistoryRun& run = runs[step.run];
  std::string word(to_string(step.change));
  std::ranges::transform(word, word.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format("{:<7} {} at {} ({}), before it {}: {}{}\n", word, step.key.text(),
                     short_commit(run.commit), date_of(run), short_commit(runs[step.before].commit),
                     step.text, step.platform.empty() ? "" : "; with it " + step.platform);
}

Json run_json(const HistoryRun& run) {
  Json platform = Json::object();
  for (const auto& [name, value] : run.platform) platform[name] = value;
  return {{"commit", run.commit}, {"time_s", run.time_s}, {"verb", run.verb}, {"platform", platform}};
}

Json step_json(const std::vector<HistoryRun>& runs, const HistoryStep& step) {
  return {{"kind", step.key.kind},
          {"name", step.key.name},
          {"part", step.key.part},
          {"type", step.key.type},
          {"setting", step.key.setting},
          {"what", step.is_speed ? "speed" : "accuracy"},
          {"change", to_string(step.change)},
          {"commit", runs[step.run].commit},
          {"before", runs[step.before].commit},
          {"text", step.text},
          {"platform", step.platform}};
}

}  // namespace ulpgate::app
