// SearchBatch: some points of one round of a search, how they are drawn, and what came of them.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "harness/core/search/search_bands.hpp"
#include "harness/core/search/search_pool.hpp"
#include "harness/core/search/search_scales.hpp"
#include "harness/core/search/search_target.hpp"

namespace ulpgate {

template <class Position>
struct SearchBatch {
  enum class Kind { seeds, box, band, neighbourhood, window, climb };
  using Point = SearchPoint<Position>;
  static constexpr std::size_t no_beam = ~std::size_t{0};

  Kind kind = Kind::box;
  SearchBox<Position> box;  // drawn from, or holding the centre as its best point
  std::size_t count = 0;
  std::size_t first = 0;  // of the seeds
  std::size_t beam = no_beam;
  std::array<int, max_arity> scale{};  // of the distances, by argument; -1: this argument stays
  std::array<int, max_arity> reach{};  // of the points from their own centre
  std::uint64_t key = 0;
  // What came of it.
  bool improved = false;
  double parent = 0;  // error of the centre
  double score = 0;   // of a band's box
  std::vector<Point> suspects;

  // Draws and ranks its points; depends on the batch alone.
  void run(const SearchTarget<Position>& target, const SearchBox<Position>& domain,
           std::span<const Point> seeds) {
    // A window is searched in generations.
    constexpr std::size_t generation = 512;
    SearchRandom random(key);
    thread_local std::vector<Point> points;
    thread_local std::vector<double> errors;
    // One in a few hundred: fewer have too few differences, more are no better than their window.
    SearchPool<Position> pool(std::max<std::size_t>(count / 340, 48));
    const Point centre = box.best;
    const std::size_t arity = target.arity();
    for (std::size_t done = 0; done < count; done += points.size()) {
      const std::size_t some = kind == Kind::window ? std::min(generation, count - done) : count;
      points.clear();
      for (std::size_t i = 0; i < some; ++i) {
        const bool combines =
            kind == Kind::window && 4 * done >= count && pool.is_useful() && random.below(8) != 0;
        points.push_back(combines ? pool.combined(random, domain, arity)
                                  : draw(target, domain, seeds, centre, i, random));
      }
      errors.assign(points.size(), 0);
      target.rank(points, errors);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (kind == Kind::window && !std::isinf(errors[i])) pool.add(points[i], errors[i]);
        note(target, points[i], errors[i]);
      }
    }
    if (kind == Kind::band) {
      // Mismatches are no part of an amplitude.
      for (double& e : errors) e = std::isfinite(e) ? e : 0;
      score = SearchBands<Position>::score(errors);
    }
  }

 private:
  void note(const SearchTarget<Position>& target, const Point& at, double error) {
    if (std::isinf(error)) {
      if (suspects.size() < 2 && !target.is_known(at)) suspects.push_back(at);
    } else if (error > box.error && !target.is_known(at)) {
      box.error = error;
      box.best = at;
      improved = true;
    }
  }

  Point draw(const SearchTarget<Position>& target, const SearchBox<Position>& domain,
             std::span<const Point> seeds, const Point& centre, std::size_t i, SearchRandom& random) const {
    const std::size_t arity = target.arity();
    if (kind == Kind::seeds) return seeds[first + i];
    if (kind == Kind::box || kind == Kind::band) return box.draw(random, arity);
    Point x = centre;
    for (std::size_t a = 0; a < arity; ++a) {
      if (kind == Kind::climb) {
        if (arity > 1 && (random.word() & 1U) != 0) continue;
        x[a] = domain.near(x[a], climb_scale(random, target.significand_bits()), a, random);
        continue;
      }
      if (kind == Kind::neighbourhood && scale[a] < 0) continue;
      x[a] = domain.near(x[a], reach[a], a, random);
    }
    return x;
  }
};

}  // namespace ulpgate
