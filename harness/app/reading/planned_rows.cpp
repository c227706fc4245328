// What a plan asks for.
#include "harness/app/reading/planned_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"

namespace ulpgate::app {

namespace {

// No plan asks for more points of one row.
constexpr std::uint64_t most_points = std::uint64_t{1} << 48U;

struct PlannedRow {
  std::string type;
  std::string subject;
  std::string stratum;
  std::uint64_t points = 0;
  std::uint64_t dealt = 0;  // to the shards of the context
};

std::vector<PlannedRow> rows_of(const Json& context, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw Failure(Standing::bad_input, fmt::format("{}: 'planned' {}", place, why));
  };
  std::vector<PlannedRow> rows;
  for (const auto& [type, subjects] : context.at("planned").items()) {
    if (!subjects.is_object()) refuse(fmt::format("has no functions of {}", type));
    for (const auto& [subject, strata] : subjects.items()) {
      if (!strata.is_object()) refuse(fmt::format("has no strata of {} {}", type, subject));
      for (const auto& [stratum, points] : strata.items()) {
        if (!find_stratum(stratum)) refuse(fmt::format("names a stratum '{}'", stratum));
        if (!field::is_steps(points) || points.get<std::uint64_t>() > most_points)
          refuse(fmt::format("has no number of points for {} {} {}", type, subject, stratum));
        rows.push_back({type, subject, stratum, points.get<std::uint64_t>(), 0});
      }
    }
  }
  if (rows.empty()) refuse("asks for nothing");
  return rows;
}

// How many points of a row, whose `units` begin at position `first` of the plan, belong to the shard: unit i
// is of shard i mod count, and only the row's last one may be short.
std::uint64_t points_of(const Shard& shard, std::uint64_t first, std::uint64_t units, std::uint64_t size,
                        std::uint64_t points) {
  const std::uint64_t own = first + (shard.index + shard.count - first % shard.count) % shard.count;
  if (own >= first + units) return 0;
  const std::uint64_t last = first + units - 1;
  const std::uint64_t number = (last - own) / shard.count + 1;
  const std::uint64_t missing = last % shard.count == shard.index ? units * size - points : 0;
  return number * size - missing;
}

// As Plan orders its units: the worst cases first, then row by row.
void deal(std::vector<PlannedRow>& rows, const Json& shards) {
  std::vector<Shard> taken;
  for (const std::string text : shards) taken.push_back(parse_shard(text));
  std::uint64_t position = 0;
  for (const bool worst : {true, false}) {
    for (auto& row : rows) {
      const Stratum stratum = *find_stratum(row.stratum);
      if ((stratum == Stratum::worst) != worst) continue;
      const std::uint64_t size = unit_size_of(stratum);
      const std::uint64_t units = (row.points + size - 1) / size;
      for (const auto& shard : taken) row.dealt += points_of(shard, position, units, size, row.points);
      position += units;
    }
  }
}

// The parts of each function, or the quantities of each kernel.
std::map<std::string, std::vector<std::string>> parts_of(const Json& context, const std::string& place) {
  std::map<std::string, std::vector<std::string>> parts;
  const bool functions = context.contains("functions");
  constexpr std::array<Field, 2> function_fields = {{{"name", field::word}, {"parts", field::texts}}};
  constexpr std::array<Field, 2> kernel_fields = {{{"name", field::word}, {"outputs", field::objects}}};
  constexpr std::array<Field, 1> output_fields = {{{"name", field::word}}};
  for (const auto& entry : context.at(functions ? "functions" : "kernels")) {
    check_fields(entry, functions ? std::span<const Field>(function_fields) : kernel_fields,
                 UnknownKeys::ignore, place);
    auto& names = parts[entry.at("name")];
    if (functions) {
      names = entry.at("parts").get<std::vector<std::string>>();
      continue;
    }
    for (const auto& output : entry.at("outputs")) {
      check_fields(output, output_fields, UnknownKeys::ignore, place);
      names.push_back(output.at("name"));
    }
  }
  return parts;
}

}  // namespace

Json planned_rows(const Plan& plan) {
  Json planned = Json::object();
  for (const auto& row : plan.rows()) {
    planned[row.subject->type().token][row.subject->name()][std::string(name_of(row.source.stratum))] =
        row.source.count;
  }
  return planned;
}

std::vector<std::string> absent_rows(const Json& context, const std::string& context_place,
                                     const std::vector<RowRecord>& records,
                                     const std::vector<std::string>& places) {
  auto rows = rows_of(context, context_place);
  deal(rows, context.at("shards"));
  const auto parts = parts_of(context, context_place);
  struct Wanted {
    const PlannedRow* row;
    const RowRecord* record;
    const std::string* place;
  };
  std::map<std::string, Wanted> wanted;
  const auto name = [](const std::string& subject, const std::string& part, const std::string& type,
                       const std::string& stratum) {
    return fmt::format("{} {} {} {}", subject, part, type, stratum);
  };
  for (const auto& row : rows) {
    const auto found = parts.find(row.subject);
    if (found == parts.end()) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: '{}' is planned, but not described", context_place, row.subject));
    }
    for (const auto& part : found->second)
      wanted[name(row.subject, part, row.type, row.stratum)] = {&row, nullptr, nullptr};
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    const RowRecord& r = records[i];
    const std::string key = name(r.subject, r.part, r.type, r.stratum);
    const auto refuse = [&](const std::string& why) {
      throw Failure(Standing::bad_input, fmt::format("{}: {}: {}", places[i], key, why));
    };
    const auto it = wanted.find(key);
    if (it == wanted.end()) refuse("not among the rows that were planned");
    auto& [row, record, place] = it->second;
    if (record != nullptr) refuse(fmt::format("a second record; the first is at {}", *place));
    record = &r;
    place = &places[i];
    if (r.planned != row->points)
      refuse(fmt::format("planned {}, {} says {}", r.planned, context_place, row->points));
    if (r.summary.samples > row->dealt)
      refuse(fmt::format("{} samples, of which only {} were dealt to it", r.summary.samples, row->dealt));
    if (context.contains("seed") && context.at("seed") != r.seed)
      refuse(fmt::format("seed {}, {} says {}", r.seed, context_place, context.at("seed").dump()));
  }
  std::vector<std::string> absent;
  for (const auto& [key, one] : wanted) {
    if (one.record == nullptr) {
      if (one.row->dealt > 0) absent.push_back(key);
    } else if (one.record->summary.samples < one.row->dealt) {
      absent.push_back(
          fmt::format("{} ({} of {} samples)", key, one.record->summary.samples, one.row->dealt));
    }
  }
  return absent;
}

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 5;
  const auto shown = std::span(names).first(std::min(most, names.size()));
  return fmt::format("{}{}", fmt::join(shown, "; "),
                     names.size() > most ? fmt::format("; and {} more", names.size() - most) : "");
}

}  // namespace ulpgate::app
