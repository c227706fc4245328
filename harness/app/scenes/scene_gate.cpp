// The gate over records of scenes.
#include "harness/app/scenes/scene_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/scenes/scene_output.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/gate/findings/reproducer.hpp"

namespace ulpgate::app {

namespace {

bool is_collision_word(const Json& j) {
  return j == "collision" || j == "ledger";
}
// Two bodies and a step, or null.
bool is_place(const Json& j) {
  return j.is_null() || (j.is_array() && j.size() == 3 && std::ranges::all_of(j, field::count.accepts));
}
constexpr FieldKind collision_word = {"\"collision\" or \"ledger\"", is_collision_word};
constexpr FieldKind place = {"a list of two bodies and a step, or null", is_place};
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

void set_figure(MeasuredRow& m, const char* figure, const PlacedRow& row, const char* key) {
  if (const auto x = number_at(row, key)) m.figures[figure] = *x;
}

// Whether a correlation is that of the run: all that tells two runs of one plan apart.
bool is_of_run(const PlacedRow& correlation, const PlacedRow& run) {
  for (const char* key : {"scene", "type", "dt", "variant", "integrator"})
    if (text_of(correlation, key) != text_of(run, key)) return false;
  const auto steps = correlation.row.find("steps");
  return steps == correlation.row.end() || *steps == run.row.at("steps");
}

// What the ledger of a run says, where there is one.
void add_collisions(const std::vector<PlacedRow>& rows, const PlacedRow& run, MeasuredRow& m) {
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
  if (t.at("ended").get<std::uint64_t>() > 0) set_figure(m, "max_energy_created", *totals, "largest_created");
  m.figures["still_open"] = static_cast<double>(t.at("still_open").get<std::uint64_t>());
  const auto beyond = t.at("beyond").get<std::uint64_t>();
  if (beyond == 0) return;
  m.breach = fmt::format("{} collisions make energy beyond their condition, furthest", beyond);
  if (const Json& at = t.at("largest_part_of_bound_at"); at.is_array()) {
    m.got = fmt::format("bodies {}-{} from step {}, {} times what they may", at[0].dump(), at[1].dump(),
                        at[2].dump(), t.at("largest_part_of_bound").dump());
    m.breach += " " + m.got;
    m.wanted = "no energy beyond rounding, time step and law";
  }
}

}  // namespace

bool has_scene_records(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / scene_records_file);
}

std::vector<MeasuredRow> read_scene_measurements(const std::filesystem::path& directory) {
  const SceneRows rows = read_scene_rows(directory);
  if (!rows.context.at("complete").get<bool>())
    throw Failure(Standing::incomplete, fmt::format("{}: the run is not complete", directory.string()));
  std::vector<PlacedRow> collisions;
  const bool ledger = std::filesystem::exists(directory / collision_records_file);
  if (ledger) collisions = read_rows(directory, rows.context, collision_lines);
  std::vector<MeasuredRow> measured;
  for (const PlacedRow& row : rows.scenes) {
    MeasuredRow m;
    m.name = text_of(row, "scene");
    m.type = text_of(row, "type");
    const std::string dt = text_of(row, "dt");
    const std::string variant = text_of(row, "variant");
    const std::string integrator = text_of(row, "integrator");
    const auto steps = row.row.at("steps").get<std::uint64_t>();
    m.run = fmt::format("{} dt={} steps={}{}{}", integrator, dt, steps, variant.empty() ? "" : " ", variant);
    // Without an account both errors are 0 and say nothing.
    if (row.row.contains("energy") && row.row["energy"].is_object()) {
      set_figure(m, "max_energy_error", row, "max_energy_error");
      set_figure(m, "max_energy_error_raw", row, "max_energy_error_raw");
    }
    m.digest = text_of(row, "state_hash");
    const std::string file = text_of(row, "scene_file");
    const std::string run =
        fmt::format("{} --types {} --dt {} --steps {}", file.empty() ? m.name : shell_word(file), m.type,
                    shell_word(dt), steps);
    std::string against;
    if (ledger) add_collisions(collisions, row, m);
    for (const PlacedRow& c : rows.correlations) {
      const std::string reference = text_of(c, "against");
      if (!is_of_run(c, row) || reference == "RealHP4" || reference == "half_step") continue;
      if (m.figures.contains("t_s"))
        bad(c.place, fmt::format("a second correlation of {} {}", m.name, figure_key(m)));
      set_figure(m, "t_s", c, "t_s");
      against = reference;
    }
    // The directory is the reader's own, and the command may be given twice.
    const std::string verb = against.empty() ? fmt::format("run {}{}", run, ledger ? " --collisions" : "")
                                             : fmt::format("correlate {} --reference {}", run, against);
    m.reproduce = fmt::format("ulpgate scene {} --series --out reproduced --overwrite", verb);
    if (integrator != "leapfrog") m.reproduce += " --integrator " + integrator;
    for (const auto& change : split(variant, ',')) m.reproduce += " --set " + shell_word(change);
    measured.push_back(std::move(m));
  }
  return measured;
}

}  // namespace ulpgate::app
