// Budgets of a platform: the rows that differ from the base, laid over it.
#pragma once

#include "harness/core/gate/budgets.hpp"
#include "harness/core/gate/figure_budgets.hpp"

namespace ulpgate {

// The base with the rows of the overlay in the place of its own.
[[nodiscard]] Budgets overlaid(Budgets base, const Budgets& overlay);
[[nodiscard]] FigureBudgets overlaid(FigureBudgets base, const FigureBudgets& overlay);

// Rows with what they were changed for.
template <class AllBudgets>
struct PlatformRows {
  AllBudgets rows;
  std::vector<Raise> changes;
};

// The rows of `measured`, by `records` of the same plan, that do not hold on the platform: beyond a limit of
// `held`, without a budget there, or lists whose worst error is so small that its cases would count as lost.
// Each is a whole row: strata that were measured have the limits of the platform, others those of `held`;
// what no seed exceeds is no less than either.
[[nodiscard]] PlatformRows<Budgets> platform_rows(const Budgets& held, const Budgets& measured,
                                                  const std::vector<RowRecord>& records,
                                                  const std::string& reason);
[[nodiscard]] PlatformRows<FigureBudgets> platform_rows(const FigureBudgets& held,
                                                        const std::vector<MeasuredRow>& measured,
                                                        const std::string& reason);

}  // namespace ulpgate
