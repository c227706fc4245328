// Correlation of two recorded signals in chunks.
#include "harness/core/scenes/correlation.hpp"

#include <cmath>

namespace ulpgate {

double pearson(std::span<const double> a, std::span<const double> b) {
  const auto n = static_cast<double>(a.size());
  double mean_a = 0;
  double mean_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
  }
  double aa = 0;
  double bb = 0;
  double ab = 0;
  bool equal = true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = a[i] - mean_a;
    const double y = b[i] - mean_b;
    aa += x * x;
    bb += y * y;
    ab += x * y;
    equal = equal && a[i] == b[i];
  }
  if (equal) return 1;
  const double p = ab / std::sqrt(aa * bb);
  // A series that has left the numbers, or that stands still, is not correlated.
  return std::isfinite(p) ? p : 0;
}

std::vector<double> chunk_correlations(std::span<const double> a, std::span<const double> b,
                                       const CorrelationRule& rule) {
  std::vector<double> p;
  for (std::size_t start = 0; start + rule.chunk <= a.size() && start + rule.chunk <= b.size();
       start += rule.chunk)
    p.push_back(pearson(a.subspan(start, rule.chunk), b.subspan(start, rule.chunk)));
  return p;
}

std::size_t true_records(std::span<const double> correlations, const CorrelationRule& rule) {
  std::size_t chunk = 0;
  while (chunk < correlations.size() && correlations[chunk] >= rule.limit) ++chunk;
  return chunk * rule.chunk;
}

}  // namespace ulpgate
