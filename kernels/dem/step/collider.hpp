// Collider<Real>: keeps the sorted list of pairs that may touch, rebuilt when a body has moved as far as its
// sweep.
#pragma once

#include <limits>
#include <span>
#include <string>

#include "kernels/dem/step/bounds.hpp"
#include "kernels/dem/step/simulation_state.hpp"

namespace ulpgate::dem {

template <RealType Real>
class Collider {
 public:
  // Brings the contacts of `s` up to date before a step.
  void update(SimulationState<Real>& s, bool want_body_lists) {
    if (!started_ || outdated_) {
      rebuild(s);
      if (want_body_lists) list_by_body(s);
      started_ = true;
      outdated_ = false;
    }
  }
  // More pairs that may touch are refused: update() then throws scenes::SceneTooLarge.
  void limit_pairs(std::size_t most) { most_pairs_ = most; }
  void outdate() { outdated_ = true; }
  void restart() {
    started_ = false;
    outdated_ = true;
  }
  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] const std::vector<CoarseSphere>& coarse() const { return coarse_; }
  // Indices of the pairs that body i is in, ascending.
  [[nodiscard]] std::span<const std::int32_t> pairs_of(std::size_t i) const {
    return {entries_.data() + start_[i], entries_.data() + start_[i + 1]};
  }

  // Notes where body i went; returns whether it has left its sweep.
  bool moved(const Bodies<Real>& bodies, std::size_t i) {
    const Vec3<Real>& p = bodies.position[i];
    const auto x = static_cast<double>(p.x);
    const auto y = static_cast<double>(p.y);
    const auto z = static_cast<double>(p.z);
    if constexpr (!NativeReal<Real>) {
      coarse_[i].x = x;
      coarse_[i].y = y;
      coarse_[i].z = z;
    }
    if (reference_.empty()) return false;
    const auto& from = reference_[i];
    // In units of the sweep's binade: exact, and no square is 0 or infinite where the distances are not.
    const double dx = (x - from[0]) * unit_;
    const double dy = (y - from[1]) * unit_;
    const double dz = (z - from[2]) * unit_;
    return dx * dx + dy * dy + dz * dz > limit2_;
  }

  [[nodiscard]] std::size_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] std::size_t memory() const {
    return coarse_.capacity() * sizeof(CoarseSphere) + boxes_.capacity() * sizeof(CoarseBody) +
           reference_.capacity() * sizeof(reference_[0]) + entries_.capacity() * sizeof(std::int32_t) +
           pairs_.capacity() * 2 * sizeof(BodyPair);
  }

 private:
  // Far above the rounding of a coordinate and a radius to double, far below any sweep that makes sense.
  [[nodiscard]] static double margin(const CoarseBody& b) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      largest = std::max({largest, std::abs(b.low[k]), std::abs(b.high[k])});
    }
    return 16 * std::numeric_limits<double>::epsilon() * largest;
  }

  [[nodiscard]] CoarseBody coarse_body(const SimulationState<Real>& s, std::size_t i) const {
    const Bodies<Real>& b = s.bodies;
    CoarseBody c;
    c.movable = b.fixed[i] == 0;
    c.sphere = b.shape[i] == Shape::sphere;
    Bounds<Real> box;
    const Flat<Real>* flat = c.sphere ? nullptr : &s.flats[static_cast<std::size_t>(b.flat[i])];
    switch (b.shape[i]) {
      case Shape::sphere:
        box = sphere_bounds(b.position[i], b.radius[i], s.sweep);
        break;
      case Shape::facet:
        box = facet_bounds(flat->facet, s.sweep);
        break;
      case Shape::box:
        box = box_bounds(b.position[i], flat->half_size, flat->orientation, s.sweep);
        break;
      case Shape::wall:
        box = sphere_bounds(b.position[i], Real(0), s.sweep);
        break;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      c.low[k] = static_cast<double>(box.low[k]);
      c.high[k] = static_cast<double>(box.high[k]);
      c.centre[k] = static_cast<double>(b.position[i][k]);
    }
    const double out = margin(c);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool endless = b.shape[i] == Shape::wall && k != flat->axis;
      const bool lost = !std::isfinite(c.low[k]) || !std::isfinite(c.high[k]);
      c.low[k] = endless || lost ? -std::numeric_limits<double>::infinity() : c.low[k] - out;
      c.high[k] = endless || lost ? std::numeric_limits<double>::infinity() : c.high[k] + out;
    }
    c.reach = static_cast<double>(b.radius[i] + s.sweep) + out;
    return c;
  }

  void rebuild(SimulationState<Real>& s) {
    const std::size_t count = s.bodies.size();
    ++rebuilds_;
    const auto sweep = static_cast<double>(s.sweep);
    // A hair less than the sweep, for the rounding of the distance itself.
    unit_ = sweep > 0 && std::isfinite(sweep) ? std::ldexp(1.0, std::min(1000, -std::ilogb(sweep))) : 1;
    limit2_ = (sweep * unit_) * (sweep * unit_) * 0.999;
    if (s.parts.collider) {
      boxes_.resize(count);
      reference_.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        boxes_[i] = coarse_body(s, i);
        reference_[i] = boxes_[i].centre;
      }
      if (!broad_phase_.find(boxes_, pairs_, most_pairs_))
        throw scenes::SceneTooLarge("more than " + std::to_string(most_pairs_) + " of the pairs of " +
                                    std::to_string(count) + " bodies may touch");
    } else {
      pairs_.clear();
      reference_.clear();
    }
    if constexpr (!NativeReal<Real>) {
      coarse_.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3<Real>& p = s.bodies.position[i];
        coarse_[i] = {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), 0};
        const double far =
            std::max({std::abs(coarse_[i].x), std::abs(coarse_[i].y), std::abs(coarse_[i].z)}) + sweep;
        coarse_[i].reach = static_cast<double>(s.bodies.radius[i]) * (1 + 1e-9) + 1e-12 * far;
      }
    }
    keep_contacts(s);
  }

  // Touching pairs and bonds stay, with what they carry; the others are as the broad phase has them.
  void keep_contacts(SimulationState<Real>& s) {
    Contacts<Real>& c = s.contacts;
    std::vector<std::size_t> from;
    std::vector<BodyPair> kept;
    for (std::size_t p = 0; p < c.size(); ++p) {
      if (c.touching[p] != 0 || (!c.bond.empty() && c.bond[p] >= 0)) {
        from.push_back(p);
        kept.push_back(c.pair[p]);
      }
    }
    const std::vector<std::uint8_t> touching = c.touching;
    const std::vector<std::int32_t> bond = c.bond;
    merged_.clear();
    std::set_union(pairs_.begin(), pairs_.end(), kept.begin(), kept.end(), std::back_inserter(merged_));
    std::vector<std::size_t> to;
    to.reserve(kept.size());
    std::size_t p = 0;
    for (const BodyPair& pair : kept) {
      while (merged_[p] != pair) ++p;
      to.push_back(p);
    }
    // Gather before the arrays change length, scatter afterwards.
    const std::size_t count = merged_.size();
    const auto move_array = [&](auto& array) {
      if (array.empty()) return;
      std::remove_cvref_t<decltype(array)> values;
      values.reserve(from.size());
      for (const std::size_t k : from) values.push_back(array[k]);
      array.resize(count);
      for (std::size_t k = 0; k < to.size(); ++k) array[to[k]] = values[k];
    };
    c.each_array(move_array);
    resize_contacts(s, count);
    c.pair = merged_;
    std::fill(c.touching.begin(), c.touching.end(), std::uint8_t{0});
    std::fill(c.bond.begin(), c.bond.end(), -1);
    for (std::size_t k = 0; k < to.size(); ++k) {
      c.touching[to[k]] = touching[from[k]];
      if (!bond.empty()) c.bond[to[k]] = bond[from[k]];
    }
    if (s.parts.energy) {
      for (std::size_t k = 0; k < count; ++k) {
        if (c.touching[k] == 0) c.elastic[k] = Real(0);
      }
    }
  }

  void list_by_body(const SimulationState<Real>& s) {
    const std::size_t bodies = s.bodies.size();
    start_.assign(bodies + 1, 0);
    for (const BodyPair& p : s.contacts.pair) {
      ++start_[static_cast<std::size_t>(p.first) + 1];
      ++start_[static_cast<std::size_t>(p.second) + 1];
    }
    for (std::size_t i = 0; i < bodies; ++i) start_[i + 1] += start_[i];
    entries_.resize(2 * s.contacts.size());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t p = 0; p < s.contacts.size(); ++p) {
      const BodyPair& pair = s.contacts.pair[p];
      entries_[static_cast<std::size_t>(next[static_cast<std::size_t>(pair.first)]++)] =
          static_cast<std::int32_t>(p);
      entries_[static_cast<std::size_t>(next[static_cast<std::size_t>(pair.second)]++)] =
          static_cast<std::int32_t>(p);
    }
  }

  BroadPhase broad_phase_;
  std::vector<CoarseBody> boxes_;
  std::vector<std::array<double, 3>> reference_;
  std::vector<CoarseSphere> coarse_;
  std::vector<BodyPair> pairs_, merged_;
  std::vector<std::int32_t> start_, entries_;
  std::size_t most_pairs_ = scenes::most_pairs;
  double unit_ = 1;    // 1/m, a power of two
  double limit2_ = 0;  // of the squared distance in that unit
  bool started_ = false;
  bool outdated_ = true;
  std::size_t rebuilds_ = 0;
};

}  // namespace ulpgate::dem
