// Names on the command line: subjects, types, strata and shards, with a helpful word for the misspelt.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/core/plan/plan.hpp"
#include "harness/core/subject/registry.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate::app {

[[nodiscard]] std::vector<std::string> split(const std::string& text, char separator);
// "all", a class of subjects ("real", "complex", "special") or names; in the order of the lists, each once.
[[nodiscard]] std::vector<std::string> select_subjects(SubjectKind kind, const std::string& text);
[[nodiscard]] std::vector<std::string> select_types(const std::string& text);
[[nodiscard]] std::vector<Stratum> select_strata(SubjectKind kind, const std::string& text);
// Where the exhaustive or the narrow stratum was asked for: types and functions that it cannot take are a
// Failure when named one by one, and left out when they came with "all", "real" and the like.
void keep_rows_of_named_strata(const std::string& functions, const std::string& types, PlanRequest& request);

struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;
  [[nodiscard]] std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
};
// No run has more units; positions of units, sums of index and count, stay far from the end of their type.
inline constexpr std::uint64_t most_shards = std::uint64_t{1} << 32U;
// "0/3": zero-based.
[[nodiscard]] Shard parse_shard(const std::string& text);

// Throws the Failure for an unknown name, with the nearest of the known ones.
[[noreturn]] void unknown_name(const std::string& what, const std::string& name,
                               const std::vector<std::string>& known);
[[nodiscard]] const FunctionInfo& function_or_fail(const std::string& name);
[[nodiscard]] const RealDescriptor& type_or_fail(const std::string& token);
// A function or kernel in a type.
[[nodiscard]] const Subject& subject_or_fail(const std::string& name, const std::string& token);

}  // namespace ulpgate::app
