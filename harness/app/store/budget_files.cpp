// Budget files.
#include "harness/app/store/budget_files.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

[[noreturn]] void bad(const std::string& file, const toml::node& node, const std::string& what) {
  throw Failure(ExitCode::bad_input, fmt::format("{}:{}: {}", file, node.source().begin.line, what));
}

std::uint64_t count_of(const std::string& file, const toml::node& node, std::string_view key) {
  const auto n = node.value_exact<std::int64_t>();
  if (!n || *n < 0) bad(file, node, fmt::format("'{}' must be a non-negative integer", key));
  return static_cast<std::uint64_t>(*n);
}

// { stratum = limit, ... }
std::map<std::string, double> parse_limits(const std::string& file, const toml::node& node,
                                           std::string_view name, std::string_view key) {
  const auto* table = node.as_table();
  if (table == nullptr)
    bad(file, node, fmt::format("[{}] {} must be a table {{ stratum = limit }}", name, key));
  std::map<std::string, double> limits;
  for (const auto& [stratum, value] : *table) {
    const auto limit = value.value<double>();
    if (!find_stratum(stratum.str()))
      bad(file, value, fmt::format("[{}] {}: no stratum '{}'", name, key, stratum.str()));
    if (!limit || std::isnan(*limit) || *limit < 0)
      bad(file, value, fmt::format("[{}] {} of {} must be a number >= 0", name, key, stratum.str()));
    limits[std::string(stratum.str())] = *limit;
  }
  return limits;
}

Budget parse_row(const std::string& file, const toml::table& row, std::string_view name) {
  Budget budget;
  bool has_limit = false;
  for (const auto& [key, node] : row) {
    if (key == "max_ulp") {
      budget.max_ulp = parse_limits(file, node, name, key.str());
      has_limit = true;
    } else if (key == "over_condition") {
      budget.over_condition = parse_limits(file, node, name, key.str());
    } else if (key == "implementation" && node.is_string()) {
      budget.implementation = *node.value<std::string>();
    } else if (key == "reason" && node.is_string()) {
      budget.reason = *node.value<std::string>();
    } else if (key == "mismatch" && node.is_table()) {
      for (const auto& [what, count] : *node.as_table()) {
        budget.mismatch[std::string(what.str())] = count_of(file, count, what.str());
      }
    } else {
      bad(file, node,
          fmt::format("[{}] has no key '{}' of this kind (implementation, max_ulp, over_condition, mismatch, "
                      "reason)",
                      name, key.str()));
    }
  }
  if (!has_limit) bad(file, row, fmt::format("[{}] lacks max_ulp", name));
  return budget;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : c == '\n' ? " " : std::string(1, c);
  return out + "\"";
}

std::string number(double x) {
  return std::isinf(x)                    ? "inf"
         : x == std::floor(x) && x < 1e15 ? fmt::format("{:.1f}", x)
                                          : fmt::format("{}", x);
}

std::string limits_text(std::string_view key, const std::map<std::string, double>& limits) {
  std::string text = fmt::format("{} = {{", key);
  const char* separator = " ";
  for (const auto& [stratum, limit] : limits) {
    text += fmt::format("{}{} = {}", separator, stratum, number(limit));
    separator = ", ";
  }
  return text + " }\n";
}

std::string file_text(const std::string& token, const TypeBudgets& type) {
  std::string text = fmt::format(
      "# Budgets of {}: the largest error in ULP and the accepted mismatches of every row, by stratum.\n"
      "# Written by `ulpgate gate DIR --budgets DIR --update`; raised only with `--reason`.\n"
      "[plan]\nsamples = {}\nseed = {}\n",
      token, type.samples, type.seed);
  for (const auto& [row, b] : type.rows) {
    text += fmt::format("\n[budget.\"{}\"]\n", row);
    if (!b.implementation.empty()) text += fmt::format("implementation = {}\n", quoted(b.implementation));
    text += limits_text("max_ulp", b.max_ulp);
    if (!b.over_condition.empty()) text += limits_text("over_condition", b.over_condition);
    if (!b.mismatch.empty()) {
      text += "mismatch = {";
      const char* separator = " ";
      for (const auto& [key, count] : b.mismatch) {
        text += fmt::format("{}\"{}\" = {}", separator, key, count);
        separator = ", ";
      }
      text += " }\n";
    }
    if (!b.reason.empty()) text += fmt::format("reason = {}\n", quoted(b.reason));
  }
  return text;
}

}  // namespace

Budgets read_budgets(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) {
    throw Failure(ExitCode::bad_input, fmt::format("{}: no such directory of budgets", directory.string()));
  }
  Budgets budgets;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string file = entry.path().string();
    try {
      const toml::table table = toml::parse(read_file(entry.path()), file);
      TypeBudgets& type = budgets[entry.path().stem().string()];
      for (const auto& [key, node] : table) {
        const auto* section = node.as_table();
        if (section == nullptr || (key != "plan" && key != "budget"))
          bad(file, node, fmt::format("unknown section '{}'", key.str()));
        for (const auto& [name, value] : *section) {
          if (key == "plan") {
            if (name != "samples" && name != "seed")
              bad(file, value, fmt::format("[plan] has no key '{}'", name.str()));
            (name == "samples" ? type.samples : type.seed) = count_of(file, value, name.str());
          } else {
            const auto* row = value.as_table();
            if (row == nullptr) bad(file, value, fmt::format("budget '{}' must be a table", name.str()));
            type.rows[std::string(name.str())] = parse_row(file, *row, name.str());
          }
        }
      }
    } catch (const toml::parse_error& e) {
      throw Failure(ExitCode::bad_input,
                    fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
    }
  }
  return budgets;
}

void write_budgets(const std::filesystem::path& directory, const Budgets& budgets) {
  make_directory(directory);
  for (const auto& [token, type] : budgets) write_file(directory / (token + ".toml"), file_text(token, type));
}

}  // namespace ulpgate::app
