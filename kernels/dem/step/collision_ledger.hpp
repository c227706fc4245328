// CollisionLedger<Real>: keeps book of every collision of a simulation.  It looks at the state only: the
// trajectory is the same to the last bit.
#pragma once

#include <utility>

#include "kernels/dem/step/collision_energy.hpp"

namespace ulpgate::dem {

// Looks once a step, behind the contacts and before the motion, in the order of the pairs on one thread:
// the entries do not depend on the number of threads.  Bonds are no collisions; a broken one may have some.
template <RealType Real>
class CollisionLedger {
 public:
  // `forces` and `active`: of every pair of the contacts, as the step of this state has them.
  void look(const SimulationState<Real>& s, const ContactPass<Real>& pass,
            const std::vector<PairForce<Real>>& forces, const std::vector<std::uint8_t>& active) {
    detail::CollisionEnergy<Real> account(s);
    if (pass.surface.mesh != nullptr) follow_facets(s, pass, forces, active);
    std::vector<std::size_t> gone;
    std::vector<Entry> fresh;
    std::size_t at = 0;
    for (std::size_t p = 0; p < s.contacts.size(); ++p) {
      if (active[p] == 0 || is_bonded(s, p)) continue;
      const BodyPair pair = s.contacts.pair[p];
      while (at < open_.size() && open_[at].pair < pair) gone.push_back(at++);
      if (at < open_.size() && open_[at].pair == pair) {
        account.kicked(open_[at]);
        account.look(pass, p, forces[p], false, open_[at]);
        ++at;
      } else {
        fresh.emplace_back();
        fresh.back().pair = pair;
        fresh.back().begin_step = s.iteration;
        account.look(pass, p, forces[p], true, fresh.back());
      }
    }
    while (at < open_.size()) gone.push_back(at++);
    for (const std::size_t k : gone) {
      account.kicked(open_[k]);
      account.end(s.iteration, open_[k]);
      ended_.push_back(open_[k]);
    }
    if (gone.empty() && fresh.empty()) return;
    std::vector<Entry> open;
    open.reserve(open_.size() - gone.size() + fresh.size());
    auto next_gone = gone.begin();
    auto next_fresh = fresh.begin();
    for (std::size_t k = 0; k < open_.size(); ++k) {
      while (next_fresh != fresh.end() && next_fresh->pair < open_[k].pair)
        open.push_back(std::move(*next_fresh++));
      if (next_gone != gone.end() && *next_gone == k) {
        ++next_gone;
      } else {
        open.push_back(std::move(open_[k]));
      }
    }
    for (; next_fresh != fresh.end(); ++next_fresh) open.push_back(std::move(*next_fresh));
    open_ = std::move(open);
  }

  // Those that have ended since the last call, by their last step, then by pair.
  [[nodiscard]] std::vector<CollisionRecord> take(const Real& dt) {
    std::vector<CollisionRecord> records;
    for (const Entry& e : ended_) records.push_back(ended_record(e, dt));
    ended_.clear();
    return records;
  }
  // Those that have not, by pair; `iteration` steps have been taken.
  [[nodiscard]] std::vector<CollisionRecord> open(std::uint64_t iteration, const Real& dt) const {
    std::vector<CollisionRecord> records;
    for (const Entry& e : open_) {
      CollisionRecord r = begun_record(e, dt);
      r.open = true;
      r.end_step = iteration;
      r.steps_inside = r.end_step - r.begin_step;
      records.push_back(r);
    }
    return records;
  }

  template <class Archive>
  void visit(Archive& a) {
    const auto list = [&a](const char* name, std::vector<Entry>& entries) {
      std::size_t count = entries.size();
      a.field(name, count);
      if constexpr (Archive::reading) entries.clear();
      for (std::size_t k = 0; k < count; ++k) {
        // One by one: a count that is none meets the end of the text.
        if constexpr (Archive::reading) entries.emplace_back();
        entries[k].each_field([&a](const char* field, auto& value) { a.field(field, value); });
      }
    };
    list("collisions_open", open_);
    list("collisions_ended", ended_);
  }
  // Throws ArchiveError where an entry names no bodies.
  void check(std::size_t bodies) const {
    const auto n = static_cast<std::int32_t>(bodies);
    for (const auto* list : {&open_, &ended_}) {
      for (const Entry& e : *list) {
        for (const std::int32_t i : {e.pair.first, e.pair.second, e.one, e.two}) {
          if (i < 0 || i >= n) throw ArchiveError("a collision names no bodies");
        }
      }
    }
  }

  [[nodiscard]] std::size_t memory() const { return (open_.capacity() + ended_.capacity()) * sizeof(Entry); }

 private:
  using Entry = LedgerEntry<Real>;

  [[nodiscard]] static bool is_bonded(const SimulationState<Real>& s, std::size_t p) {
    if (s.contacts.bond.empty() || s.contacts.bond[p] < 0) return false;
    return s.bonds[static_cast<std::size_t>(s.contacts.bond[p])].broken == 0;
  }

  // A collision that goes from one facet of a surface to another stays one.
  void follow_facets(const SimulationState<Real>& s, const ContactPass<Real>& pass,
                     const std::vector<PairForce<Real>>& forces, const std::vector<std::uint8_t>& active) {
    std::vector<std::pair<std::size_t, BodyPair>> moved;
    for (std::size_t p = 0; p < s.contacts.size(); ++p) {
      if (active[p] == 0 || s.contacts.touched_before[p] != 0) continue;
      const auto i1 = static_cast<std::size_t>(forces[p].first);
      const auto from = pass.surface.taken_from(i1, static_cast<std::size_t>(forces[p].second));
      if (from < 0) continue;
      const BodyPair old = s.contacts.pair[static_cast<std::size_t>(from)];
      const auto found = std::lower_bound(open_.begin(), open_.end(), old,
                                          [](const Entry& e, const BodyPair& pair) { return e.pair < pair; });
      if (found != open_.end() && found->pair == old)
        moved.emplace_back(static_cast<std::size_t>(found - open_.begin()), s.contacts.pair[p]);
    }
    if (moved.empty()) return;
    for (const auto& [k, pair] : moved) open_[k].pair = pair;
    std::sort(open_.begin(), open_.end(), [](const Entry& a, const Entry& b) { return a.pair < b.pair; });
  }

  [[nodiscard]] static CollisionRecord begun_record(const Entry& e, const Real& dt) {
    using std::sqrt;
    CollisionRecord r;
    r.first = e.pair.first;
    r.second = e.pair.second;
    r.begin_step = e.begin_step;
    r.begin_s =
        (static_cast<double>(e.begin_step) - static_cast<double>(e.begin_part)) * static_cast<double>(dt);
    r.normal_velocity_before = static_cast<double>(e.velocity_before);
    r.largest_overlap_m = static_cast<double>(e.largest_overlap);
    r.energy_before = static_cast<double>(e.energy_before);
    r.omega_dt = static_cast<double>(Real(dt * sqrt(e.stiffest / e.mass)));
    return r;
  }

  [[nodiscard]] static CollisionRecord ended_record(const Entry& e, const Real& dt) {
    CollisionRecord r = begun_record(e, dt);
    r.end_step = e.end_step;
    r.steps_inside = e.end_step - e.begin_step;
    const auto whole = static_cast<double>(r.steps_inside - 1);
    const Real steps = Real(whole) + (e.begin_part + e.end_part);
    r.duration_s = static_cast<double>(Real(steps * dt));
    r.end_s =
        (static_cast<double>(e.end_step - 1) + static_cast<double>(e.end_part)) * static_cast<double>(dt);
    r.normal_velocity_after = static_cast<double>(e.velocity_after);
    if (e.velocity_before < 0)
      r.restitution = static_cast<double>(Real(-e.velocity_after / e.velocity_before));
    r.energy_after = static_cast<double>(e.energy_after);
    const Real gained = e.gained + e.gained_rest;
    r.energy_gained = static_cast<double>(gained);
    const Real rounding = 8 * std::numeric_limits<Real>::epsilon() * e.sensitivity;
    const Real bound = rounding + e.step_bound + e.law_bound;
    r.rounding_bound = static_cast<double>(rounding);
    r.step_bound = static_cast<double>(e.step_bound);
    r.law_bound = static_cast<double>(e.law_bound);
    r.beyond_condition = !(gained <= bound);
    if (e.energy_largest > 0) {
      r.energy_created = gained > 0 ? static_cast<double>(Real(gained / e.energy_largest)) : 0;
      r.condition = static_cast<double>(Real(e.sensitivity / e.energy_largest));
    }
    return r;
  }

  std::vector<Entry> open_;   // by pair
  std::vector<Entry> ended_;  // since they were taken
};

}  // namespace ulpgate::dem
