// Lines of the files that scenes and integrators leave.
#include "harness/app/reading/line_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

using namespace field;

bool is_dt(const Json& j) {
  return field::word.accepts(j) || field::positive.accepts(j);
}
bool is_position(const Json& j) {
  return j.is_null() || (j.is_array() && j.size() == 3 && std::ranges::all_of(j, field::number.accepts));
}
bool is_account(const Json& j) {
  return j.is_null() || (j.is_object() && std::ranges::all_of(j, field::number.accepts));
}
bool is_hash_or_null(const Json& j) {
  return j.is_null() || field::hash.accepts(j);
}
bool is_time(const Json& j) {
  return j.is_number() && j.get<double>() >= 0;
}
bool is_limit(const Json& j) {
  return j == "rounding" || j == "time-stepping" || j == "the reference" || j == "the end of the run" ||
         j == "not told";
}
bool is_correlation_word(const Json& j) {
  return j == "correlation";
}
bool is_order_word(const Json& j) {
  return j == "order";
}
bool is_drift_word(const Json& j) {
  return j == "drift";
}

constexpr FieldKind dt = {"a time step", is_dt};
constexpr FieldKind position = {"a list of 3 numbers, or null", is_position};
constexpr FieldKind account = {"an object of numbers, or null", is_account};
constexpr FieldKind hash_or_null = {"a text of 16 hexadecimal digits, or null", is_hash_or_null};
constexpr FieldKind time = {"a number from 0 on", is_time};
constexpr FieldKind limit = {"what limits a correlation", is_limit};
constexpr FieldKind correlation_word = {"\"correlation\"", is_correlation_word};
constexpr FieldKind order_word = {"\"order\"", is_order_word};
constexpr FieldKind drift_word = {"\"drift\"", is_drift_word};

// Without an account nothing is known of the energy; with one, its errors are there.
std::string energy_contradiction(const Json& row) {
  if (!row.contains("energy") || row.at("energy").is_null()) return "";
  for (const auto* key : {"max_energy_error", "max_energy_error_raw"})
    if (!row.contains(key)) return fmt::format("'energy' without '{}'", key);
  return "";
}

std::string end_contradiction(const Json& row) {
  const bool end = row.at("limited_by") == "the end of the run";
  return end == row.at("to_the_end").get<bool>()
             ? ""
             : fmt::format("'to_the_end' is {}, but 'limited_by' is {}", row.at("to_the_end").dump(),
                           row.at("limited_by").dump());
}

std::string no_contradiction(const Json& /*row*/) {
  return "";
}

constexpr std::array<Field, 22> scene_fields = {{{"scene", name},
                                                 {"type", word},
                                                 {"integrator", word},
                                                 {"dt", dt},
                                                 {"variant", text, optional},
                                                 {"steps", count},
                                                 {"t_end", number},
                                                 {"bodies", count},
                                                 {"contacts", count, optional},
                                                 {"parts_left_out", objects, optional},
                                                 {"kinetic_energy_half_step_J", number, optional},
                                                 {"kinetic_energy_on_step_J", number, optional},
                                                 {"mean_position", position, optional},
                                                 {"energy", account, optional},
                                                 {"energy_start", number, optional},
                                                 {"max_energy_error", size, optional},
                                                 {"max_energy_error_raw", size, optional},
                                                 {"energy_slope", number, optional},
                                                 {"energy_slope_raw", number, optional},
                                                 {"state_hash", hash_or_null, optional},
                                                 {"scene_file", text, optional},
                                                 {"plan", hash}}};
constexpr std::array<std::string_view, 5> scene_key = {"scene", "type", "integrator", "dt", "variant"};

constexpr std::array<Field, 12> correlation_fields = {{{"what", correlation_word},
                                                       {"scene", name},
                                                       {"type", name},
                                                       {"against", name},
                                                       {"integrator", word},
                                                       {"dt", dt},
                                                       {"variant", text, optional},
                                                       {"steps", steps, optional},
                                                       {"t_s", time},
                                                       {"to_the_end", flag},
                                                       {"limited_by", limit},
                                                       {"plan", hash}}};
constexpr std::array<std::string_view, 5> correlation_key = {"scene", "type", "against", "dt", "variant"};

constexpr std::array<Field, 11> order_fields = {{{"what", order_word},
                                                 {"integrator", word},
                                                 {"order", positive},
                                                 {"type", word},
                                                 {"problem", name},
                                                 {"t_end", positive, optional},
                                                 {"dt", positive},
                                                 {"steps", steps},
                                                 {"error", size},
                                                 {"measured_order", number},
                                                 {"plan", hash, optional}}};
constexpr std::array<Field, 9> drift_fields = {{{"what", drift_word},
                                                {"integrator", word},
                                                {"type", word},
                                                {"problem", name},
                                                {"dt", positive},
                                                {"t_end", positive},
                                                {"max_energy_error", size},
                                                {"energy_slope", number},
                                                {"plan", hash, optional}}};
constexpr std::array<std::string_view, 4> order_key = {"integrator", "type", "problem", "dt"};

std::string key_of(const Json& row, const LineKind& kind) {
  std::string key;
  for (const auto& name : kind.key) {
    const auto it = row.find(name);
    if (it != row.end())
      key += (key.empty() ? "" : " ") + (it->is_string() ? it->get<std::string>() : it->dump());
  }
  return key;
}

}  // namespace

const LineKind scene_lines = {"scenes.jsonl", scene_fields, scene_key, energy_contradiction};
const LineKind correlation_lines = {"correlation.jsonl", correlation_fields, correlation_key,
                                    end_contradiction};
const LineKind order_lines = {"orders.jsonl", order_fields, order_key, no_contradiction};
const LineKind drift_lines = {"drift.jsonl", drift_fields, order_key, no_contradiction};

std::vector<PlacedRow> read_rows(const std::filesystem::path& directory, const Json& context,
                                 const LineKind& kind) {
  const std::string file(kind.file);
  const std::string text = read_records_text(directory, file);
  std::vector<PlacedRow> rows;
  std::map<std::string, std::string> seen;
  for (auto& line : placed_lines(directory / file, text)) {
    Json row = parse_object(line.text, line.place);
    check_fields(row, kind.fields, UnknownKeys::refuse, line.place);
    const auto refuse = [&](const std::string& why) {
      throw Failure(Standing::bad_input, fmt::format("{}: {}", line.place, why));
    };
    if (const std::string why = kind.contradiction(row); !why.empty()) refuse(why);
    if (row.contains("plan") && row.at("plan") != context.at("plan"))
      refuse(fmt::format("plan {} is not that of {}", row.at("plan").get<std::string>(), context_file));
    const std::string key = key_of(row, kind);
    const auto [first, fresh] = seen.emplace(key, line.place);
    if (!fresh) refuse(fmt::format("{}: a second record; the first is at {}", key, first->second));
    rows.push_back({std::move(line.place), std::move(row)});
  }
  check_records_text(context, directory, file, text);
  return rows;
}

SceneRows read_scene_rows(const std::filesystem::path& directory) {
  SceneRows found{read_context(directory), {}, {}};
  found.scenes = read_rows(directory, found.context, scene_lines);
  if (std::filesystem::exists(directory / correlation_lines.file))
    found.correlations = read_rows(directory, found.context, correlation_lines);
  if (!found.context.at("complete").get<bool>()) return found;
  for (const auto& type : found.context.at("types")) {
    const auto there = [&](const PlacedRow& r) { return r.row.at("type") == type.value("token", Json()); };
    if (std::ranges::any_of(found.scenes, there)) continue;
    throw Failure(Standing::incomplete,
                  fmt::format("{}: no record of type {}, though {} says that the run is complete",
                              (directory / scene_lines.file).string(), type.value("token", Json()).dump(),
                              context_file));
  }
  return found;
}

}  // namespace ulpgate::app
