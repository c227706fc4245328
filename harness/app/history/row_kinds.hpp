// Kinds of rows: which fields of a line of records say what the row is, and which what it came to.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "harness/app/reading/json_fields.hpp"

namespace ulpgate::app {

struct RowKind {
  std::string_view word;  // "math"
  std::string_view file;  // "math.jsonl"
  std::string_view name;  // field of the subject's name
  std::string_view part;  // of what is looked at of it, where there is more than one thing
  std::span<const std::string_view> setting;  // what else must be the same of two rows that are compared
  std::span<const std::string_view> error;  // the figure that is watched: the first of these that is a number
  std::string_view unit;
  bool more_is_better = false;
  std::string_view argument;                   // where it was reached; may be empty
  std::span<const std::string_view> left_out;  // says nothing of the result
};

[[nodiscard]] std::span<const RowKind> row_kinds();
// The kind of that word; nullptr where a newer program wrote it.
[[nodiscard]] const RowKind* find_row_kind(std::string_view word);

// What one row is.
struct RowKey {
  std::string kind, name, part, type, setting;
  auto operator<=>(const RowKey&) const = default;
  // "exp double, uniform seed 1 planned 1000"
  [[nodiscard]] std::string text() const;
};

// What one row came to.
struct RowResult {
  std::optional<double> error;  // infinity where it has no bound, nothing where there is none
  std::string argument;
  std::uint64_t mismatches = 0;  // results that no error describes; 1 for a failure of a row of one result
  std::string figures;           // all of them, as JSON: rows are the same where these texts are

  bool operator==(const RowResult& other) const { return figures == other.figures; }
};

[[nodiscard]] RowKey key_of(const RowKind& kind, const Json& line);
// The text of RowResult::figures for a line, and what it says.
[[nodiscard]] std::string figures_of(const RowKind& kind, const Json& line);
[[nodiscard]] RowResult result_of(const RowKind* kind, std::string figures);

enum class Change { none, better, worse, other };
[[nodiscard]] std::string_view to_string(Change change);
// By mismatches and error; `other` where both stay and another figure does not.
[[nodiscard]] Change change_of(const RowKind* kind, const RowResult& before, const RowResult& after);
// "max_ulp 0.51 -> 1.51, argmax [\"0x1p+0\"] -> ...": the figures that differ, the watched one first.
[[nodiscard]] std::string change_text(const RowKind* kind, const RowResult& before, const RowResult& after);

}  // namespace ulpgate::app
