// Worst cases kept as data: ci/worst_cases/<type token>.txt, one "function argument..." a line, # starts a
// comment.
#pragma once

#include <filesystem>

#include "harness/core/plan/plan.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate::app {

struct WorstCaseFile {
  WorstCases cases;
  std::string text;  // canonical text of what applies, for the plan's hash
};

// Reads the files of the given types; a type without a file has no worst cases.  Functions that are not
// selected are checked and left out.
[[nodiscard]] WorstCaseFile read_worst_cases(const std::filesystem::path& directory,
                                             const PlanRequest& request);

// The cases of one function in one type that a directory holds.
[[nodiscard]] ArgumentList worst_cases_of(const std::filesystem::path& directory, const FunctionInfo& f,
                                          const std::string& token);
// Adds the point to the file of the type unless the file holds one of the function with at least this error;
// says what was done.
[[nodiscard]] std::string offer_worst_case(const std::filesystem::path& directory, const FunctionInfo& f,
                                           const std::string& token, const std::vector<MpfrValue>& args,
                                           double error_ulp);

// A number of the type; the Failure of a bad one begins with `place`.
[[nodiscard]] MpfrValue parse_number(const RealDescriptor& type, const std::string& text,
                                     const std::string& place);
// The same for argument slot `slot` of f, with what its domain asks for.
[[nodiscard]] MpfrValue parse_argument(const FunctionInfo& f, std::size_t slot, const RealDescriptor& type,
                                       const std::string& text, const std::string& place);

}  // namespace ulpgate::app
