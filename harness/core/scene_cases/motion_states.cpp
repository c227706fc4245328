// Velocities at the ends of the type, impulses below an ulp, a million turns a step; facets beside each
// other.
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

// Part 1 of `translation` is the new position; inputs 0 to 2 the old.
std::string must_move(const KernelPoint& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (p.inputs[3 + i] != 0 && p.got[1][i] == p.inputs[i])
      return "the body stands still: its v dt is below half an ulp of x";
  }
  return "";
}

void add_velocities(std::vector<KernelStateCase>& list) {
  const std::string rest = " 0 0 0 0 0 0";
  list.push_back(
      {.name = "subnormal_velocity",
       .form = "relative",
       .title = "relative velocity of bodies at the least velocities the type has",
       .kernel = "sphere_relative_velocity",
       .inputs = "0 0 1 0.1 1 1 3*least 0 0 0 5*least 0" + rest,
       .known = {
           {"float,double,long_double,float128", StressVerdict::unstable,
            "Below the normal range the spacing is absolute: gradual underflow, a property of the type."}}});
  list.push_back({.name = "subnormal_velocity",
                  .form = "kinetic_energy",
                  .title = "the energy of a velocity whose square has no full precision",
                  .kernel = "body_energy",
                  .inputs = "1e10 small/1e3 small/1e3 0 1 0 0 0 0 0 0 0 0 0",
                  .known = {{"float,double,long_double,float128", StressVerdict::unstable,
                             "The square of the velocity is subnormal before the mass multiplies it: a "
                             "property of the order of the products."}}});
  list.push_back(
      {.name = "near_overflow_velocity",
       .form = "relative",
       .title = "relative velocity of two bodies that approach at a quarter of the largest number each",
       .kernel = "sphere_relative_velocity",
       .inputs = "1 0 0 0.1 1 1 huge/4 0 0 -huge/4 0 0" + rest,
       .known = {{"mpfr62,mpfr150,cpp_bin_float62", StressVerdict::wrong_outcome,
                  "The difference of the velocities is infinite in the reference of this type as well, which "
                  "has the same range of exponents: another way to say that the case lies at its end."}}});
  list.push_back({.name = "near_overflow_velocity",
                  .form = "kinetic_energy",
                  .title = "an energy of which only the square of the velocity overflows",
                  .kernel = "body_energy",
                  .inputs = "1e-10 2*large 2*large 0 1 0 0 0 0 0 0 0 0 0",
                  .known = {{"all", StressVerdict::diverged,
                             "The square of the velocity overflows before the mass makes it small: a "
                             "property of the order of the products."}}});
  list.push_back({.name = "damping",
                  .form = "sign_of_an_underflow",
                  .title = "damping by the sign of a product of a and v that underflows",
                  .kernel = "translation",
                  .inputs = "0 0 0 -3*small*u 0 0 small*u 0 0 1 0 0 0 0.5 1",
                  .truth = {{0, {"-1.5*small*u", "0", "0"}}}});
  list.push_back({.name = "damping",
                  .form = "at_rest",
                  .title = "damping of a body that starts from rest",
                  .kernel = "translation",
                  .inputs = "0 0 0 0 0 0 1 0 0 1 0 0 0 0.5 1",
                  .truth = {{0, {"0.5", "0", "0"}}}});
}

void add_integration(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "absorbed_motion",
                  .form = "scan",
                  .title = "a body at 1 m with 1 m/s, moved by ever smaller steps s: where it stands still",
                  .kernel = "translation",
                  .inputs = "1 0 0 1 0 0 0 0 0 1 0 0 0 0 s",
                  .scan_step = -1,
                  .scan_end = -520,
                  .outcome = must_move,
                  .known = {{"all", StressVerdict::wrong_outcome,
                             "x + v dt is x where v dt is below half an ulp of x: smaller steps make it "
                             "worse, a property of the type and of sums that are not compensated."}}});
  list.push_back({.name = "absorbed_impulse",
                  .form = "",
                  .title = "an impulse below half an ulp of the momentum",
                  .kernel = "translation",
                  .inputs = "0 0 0 1 0 0 u/2 0 0 1 0 0 0 0 1",
                  .outcome = [](const KernelPoint& p) -> std::string {
                    return p.got[0][0] == 1 ? "the velocity does not change under a force" : "";
                  },
                  .known = {{"all", StressVerdict::wrong_outcome,
                             "v + a dt is v where a dt is below half an ulp of v: a property of the type and "
                             "of sums that are not compensated."}}});
  list.push_back({.name = "million_turns",
                  .form = "sphere",
                  .title = "a sphere that spins 1e6 times a step comes back to its orientation",
                  .kernel = "rotation",
                  .inputs = "1 0 0 0 0 0 2e6*pi 0 0 0 1 0 1",
                  .truth = {{1, {"1", "0", "0", "0"}}}});
  list.push_back(
      {.name = "million_turns",
       .form = "aspherical",
       .title = "1e6 and a quarter turns a step by the quaternion leapfrog of bodies of three moments",
       .kernel = "aspherical_rotation",
       .inputs = "1 0 0 0 0 0 2e6*pi+pi/2 1 1 1 0 0 0 1",
       .truth = {{0, {"sqrt(0.5)", "0", "0", "sqrt(0.5)"}}},
       .outcome = [](const KernelPoint& p) -> std::string {
         return std::fabs(std::fabs(p.of(0, 0)) - std::sqrt(0.5)) < 0.01
                    ? ""
                    : "the turns are lost: the orientation is not that of a quarter turn";
       },
       .known = {{"all", StressVerdict::wrong_outcome,
                  "The quaternion leapfrog follows the tangent of the turn and not the turn: more than about "
                  "a radian a step is lost, a property of the method."}}});
  list.push_back({.name = "million_turns",
                  .form = "hundredth_of_a_turn",
                  .title = "a hundredth of a turn a step by the quaternion leapfrog",
                  .kernel = "aspherical_rotation",
                  .inputs = "1 0 0 0 0 0 pi/50 1 1 1 0 0 0 1"});
  list.push_back({.name = "needle_moments",
                  .form = "1e12",
                  .title = "a body whose moments are as 1 to 1e12",
                  .kernel = "aspherical_rotation",
                  .inputs = "0.6 0 0.8 0 1e-6 2e-6 3e-6 1e-6 1e6 1e6 0 0 0 1e-6"});
  list.push_back(
      {.name = "critical_step_oblique",
       .form = "",
       .title = "the critical step of one contact along (1, 1, 1): that of one along an axis",
       .kernel = "stiffness_step",
       .inputs = "1 0.4 1e5 0 sqrt(1/3) sqrt(1/3) sqrt(1/3) 1",
       .truth = {{0, {"0.8*sqrt(2/1e5)"}}},
       .outcome = [](const KernelPoint& p) -> std::string {
         const double ratio = p.of(0, 0) / (0.8 * std::sqrt(2 / 1e5));
         return std::fabs(ratio - 1) < 0.01
                    ? ""
                    : "the step is " + std::to_string(ratio) + " times that of the same contact along x";
       },
       .known = {{"all", StressVerdict::wrong_outcome,
                  "of the rule: it looks along the axes alone; the engine's own step does not use it"}}});
}

// Two triangles of a square, cut along the diagonal through (0,0) and (1,1), under a sphere of radius 0.5
// over (x, y) at height z; force is the sum of overlap times normal, that of a spring of 1 N/m.
StressCase shared_edge(const std::string& form, const std::string& title, const std::string& centre,
                       const std::string& overlap, const std::string& cause) {
  StressCase out;
  if (!cause.empty()) out.known = {{"all", StressVerdict::wrong_outcome, cause}};
  out.kind = "state";
  out.name = "shared_edge";
  out.form = form;
  out.title = title;
  out.cost = 0.02;
  out.run = [=](std::string_view token, const ode::StopFlag&) -> std::optional<StressRow> {
    const RealDescriptor* type = find_type(token);
    if (type == nullptr) return std::nullopt;
    StressRow row;
    row.condition = 1;
    WideReal force[3] = {WideReal(0), WideReal(0), WideReal(0)};
    int contacts = 0;
    for (const std::string facet : {"0 0 0 1 0 0 1 1 0 ", "0 0 0 1 1 0 0 1 0 "}) {
      const KernelPoint p = evaluate_state("facet_sphere", *type, facet + centre + " 0.5", 0);
      if (!(p.got[0][0] > 0)) continue;
      ++contacts;
      for (std::size_t i = 0; i < 3; ++i) force[i] += p.got[0][0] * p.got[1][i];
      row.condition = std::max(*row.condition, p.point.parts[0].condition);
    }
    const WideReal truth = state_names(type->format, 0)(overlap);
    const WideReal d = force[2] - truth;
    row.error = static_cast<double>(
        WideReal(sqrt(WideReal(force[0] * force[0] + force[1] * force[1] + d * d)) / truth));
    row.correct_digits = std::max(0.0, *row.error > 0 ? -std::log10(*row.error) : type->decimal_places);
    row.figures["contacts"] = contacts;
    row.figures["force_over_that_of_one_plane"] = static_cast<double>(WideReal(force[2] / truth));
    row.verdict = judge_stress(*row.error, *row.condition, unit_roundoff(type->significand_bits));
    if (row.verdict == StressVerdict::unstable && *row.error > 0.01) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = std::to_string(contacts) +
                " facets push where one plane does: the force depends on the triangulation";
    }
    return row;
  };
  return out;
}

}  // namespace

std::vector<KernelStateCase> motion_states() {
  std::vector<KernelStateCase> list;
  add_velocities(list);
  add_integration(list);
  return list;
}

std::vector<StressCase> shared_edge_states() {
  const std::string cause =
      "Every facet acts on its own: near a common edge each of two coplanar facets pushes with its full "
      "stiffness, a property of the method.";
  std::vector<StressCase> list;
  list.push_back(shared_edge("on_it", "a sphere over the common edge of two coplanar facets", "0.5 0.5 0.375",
                             "0.125", cause));
  list.push_back(shared_edge("beside_it", "a sphere beside the common edge, nearer than its radius",
                             "0.5+1/16 0.5-1/16 0.375", "0.125", cause));
  list.push_back(shared_edge("away", "a sphere farther from the common edge than its contact reaches",
                             "0.875 0.125 0.375", "0.125", ""));
  return list;
}

}  // namespace ulpgate
