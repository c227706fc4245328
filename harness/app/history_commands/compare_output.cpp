// What ulpgate compare prints.
#include "harness/app/history_commands/compare_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

std::string percent(double ratio) {
  return fmt::format("{:+.1f} %", 100 * (ratio - 1));
}

std::string keys_text(const char* words, const std::vector<RowKey>& keys, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, keys.size()); ++i)
    text += fmt::format("{:<8} {}\n", words, keys[i].text());
  if (keys.size() > most) text += fmt::format("{:<8} ... {} rows in all\n", words, keys.size());
  return text;
}

std::string counts_text(const Comparison& c) {
  const RunDifferences& f = c.found;
  std::string text = fmt::format("{} rows in both: {} the same, {} worse, {} better, {} another", f.compared,
                                 f.compared - f.rows.size(), f.count(Change::worse), f.count(Change::better),
                                 f.count(Change::other));
  text += fmt::format("; {} only in {}, {} only in {}", f.only_before.size(), c.before.directory.string(),
                      f.only_after.size(), c.after.directory.string());
  return text;
}

std::string times_counts(const RunDifferences& f) {
  if (!f.times_not_judged.empty()) return "times are not judged: " + f.times_not_judged;
  return fmt::format("{} times: {} slower, {} faster; less than {:.1f} % is noise", f.times.size(),
                     f.count_times(Change::worse), f.count_times(Change::better), 100 * std::expm1(f.noise));
}

std::string machines_text(const Comparison& c) {
  std::string text = c.found.platform;
  if (c.before.version != c.after.version)
    text += fmt::format("{}ulpgate {} -> {}", text.empty() ? "" : ", ", c.before.version, c.after.version);
  return text.empty() ? "the same" : text;
}

std::string implementations(const RowDifference& row) {
  if (row.before.implementation == row.after.implementation) return row.after.implementation;
  return row.before.implementation + " -> " + row.after.implementation;
}

std::string time_of(double seconds) {
  return seconds < 1e-6 ? fmt::format("{:.4g} ns", 1e9 * seconds) : fmt::format("{:.4g} us", 1e6 * seconds);
}

// A vertical bar would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

Json key_json(const RowKey& key) {
  return {{"kind", key.kind},
          {"name", key.name},
          {"part", key.part},
          {"type", key.type},
          {"setting", key.setting}};
}

Json error_json(const std::optional<double>& x) {
  if (!x || std::isnan(*x)) return nullptr;
  return std::isinf(*x) ? Json("inf") : Json(*x);
}

Json side_json(const SummaryRow& row) {
  return {{"error", error_json(row.result.error)},
          {"argument", row.result.argument},
          {"mismatches", row.result.mismatches},
          {"implementation", row.implementation}};
}

Json keys_json(const std::vector<RowKey>& keys) {
  Json rows = Json::array();
  for (const auto& key : keys) rows.push_back(key_json(key));
  return rows;
}

}  // namespace

namespace {

// A word at the head of a line, in the colour of its change.
std::string padded(Change change, std::string_view word) {
  const std::string text = fmt::format("{:<8}", word);
  if (change == Change::worse) return painted(Paint::bad, text);
  return change == Change::better ? painted(Paint::good, text) : text;
}

std::string word_of(Change change) {
  return padded(change, to_string(change));
}

}  // namespace

std::string comparison_text(const Comparison& c, std::size_t most) {
  // What it came to stands first.
  std::string text =
      fmt::format("{}\n{}\nplatform {}\n", counts_text(c), times_counts(c.found), machines_text(c));
  std::array<std::size_t, 4> shown{};
  for (const auto& row : c.found.rows) {
    if (++shown[static_cast<std::size_t>(row.change)] > most) continue;
    text +=
        fmt::format("{} {}: {}{}\n", word_of(row.change), row.key.text(), row.text,
                    row.before.implementation == row.after.implementation ? "" : "; " + implementations(row));
  }
  for (const auto change : {Change::worse, Change::better, Change::other})
    if (c.found.count(change) > most)
      text += fmt::format("{} ... {} rows in all\n", word_of(change), c.found.count(change));
  text += keys_text("lost", c.found.only_before, most) + keys_text("new", c.found.only_after, most);
  for (const auto& row : c.found.times) {
    if (row.change == Change::none) continue;
    text += fmt::format("{} {}: {} -> {}, {} (p = {:.2g})\n",
                        padded(row.change, row.change == Change::worse ? "slower" : "faster"), row.key.text(),
                        time_of(row.before_s), time_of(row.after_s), percent(row.ratio), row.p_value);
  }
  return text;
}

std::string comparison_markdown(const Comparison& c, std::size_t most) {
  std::string text =
      fmt::format("## `{}` beside `{}`\n\n* {}\n* {}\n* platform: {}\n", c.after.directory.string(),
                  c.before.directory.string(), counts_text(c), times_counts(c.found), machines_text(c));
  if (!c.found.rows.empty()) {
    text += "\n| | row | figures | code |\n|---|---|---|---|\n";
    for (std::size_t i = 0; i < std::min(most, c.found.rows.size()); ++i) {
      const auto& row = c.found.rows[i];
      text += fmt::format("| {} | `{}` | {} | {} |\n", to_string(row.change), cell(row.key.text()),
                          cell(row.text), cell(implementations(row)));
    }
    if (c.found.rows.size() > most) text += fmt::format("\n{} rows in all.\n", c.found.rows.size());
  }
  std::string times;
  for (const auto& row : c.found.times) {
    if (row.change == Change::none) continue;
    times += fmt::format("| {} | `{}` | {} | {} | {} | {:.2g} |\n",
                         row.change == Change::worse ? "slower" : "faster", cell(row.key.text()),
                         time_of(row.before_s), time_of(row.after_s), percent(row.ratio), row.p_value);
  }
  if (!times.empty())
    text += "\n| | row | before | after | change | p |\n|---|---|---|---|---|---|\n" + times;
  for (const auto& key : c.found.only_before) {
    if (&key == &c.found.only_before.front()) text += "\nRows that are no longer there:\n\n";
    if (static_cast<std::size_t>(&key - c.found.only_before.data()) < most)
      text += fmt::format("* `{}`\n", key.text());
  }
  return text;
}

std::string comparison_json(const Comparison& c) {
  Json rows = Json::array();
  for (const auto& row : c.found.rows) {
    Json j = key_json(row.key);
    j["change"] = to_string(row.change);
    j["before"] = side_json(row.before);
    j["after"] = side_json(row.after);
    j["figures"] = row.text;
    rows.push_back(j);
  }
  Json times = Json::array();
  for (const auto& row : c.found.times) {
    Json j = key_json(row.key);
    j["change"] = row.change == Change::none ? "the same" : row.change == Change::worse ? "slower" : "faster";
    j["before_s"] = row.before_s;
    j["after_s"] = row.after_s;
    j["ratio"] = row.ratio;
    j["p_value"] = row.p_value;
    times.push_back(j);
  }
  const Json all = {{"before", c.before.directory.string()},
                    {"after", c.after.directory.string()},
                    {"platform", c.found.platform},
                    {"versions", {c.before.version, c.after.version}},
                    {"compared", c.found.compared},
                    {"same", c.found.compared - c.found.rows.size()},
                    {"rows", rows},
                    {"only_before", keys_json(c.found.only_before)},
                    {"only_after", keys_json(c.found.only_after)},
                    {"times", times},
                    {"times_not_judged", c.found.times_not_judged},
                    {"noise", c.found.noise}};
  return all.dump(2) + "\n";
}

}  // namespace ulpgate::app
