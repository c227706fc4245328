// Machine facts: what else decides a run's numbers beside its plan.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ulpgate::app {

// Program, compiler, flags, libraries with path and build-id, which variants of the math functions the loader
// chose, instruction sets and processor.  The same in every process of one program on one machine.
[[nodiscard]] nlohmann::ordered_json machine_facts();

// The facts in which two contexts differ, "libm_variants \"1f\", not \"2e\"": what `there` says, then `here`.
// Empty where both were made by the same program on the same machine.
[[nodiscard]] std::vector<std::string> machine_differences(const nlohmann::ordered_json& there,
                                                           const nlohmann::ordered_json& here);

// Those of a context's facts that decide the bits of a function's results: versions and build-ids of
// libraries, variants, processor.
[[nodiscard]] std::map<std::string, std::string> deciding_facts(const nlohmann::ordered_json& context);

}  // namespace ulpgate::app
