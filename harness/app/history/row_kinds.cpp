// Kinds of rows.
#include "harness/app/history/row_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ulpgate::app {

namespace {

using Names = std::string_view;

constexpr std::array<Names, 3> plan_setting = {"stratum", "seed", "planned"};
constexpr std::array<Names, 1> math_error = {"max_ulp"};
constexpr std::array<Names, 1> kernel_error = {"max_normwise"};
constexpr std::array<Names, 4> math_left_out = {"class", "reference", "reference_bits", "oracle"};
constexpr std::array<Names, 4> scene_setting = {"integrator", "dt", "variant", "steps"};
constexpr std::array<Names, 1> energy_error = {"max_energy_error"};
constexpr std::array<Names, 1> scene_left_out = {"parts_left_out"};
constexpr std::array<Names, 1> separation = {"t_s"};
constexpr std::array<Names, 3> order_setting = {"t_end", "dt", "steps"};
constexpr std::array<Names, 1> plain_error = {"error"};
constexpr std::array<Names, 2> drift_setting = {"t_end", "dt"};
constexpr std::array<Names, 1> stress_setting = {"kind"};
constexpr std::array<Names, 3> stress_left_out = {"what", "title", "reproducer"};
constexpr std::array<Names, 4> work_setting = {"subject", "end", "steps", "dt_text"};
constexpr std::array<Names, 3> work_error = {"largest_error_ulp", "final_error", "largest_error"};
constexpr std::array<Names, 1> work_left_out = {"dt"};

constexpr std::array<RowKind, 8> kinds = {
    {{"math", "math.jsonl", "function", "part", plan_setting, math_error, "ULP", false, "argmax",
      math_left_out},
     {"kernels", "kernels.jsonl", "function", "part", plan_setting, kernel_error, "roundoffs", false,
      "normwise_argmax", math_left_out},
     {"scene", "scenes.jsonl", "scene", "", scene_setting, energy_error, "J", false, "", scene_left_out},
     {"correlation", "correlation.jsonl", "scene", "against", scene_setting, separation, "s", true, "", {}},
     {"order", "orders.jsonl", "integrator", "problem", order_setting, plain_error, "", false, "", {}},
     {"drift", "drift.jsonl", "integrator", "problem", drift_setting, energy_error, "", false, "", {}},
     {"stress", "stress.jsonl", "case", "form", stress_setting, plain_error, "", false, "first_wrong",
      stress_left_out},
     {"work_precision", "work_precision.jsonl", "name", "integrator", work_setting, work_error, "", false, "",
      work_left_out}}};

// A field as the words of a key: texts as they are.
std::string word_of(const Json& line, std::string_view key) {
  const auto it = key.empty() ? line.end() : line.find(key);
  if (it == line.end() || it->is_null()) return "";
  return it->is_string() ? it->get<std::string>() : it->dump();
}

std::optional<double> error_of(const Json& figures, std::span<const std::string_view> names) {
  for (const auto& name : names) {
    const auto it = figures.find(name);
    if (it == figures.end() || it->is_null()) continue;
    if (it->is_number()) return it->get<double>();
    if (*it == "inf") return HUGE_VAL;
    if (*it == "nan") return std::nan("");
  }
  return std::nullopt;
}

std::uint64_t mismatches_of(const Json& line) {
  std::uint64_t count = 0;
  if (const auto it = line.find("mismatch"); it != line.end() && it->is_object())
    for (const auto& [name, value] : it->items())
      count += value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
  // A case that is not as known, a setting that failed.
  if (const auto it = line.find("as_known"); it != line.end() && *it == false) ++count;
  if (const auto it = line.find("failure"); it != line.end() && it->is_string()) ++count;
  return count;
}

std::string argument_text(const Json& j) {
  if (j.is_string()) return j.get<std::string>();
  std::string text;
  if (!j.is_array()) return text;
  for (const auto& one : j) {
    text += text.empty() ? "" : " ";
    text += one.is_string() ? one.get<std::string>() : one.dump();
  }
  return text;
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// What is right: a NaN is no smaller than anything.
bool grew(const std::optional<double>& before, const std::optional<double>& after) {
  if (!after) return false;
  if (!before) return true;
  if (std::isnan(*after)) return !std::isnan(*before);
  return *after > *before;
}

std::string shown(const Json& value) {
  std::string text = value.is_array() || value.is_string() ? argument_text(value) : value.dump();
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace

std::span<const RowKind> row_kinds() {
  return kinds;
}

const RowKind* find_row_kind(std::string_view word) {
  const auto it = std::ranges::find(kinds, word, &RowKind::word);
  return it == kinds.end() ? nullptr : &*it;
}

std::string RowKey::text() const {
  return fmt::format("{}{} {}{}", name, part.empty() || part == "value" ? "" : "." + part, type,
                     setting.empty() ? "" : ", " + setting);
}

RowKey key_of(const RowKind& kind, const Json& line) {
  RowKey key{std::string(kind.word), word_of(line, kind.name), word_of(line, kind.part),
             word_of(line, "type"), ""};
  for (const auto& name : kind.setting) {
    const std::string word = word_of(line, name);
    if (word.empty()) continue;
    key.setting += key.setting.empty() ? "" : " ";
    // A stratum's or an integrator's name says what it is; a number does not.
    key.setting += line.at(std::string(name)).is_string() ? word : fmt::format("{} {}", name, word);
  }
  return key;
}

std::string figures_of(const RowKind& kind, const Json& line) {
  Json figures = Json::object();
  for (const auto& [key, value] : line.items()) {
    const bool identity = key == "plan" || key == "type" || key == "implementation" || key == kind.name ||
                          key == kind.part || contains(kind.setting, key) || contains(kind.left_out, key);
    if (!identity) figures[key] = value;
  }
  return figures.dump();
}

RowResult result_of(const RowKind* kind, std::string figures) {
  const Json line = Json::parse(figures, nullptr, false);
  RowResult result;
  result.figures = std::move(figures);
  if (!line.is_object()) return result;
  result.mismatches = mismatches_of(line);
  if (kind == nullptr) return result;
  result.error = error_of(line, kind->error);
  if (const auto it = line.find(std::string(kind->argument)); it != line.end())
    result.argument = argument_text(*it);
  return result;
}

std::string_view to_string(Change change) {
  constexpr std::array<std::string_view, 4> words = {"the same", "better", "worse", "another"};
  return words[static_cast<std::size_t>(change)];
}

Change change_of(const RowKind* kind, const RowResult& before, const RowResult& after) {
  if (before == after) return Change::none;
  const bool more_is_better = kind != nullptr && kind->more_is_better;
  const bool up = grew(before.error, after.error);
  const bool down = grew(after.error, before.error);
  if (after.mismatches > before.mismatches || (more_is_better ? down : up)) return Change::worse;
  if (after.mismatches < before.mismatches || (more_is_better ? up : down)) return Change::better;
  return Change::other;
}

std::string change_text(const RowKind* kind, const RowResult& before, const RowResult& after) {
  const Json old_figures = Json::parse(before.figures, nullptr, false);
  const Json new_figures = Json::parse(after.figures, nullptr, false);
  std::vector<std::string> texts;
  std::size_t others = 0;
  for (const auto& [key, value] : new_figures.items()) {
    const Json old_value = old_figures.value(key, Json());
    if (old_value == value) continue;
    const bool watched = kind != nullptr && contains(kind->error, key);
    const bool told = watched || key == "mismatch" || key == "verdict" || key == "mean_ulp" ||
                      (kind != nullptr && key == kind->argument);
    const std::string text = fmt::format("{} {} -> {}", key, shown(old_value), shown(value));
    if (watched) {
      texts.insert(texts.begin(), text);
    } else if (told) {
      texts.push_back(text);
    } else {
      ++others;
    }
  }
  for (const auto& [key, value] : old_figures.items())
    if (!new_figures.contains(key)) texts.push_back(fmt::format("{} {} -> none", key, shown(value)));
  if (others > 0) texts.push_back(fmt::format("{} more figure{}", others, others == 1 ? "" : "s"));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace ulpgate::app
