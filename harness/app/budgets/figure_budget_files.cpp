// Budget files of rows with named figures.
#include "harness/app/budgets/figure_budget_files.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "harness/app/budgets/toml_files.hpp"

namespace ulpgate::app {

namespace {

[[noreturn]] void bad(const std::string& place, const std::string& what) {
  throw Failure(Standing::bad_input, fmt::format("{}: {}", place, what));
}

// A float of TOML: digits on both sides of the point, or an exponent.
std::string toml_float(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string keys_of(RowKind of) {
  std::string keys;
  for (const auto& column : figure_columns(of)) keys += (keys.empty() ? "" : ", ") + std::string(column.key);
  return keys;
}

FigureBudget parse_row(RowKind of, const toml::table& row, std::string_view name,
                       const std::function<std::string(const toml::node&)>& at) {
  FigureBudget b;
  for (const auto& [key, node] : row) {
    if (key == "reason" && node.is_string()) {
      b.reason = *node.value<std::string>();
    } else if (key == "digest" && node.is_string()) {
      b.digest = *node.value<std::string>();
      if (!is_digest(b.digest, 16))
        bad(at(node), fmt::format("['{}'] digest must be sixteen hexadecimal digits", name));
    } else if (key == "outcome" && node.is_string()) {
      b.outcome = *node.value<std::string>();
    } else {
      const auto columns = figure_columns(of);
      const auto x = node.value<double>();
      if (std::ranges::find(columns, key.str(), &FigureColumn::key) == columns.end() || !x ||
          !std::isfinite(*x) || *x < 0)
        bad(at(node),
            fmt::format(
                "['{}'] {} must be one of {} and a finite number >= 0, an outcome, a digest or a reason",
                name, key.str(), keys_of(of)));
      b.limits[std::string(key.str())] = *x;
    }
  }
  if (b.limits.empty() && b.outcome.empty() && b.digest.empty())
    bad(at(row), fmt::format("['{}'] limits nothing", name));
  return b;
}

template <RowKind of>
FigureFile parse_file(const std::string& text, const std::string& file) {
  const auto at = [&](const toml::node& node) {
    return fmt::format("{}:{}", file, node.source().begin.line);
  };
  try {
    FigureFile content{of, {}};
    for (const auto& [section, node] : toml::parse(text, file)) {
      if (section != "budget" || !node.is_table())
        bad(at(node), fmt::format("unknown section '{}'", section.str()));
      for (const auto& [name, value] : *node.as_table()) {
        if (!value.is_table()) bad(at(value), fmt::format("budget '{}' must be a table", name.str()));
        content.rows[std::string(name.str())] = parse_row(of, *value.as_table(), name.str(), at);
      }
    }
    return content;
  } catch (const toml::parse_error& e) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

std::string_view title_of(RowKind of) {
  switch (of) {
    case RowKind::scene:
      return "the least t_s (s) and the largest energy errors (J) of every type and run";
    case RowKind::order:
      return "the least order and the largest least error of every integrator and type";
    case RowKind::drift:
      return "the largest energy error of every integrator and type";
    case RowKind::stress:
      return "the verdict and the largest error of rounding of every case and type";
    default:
      return "the largest errors of every setting";
  }
}

std::string file_text(const std::string& name, const FigureFile& file) {
  std::string text = fmt::format(
      "# Budgets of {}: {}.\n"
      "# Written by `ulpgate gate DIR --budgets DIR --update`; loosened only with `--reason`.\n",
      name, title_of(file.of));
  for (const auto& [key, b] : file.rows) {
    text += fmt::format("\n[budget.{}]\n", toml_quoted(key));
    if (!b.outcome.empty()) text += fmt::format("outcome = {}\n", toml_quoted(b.outcome));
    for (const auto& column : figure_columns(file.of)) {
      const auto limit = b.limits.find(std::string(column.key));
      if (limit == b.limits.end()) continue;
      if (!std::isfinite(limit->second)) {
        throw Failure(Standing::not_finite, fmt::format("{} {}: {} is {}, of which no budget can be made",
                                                        name, key, column.key, limit->second));
      }
      text += fmt::format("{} = {}\n", column.key, toml_float(limit->second));
    }
    if (!b.digest.empty()) text += fmt::format("digest = {}\n", toml_quoted(b.digest));
    if (!b.reason.empty()) text += fmt::format("reason = {}\n", toml_quoted(b.reason));
  }
  return text;
}

ParseToml<FigureFile> parser_of(RowKind of) {
  switch (of) {
    case RowKind::order:
      return parse_file<RowKind::order>;
    case RowKind::drift:
      return parse_file<RowKind::drift>;
    case RowKind::stress:
      return parse_file<RowKind::stress>;
    case RowKind::work_precision:
      return parse_file<RowKind::work_precision>;
    default:
      return parse_file<RowKind::scene>;
  }
}

}  // namespace

FigureBudgets read_figure_budgets(const std::filesystem::path& directory, RowKind of) {
  return read_toml_files<FigureFile>(directory, parser_of(of));
}

void write_figure_budgets(const std::filesystem::path& directory, RowKind of, const FigureBudgets& budgets) {
  write_toml_files<FigureFile>(directory, budgets, file_text, parser_of(of));
}

}  // namespace ulpgate::app
