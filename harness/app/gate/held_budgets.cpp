// The budgets that hold for records.
#include "harness/app/gate/held_budgets.hpp"

#include <fmt/format.h>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

std::optional<PlatformBudgets> platform_for(const std::string& records, const std::string& budgets,
                                            const nlohmann::ordered_json& context, const GateRules& rules) {
  if (rules.platform == "base") return std::nullopt;
  // Budgets that name no platform ask for none of the records.
  if (!find_platform_budgets(budgets, Platform())) {
    if (rules.platform.empty() || !rules.update) return std::nullopt;
    throw Failure(Standing::bad_input,
                  fmt::format("{}: no file 'platform' here or above: budgets that name no platform have no "
                              "others; write them with --update alone",
                              budgets));
  }
  return find_platform_budgets(budgets, platform_of(deciding_facts(context), records + "/context.json"));
}

void check_overlay(const Budgets& base, const Budgets& overlay, const std::filesystem::path& directory) {
  for (const auto& [token, type] : overlay) {
    const auto of_base = base.find(token);
    if (of_base == base.end()) continue;
    if (of_base->second.samples == type.samples && of_base->second.seed == type.seed) continue;
    throw Failure(
        Standing::bad_input,
        fmt::format("{}: its [plan] is of {} samples with seed {}, that of the base of {} with seed {}",
                    (directory / (token + ".toml")).string(), type.samples, type.seed,
                    of_base->second.samples, of_base->second.seed));
  }
}

}  // namespace ulpgate::app
