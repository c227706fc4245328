// CollisionSummary: the totals of a ledger of collisions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "kernels/dem/step/collision_record.hpp"

namespace ulpgate {

// What a collision gained as a part of all that it may gain; above 1 it is beyond its condition.
[[nodiscard]] inline double part_of_bound(const dem::CollisionRecord& r) {
  const double bound = r.rounding_bound + r.step_bound + r.law_bound;
  if (!(r.energy_gained > 0)) return r.beyond_condition ? std::numeric_limits<double>::infinity() : 0;
  return bound > 0 ? r.energy_gained / bound : std::numeric_limits<double>::infinity();
}

// A collision by what tells it from the others of its run.
struct CollisionPlace {
  std::int32_t first = 0, second = 0;
  std::uint64_t begin_step = 0;
};

struct CollisionSummary {
  std::uint64_t ended = 0, open = 0;
  std::uint64_t creating = 0;  // ended ones that gained energy
  std::uint64_t beyond = 0;    // more of it than their condition allows
  double largest_created = 0;  // as a part of the pair's energy
  CollisionPlace largest_at;
  double largest_part_of_bound = 0;
  CollisionPlace nearest_at;
  double restitution_sum = 0;
  std::uint64_t restitutions = 0;  // collisions that have one
  std::uint64_t shortest = 0;      // steps inside; 0 where none has ended
  double largest_omega_dt = 0;

  // Sums depend on the order, which is that of the ledger.
  void add(const dem::CollisionRecord& r) {
    largest_omega_dt = std::max(largest_omega_dt, r.omega_dt);
    if (r.open) {
      ++open;
      return;
    }
    ++ended;
    shortest = shortest == 0 ? r.steps_inside : std::min(shortest, r.steps_inside);
    if (r.energy_gained > 0) ++creating;
    if (r.beyond_condition) ++beyond;
    const CollisionPlace here{r.first, r.second, r.begin_step};
    if (r.energy_created > largest_created) {
      largest_created = r.energy_created;
      largest_at = here;
    }
    if (const double part = part_of_bound(r); part > largest_part_of_bound) {
      largest_part_of_bound = part;
      nearest_at = here;
    }
    // None has no restitution: it is no number.
    if (r.restitution == r.restitution) {
      restitution_sum += r.restitution;
      ++restitutions;
    }
  }

  // NaN where no collision has a restitution.
  [[nodiscard]] double mean_restitution() const {
    return restitutions > 0 ? restitution_sum / static_cast<double>(restitutions)
                            : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace ulpgate
