// The gate over records of scenes.
#include "harness/app/scenes/scene_gate.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "harness/app/budgets/toml_files.hpp"
#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

namespace {

using SceneRowBudgets = SceneBudgets::mapped_type;
using Limit = std::optional<double> SceneBudget::*;
constexpr std::pair<const char*, Limit> limits[] = {
    {"t_s", &SceneBudget::t_s},
    {"max_energy_error", &SceneBudget::max_energy_error},
    {"max_energy_error_raw", &SceneBudget::max_energy_error_raw}};

[[noreturn]] void bad(const std::string& place, const std::string& what) {
  throw Failure(Standing::bad_input, fmt::format("{}: {}", place, what));
}

// A text of a row; empty where it has none.
std::string text_of(const PlacedRow& row, const char* key) {
  const auto it = row.row.find(key);
  if (it == row.row.end()) return "";
  return it->is_string() ? it->get<std::string>() : it->dump();
}

std::optional<double> number_at(const PlacedRow& row, const char* key) {
  const auto it = row.row.find(key);
  if (it == row.row.end()) return std::nullopt;
  // Null or a word stands for what is no finite number.
  return it->is_number() ? it->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// Whether a correlation is that of the run: all that tells two runs of one plan apart.
bool is_of_run(const PlacedRow& correlation, const PlacedRow& run) {
  for (const char* key : {"scene", "type", "dt", "variant", "integrator"})
    if (text_of(correlation, key) != text_of(run, key)) return false;
  const auto steps = correlation.row.find("steps");
  return steps == correlation.row.end() || *steps == run.row.at("steps");
}

// Expressions hold brackets and stars, which a shell would take.
std::string shell_word(const std::string& text) {
  const bool plain = text.find_first_of("()* ") == std::string::npos;
  return plain ? text : "'" + text + "'";
}

}  // namespace

bool has_scene_records(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / scene_records_file);
}

std::vector<SceneMeasurement> read_scene_measurements(const std::filesystem::path& directory) {
  const SceneRows rows = read_scene_rows(directory);
  if (!rows.context.at("complete").get<bool>())
    throw Failure(Standing::incomplete, fmt::format("{}: the run is not complete", directory.string()));
  std::vector<SceneMeasurement> measured;
  for (const PlacedRow& row : rows.scenes) {
    SceneMeasurement m;
    m.scene = text_of(row, "scene");
    m.type = text_of(row, "type");
    const std::string dt = text_of(row, "dt");
    const std::string variant = text_of(row, "variant");
    const std::string integrator = text_of(row, "integrator");
    const auto steps = row.row.at("steps").get<std::uint64_t>();
    m.run = fmt::format("{} dt={} steps={}{}{}", integrator, dt, steps, variant.empty() ? "" : " ", variant);
    // Without an account both errors are 0 and say nothing.
    if (row.row.contains("energy") && row.row["energy"].is_object()) {
      m.max_energy_error = number_at(row, "max_energy_error");
      m.max_energy_error_raw = number_at(row, "max_energy_error_raw");
    }
    const std::string run =
        fmt::format("{} --types {} --dt {} --steps {}", m.scene, m.type, shell_word(dt), steps);
    m.reproduce = fmt::format("ulpgate scene run {} --series --out DIR", run);
    for (const PlacedRow& c : rows.correlations) {
      const std::string against = text_of(c, "against");
      if (!is_of_run(c, row) || against == "RealHP4" || against == "half_step") continue;
      if (m.t_s) bad(c.place, fmt::format("a second correlation of {} {}", m.scene, scene_budget_key(m)));
      m.t_s = number_at(c, "t_s");
      m.reproduce = fmt::format("ulpgate scene correlate {} --reference {} --series --out DIR", run, against);
    }
    if (integrator != "leapfrog") m.reproduce += " --integrator " + integrator;
    for (const auto& change : split(variant, ',')) m.reproduce += " --set " + shell_word(change);
    measured.push_back(std::move(m));
  }
  return measured;
}

namespace {

SceneRowBudgets parse_scene(const std::string& text, const std::string& file) {
  const auto at = [&](const toml::node& node) {
    return fmt::format("{}:{}", file, node.source().begin.line);
  };
  try {
    SceneRowBudgets rows;
    for (const auto& [section, node] : toml::parse(text, file)) {
      if (section != "budget" || !node.is_table())
        bad(at(node), fmt::format("unknown section '{}'", section.str()));
      for (const auto& [name, value] : *node.as_table()) {
        if (!value.is_table()) bad(at(value), fmt::format("budget '{}' must be a table", name.str()));
        SceneBudget& b = rows[std::string(name.str())];
        bool limited = false;
        for (const auto& [key, number] : *value.as_table()) {
          if (key == "reason" && number.is_string()) {
            b.reason = *number.value<std::string>();
            continue;
          }
          const auto* const limit =
              std::ranges::find_if(limits, [text = key.str()](const auto& l) { return text == l.first; });
          const auto x = number.value<double>();
          if (limit == std::end(limits) || !x || !std::isfinite(*x) || *x < 0)
            bad(at(number),
                fmt::format("['{}'] {} must be one of t_s, max_energy_error, max_energy_error_raw "
                            "and a finite number >= 0, or a reason",
                            name.str(), key.str()));
          b.*limit->second = *x;
          limited = true;
        }
        if (!limited) bad(at(value), fmt::format("['{}'] limits nothing", name.str()));
      }
    }
    return rows;
  } catch (const toml::parse_error& e) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

std::string scene_text(const std::string& scene, const SceneRowBudgets& rows) {
  std::string text = fmt::format(
      "# Budgets of {}: the least t_s (s) and the largest energy errors (J) of every type and run.\n"
      "# Written by `ulpgate gate DIR --budgets DIR --update`; loosened only with `--reason`.\n",
      scene);
  for (const auto& [key, b] : rows) {
    text += fmt::format("\n[budget.{}]\n", toml_quoted(key));
    for (const auto& [name, limit] : limits) {
      if (!(b.*limit)) continue;
      if (!std::isfinite(*(b.*limit))) {
        throw Failure(Standing::not_finite, fmt::format("{} {}: {} is {}, of which no budget can be made",
                                                        scene, key, name, *(b.*limit)));
      }
      text += fmt::format("{} = {:#}\n", name, *(b.*limit));
    }
    if (!b.reason.empty()) text += fmt::format("reason = {}\n", toml_quoted(b.reason));
  }
  return text;
}

}  // namespace

SceneBudgets read_scene_budgets(const std::filesystem::path& directory) {
  return read_toml_files<SceneRowBudgets>(directory, parse_scene);
}

void write_scene_budgets(const std::filesystem::path& directory, const SceneBudgets& budgets) {
  write_toml_files<SceneRowBudgets>(directory, budgets, scene_text, parse_scene);
}

}  // namespace ulpgate::app
