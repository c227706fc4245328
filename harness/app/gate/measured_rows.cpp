// Records as rows with figures.
#include "harness/app/gate/measured_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "harness/app/advice/work_precision_records.hpp"
#include "harness/app/gate/stress_rows.hpp"
#include "harness/app/orders/order_output.hpp"
#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/scenes/scene_gate.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/core/gate/findings/reproducer.hpp"
#include "harness/core/orders/order_judgement.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

namespace {

// A number of a row; a word or null stands for what is no finite number.
double number_in(const Json& row, const char* key) {
  const Json& x = row.at(key);
  return x.is_number() ? x.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// What the run itself found wrong of a row that its lines begin with; empty where nothing.
std::string wrong_of(const OrderVerdicts& verdicts, const std::string& name) {
  for (const auto& line : verdicts.wrong)
    if (line.starts_with(name + ": ")) return line.substr(name.size() + 2);
  return "";
}

OrderVerdicts verdicts_of(const std::filesystem::path& directory, const Json& context) {
  return verdicts_from_json(context.value("verdicts", Json()), (directory / context_file).string());
}

// Errors below it, 4096 units of the type at 1, have no order (orders/ladder_measurement).
double order_floor(const std::string& type, const std::string& place) {
  const RealDescriptor* known = find_type(type);
  if (known == nullptr)
    throw Failure(Standing::bad_input, fmt::format("{}: no type '{}' is built in", place, type));
  return std::ldexp(4096.0, 1 - known->significand_bits);
}

std::vector<MeasuredRow> order_rows(const std::filesystem::path& directory, const Json& context) {
  const OrderVerdicts verdicts = verdicts_of(directory, context);
  std::map<std::string, MeasuredRow> by_name;
  std::vector<std::string> names;
  std::map<std::string, std::size_t> rungs;
  for (const PlacedRow& rung : read_rows(directory, context, order_lines)) {
    const std::string integrator = rung.row.at("integrator");
    const std::string type = rung.row.at("type");
    const std::string problem = rung.row.at("problem");
    const std::string name = fmt::format("{} {} {}", integrator, type, problem);
    const auto [at, fresh] = by_name.try_emplace(name);
    MeasuredRow& m = at->second;
    if (fresh) {
      names.push_back(name);
      m.of = RowKind::order;
      m.name = problem;
      m.type = type;
      m.run = integrator;
      m.reproduce = fmt::format("ulpgate integrators --integrators {} --types {} --problems {}",
                                shell_word(integrator), type, problem);
      m.breach = wrong_of(verdicts, name);
    }
    const double error = number_in(rung.row, "error");
    const auto least = m.figures.find("least_error");
    // NaN stays: what is no number is beyond every budget.
    if (least == m.figures.end() || !(error >= least->second)) m.figures["least_error"] = error;
    // As the measurement takes it: of the last rung above the floor of rounding.
    ++rungs[name];
    if (error >= order_floor(type, rung.place) && rung.row.at("measured_order").is_number())
      m.figures["measured_order"] = number_in(rung.row, "measured_order");
    m.wanted = fmt::format("order {}", rung.row.at("order").dump());
  }
  std::vector<MeasuredRow> rows;
  for (const auto& name : names) {
    MeasuredRow& m = by_name.at(name);
    // With fewer the order is not yet asymptotic, and the run did not judge it either.
    if (rungs.at(name) < least_judged_rungs) m.figures.erase("measured_order");
    m.got = m.breach;
    rows.push_back(std::move(m));
  }
  return rows;
}

std::vector<MeasuredRow> drift_rows(const std::filesystem::path& directory, const Json& context) {
  const OrderVerdicts verdicts = verdicts_of(directory, context);
  std::vector<MeasuredRow> rows;
  for (const PlacedRow& row : read_rows(directory, context, drift_lines)) {
    MeasuredRow& m = rows.emplace_back();
    const std::string integrator = row.row.at("integrator");
    m.of = RowKind::drift;
    m.name = row.row.at("problem");
    m.type = row.row.at("type");
    const auto units = static_cast<std::uint64_t>(std::llround(number_in(row.row, "t_end")));
    const auto per_unit = static_cast<std::uint64_t>(std::llround(1 / number_in(row.row, "dt")));
    m.run = fmt::format("{} steps_per_unit={} units={}", integrator, per_unit, units);
    m.figures["max_energy_error"] = number_in(row.row, "max_energy_error");
    m.breach = wrong_of(verdicts, fmt::format("{} {} {}", integrator, m.type, m.name));
    m.got = row.row.at("max_energy_error").dump();
    m.wanted = "a finite energy error";
    m.reproduce = fmt::format(
        "ulpgate integrators --integrators {} --types {} --problems {} --drift {} --steps-per-unit {}",
        shell_word(integrator), m.type, m.name, units, per_unit);
  }
  return rows;
}

std::string work_reproducer(const Json& row) {
  const std::string name = row.at("name");
  const std::string type = row.at("type");
  if (!row.contains("integrator")) {
    return fmt::format("ulpgate work-precision --subjects {} --types {} --samples {} --repeats 0", name, type,
                       row.at("evaluations").dump());
  }
  const std::string step =
      row.contains("dt_text") ? "--dt " + shell_word(row.at("dt_text")) : "--steps " + row.at("steps").dump();
  return fmt::format(
      "ulpgate work-precision --cases {} --types {} --integrators {} {} --until {} --repeats 0", name, type,
      shell_word(row.at("integrator")), step, shell_word(row.at("end").get<std::string>()));
}

std::vector<MeasuredRow> work_rows(const std::filesystem::path& directory, const Json& context) {
  std::vector<MeasuredRow> rows;
  for (const PlacedRow& row : read_rows(directory, context, work_precision_lines)) {
    const Json& j = row.row;
    MeasuredRow& m = rows.emplace_back();
    m.of = RowKind::work_precision;
    m.name = j.at("name");
    m.type = j.at("type");
    m.run = j.at("subject");
    if (j.contains("integrator")) {
      const std::string end = j.at("end");
      m.run += fmt::format(" {} end={} steps={}", j.at("integrator").get<std::string>(), end,
                           j.at("steps").dump());
      if (j.contains("dt_text")) m.run += " dt=" + j.at("dt_text").get<std::string>();
    }
    m.outcome = j.at("failure").is_string() ? j.at("failure").get<std::string>() : "measured";
    for (const auto* key : {"final_error", "largest_error", "energy_error"})
      if (!j.at(key).is_null()) m.figures[key] = number_in(j, key);
    m.reproduce = work_reproducer(j);
  }
  return rows;
}

struct Reader {
  const char* file;
  RowKind of;
  std::vector<MeasuredRow> (*read)(const std::filesystem::path& directory, const Json& context);
};
constexpr const char* orders_file = "orders.jsonl";
constexpr const char* drift_file = "drift.jsonl";
const std::array<Reader, 5> readers = {{{scene_records_file, RowKind::scene,
                                         [](const std::filesystem::path& directory, const Json& /*context*/) {
                                           return read_scene_measurements(directory);
                                         }},
                                        {orders_file, RowKind::order, order_rows},
                                        {drift_file, RowKind::drift, drift_rows},
                                        {stress_records_file, RowKind::stress, stress_rows},
                                        {work_precision_file, RowKind::work_precision, work_rows}}};

const Reader* reader_of(const std::filesystem::path& directory) {
  for (const Reader& reader : readers)
    if (std::filesystem::exists(directory / reader.file)) return &reader;
  return nullptr;
}

}  // namespace

bool has_measured_rows(const std::filesystem::path& directory) {
  return reader_of(directory) != nullptr;
}

MeasuredRows read_measured_rows(const std::filesystem::path& directory) {
  const Reader* reader = reader_of(directory);
  if (reader == nullptr)
    throw Failure(Standing::nothing_measured, fmt::format("{}: no records", directory.string()));
  MeasuredRows found{reader->of, read_context(directory), {}};
  if (!found.context.at("complete").get<bool>())
    throw Failure(Standing::incomplete, fmt::format("{}: the run is not complete", directory.string()));
  found.rows = reader->read(directory, found.context);
  std::set<std::pair<std::string, std::string>> seen;
  for (const MeasuredRow& m : found.rows) {
    // Two would share a budget.
    if (!seen.insert({m.name, figure_key(m)}).second)
      throw Failure(Standing::bad_input,
                    fmt::format("{}: {} {} is there twice", directory.string(), m.name, figure_key(m)));
  }
  if (found.rows.empty())
    throw Failure(Standing::nothing_measured, fmt::format("{}: no records", directory.string()));
  return found;
}

}  // namespace ulpgate::app
