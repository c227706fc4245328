// Contact laws on the cone, at no overlap, under tension; shear that is carried on.
#include <fmt/format.h>

#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"

namespace ulpgate {

namespace {

// Whether the shear force of `part` is one that slid: shorter than that of the inputs at `at`.
bool shorter(const KernelPoint& p, std::size_t part, std::size_t at) {
  WideReal before(0);
  WideReal after(0);
  for (std::size_t i = 0; i < 3; ++i) {
    before += p.inputs[at + i] * p.inputs[at + i];
    after += p.got[part][i] * p.got[part][i];
  }
  return after * 1001 < before * 1000;
}
std::string must_slip(const KernelPoint& p) {
  return shorter(p, 0, 0) ? "" : "sticks beyond the cone";
}
std::string must_stick(const KernelPoint& p) {
  return shorter(p, 0, 0) ? "slips inside the cone" : "";
}

void add_friction(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "friction_cone",
                  .form = "exactly_on_it",
                  .title = "a shear force of the length of the limit sticks",
                  .kernel = "cut_to_cone",
                  .inputs = "3 4 0 5 1",
                  .truth = {{0, {"3", "4", "0"}}, {1, {"0"}}},
                  .outcome = must_stick});
  list.push_back({.name = "friction_cone",
                  .form = "on_it_by_rounding",
                  .title = "0.3, 0.4 against 0.5: which side is a matter of rounding, the force is not",
                  .kernel = "cut_to_cone",
                  .inputs = "0.3 0.4 0 0.5 1",
                  .truth = {{0, {"0.3", "0.4", "0"}}, {1, {"0"}}},
                  .outcome = must_stick});
  list.push_back({.name = "friction_cone",
                  .form = "no_limit",
                  .title = "a normal force of 0 leaves no shear",
                  .kernel = "cut_to_cone",
                  .inputs = "3 4 0 0 1",
                  .truth = {{0, {"0", "0", "0"}}},
                  .outcome = must_slip});
  list.push_back({.name = "friction_cone",
                  .form = "squares_underflow",
                  .title = "forces so small that their squares are 0, twice beyond the cone",
                  .kernel = "cut_to_cone",
                  .inputs = "3*least/u*16 4*least/u*16 0 2.5*least/u*16 2.5*least/u*16",
                  .outcome = must_slip});
  list.push_back({.name = "friction_cone",
                  .form = "squares_overflow",
                  .title = "forces so large that their squares overflow, twice beyond the cone",
                  .kernel = "cut_to_cone",
                  .inputs = "12*large 16*large 0 10*large 1e30",
                  .outcome = must_slip,
                  .known = {{"cpp_bin_float62", StressVerdict::wrong_outcome,
                             "The reference of this type has the same range of exponents, and the squares "
                             "overflow in it: a property of the type."}}});
}

void add_laws(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "tension_at_separation",
                  .form = "cohesive",
                  .title = "a bond that pulls more than its adhesion holds keeps no shear; the limit is no "
                           "longer a length",
                  .kernel = "cohesive",
                  .inputs = "1e5 3e4 0.5 10 0.001 0.0015 0 0 1 3 4 0 0.1 0 0 1e-6",
                  .truth = {{0, {"-50"}}, {1, {"0", "0", "0"}}, {2, {"0"}}}});
  list.push_back({.name = "tension_at_separation",
                  .form = "frictional",
                  .title = "a negative overlap in a law without tension keeps no shear",
                  .kernel = "cundall_strack",
                  .inputs = "1e5 3e4 0.5 -u 0 0 1 3 4 0 0.1 0 0 1e-6",
                  .truth = {{1, {"0", "0", "0"}}, {2, {"0"}}}});
  list.push_back({.name = "overlap_zero",
                  .form = "dashpot_opening",
                  .title = "a dashpot at no overlap does not pull",
                  .kernel = "viscoelastic",
                  .inputs = "1e5 3e4 10 3 0.5 0 -1 0 0 1 0 0 0 0.1 0 1 1e-6",
                  .truth = {{0, {"0"}}, {1, {"0", "0", "0"}}, {2, {"0", "0", "0"}}}});
  list.push_back({.name = "overlap_zero",
                  .form = "dashpot_closing",
                  .title = "a dashpot at no overlap pushes at once: the force begins with a jump",
                  .kernel = "viscoelastic",
                  .inputs = "1e5 3e4 10 3 0.5 0 1 0 0 1 0 0 0 0 0 -1 1e-6",
                  .truth = {{0, {"10"}}}});
  list.push_back({.name = "overlap_zero",
                  .form = "cohesion",
                  .title = "a bond at no overlap pulls by its rest overlap",
                  .kernel = "cohesive",
                  .inputs = "1e5 3e4 0.5 1000 0 0.001 0 0 1 3 4 0 0 0 0 1e-6",
                  .truth = {{0, {"-100"}}, {1, {"3", "4", "0"}}}});
  list.push_back({.name = "overlap_zero",
                  .form = "hertz",
                  .title = "Hertz at no overlap keeps no shear",
                  .kernel = "hertz_mindlin",
                  .inputs = "1e9 1e9 0.5 0 0 0 1 3 4 0 0.1 0 0 1e-6",
                  .truth = {{0, {"0"}}, {1, {"0", "0", "0"}}, {2, {"0"}}}});
  list.push_back({.name = "overlap_zero",
                  .form = "hertz_one_least",
                  .title = "Hertz at the least overlap that the type has",
                  .kernel = "hertz_mindlin",
                  .inputs = "1e9 1e9 0.5 least 0 0 1 0 0 0 0 0 0 1e-6",
                  .known = {{"float,double,long_double,float128", StressVerdict::unstable,
                             "The force of the least overlap is below the least number: gradual underflow, a "
                             "property of the type."}}});
  // Centres 1e-6 apart, moving across: the factor without ratcheting, (r1 + r2)/distance, is 2e6.
  list.push_back({.name = "deep_overlap",
                  .form = "two_radii",
                  .title = "a contact step of two spheres 1e-6 of a radius apart",
                  .kernel = "sphere_contact_step",
                  .inputs = "0 0 0 1 1e-6 0 0 1 0 0 0 0 1 0 0 0 0 0 0 0 1e5 3e4 0.5 0 0 0 1 0 0 1e-6"});
  list.push_back({.name = "deep_overlap",
                  .form = "half_a_radius",
                  .title = "a contact step of two spheres half a radius apart",
                  .kernel = "sphere_contact_step",
                  .inputs = "0 0 0 1 0.3 0.4 0 1 0 0 0 0 1 0 0 0 1 0 0 1 1e5 3e4 0.5 0 0 1 0.6 0.8 0 1e-6"});
  list.push_back({.name = "restitution",
                  .form = "near_nothing",
                  .title = "a visco-elastic contact of restitution 1e-12",
                  .kernel = "viscoelastic_physics",
                  .inputs = "1e-3 1e-12 1e-12 0.5 1 1"});
  list.push_back({.name = "restitution",
                  .form = "near_one",
                  .title = "restitution one ulp below 1: the viscosity is that ulp",
                  .kernel = "viscoelastic_physics",
                  .inputs = "1e-3 1-u 1-u 0.5 1 1"});
  list.push_back({.name = "mass_ratio",
                  .form = "1e12",
                  .title = "a contact of 1e-6 kg with 1e6 kg: the reduced mass",
                  .kernel = "viscoelastic_physics",
                  .inputs = "1e-3 0.5 0.5 0.5 1e-6 1e6"});
  list.push_back({.name = "mass_ratio",
                  .form = "near_overflow",
                  .title = "two masses whose product overflows",
                  .kernel = "viscoelastic_physics",
                  .inputs = "1 0.5 0.5 0.5 8*large 8*large"});
}

// The stored force after its turn must be as long as before, and across the new normal.
std::string keeps_length(const KernelPoint& p) {
  WideReal before(0);
  WideReal after(0);
  WideReal along(0);
  for (std::size_t i = 0; i < 3; ++i) {
    before += p.inputs[i] * p.inputs[i];
    after += p.got[0][i] * p.got[0][i];
    along += p.got[0][i] * p.inputs[6 + i];
  }
  const double growth = static_cast<double>(WideReal(sqrt(WideReal(after / before))));
  const double tilt = static_cast<double>(WideReal(along / sqrt(before)));
  if (std::fabs(growth - 1) > 0.01)
    return fmt::format("the shear force becomes {:.3g} times as long", growth);
  if (std::fabs(tilt) > 0.01)
    return fmt::format("a part {:.3g} of the shear force lies along the normal", tilt);
  return "";
}

void add_shear(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "shear_carried",
                  .form = "small_turn",
                  .title = "a normal that turns by 1e-3, and a spin of as much",
                  .kernel = "rotate_shear",
                  .inputs = "1 0 0 0 0 1 1e-3 0 1 0 0 500 0 0 500 2e-6",
                  .outcome = keeps_length});
  list.push_back({.name = "shear_carried",
                  .form = "large_turn",
                  .title = "a normal that turns by atan(3/4) in a step: small sphere on a large one",
                  .kernel = "rotate_shear",
                  .inputs = "1 0 0 0 0 1 0.6 0 0.8 0 0 0 0 0 0 1e-6",
                  .outcome = keeps_length,
                  .known = {{"all", StressVerdict::wrong_outcome,
                             "The stored force is turned to first order, s - s x t: it grows by sqrt(1 + "
                             "t^2) in a step that turns the normal by t, a property of the method."}}});
  list.push_back(
      {.name = "shear_carried",
       .form = "million_turns",
       .title = "a pair that spins 1e6 times a step about its normal: the force comes back to itself",
       .kernel = "rotate_shear",
       .inputs = "1 0 0 0 0 1 0 0 1 0 0 2e6*pi 0 0 2e6*pi 1",
       .truth = {{0, {"1", "0", "0"}}},
       .outcome = keeps_length,
       .known = {{"all", StressVerdict::wrong_outcome,
                  "The stored force is turned to first order by the angle of the spin in a step, which is no "
                  "small one: it grows by that factor, a property of the method."}}});
  list.push_back({.name = "bond_turned",
                  .form = "half_a_turn",
                  .title = "a bond twisted by half a turn: q and -q are one",
                  .kernel = "twist_and_bending",
                  .inputs = "1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 1 0 0 1",
                  .truth = {{0, {"pi"}}}});
  list.push_back(
      {.name = "bond_turned",
       .form = "two_thirds_of_a_turn",
       .title = "a bond twisted by 4 pi/3 comes back as -2 pi/3: its moment changes sign",
       .kernel = "twist_and_bending",
       .inputs = "1 0 0 0 1 0 0 0 1 0 0 0 -0.5 0 0 sqrt(0.75) 0 0 1",
       .truth = {{0, {"4*pi/3"}}},
       .outcome = [](const KernelPoint& p) -> std::string {
         return p.got[0][0] > 0 ? "" : "the twist has the wrong sign";
       },
       .known = {{"all", StressVerdict::wrong_outcome,
                  "Two orientations tell their relative turn up to whole turns only: a bond twisted by more "
                  "than half a turn turns back the other way, a property of the method."}}});
}

}  // namespace

std::vector<KernelStateCase> law_states() {
  std::vector<KernelStateCase> list;
  add_friction(list);
  add_laws(list);
  add_shear(list);
  return list;
}

}  // namespace ulpgate
