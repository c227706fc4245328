// SearchBands: where in its domain a function's errors are largest on the whole, rather than at one lucky
// point.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "harness/core/search/search_space.hpp"

namespace ulpgate {

// Errors are noise of an amplitude that depends smoothly on x, often largest next to the end of an interval
// on which the library uses one polynomial.  The largest of few errors says little of the amplitude; the mean
// of the largest 64th of many says it to a percent or two.  A beam over boxes by that figure ends in bands
// where it is worth drawing again and again.
template <class Position>
class SearchBands {
 public:
  using Box = SearchBox<Position>;

  // Points to draw from each box of a generation; their errors go to score().
  static constexpr std::size_t samples = 2048;

  // A score of errors of points of one box.
  [[nodiscard]] static double score(std::span<double> errors) {
    const std::size_t most = std::max<std::size_t>(errors.size() / 64, 1);
    const auto end = errors.begin() + static_cast<std::ptrdiff_t>(most);
    std::ranges::nth_element(errors, end - 1, std::ranges::greater{});
    double sum = 0;
    for (auto it = errors.begin(); it != end; ++it) sum += *it;
    return sum / static_cast<double>(most);
  }

  [[nodiscard]] bool idle() const { return boxes_.empty(); }
  // A new beam; a box with `smallest` positions or less is not cut.
  void start(const Box& root, std::size_t arity, const Width<Position>& smallest) {
    smallest_ = smallest;
    beside_ = false;
    boxes_.clear();
    root.split(root.widest(arity), cuts * kept_boxes, arity, boxes_);
  }
  // In place of a beam, boxes of a band's size at random distances from it: within a library's interval the
  // amplitude still differs from place to place, where a part of x that some steps share is rounded well or
  // badly.
  void start_beside(const Box& band, SearchRandom& random, const Box& domain, std::size_t arity) {
    constexpr std::uint64_t greatest_scale = 18;
    boxes_.clear();
    beside_ = true;
    for (std::size_t i = 0; i < std::size_t{cuts} * kept_boxes; ++i) {
      Box box = band;
      for (std::size_t a = 0; a < arity; ++a) {
        const Width<Position> width = width_of(band.low[a], band.high[a]);
        const auto times = (std::uint64_t{1} << random.below(greatest_scale)) + random.below(greatest_scale);
        const auto last = moved_within(domain.high[a], width, false, domain.low[a], domain.high[a]);
        box.low[a] = moved_within(box.low[a], Width<Position>(width * Width<Position>(times)),
                                  (random.word() & 1U) != 0, domain.low[a], last);
        box.high[a] = moved_within(box.low[a], width, true, domain.low[a], domain.high[a]);
      }
      boxes_.push_back(std::move(box));
    }
  }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  // The scores of boxes(); makes the next generation, or a band.
  void advance(std::span<const double> scores, std::size_t arity) {
    std::vector<std::size_t> order(boxes_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return scores[i]; });
    if (beside_) {
      for (const std::size_t i : order) add(boxes_[i], scores[i]);
      boxes_.clear();
      return;
    }
    const Box& best = boxes_[order[0]];
    const std::size_t slot = best.widest(arity);
    if (width_of(best.low[slot], best.high[slot]) <= smallest_) {
      add(best, scores[order[0]]);
      boxes_.clear();
      return;
    }
    std::vector<Box> finer;
    for (std::size_t i = 0; i < std::min(kept_boxes, order.size()); ++i)
      boxes_[order[i]].split(boxes_[order[i]].widest(arity), cuts, arity, finer);
    boxes_ = std::move(finer);
  }

  [[nodiscard]] bool empty() const { return bands_.empty(); }
  // One of the best bands.
  [[nodiscard]] const Box& chosen(SearchRandom& random) const {
    return bands_[random.below(random.below(bands_.size()) + 1)];
  }

 private:
  static constexpr std::size_t kept_boxes = 4;
  static constexpr unsigned cuts = 4;
  static constexpr std::size_t kept_bands = 24;

  void add(Box band, double score) {
    band.error = score;
    const auto at = std::ranges::upper_bound(bands_, score, std::ranges::greater{}, &Box::error);
    bands_.insert(at, std::move(band));
    if (bands_.size() > kept_bands) bands_.pop_back();
  }

  std::vector<Box> boxes_;
  std::vector<Box> bands_;  // by falling score
  Width<Position> smallest_{};
  bool beside_ = false;
};

}  // namespace ulpgate
