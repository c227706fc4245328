// SearchElites: the best confirmed points of a search, few of each neighbourhood.
#pragma once

#include "harness/core/search/search_space.hpp"

namespace ulpgate {

template <class Position>
struct SearchElite {
  SearchPoint<Position> at;
  double error;
};

// By falling error.  Few are kept of one neighbourhood, so that a search does not end in the first one.
template <class Position>
class SearchElites {
 public:
  SearchElites(SearchBox<Position> domain, std::size_t arity) : domain_(std::move(domain)), arity_(arity) {}

  [[nodiscard]] bool empty() const { return elites_.empty(); }

  // Among the best, and among the best of its neighbourhood.
  [[nodiscard]] bool would_take(const SearchPoint<Position>& at, double error) const {
    if (elites_.size() >= kept && error <= elites_.back().error) return false;
    std::size_t better = 0;
    for (const SearchElite<Position>& e : elites_) {
      if (e.error < error) break;
      if (e.at == at) return false;
      better += is_neighbour(e.at, at) ? 1U : 0U;
    }
    return better < kept_of_a_neighbourhood;
  }

  void add(SearchElite<Position> elite) {
    const SearchPoint<Position> at = elite.at;
    const auto it =
        std::ranges::upper_bound(elites_, elite.error, std::ranges::greater{}, &SearchElite<Position>::error);
    elites_.insert(it, std::move(elite));
    thin_out(at);
    if (elites_.size() > kept) elites_.pop_back();
  }

  // Not empty.
  [[nodiscard]] const SearchElite<Position>& chosen(SearchRandom& random) const {
    // The better half of what is left, again and again: the best is chosen most often.
    std::size_t n = elites_.size();
    while (n > 1 && (random.word() & 1U) != 0) n = (n + 1) / 2;
    return elites_[random.below(n)];
  }

 private:
  static constexpr std::size_t kept = 64;
  static constexpr std::size_t kept_of_a_neighbourhood = 6;

  // Drops the least of a neighbourhood that holds too many.
  void thin_out(const SearchPoint<Position>& at) {
    std::size_t same = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < elites_.size(); ++i) {
      if (!is_neighbour(elites_[i].at, at)) continue;
      ++same;
      last = i;
    }
    if (same > kept_of_a_neighbourhood) elites_.erase(elites_.begin() + static_cast<std::ptrdiff_t>(last));
  }

  // Within 2^-14 of the domain's positions in every argument: less than a binade of double.
  bool is_neighbour(const SearchPoint<Position>& a, const SearchPoint<Position>& b) const {
    for (std::size_t i = 0; i < arity_; ++i) {
      const Width<Position> reach = width_of(domain_.low[i], domain_.high[i]) >> 14;
      const Width<Position> apart = a[i] < b[i] ? width_of(a[i], b[i]) : width_of(b[i], a[i]);
      if (apart > reach) return false;
    }
    return true;
  }

  SearchBox<Position> domain_;
  std::size_t arity_;
  std::vector<SearchElite<Position>> elites_;
};

}  // namespace ulpgate
