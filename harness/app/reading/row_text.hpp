// Row text: RowRecord to a line of math.jsonl or kernels.jsonl and back.
#pragma once

#include <optional>
#include <string>

#include "harness/app/reading/json_fields.hpp"
#include "harness/core/records/row_record.hpp"

namespace ulpgate::app {

[[nodiscard]] std::string to_json_line(const RowRecord& record);
// Throws a Failure of bad_input that begins with `place` ("DIR/math.jsonl:12") unless the line is one that
// to_json_line writes and its figures agree with each other.
[[nodiscard]] RowRecord from_json_line(const std::string& line, const std::string& place);

// What no measurement can have led to, in words: counts that do not add up, an error outside the greatest
// bucket of the histogram, a sum beyond what the buckets allow; nothing where the figures agree.
[[nodiscard]] std::optional<std::string> contradiction(const RowRecord& record);

// A number, or the string "inf", or null where there is none (negative stands for "nothing seen").
[[nodiscard]] Json number_or_text(double x);

}  // namespace ulpgate::app
