// pareto_front().
#include "harness/core/work_precision/pareto_front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace ulpgate {

std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order,
                [&](std::size_t i) { return !(points[i].error < 1) || !std::isfinite(points[i].seconds); });
  std::ranges::stable_sort(order, std::ranges::less{},
                           [&](std::size_t i) { return std::tuple(points[i].seconds, points[i].error); });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const auto i : order) {
    if (!(points[i].error < least * (1 - least_gain))) continue;
    least = points[i].error;
    front.push_back(i);
  }
  return front;
}

}  // namespace ulpgate
