// Names on the command line: functions, types, strata and shards, with a helpful word for the misspelt.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/core/kernels/kernel_plan.hpp"
#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

[[nodiscard]] std::vector<std::string> split(const std::string& text, char separator);
// "all", "real", "complex", "special" or names; in the order of the function list, each once.
[[nodiscard]] std::vector<FunctionId> select_functions(const std::string& text);
[[nodiscard]] std::vector<std::string> select_types(const std::string& text);
[[nodiscard]] std::vector<Stratum> select_strata(const std::string& text);
// Where the exhaustive stratum was asked for: types and functions that it cannot take are a Failure when
// named one by one, and left out when they came with "all", "real" and the like.
void narrow_to_exhaustible(const std::string& functions, const std::string& types, PlanRequest& request);
[[nodiscard]] std::vector<dem::KernelId> select_kernels(const std::string& text);
[[nodiscard]] std::vector<StateStratum> select_state_strata(const std::string& text);

struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;
  [[nodiscard]] std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
};
// "0/3": zero-based.
[[nodiscard]] Shard parse_shard(const std::string& text);

// Throws the Failure for an unknown name, with the nearest of the known ones.
[[noreturn]] void unknown_name(const std::string& what, const std::string& name,
                               const std::vector<std::string>& known);
[[nodiscard]] const FunctionInfo& function_or_fail(const std::string& name);
[[nodiscard]] const TypeEngine& type_or_fail(const std::string& token);

}  // namespace ulpgate::app
