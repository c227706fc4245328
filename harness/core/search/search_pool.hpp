// SearchPool: the best points of one small window, and new points made from their differences.
#pragma once

#include <algorithm>
#include <vector>

#include "harness/core/search/search_elites.hpp"

namespace ulpgate {

// Near a point the rounding errors of a function's single operations are functions of x modulo their
// spacings: the total error is nearly periodic, with many periods at once.  The difference of two points of
// large error is nearly a common period of all of them, so a third point moved by it has a large error more
// often than not, and sometimes a larger one.  It is the mutation of differential evolution (Storn and Price,
// J. Global Optimization 11, 1997) on integers.
template <class Position>
class SearchPool {
 public:
  explicit SearchPool(std::size_t capacity) : capacity_(capacity) {}

  [[nodiscard]] bool is_useful() const { return points_.size() >= 8; }

  void add(const SearchPoint<Position>& at, double error) {
    if (points_.size() >= capacity_ && error <= points_.back().error) return;
    const auto it =
        std::ranges::upper_bound(points_, error, std::ranges::greater{}, &SearchElite<Position>::error);
    for (auto same = it; same != points_.begin() && (--same)->error == error;)
      if (same->at == at) return;
    points_.insert(it, {at, error});
    if (points_.size() > capacity_) points_.pop_back();
  }

  // One of the best moved by the difference of two others, within the domain.
  [[nodiscard]] SearchPoint<Position> combined(SearchRandom& random, const SearchBox<Position>& domain,
                                               std::size_t arity) const {
    const std::size_t n = points_.size();
    const auto& from = points_[random.below(random.below(n) + 1)].at;
    const std::size_t i = random.below(n);
    const std::size_t j = (i + 1 + random.below(n - 1)) % n;
    SearchPoint<Position> x = from;
    for (std::size_t a = 0; a < arity; ++a) {
      const Position& low = points_[i].at[a];
      const Position& high = points_[j].at[a];
      const bool up = low < high;
      const Width<Position> by = up ? width_of(low, high) : width_of(high, low);
      x[a] = moved_within(x[a], by, up, domain.low[a], domain.high[a]);
    }
    return x;
  }

 private:
  std::size_t capacity_;
  std::vector<SearchElite<Position>> points_;  // by falling error
};

}  // namespace ulpgate
