// CollisionRecord: one line of the ledger of collisions, as numbers for people and files.
#pragma once

#include <cstdint>
#include <limits>

namespace ulpgate::dem {

// A collision begins with the first step that finds two bodies touching and ends with the first that finds
// them apart.  Energies are those of the motion of the two against each other, m*/2 |v2 - v1|^2 with the
// reduced mass m* (the other's mass where one is fixed), and of the spins of those that are movable.
struct CollisionRecord {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::int32_t first = 0, second = 0;          // bodies, first < second
  std::uint64_t begin_step = 0, end_step = 0;  // end_step of an open one: the last step seen, plus 1
  std::uint64_t steps_inside = 0;              // end_step - begin_step
  bool open = false;                           // the run ended first: nothing of its end is known
  // When the paths of the bodies, straight from step to step, crossed overlap 0, s; none of an open one.
  double begin_s = 0, end_s = none, duration_s = none;
  double normal_velocity_before = 0, normal_velocity_after = none;  // m/s; negative: towards each other
  double restitution = none;                                        // -after/before; none without an approach
  double largest_overlap_m = 0;
  double energy_before = 0, energy_after = none;  // J; before: with the springs of bodies that began inside
  // What the contact alone did, J, without the work of gravity, damping and other contacts.
  double energy_gained = none;
  // The part of the largest energy of the pair that it made from nothing: 0 where it took energy.
  double energy_created = none;
  double omega_dt = 0;   // largest sqrt(stiffness/m*) dt; a contact is stable below 2
  double condition = 0;  // of the gained energy: relative change by relative changes of state and constants
  // What it may gain, J: by rounding, 16 u condition energy; by the step; by a law that is not passive.
  double rounding_bound = 0, step_bound = 0, law_bound = 0;
  bool beyond_condition = false;  // gained more than the three
};

}  // namespace ulpgate::dem
