// The test of Mann and Whitney.
#include "harness/core/trend/rank_sum.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/core/trend/time_noise.hpp"

namespace ulpgate {

namespace {

constexpr std::size_t most_exact_pairs = 400;

// How many orders of n and m values give each U, as parts of all: c(n, m, u) = c(n-1, m, u-m) + c(n, m-1, u)
// (Mann and Whitney, equation 1), divided by what it adds up to.
std::vector<double> distribution(std::size_t n, std::size_t m) {
  std::vector<std::vector<double>> column(n + 1, {1.0});  // of i and 0 values
  for (std::size_t j = 1; j <= m; ++j) {
    std::vector<std::vector<double>> next(n + 1);
    next[0] = {1.0};
    for (std::size_t i = 1; i <= n; ++i) {
      next[i].assign(i * j + 1, 0.0);
      const double share = static_cast<double>(i) / static_cast<double>(i + j);
      for (std::size_t u = 0; u < next[i - 1].size(); ++u) next[i][u + j] += share * next[i - 1][u];
      for (std::size_t u = 0; u < column[i].size(); ++u) next[i][u] += (1 - share) * column[i][u];
    }
    column = std::move(next);
  }
  return column[n];
}

double exact_p_value(double u, std::size_t n, std::size_t m) {
  const auto parts = distribution(n, m);
  const auto pairs = static_cast<double>(n * m);
  const auto lower = static_cast<std::size_t>(std::min(u, pairs - u));
  double sum = 0;
  for (std::size_t i = 0; i <= lower; ++i) sum += parts[i];
  return std::min(1.0, 2 * sum);
}

// `tied` is the sum of t^3 - t over groups of t equal values.
double normal_p_value(double u, double n, double m, double tied) {
  const double all = n + m;
  const double variance = n * m / 12 * (all + 1 - tied / (all * (all - 1)));
  if (!(variance > 0)) return 1;
  const double distance = std::max(0.0, std::fabs(u - n * m / 2) - 0.5);
  return std::erfc(distance / std::sqrt(2 * variance));
}

double ties_of(std::vector<double> values) {
  std::ranges::sort(values);
  double tied = 0;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i + 1;
    while (end < values.size() && values[end] == values[i]) ++end;
    const auto t = static_cast<double>(end - i);
    tied += t * t * t - t;
    i = end;
  }
  return tied;
}

}  // namespace

RankSum rank_sum(std::span<const double> first, std::span<const double> second) {
  RankSum result;
  if (first.empty() || second.empty()) return result;
  std::vector<double> differences;
  differences.reserve(first.size() * second.size());
  for (const double a : first) {
    for (const double b : second) {
      differences.push_back(b - a);
      result.u += b > a ? 1 : b == a ? 0.5 : 0;
    }
  }
  result.shift = median(std::move(differences));
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const double tied = ties_of(std::move(all));
  const bool exact = tied == 0 && first.size() * second.size() <= most_exact_pairs;
  result.p_value = exact ? exact_p_value(result.u, first.size(), second.size())
                         : normal_p_value(result.u, static_cast<double>(first.size()),
                                          static_cast<double>(second.size()), tied);
  return result;
}

double least_p_value(std::size_t first, std::size_t second) {
  if (first == 0 || second == 0) return 1;
  // Two orders of all: 2 first! second! / (first + second)!.
  const auto n = static_cast<double>(first);
  const auto m = static_cast<double>(second);
  return std::min(1.0, 2 * std::exp(std::lgamma(n + 1) + std::lgamma(m + 1) - std::lgamma(n + m + 1)));
}

}  // namespace ulpgate
