// Known defects of a family's RealHP<4>.
#include "harness/core/oracle_defects.hpp"

namespace ulpgate {

std::optional<std::string_view> known_oracle_defect(const FunctionInfo&, std::string_view) { return std::nullopt; }

}  // namespace ulpgate
