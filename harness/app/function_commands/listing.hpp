// How `ulpgate list` shows rows: JSON or an aligned table.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "harness/app/store/context.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

using Table = std::vector<std::vector<std::string>>;

// `rows` where `json`, else `table`, whose first line is its head; `sides` as aligned() wants them, a letter
// a column.
inline void print_listing(bool json, const Json& rows, const Table& table, std::string_view sides) {
  if (json) {
    fmt::print("{}\n", rows.dump(2));
  } else {
    show_text(aligned(table, sides));
  }
}

inline std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

inline std::vector<std::string> part_names(const SubjectInfo& subject) {
  std::vector<std::string> names;
  for (const auto& part : subject.parts) names.push_back(part.name);
  return names;
}

}  // namespace ulpgate::app
