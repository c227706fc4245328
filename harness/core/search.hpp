// Search<Position>: a hunt for the largest error over a space of positions, by a portfolio of strategies.
#pragma once

#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "harness/core/search_space.hpp"
#include "reference/ulp.hpp"

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
  // Points within 2^this many positions of each other are ranked faster together than one by one.
  [[nodiscard]] virtual int cheap_scale() const = 0;
  // Estimates turned out to be wrong too often: rank by proven errors from now on.
  virtual void distrust_estimates() = 0;
};

struct SearchSize {
  std::size_t round = 1U << 16U;  // evaluations of one round, at least 512
};

// A round is a list of batches of points, fixed by the state before it; batches may be evaluated in any order
// and by any thread, and what they found is taken over in the order of the list.  So a search depends on its
// seed and its number of evaluations alone.
//
// A round shares its evaluations between
//  * bisection with a beam: every box is cut in four, some points of each are evaluated, and the boxes with
//    the largest errors go on until they hold a few neighbouring numbers; then the beam starts again, in turn
//    from the whole domain, from ordinary magnitudes and from around a number found;
//  * neighbourhoods: points at random distances from the best, on scales that a reward for success chooses,
//    from the last bits up;
//  * random points of the whole domain.
template <class Position>
class Search {
 public:
  struct Found {
    SearchPoint<Position> at{};
    double error = -1;
    double distance = 0;
    std::uint64_t evaluations = 0;  // done when it was found
  };
  struct Mismatch {
    SearchPoint<Position> at{};
    std::uint64_t confirmed = 0;
  };

  // `ordinary` are parts of the domain that deserve more than their share of positions, at least one; `seeds`
  // are evaluated first.
  Search(SearchTarget<Position>& target, std::vector<SearchBox<Position>> ordinary,
         std::vector<SearchPoint<Position>> seeds, std::uint64_t seed, SearchSize size)
      : target_(target),
        arity_(target.arity()),
        domain_(target.domain()),
        ordinary_(std::move(ordinary)),
        seeds_(std::move(seeds)),
        seed_(seed),
        size_(size),
        scales_(static_cast<std::size_t>(greatest_scale()) + 1, 1.0) {
    // The same evaluations on many boxes with few points each, or on few with many.
    for (const std::size_t samples : {256U, 64U, 16U, 64U}) {
      const std::size_t share = std::max<std::size_t>(size_.round / 8, 4);
      const std::size_t n = std::min(samples, share / 4);
      beams_.push_back({std::max<std::size_t>(share / (4 * n), 1), n, {}, beams_.size()});
    }
  }

  // Prepares a round of at most `most` evaluations; returns the number of its batches.
  std::size_t begin_round(std::uint64_t most) {
    batches_.clear();
    if (evaluations_ == 0) add_seed_batches();
    if (batches_.empty()) {
      add_beam_batches();
      add_neighbourhood_batches();
      add_random_batches();
    }
    std::uint64_t planned = 0;
    std::size_t kept = 0;
    for (; kept < batches_.size() && planned < most; ++kept) {
      Batch& b = batches_[kept];
      b.count = static_cast<std::size_t>(std::min<std::uint64_t>(b.count, most - planned));
      planned += b.count;
      b.key = mixed(mixed(seed_ + round_) + kept);
    }
    batches_.resize(kept);
    ++round_;
    return kept;
  }

  // Evaluates a batch of the round; any thread.
  void run_batch(std::size_t index) {
    Batch& b = batches_[index];
    SearchRandom random(b.key);
    thread_local std::vector<SearchPoint<Position>> points;
    thread_local std::vector<double> errors;
    points.clear();
    for (std::size_t i = 0; i < b.count; ++i) points.push_back(draw(b, i, random));
    errors.assign(points.size(), 0);
    target_.rank(points, errors);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isinf(errors[i])) {
        if (b.suspects.size() < 2) b.suspects.push_back(points[i]);
      } else if (errors[i] > b.box.error) {
        b.box.error = errors[i];
        b.box.best = points[i];
        b.improved = true;
      }
    }
  }

  // Takes over what the batches found, confirms the best of it and moves the beams on.
  void end_round() {
    for (const auto& b : batches_) evaluations_ += b.count;
    confirm_best();
    confirm_suspects();
    advance_beams();
    for (auto& weight : scales_) weight = 1 + 0.98 * (weight - 1);
  }

  [[nodiscard]] const Found& best() const { return best_; }
  [[nodiscard]] const std::map<Outcome, Mismatch>& mismatches() const { return mismatches_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  enum class Kind { seeds, box, neighbourhood };
  static constexpr std::size_t no_beam = ~std::size_t{0};
  struct Batch {
    Kind kind = Kind::box;
    SearchBox<Position> box;  // drawn from, or holding the centre as its best point
    std::size_t count = 0;
    std::size_t first = 0;  // of the seeds
    std::size_t beam = no_beam;
    std::array<int, max_arity> scale{};  // of the distances, by argument; -1: this argument stays
    std::uint64_t key = 0;
    bool improved = false;
    std::vector<SearchPoint<Position>> suspects;
  };
  struct Beam {
    std::size_t keep;
    std::size_t samples;
    std::vector<SearchBox<Position>> boxes;
    std::size_t restarts;
  };
  // A confirmed point; few are kept of one neighbourhood, so that the search does not end in the first one.
  struct Elite {
    SearchPoint<Position> at;
    double error;
  };
  static constexpr std::size_t elites_kept = 64;
  static constexpr std::size_t elites_of_a_cell = 6;
  static constexpr std::size_t confirmed_a_round = 24;
  static constexpr std::size_t suspects_a_round = 4;

  static std::uint64_t mixed(std::uint64_t key) { return SearchRandom(key).word(); }

  [[nodiscard]] int greatest_scale() const {
    int scale = 1;
    for (std::size_t i = 0; i < arity_; ++i)
      scale = std::max(scale, bit_length(Width<Position>(width_of(domain_.low[i], domain_.high[i]))) - 1);
    return scale;
  }

  SearchPoint<Position> draw(const Batch& b, std::size_t i, SearchRandom& random) const {
    if (b.kind == Kind::seeds) return seeds_[b.first + i];
    if (b.kind == Kind::box) return b.box.draw(random, arity_);
    SearchPoint<Position> x = b.box.best;
    for (std::size_t a = 0; a < arity_; ++a) {
      if (b.scale[a] < 0) continue;
      const Width<Position> reach = (Width<Position>(1) << b.scale[a]);
      const Width<Position> by = random.up_to(reach);
      x[a] = moved_within(x[a], by, (random.word() & 1U) != 0, domain_.low[a], domain_.high[a]);
    }
    return x;
  }

  void add_seed_batches() {
    constexpr std::size_t batch = 256;
    for (std::size_t first = 0; first < seeds_.size(); first += batch) {
      Batch b;
      b.kind = Kind::seeds;
      b.first = first;
      b.count = std::min(batch, seeds_.size() - first);
      batches_.push_back(std::move(b));
    }
  }

  void add_beam_batches() {
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      Beam& beam = beams_[i];
      if (beam.boxes.empty()) start(beam, i);
      for (auto& box : beam.boxes) {
        Batch b;
        b.box = std::move(box);
        b.count = beam.samples;
        b.beam = i;
        batches_.push_back(std::move(b));
      }
      beam.boxes.clear();
    }
  }

  // The first boxes of a beam: a grid over its root, as many as a generation has.
  void start(Beam& beam, std::size_t index) {
    SearchRandom random(mixed(mixed(seed_ + 0x5eed) + index) + beam.restarts);
    SearchBox<Position> root = domain_;
    const std::size_t turn = beam.restarts++ % 4;
    if (turn == 1) root = ordinary_[beam.restarts / 4 % ordinary_.size()];
    if (turn > 1 && !elites_.empty()) root = around(chosen_elite(random), random);
    root.error = -1;
    beam.boxes = {root};
    while (beam.boxes.size() * 4 <= 4 * beam.keep) {
      std::vector<SearchBox<Position>> finer;
      for (const auto& box : beam.boxes) box.split(box.widest(arity_), 4, arity_, finer);
      if (finer.size() == beam.boxes.size()) break;
      beam.boxes = std::move(finer);
    }
  }

  SearchBox<Position> around(const Elite& elite, SearchRandom& random) const {
    SearchBox<Position> box = domain_;
    for (std::size_t a = 0; a < arity_; ++a) {
      const Width<Position> width = width_of(domain_.low[a], domain_.high[a]);
      const auto reach = Width<Position>(width >> static_cast<int>(4 + random.below(24)));
      box.low[a] = moved_within(elite.at[a], reach, false, domain_.low[a], domain_.high[a]);
      box.high[a] = moved_within(elite.at[a], reach, true, domain_.low[a], domain_.high[a]);
    }
    return box;
  }

  const Elite& chosen_elite(SearchRandom& random) const {
    // The better half of what is left, again and again: the best is chosen most often.
    std::size_t n = elites_.size();
    while (n > 1 && (random.word() & 1U) != 0) n = (n + 1) / 2;
    return elites_[random.below(n)];
  }

  int chosen_scale(SearchRandom& random) const {
    double total = 0;
    for (const double w : scales_) total += w;
    double at = std::ldexp(static_cast<double>(random.word() >> 11U), -53) * total;
    for (std::size_t j = 0; j < scales_.size(); ++j) {
      at -= scales_[j];
      if (at < 0) return static_cast<int>(j);
    }
    return static_cast<int>(scales_.size()) - 1;
  }

  void add_neighbourhood_batches() {
    if (elites_.empty()) return;
    constexpr std::size_t batch = 64;
    SearchRandom random(mixed(seed_ + 0xe117e) + round_);
    for (std::size_t done = 0; done + batch <= size_.round * 7 / 16; done += batch) {
      const Elite& elite = chosen_elite(random);
      Batch b;
      b.kind = Kind::neighbourhood;
      b.box.best = elite.at;
      b.count = batch;
      const std::size_t sure = random.below(arity_);
      for (std::size_t a = 0; a < arity_; ++a) {
        const bool moves = a == sure || (random.word() & 1U) != 0;
        b.scale[a] = moves ? chosen_scale(random) : -1;
      }
      batches_.push_back(std::move(b));
    }
  }

  void add_random_batches() {
    constexpr std::size_t batch = 64;
    for (std::size_t done = 0; done + batch <= size_.round / 16; done += batch) {
      Batch b;
      const std::size_t turn = done / batch;
      b.box = turn % 2 == 0 ? domain_ : ordinary_[turn / 2 % ordinary_.size()];
      b.count = batch;
      batches_.push_back(std::move(b));
    }
  }

  void confirm_best() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < batches_.size(); ++i)
      if (batches_[i].improved) order.push_back(i);
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return batches_[i].box.error; });
    if (order.size() > confirmed_a_round) order.resize(confirmed_a_round);
    for (const std::size_t i : order) {
      Batch& b = batches_[i];
      if (!would_be_elite(b.box.error)) break;
      if (std::ranges::any_of(elites_, [&](const Elite& e) { return e.at == b.box.best; })) continue;
      const double estimate = b.box.error;
      b.box.error = take(b.box.best);
      ++confirmations_;
      if (!(std::fabs(estimate - b.box.error) <= 0.02 + 0.02 * std::fabs(b.box.error))) ++lies_;
      if (b.kind == Kind::neighbourhood && !elites_.empty() && b.box.error >= elites_.back().error) {
        for (const int scale : b.scale)
          if (scale >= 0) scales_[static_cast<std::size_t>(scale)] += 1;
      }
    }
    if (!distrusted_ && lies_ >= 32 && 2 * lies_ > confirmations_) {
      distrusted_ = true;
      target_.distrust_estimates();
      // What was kept for wrong reasons must not lead the beams.
      for (auto& b : batches_) b.box.error = -1;
    }
  }

  [[nodiscard]] bool would_be_elite(double error) const {
    return elites_.size() < elites_kept || error > elites_.back().error;
  }

  // Confirms a point, and keeps it where it deserves it; the proven error, -1 for a mismatch.
  double take(const SearchPoint<Position>& at) {
    const Judgement judgement = target_.confirm(at);
    if (judgement.outcome != Outcome::finite) {
      Mismatch& m = mismatches_[judgement.outcome];
      if (m.confirmed++ == 0) m.at = at;
      return -1;
    }
    const double error = judgement.error.value;
    if (error > best_.error) best_ = {at, error, judgement.distance, evaluations_};
    const auto it = std::ranges::upper_bound(elites_, error, std::ranges::greater{}, &Elite::error);
    elites_.insert(it, {at, error});
    thin_out(at);
    if (elites_.size() > elites_kept) elites_.pop_back();
    return error;
  }

  // Drops the least of a neighbourhood that holds too many.
  void thin_out(const SearchPoint<Position>& at) {
    std::size_t same = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < elites_.size(); ++i) {
      if (!is_neighbour(elites_[i].at, at)) continue;
      ++same;
      last = i;
    }
    if (same > elites_of_a_cell) elites_.erase(elites_.begin() + static_cast<std::ptrdiff_t>(last));
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

  void confirm_suspects() {
    std::size_t confirmed = 0;
    for (const auto& b : batches_) {
      for (const auto& x : b.suspects) {
        if (confirmed++ >= suspects_a_round) return;
        take(x);
      }
    }
  }

  void advance_beams() {
    for (auto& b : batches_)
      if (b.beam != no_beam) beams_[b.beam].boxes.push_back(std::move(b.box));
    for (auto& beam : beams_) {
      if (beam.boxes.empty()) continue;
      std::ranges::stable_sort(beam.boxes, std::ranges::greater{}, &SearchBox<Position>::error);
      if (beam.boxes.size() > beam.keep) beam.boxes.resize(beam.keep);
      std::vector<SearchBox<Position>> children;
      for (const auto& box : beam.boxes) {
        const std::size_t slot = box.widest(arity_);
        if (width_of(box.low[slot], box.high[slot]) < Width<Position>(beam.samples)) continue;
        box.split(slot, 4, arity_, children);
      }
      beam.boxes = std::move(children);
    }
  }

  SearchTarget<Position>& target_;
  std::size_t arity_;
  SearchBox<Position> domain_;
  std::vector<SearchBox<Position>> ordinary_;
  std::vector<SearchPoint<Position>> seeds_;
  std::uint64_t seed_;
  SearchSize size_;
  std::uint64_t round_ = 0;
  std::uint64_t evaluations_ = 0;
  std::uint64_t confirmations_ = 0;
  std::uint64_t lies_ = 0;
  bool distrusted_ = false;
  std::vector<Batch> batches_;
  std::vector<Beam> beams_;
  std::vector<Elite> elites_;  // by falling error
  std::vector<double> scales_;
  Found best_;
  std::map<Outcome, Mismatch> mismatches_;
};

}  // namespace ulpgate
