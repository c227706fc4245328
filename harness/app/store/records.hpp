// Records: RowRecord to a JSON line and back; directories of records.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/core/records/row_record.hpp"

namespace ulpgate::app {

using Json = nlohmann::ordered_json;

[[nodiscard]] std::string to_json_line(const RowRecord& record);
// `place` ("DIR/math.jsonl:12") stands in the message of the Failure for a malformed line.
[[nodiscard]] RowRecord from_json_line(const std::string& line, const std::string& place);

// A number, or the string "inf", or null where there is none (negative stands for "nothing seen").
[[nodiscard]] Json number_or_text(double x);

// The files of a run's directory; a directory holds the records of one plan.
inline constexpr const char* math_records_file = "math.jsonl";
inline constexpr const char* kernel_records_file = "kernels.jsonl";
inline constexpr const char* scene_records_file = "scenes.jsonl";

struct RecordSet {
  Json context;
  std::vector<RowRecord> records;
  std::string file;  // name of the file that holds them
};
[[nodiscard]] RecordSet read_records(const std::filesystem::path& directory);
// Writes context.json; `finished` says that every unit of the shard was done.
void write_context(const std::filesystem::path& out, Json context, bool finished);
// Whether `out` holds all records of this shard of this plan.
[[nodiscard]] bool is_finished(const std::filesystem::path& out, const std::string& plan_hash,
                               const std::string& shard);
// Throws a Failure unless `out` is empty or holds records of the plan with this hash: those of another plan
// are somebody's results and are not written over unless asked.
void guard_output(const std::filesystem::path& out, const std::string& plan_hash, bool overwrite);
// Sorted by (function, part, type, stratum), a JSON object a line.
[[nodiscard]] std::string records_text(std::vector<RowRecord> records);

}  // namespace ulpgate::app
