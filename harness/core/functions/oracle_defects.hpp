// Known defects of a family's RealHP<4>: rows that the comparison of the oracles may disagree on, each with
// its cause.
#pragma once

#include <optional>
#include <string_view>

#include "reference/functions/function_info.hpp"

namespace ulpgate {

// Why the RealHP<4> of the type `token` is not a trustworthy reference for f, or nothing where it must agree
// with MPFR.  MPFR decides every judgement; this only says which disagreements are explained.
[[nodiscard]] std::optional<std::string_view> known_oracle_defect(const FunctionInfo& f,
                                                                  std::string_view token);

}  // namespace ulpgate
