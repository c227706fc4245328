// Search<Position>: a hunt for the largest error over a space of positions, by a portfolio of strategies.
#pragma once

#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "harness/core/search/search_bands.hpp"
#include "harness/core/search/search_batch.hpp"
#include "harness/core/search/search_elites.hpp"
#include "harness/core/search/search_scales.hpp"
#include "harness/core/search/search_target.hpp"

namespace ulpgate {

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
//  * neighbourhoods: points at random distances from the best, on scales that a reward for success chooses;
//  * bands: a beam over boxes by the size of their errors on the whole, and boxes beside the best of them;
//  * a window: a small one in one of the best bands or near a good point, searched by differences of its
//  best;
//  * climbs: from the best points of this round, through their low bits, for as long as they get higher;
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
        elites_(domain_, arity_),
        ordinary_(std::move(ordinary)),
        seeds_(std::move(seeds)),
        seed_(seed),
        size_(size),
        scales_(least_scale, greatest_scale(domain_, arity_)) {
    // The same evaluations on many boxes with few points each, or on few with many.
    // Points of a box lie far apart and cost most: large rounds, of cheap points, give them less.
    for (const std::size_t samples : {256U, 64U, 16U, 64U}) {
      const std::size_t share = std::max<std::size_t>(size_.round / (size_.round > 65536 ? 64 : 16), 4);
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
      add_climb_batches();
      add_neighbourhood_batches();
      add_band_batches();
      add_window_batches();
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
  void run_batch(std::size_t index) { batches_[index].run(target_, domain_, seeds_); }

  // Takes over what the batches found, confirms the best of it and moves the beams on.
  void end_round() {
    for (const auto& b : batches_) evaluations_ += b.count;
    confirm_best();
    confirm_suspects();
    advance_bands();
    advance_climbers();
    advance_beams();
    scales_.forget();
  }

  [[nodiscard]] const Found& best() const { return best_; }
  [[nodiscard]] const std::map<Outcome, Mismatch>& mismatches() const { return mismatches_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  using Batch = SearchBatch<Position>;
  using Kind = typename Batch::Kind;
  struct Beam {
    std::size_t keep;
    std::size_t samples;
    std::vector<SearchBox<Position>> boxes;
    std::size_t restarts;
  };
  // Nearer than that a climb looks at every number.
  static constexpr int least_scale = 6;
  static constexpr std::size_t climb_batch = 128;
  static constexpr std::size_t confirmed_a_round = 8;
  static constexpr std::size_t suspects_a_round = 4;

  static std::uint64_t mixed(std::uint64_t key) { return SearchRandom(key).word(); }

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
    if (turn > 1 && !elites_.empty()) root = around(elites_.chosen(random), random);
    root.error = -1;
    beam.boxes = {root};
    while (beam.boxes.size() * 4 <= 4 * beam.keep) {
      std::vector<SearchBox<Position>> finer;
      for (const auto& box : beam.boxes) box.split(box.widest(arity_), 4, arity_, finer);
      if (finer.size() == beam.boxes.size()) break;
      beam.boxes = std::move(finer);
    }
  }

  SearchBox<Position> around(const SearchElite<Position>& elite, SearchRandom& random) const {
    SearchBox<Position> box = domain_;
    for (std::size_t a = 0; a < arity_; ++a) {
      const Width<Position> width = width_of(domain_.low[a], domain_.high[a]);
      const auto reach = Width<Position>(width >> static_cast<int>(4 + random.below(24)));
      box.low[a] = moved_within(elite.at[a], reach, false, domain_.low[a], domain_.high[a]);
      box.high[a] = moved_within(elite.at[a], reach, true, domain_.low[a], domain_.high[a]);
    }
    return box;
  }

  void add_climb_batches() {
    for (auto& climber : climbers_) {
      Batch b;
      b.kind = Kind::climb;
      b.box.best = climber.at;
      b.box.error = climber.error;
      b.parent = climber.error;
      b.count = climb_batch;
      batches_.push_back(std::move(b));
    }
    climbers_.clear();
  }

  // Who got higher goes on; others rest, and the best of this round's other batches start in their places.
  void advance_climbers() {
    const std::size_t places = size_.round / 4 / climb_batch;
    std::vector<std::size_t> fresh;
    for (std::size_t i = 0; i < batches_.size(); ++i) {
      const Batch& b = batches_[i];
      if (!b.improved || b.box.error < 0) continue;
      if (b.kind == Kind::climb) {
        climbers_.push_back({b.box.best, b.box.error});
      } else {
        fresh.push_back(i);
      }
    }
    std::ranges::stable_sort(fresh, std::ranges::greater{},
                             [&](std::size_t i) { return batches_[i].box.error; });
    for (const std::size_t i : fresh) {
      if (climbers_.size() >= places) break;
      climbers_.push_back({batches_[i].box.best, batches_[i].box.error});
    }
  }

  void add_neighbourhood_batches() {
    if (elites_.empty()) return;
    const std::size_t batch = std::min<std::size_t>(256, std::max<std::size_t>(size_.round / 64, 16));
    SearchRandom random(mixed(seed_ + 0xe117e) + round_);
    for (std::size_t done = 0; done + batch <= size_.round / 4; done += batch) {
      const SearchElite<Position>& elite = elites_.chosen(random);
      Batch b;
      b.kind = Kind::neighbourhood;
      b.box.best = elite.at;
      b.parent = elite.error;
      b.count = batch;
      const std::size_t sure = random.below(arity_);
      for (std::size_t a = 0; a < arity_; ++a) {
        const bool moves = a == sure || (random.word() & 1U) != 0;
        b.scale[a] = moves ? scales_.chosen(random) : -1;
        b.reach[a] = b.scale[a];
        if (arity_ > 1 || b.scale[a] <= target_.cheap_scale()) continue;
        // Far away, but close together.
        b.box.best[a] = domain_.near(b.box.best[a], b.scale[a], a, random);
        b.reach[a] = std::max(target_.cheap_scale() - static_cast<int>(random.below(12)), 1);
      }
      batches_.push_back(std::move(b));
    }
  }

  void add_band_batches() {
    if (elites_.empty()) return;
    if (bands_.idle()) {
      SearchRandom random(mixed(seed_ + 0xba4d) + round_);
      if (bands_.empty() || random.below(8) == 0) {
        const int least_bits = std::max(target_.significand_bits() * 9 / 16, 1);
        bands_.start(around(elites_.chosen(random), random), arity_, Width<Position>(1) << least_bits);
      } else {
        bands_.start_beside(bands_.chosen(random), random, domain_, arity_);
      }
    }
    const std::size_t samples =
        std::clamp<std::size_t>(size_.round / 128, 32, SearchBands<Position>::samples);
    for (const auto& box : bands_.boxes()) {
      Batch b;
      b.kind = Kind::band;
      b.box = box;
      b.count = samples;
      batches_.push_back(std::move(b));
    }
  }

  void advance_bands() {
    std::vector<double> scores;
    for (const auto& b : batches_)
      if (b.kind == Kind::band) scores.push_back(b.score);
    // The last round of a search may have been cut short.
    if (!scores.empty() && scores.size() == bands_.boxes().size()) bands_.advance(scores, arity_);
  }

  // One a round: a long one finds more than several short ones.
  void add_window_batches() {
    if (elites_.empty()) return;
    SearchRandom random(mixed(seed_ + 0x817d0) + round_);
    Batch b;
    b.kind = Kind::window;
    b.count = size_.round / 4;
    const std::uint64_t turn = random.below(4);
    if (turn > 1 && !bands_.empty()) {
      b.box.best = bands_.chosen(random).draw(random, arity_);
    } else {
      const SearchElite<Position>& elite = elites_.chosen(random);
      b.box.best = elite.at;
      b.parent = elite.error;
    }
    for (std::size_t a = 0; a < arity_; ++a) {
      b.scale[a] = turn == 1 ? scales_.chosen(random) : -1;
      if (turn == 1) b.box.best[a] = domain_.near(b.box.best[a], b.scale[a], a, random);
      // Over half of the significand's bits the errors are no longer periodic.
      const auto bits = static_cast<std::uint64_t>(target_.significand_bits() / 2);
      b.reach[a] = static_cast<int>(bits / 2 + random.below(bits / 2 + 4));
    }
    batches_.push_back(std::move(b));
  }

  void add_random_batches() {
    constexpr std::size_t batch = 64;
    for (std::size_t done = 0; done + batch <= size_.round / 32; done += batch) {
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
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t i) { return batches_[i].box.error; });
    std::size_t confirmed = 0;
    for (const std::size_t i : order) {
      Batch& b = batches_[i];
      if (!elites_.would_take(b.box.best, b.box.error)) continue;
      if (confirmed++ >= confirmed_a_round) break;
      const double estimate = b.box.error;
      b.box.error = take(b.box.best);
      ++confirmations_;
      if (!(std::fabs(estimate - b.box.error) <= 0.02 + 0.02 * std::fabs(b.box.error))) ++lies_;
      if ((b.kind == Kind::neighbourhood || b.kind == Kind::window) && b.box.error > b.parent) {
        for (const int scale : b.scale) scales_.reward(scale);
      }
    }
    if (!distrusted_ && lies_ >= 32 && 2 * lies_ > confirmations_) {
      distrusted_ = true;
      target_.distrust_estimates();
      // What was kept for wrong reasons must not lead the beams.
      for (auto& b : batches_) b.box.error = -1;
    }
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
    elites_.add({at, error});
    return error;
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
      if (b.beam != Batch::no_beam) beams_[b.beam].boxes.push_back(std::move(b.box));
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
  SearchElites<Position> elites_;
  SearchBands<Position> bands_;
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
  SearchScales scales_;
  std::vector<SearchElite<Position>> climbers_;
  Found best_;
  std::map<Outcome, Mismatch> mismatches_;
};

}  // namespace ulpgate
