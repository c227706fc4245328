// The gate over records of scenes.
#include "harness/app/scenes/scene_gate.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "harness/app/budgets/toml_files.hpp"
#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/scenes/scene_output.hpp"
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
    {"max_energy_error_raw", &SceneBudget::max_energy_error_raw},
    {"max_energy_created", &SceneBudget::max_energy_created}};

bool is_collision_word(const Json& j) {
  return j == "collision" || j == "ledger";
}
// Two bodies and a step, or null.
bool is_place(const Json& j) {
  return j.is_null() || (j.is_array() && j.size() == 3 && std::ranges::all_of(j, field::count.accepts));
}
constexpr FieldKind collision_word = {"\"collision\" or \"ledger\"", is_collision_word};
constexpr FieldKind place = {"a list of two bodies and a step, or null", is_place};
constexpr auto optional = Presence::optional;
constexpr Field collision_fields[] = {{"what", collision_word},
                                      {"scene", field::name},
                                      {"type", field::word},
                                      {"integrator", field::word},
                                      {"dt", field::word},
                                      {"variant", field::text},
                                      {"first", field::count, optional},
                                      {"second", field::count, optional},
                                      {"open", field::flag, optional},
                                      {"begin_step", field::count, optional},
                                      {"end_step", field::count, optional},
                                      {"steps_inside", field::count, optional},
                                      {"begin_s", field::number, optional},
                                      {"end_s", field::number, optional},
                                      {"duration_s", field::number, optional},
                                      {"normal_velocity_before", field::number, optional},
                                      {"normal_velocity_after", field::number, optional},
                                      {"restitution", field::number, optional},
                                      {"largest_overlap_m", field::size, optional},
                                      {"energy_before_J", field::size, optional},
                                      {"energy_after_J", field::size, optional},
                                      {"energy_gained_J", field::number, optional},
                                      {"energy_created", field::size, optional},
                                      {"omega_dt", field::size, optional},
                                      {"condition", field::size, optional},
                                      {"rounding_bound_J", field::size, optional},
                                      {"step_bound_J", field::size, optional},
                                      {"law_bound_J", field::size, optional},
                                      {"beyond_condition", field::flag, optional},
                                      {"rows", field::count, optional},
                                      {"ended", field::count, optional},
                                      {"still_open", field::count, optional},
                                      {"creating", field::count, optional},
                                      {"beyond", field::count, optional},
                                      {"largest_created", field::size, optional},
                                      {"largest_created_at", place, optional},
                                      {"largest_part_of_bound", field::size, optional},
                                      {"largest_part_of_bound_at", place, optional},
                                      {"mean_restitution", field::number, optional},
                                      {"shortest_steps", field::count, optional},
                                      {"largest_omega_dt", field::size, optional},
                                      {"plan", field::hash}};
constexpr std::string_view collision_key[] = {"what",    "scene", "type",   "dt",
                                              "variant", "first", "second", "begin_step"};

// A collision has the fields of one and none of the totals, and the other way round.
std::string collision_contradiction(const Json& row) {
  const bool one = row.at("what") == "collision";
  const auto begin = std::ranges::find(collision_fields, "first", &Field::key);
  const auto totals = std::ranges::find(collision_fields, "rows", &Field::key);
  for (auto field = begin; field != std::end(collision_fields) && field->key != "plan"; ++field) {
    const bool wanted = (field < totals) == one;
    if (row.contains(field->key) != wanted)
      return fmt::format("'{}' {}", field->key,
                         wanted ? "is missing" : "is none of a " + row.at("what").dump());
  }
  return "";
}

const LineKind collision_lines = {collision_records_file, collision_fields, collision_key,
                                  collision_contradiction};

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

// What the ledger of a run says, where there is one.
void add_collisions(const std::vector<PlacedRow>& rows, const PlacedRow& run, SceneMeasurement& m) {
  const PlacedRow* totals = nullptr;
  std::uint64_t listed = 0;
  for (const PlacedRow& row : rows) {
    if (!is_of_run(row, run)) continue;
    if (row.row.at("what") == "ledger") {
      totals = &row;
    } else {
      ++listed;
    }
  }
  if (totals == nullptr) bad(run.place, fmt::format("its totals are missing in {}", collision_records_file));
  const Json& t = totals->row;
  if (t.at("rows") != listed)
    bad(totals->place, fmt::format("'rows' is {}, but {} collisions are there", t.at("rows").dump(), listed));
  if (t.at("ended").get<std::uint64_t>() > 0) m.energy_created = number_at(*totals, "largest_created");
  m.collisions_beyond = t.at("beyond").get<std::uint64_t>();
  if (const Json& at = t.at("largest_part_of_bound_at"); at.is_array()) {
    m.furthest_beyond = fmt::format("bodies {}-{} from step {}, {} times what they may", at[0].dump(),
                                    at[1].dump(), at[2].dump(), t.at("largest_part_of_bound").dump());
  }
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
  std::vector<PlacedRow> collisions;
  const bool ledger = std::filesystem::exists(directory / collision_records_file);
  if (ledger) collisions = read_rows(directory, rows.context, collision_lines);
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
    m.reproduce =
        fmt::format("ulpgate scene run {} --series{} --out DIR", run, ledger ? " --collisions" : "");
    if (ledger) add_collisions(collisions, row, m);
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
                fmt::format("['{}'] {} must be one of t_s, max_energy_error, max_energy_error_raw, "
                            "max_energy_created and a finite number >= 0, or a reason",
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
