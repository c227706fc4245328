// Budget files.
#include "harness/app/budgets/budget_files.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "harness/app/budgets/toml_files.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/core/gate/limits.hpp"

namespace ulpgate::app {

namespace {

[[noreturn]] void bad(const std::string& file, const toml::node& node, const std::string& what) {
  throw Failure(Standing::bad_input, fmt::format("{}:{}: {}", file, node.source().begin.line, what));
}

std::uint64_t count_of(const std::string& file, const toml::node& node, std::string_view key) {
  const auto n = node.value_exact<std::int64_t>();
  if (!n || *n < 0) bad(file, node, fmt::format("'{}' must be a non-negative integer", key));
  return static_cast<std::uint64_t>(*n);
}

// The stratum that a key names.
std::string stratum_of(const std::string& file, const toml::node& node, std::string_view name,
                       std::string_view key, std::string_view stratum) {
  if (!find_stratum(stratum)) bad(file, node, fmt::format("[{}] {}: no stratum '{}'", name, key, stratum));
  return std::string(stratum);
}

const toml::table& table_of(const std::string& file, const toml::node& node, std::string_view name,
                            std::string_view key, std::string_view content) {
  const auto* table = node.as_table();
  if (table == nullptr) bad(file, node, fmt::format("[{}] {} must be a table {{ {} }}", name, key, content));
  return *table;
}

// { stratum = limit, ... }
std::map<std::string, double> parse_limits(const std::string& file, const toml::node& node,
                                           std::string_view name, std::string_view key) {
  std::map<std::string, double> limits;
  for (const auto& [stratum, value] : table_of(file, node, name, key, "stratum = limit")) {
    const auto limit = value.value<double>();
    const std::string of = stratum_of(file, value, name, key, stratum.str());
    if (!limit || !std::isfinite(*limit) || *limit < 0)
      bad(file, value, fmt::format("[{}] {} of {} must be a finite number >= 0", name, key, of));
    limits[of] = *limit;
  }
  return limits;
}

// { stratum = { "2^4" = count, ... }, ... }
std::map<std::string, std::map<int, std::uint64_t>> parse_tails(const std::string& file,
                                                                const toml::node& node,
                                                                std::string_view name) {
  std::map<std::string, std::map<int, std::uint64_t>> tails;
  for (const auto& [stratum, counts] : table_of(file, node, name, "above", "stratum = { \"2^4\" = count }")) {
    const std::string of = stratum_of(file, counts, name, "above", stratum.str());
    for (const auto& [power, count] :
         table_of(file, counts, name, "above", "stratum = { \"2^4\" = count }")) {
      const auto* const e = std::ranges::find_if(tail_exponents, [text = power.str()](int exponent) {
        return fmt::format("2^{}", exponent) == text;
      });
      if (e == tail_exponents.end())
        bad(file, count,
            fmt::format("[{}] above of {}: '{}' is none of 2^0, 2^1, 2^2, 2^4, 2^8, ... 2^512, 2^1023", name,
                        of, power.str()));
      tails[of][*e] = count_of(file, count, power.str());
    }
  }
  return tails;
}

// { "stratum.outcome" = count, ... }
std::map<std::string, std::uint64_t> parse_mismatches(const std::string& file, const toml::node& node,
                                                      std::string_view name) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [what, count] : table_of(file, node, name, "mismatch", "\"stratum.outcome\" = count")) {
    const std::string_view key = what.str();
    const std::size_t dot = std::min(key.find('.'), key.size());
    const bool known =
        std::ranges::find(outcome_names, key.substr(std::min(dot + 1, key.size()))) != outcome_names.end();
    if (!find_stratum(key.substr(0, dot)) || !known)
      bad(file, count, fmt::format("[{}] mismatch: '{}' is no stratum.outcome", name, key));
    counts[std::string(key)] = count_of(file, count, key);
  }
  return counts;
}

// { stratum = "digest", ... }
std::map<std::string, std::string> parse_digests(const std::string& file, const toml::node& node,
                                                 std::string_view name) {
  std::map<std::string, std::string> digests;
  for (const auto& [stratum, value] : table_of(file, node, name, "digest", "stratum = \"0123abcd\"")) {
    const std::string of = stratum_of(file, value, name, "digest", stratum.str());
    const auto digest = value.value_exact<std::string>();
    if (!digest || !is_digest(*digest, 8))
      bad(file, value, fmt::format("[{}] digest of {} must be eight hexadecimal digits", name, of));
    digests[of] = *digest;
  }
  return digests;
}

// Every stratum has a limit of its maximum, or says how many of its errors are beyond measure.
void check_row(const std::string& file, const toml::table& row, std::string_view name, const Budget& budget) {
  const auto limited = [&](const std::string& stratum) {
    const auto tail = budget.above.find(stratum);
    return budget.max_ulp.contains(stratum) ||
           (tail != budget.above.end() && tail->second.contains(beyond_measure));
  };
  for (const auto& [stratum, count] : budget.samples) {
    if (count == 0) bad(file, row, fmt::format("[{}] samples of {} must not be 0", name, stratum));
    if (!limited(stratum)) bad(file, row, fmt::format("[{}] lacks max_ulp of {}", name, stratum));
  }
  if (budget.samples.empty() && budget.max_ulp.empty())
    bad(file, row, fmt::format("[{}] lacks max_ulp", name));
  const auto known = [&](std::string_view key, const auto& figures) {
    for (const auto& [stratum, figure] : figures) {
      if (!budget.knows(stratum))
        bad(file, row, fmt::format("[{}] {} of {}, which has no max_ulp or samples", name, key, stratum));
    }
  };
  for (const auto& column : limit_columns()) known(column.key, budget.*column.limits);
  for (const auto& bound : bound_columns) known(bound.key, budget.*bound.limits);
  known("winsorized_ulp", budget.winsorized_ulp);
  known("above", budget.above);
  known("digest", budget.digest);
}

Budget parse_row(const std::string& file, const toml::table& row, std::string_view name) {
  Budget budget;
  for (const auto& [key, node] : row) {
    std::map<std::string, double>* limits = nullptr;
    for (const auto& column : limit_columns())
      if (column.key == key.str()) limits = &(budget.*column.limits);
    for (const auto& bound : bound_columns)
      if (bound.key == key.str()) limits = &(budget.*bound.limits);
    if (key == "winsorized_ulp") limits = &budget.winsorized_ulp;
    if (limits != nullptr) {
      *limits = parse_limits(file, node, name, key.str());
    } else if (key == "samples") {
      for (const auto& [stratum, count] : table_of(file, node, name, "samples", "stratum = count"))
        budget.samples[stratum_of(file, count, name, "samples", stratum.str())] =
            count_of(file, count, stratum.str());
    } else if (key == "above") {
      budget.above = parse_tails(file, node, name);
    } else if (key == "mismatch") {
      budget.mismatch = parse_mismatches(file, node, name);
    } else if (key == "digest") {
      budget.digest = parse_digests(file, node, name);
    } else if (key == "implementation" && node.is_string()) {
      budget.implementation = *node.value<std::string>();
    } else if (key == "reason" && node.is_string()) {
      budget.reason = *node.value<std::string>();
    } else {
      bad(file, node,
          fmt::format(
              "[{}] has no key '{}' of this kind (implementation, samples, max_ulp, mean_ulp, p99_ulp, "
              "over_condition, bound_ulp, bound_over_condition, winsorized_ulp, above, mismatch, digest, "
              "reason)",
              name, key.str()));
    }
  }
  check_row(file, row, name, budget);
  return budget;
}

std::string toml_value(double x) {
  return x == std::floor(x) && x < 1e15 ? fmt::format("{:.1f}", x) : fmt::format("{}", x);
}
std::string toml_value(std::uint64_t n) {
  return fmt::format("{}", n);
}
std::string toml_value(const std::map<int, std::uint64_t>& counts) {
  std::string text = "{";
  const char* separator = " ";
  for (const auto& [e, count] : counts) {
    text += fmt::format("{}\"2^{}\" = {}", separator, e, count);
    separator = ", ";
  }
  return text + " }";
}

std::string toml_value(const std::string& text) {
  return toml_quoted(text);
}

// A line of a row's figures by stratum; nothing where there are none.
template <class Map>
std::string figures_text(std::string_view key, const Map& figures) {
  if (figures.empty()) return "";
  std::string text = fmt::format("{} = {{", key);
  const char* separator = " ";
  for (const auto& [stratum, figure] : figures) {
    const bool bare = stratum.find('.') == std::string::npos;
    text += fmt::format("{}{} = {}", separator, bare ? stratum : toml_quoted(stratum), toml_value(figure));
    separator = ", ";
  }
  return text + " }\n";
}

std::string file_text(const std::string& token, const TypeBudgets& type) {
  std::string text = fmt::format(
      "# Budgets of {}: what the gate accepts of every row, by stratum (ci/README.md).\n"
      "# Written by `ulpgate gate DIR --budgets DIR --update`; loosened only with `--reason`.\n"
      "[plan]\nsamples = {}\nseed = {}\n",
      token, type.samples, type.seed);
  if (!type.machine.empty()) text += "\n[machine]\n";
  for (const auto& [fact, value] : type.machine)
    text += fmt::format("{} = {}\n", toml_quoted(fact), toml_quoted(value));
  for (const auto& [row, b] : type.rows) {
    text += fmt::format("\n[budget.{}]\n", toml_quoted(row));
    if (!b.implementation.empty())
      text += fmt::format("implementation = {}\n", toml_quoted(b.implementation));
    text += figures_text("samples", b.samples);
    for (const auto& column : limit_columns()) text += figures_text(column.key, b.*column.limits);
    for (const auto& bound : bound_columns) text += figures_text(bound.key, b.*bound.limits);
    text += figures_text("winsorized_ulp", b.winsorized_ulp);
    text += figures_text("above", b.above);
    text += figures_text("mismatch", b.mismatch);
    text += figures_text("digest", b.digest);
    if (!b.reason.empty()) text += fmt::format("reason = {}\n", toml_quoted(b.reason));
  }
  return text;
}

TypeBudgets parse_type(const std::string& text, const std::string& file) {
  try {
    const toml::table table = toml::parse(text, file);
    TypeBudgets type;
    bool has_seed = false;
    for (const auto& [key, node] : table) {
      const auto* section = node.as_table();
      if (section == nullptr || (key != "plan" && key != "machine" && key != "budget"))
        bad(file, node, fmt::format("unknown section '{}'", key.str()));
      for (const auto& [name, value] : *section) {
        if (key == "plan") {
          if (name != "samples" && name != "seed")
            bad(file, value, fmt::format("[plan] has no key '{}'", name.str()));
          (name == "samples" ? type.samples : type.seed) = count_of(file, value, name.str());
          has_seed = has_seed || name == "seed";
          if (type.samples == 0 && name == "samples") bad(file, value, "[plan] samples must not be 0");
        } else if (key == "machine") {
          if (!value.is_string()) bad(file, value, fmt::format("[machine] {} must be a text", name.str()));
          type.machine[std::string(name.str())] = *value.value<std::string>();
        } else {
          const auto* row = value.as_table();
          if (row == nullptr) bad(file, value, fmt::format("budget '{}' must be a table", name.str()));
          type.rows[std::string(name.str())] = parse_row(file, *row, name.str());
        }
      }
    }
    if (type.samples == 0 || !has_seed)
      bad(file, table, "no [plan] with samples and seed: nobody knows what the limits were measured by");
    return type;
  } catch (const toml::parse_error& e) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

}  // namespace

Budgets read_budgets(const std::filesystem::path& directory) {
  return read_toml_files<TypeBudgets>(directory, parse_type);
}

void write_budgets(const std::filesystem::path& directory, const Budgets& budgets) {
  write_toml_files<TypeBudgets>(directory, budgets, file_text, parse_type);
}

}  // namespace ulpgate::app
