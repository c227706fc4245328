// SearchScales: how far from its best points a search looks, learnt from where it found something.
#pragma once

#include <cmath>
#include <vector>

#include "harness/core/search/search_space.hpp"

namespace ulpgate {

class SearchScales {
 public:
  // Distances from 2^least to 2^greatest.
  SearchScales(int least, int greatest) : least_(least) {
    weights_.resize(static_cast<std::size_t>(std::max(greatest - least, 0)) + 1, 1.0);
  }

  [[nodiscard]] int chosen(SearchRandom& random) const {
    double total = 0;
    for (const double weight : weights_) total += weight;
    double at = std::ldexp(static_cast<double>(random.word() >> 11U), -53) * total;
    int scale = least_;
    for (const double weight : weights_) {
      at -= weight;
      if (at < 0) return scale;
      ++scale;
    }
    return scale - 1;
  }

  void reward(int scale) {
    if (scale >= least_) weights_[static_cast<std::size_t>(scale - least_)] += 1;
  }
  // What was rewarded long ago counts less.
  void forget() {
    for (double& weight : weights_) weight = 1 + 0.98 * (weight - 1);
  }

 private:
  int least_;
  std::vector<double> weights_;
};

// That of the widest argument.
template <class Position>
[[nodiscard]] int greatest_scale(const SearchBox<Position>& domain, std::size_t arity) {
  int scale = 1;
  for (std::size_t i = 0; i < arity; ++i)
    scale = std::max(scale, bit_length(Width<Position>(width_of(domain.low[i], domain.high[i]))) - 1);
  return scale;
}

// The scale of a step of a climb: small ones more often than large ones, up to half of the bits of a
// significand.
[[nodiscard]] inline int climb_scale(SearchRandom& random, int significand_bits) {
  const auto most = static_cast<std::uint64_t>(std::max(significand_bits / 2, 2));
  return static_cast<int>(random.below(random.below(most) + 1)) + 1;
}

}  // namespace ulpgate
