// Correlation of two recorded signals in chunks: how long a run in one precision stays true to a reference.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ulpgate {

// Pearson's correlation coefficient of two series of one length; 1 where they are equal, though constant, and
// 0 where only one varies.
[[nodiscard]] double pearson(std::span<const double> a, std::span<const double> b);

struct CorrelationRule {
  std::size_t chunk = 500;  // records
  double limit = 0.9;
};

// Coefficients chunk by chunk; a last chunk that is not full is left out.
[[nodiscard]] std::vector<double> chunk_correlations(std::span<const double> a, std::span<const double> b,
                                                     const CorrelationRule& rule);

// t_s: the start of the first chunk whose coefficient lies below the limit, in records; the length of all
// chunks where none does.
[[nodiscard]] std::size_t true_records(std::span<const double> correlations, const CorrelationRule& rule);

}  // namespace ulpgate
