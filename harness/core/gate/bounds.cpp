// Bounds of maxima.
#include "harness/core/gate/bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "harness/core/gate/limits.hpp"

namespace ulpgate {

double exceeded_by_no_seed(std::span<const double> maxima) {
  constexpr double euler = 0.5772156649015329;
  constexpr double pi = 3.141592653589793;
  constexpr double log_of_chance = 13.8;  // ln(1e6)
  const auto n = static_cast<double>(maxima.size());
  std::vector<double> logs;
  for (const double m : maxima) logs.push_back(std::log(m));
  const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / n;
  double squares = 0;
  for (const double x : logs) squares += (x - mean) * (x - mean);
  const double scale = std::sqrt(6 * squares / (n - 1)) / pi * (1 + 2 / std::sqrt(n));
  const double level = std::exp(mean - euler * scale + scale * log_of_chance);
  return std::max(level, *std::ranges::max_element(maxima));
}

void add_bounds(Budgets& measured, const std::vector<std::vector<RowRecord>>& seeds) {
  struct Maxima {
    std::vector<double> ulp;
    std::vector<double> over_condition;
    bool of_kernel = false;
  };
  std::map<std::array<std::string, 3>, Maxima> maxima;  // by type, row, stratum
  for (const auto& records : seeds) {
    for (const RowRecord& r : records) {
      const auto stratum = find_stratum(r.stratum);
      if (!stratum || !is_drawn(*stratum) || r.summary.judged() == 0) continue;
      Maxima& m = maxima[{r.type, budget_key(r), r.stratum}];
      m.of_kernel = r.subject_class == kernel_class;
      m.ulp.push_back(r.summary.max_error.value);
      m.over_condition.push_back(r.summary.max_error_over_condition);
    }
  }
  const auto bound = [](const std::vector<double>& of, double measured_limit) -> std::optional<double> {
    const bool good = of.size() >= least_seeds &&
                      std::ranges::all_of(of, [](double x) { return std::isfinite(x) && x > 0; });
    if (!good) return std::nullopt;
    const double level = round_up(std::max(exceeded_by_no_seed(of), measured_limit));
    return std::isfinite(level) ? std::optional(level) : std::nullopt;
  };
  for (auto& [token, type] : measured) {
    for (auto& [row, budget] : type.rows) {
      for (const auto& [stratum, count] : budget.samples) {
        const auto m = maxima.find({token, row, stratum});
        if (m == maxima.end()) continue;
        const auto limit = budget.max_ulp.find(stratum);
        if (limit == budget.max_ulp.end()) continue;
        const auto ulp = bound(m->second.ulp, limit->second);
        if (ulp) {
          budget.bound_ulp[stratum] = *ulp;
        } else if (m->second.ulp.size() >= least_seeds && limit->second == 0 &&
                   std::ranges::all_of(m->second.ulp, [](double x) { return x == 0; })) {
          budget.bound_ulp[stratum] = 0;  // exact for every seed
        }
        const auto over = budget.over_condition.find(stratum);
        if (over == budget.over_condition.end()) continue;
        if (const auto ratio = bound(m->second.over_condition, over->second)) {
          // What is divided by a condition number of at least one is no larger than the error; of kernels it
          // is another error.
          const bool capped = ulp && !m->second.of_kernel;
          budget.bound_over_condition[stratum] = capped ? std::min(*ulp, *ratio) : *ratio;
        }
      }
      // The strata overlap: what one meets often, as the logarithms' worst errors next to 1, another meets
      // once in a hundred seeds.  The largest bound of the row holds for all.
      double largest = 0;
      for (const auto& [stratum, limit] : budget.bound_ulp) largest = std::max(largest, limit);
      for (auto& [stratum, limit] : budget.bound_ulp) limit = largest;
    }
  }
}

}  // namespace ulpgate
