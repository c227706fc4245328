// SearchTarget: what a search asks of the function that it searches.
#pragma once

#include <span>

#include "harness/core/search/search_space.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

// What is searched.
template <class Position>
class SearchTarget {
 public:
  SearchTarget() = default;
  SearchTarget(const SearchTarget&) = delete;
  SearchTarget& operator=(const SearchTarget&) = delete;
  virtual ~SearchTarget() = default;
  [[nodiscard]] virtual std::size_t arity() const = 0;
  // The whole domain.
  [[nodiscard]] virtual SearchBox<Position> domain() const = 0;
  // Estimated errors in ULP, to rank points by; infinity where a mismatch is suspected.  Called from several
  // threads.
  virtual void rank(std::span<const SearchPoint<Position>> points, std::span<double> errors) const = 0;
  // The proven judgement: a mismatch of any part, else the part with the largest error.
  [[nodiscard]] virtual Judgement confirm(const SearchPoint<Position>& x) const = 0;
  // Whether what can be found at a point, or next to it, is known already: it then leads nowhere.
  [[nodiscard]] virtual bool is_known(const SearchPoint<Position>& /*x*/) const { return false; }
  // Points within 2^this many positions of each other are ranked faster together than one by one.
  [[nodiscard]] virtual int cheap_scale() const = 0;
  [[nodiscard]] virtual int significand_bits() const = 0;
  // Estimates turned out to be wrong too often: rank by proven errors from now on.
  virtual void distrust_estimates() = 0;
};

}  // namespace ulpgate
