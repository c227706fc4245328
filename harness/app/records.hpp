// Records: RowRecord to a JSON line and back; directories of records.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/core/row_record.hpp"

namespace ulpgate::app {

using Json = nlohmann::ordered_json;

[[nodiscard]] std::string to_json_line(const RowRecord& record);
// `place` ("DIR/math.jsonl:12") stands in the message of the Failure for a malformed line.
[[nodiscard]] RowRecord from_json_line(const std::string& line, const std::string& place);

// A number, or the string "inf", or null where there is none (negative stands for "nothing seen").
[[nodiscard]] Json number_or_text(double x);

struct RecordSet {
  Json context;
  std::vector<RowRecord> records;
};
[[nodiscard]] RecordSet read_records(const std::filesystem::path& directory);
// Sorted by (function, part, type, stratum), a JSON object a line.
[[nodiscard]] std::string records_text(std::vector<RowRecord> records);

}  // namespace ulpgate::app
