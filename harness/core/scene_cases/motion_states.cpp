// Velocities at the ends of the type, impulses below an ulp, a million turns a step; facets beside each
// other.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"
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
                  .inputs = "1e10 small/1e3 small/1e3 0 1 0 0 0 0 0 0 0 0 0"});
  list.push_back(
      {.name = "near_overflow_velocity",
       .form = "relative",
       .title = "relative velocity of two bodies that approach at a quarter of the largest number each",
       .kernel = "sphere_relative_velocity",
       .inputs = "1 0 0 0.1 1 1 huge/4 0 0 -huge/4 0 0" + rest,
       .known = {
           {"cpp_bin_float62", StressVerdict::wrong_outcome,
            "The reference of this type has the same range of exponents, and the error is measured at its "
            "end: a property of the type."}}});
  list.push_back({.name = "near_overflow_velocity",
                  .form = "kinetic_energy",
                  .title = "an energy of which only the square of the velocity overflows",
                  .kernel = "body_energy",
                  .inputs = "1e-10 2*large 2*large 0 1 0 0 0 0 0 0 0 0 0",
                  .known = {{"cpp_bin_float62", StressVerdict::wrong_outcome,
                             "The reference of this type has the same range of exponents, and the square "
                             "overflows in it: a property of the type."}}});
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
  list.push_back({.name = "critical_step_oblique",
                  .form = "",
                  .title = "the critical step of one contact along (1, 1, 1): that of one along an axis",
                  .kernel = "stiffness_step",
                  .inputs = "1 0.4 1e5 0 sqrt(1/3) sqrt(1/3) sqrt(1/3) 1",
                  .truth = {{0, {"0.8*sqrt(2/1e5)"}}},
                  .outcome = [](const KernelPoint& p) -> std::string {
                    const double ratio = p.of(0, 0) / (0.8 * std::sqrt(2 / 1e5));
                    return std::fabs(ratio - 1) < 0.01
                               ? ""
                               : fmt::format("the step is {:.3g} times that of the same contact along x",
                                             ratio);
                  },
                  .known = {{"all", StressVerdict::wrong_outcome,
                             "The rule looks along the axes alone, a property of the method; the engine's "
                             "own step does not use it."}}});
}

// A sphere on facets that share edges, as the engine has it: what it is pushed with.
struct SharedEdge {
  std::string form, title;
  std::string facets;                // nine coordinates each
  std::string centre;                // of the sphere, of radius 0.5
  std::array<std::string, 3> force;  // of springs of 1 N/m
  std::size_t contacts = 1;
};

// One step of 1 s of a body of 1 kg that was at rest: its velocity is the force on it.
std::string text_of(const SharedEdge& c) {
  std::string text = scene_text::begin("shared_edge", "m", {{"stiffness", "1"}}) +
                     scene_text::sphere(c.centre, "1/2", {{"mass", "1"}});
  std::istringstream in(c.facets);
  for (std::array<std::string, 9> x; in >> x[0];) {
    for (std::size_t i = 1; i < x.size(); ++i) in >> x[i];
    std::string corners;
    for (std::size_t i = 0; i < x.size(); i += 3)
      corners += (i > 0 ? ", [" : "[") + x[i] + ", " + x[i + 1] + ", " + x[i + 2] + "]";
    text += scene_text::section("[[facet]]", {{"vertices", "[" + corners + "]"}});
  }
  return text + scene_text::contacts("frictional") + scene_text::run("1");
}

StressCase shared_edge(const SharedEdge& c) {
  StressCase out;
  out.kind = "state";
  out.name = "shared_edge";
  out.form = c.form;
  out.title = c.title;
  out.cost = 0.02;
  out.run = [c](std::string_view token, const ode::StopFlag&) -> std::optional<StressRow> {
    const RealDescriptor* type = find_type(token);
    if (type == nullptr) return std::nullopt;
    const auto engine = dem::make_engine(token, dem::Level::own, scene_of(text_of(c)), {});
    engine->step(1);
    const auto evaluate = state_names(type->format, 0);
    WideReal apart(0);
    WideReal size(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const WideReal truth = evaluate(c.force[i]);
      const WideReal d = evaluate(engine->text(dem::BodyQuantity::velocity, 0, i)) - truth;
      apart += d * d;
      size += truth * truth;
    }
    StressRow row;
    row.error = static_cast<double>(WideReal(sqrt(apart / size)));
    // Of an overlap, the difference of a radius and a distance of about its size.
    row.condition = 1 / static_cast<double>(WideReal(sqrt(size)));
    row.correct_digits = std::max(0.0, *row.error > 0 ? -std::log10(*row.error) : type->decimal_places);
    row.figures["contacts"] = static_cast<double>(engine->contacts().size());
    row.verdict = judge_stress(*row.error, *row.condition, unit_roundoff(type->significand_bits));
    if (engine->contacts().size() != c.contacts || *row.error > 0.01) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = std::to_string(engine->contacts().size()) + " contacts instead of " +
                std::to_string(c.contacts) + ": the force depends on the triangulation";
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
  const std::string square = "0 0 0 1 0 0 1 1 0  0 0 0 1 1 0 0 1 0";
  const std::string fan =
      "0 0 0 2 0 0 1 2 0  0 0 0 1 2 0 -1 2 0  0 0 0 -1 2 0 -2 0 0  0 0 0 -2 0 0 -1 -2 0 "
      "0 0 0 -1 -2 0 1 -2 0  0 0 0 1 -2 0 2 0 0";
  const std::array<std::string, 3> up = {"0", "0", "0.125"};
  std::vector<StressCase> list;
  for (const SharedEdge& c :
       {SharedEdge{"on_it", "over the common edge of two coplanar facets", square, "0.5, 0.5, 0.375", up},
        SharedEdge{"beside_it", "beside the common edge, nearer than its contact reaches", square,
                   "0.5625, 0.4375, 0.375", up},
        SharedEdge{"away", "farther from the common edge than its contact reaches", square,
                   "0.875, 0.125, 0.375", up},
        SharedEdge{"corner_of_six", "over the common corner of six coplanar facets", fan, "0, 0, 0.375", up},
        SharedEdge{"convex", "over a ridge, the common edge of two facets: one push of the edge",
                   "0 -1 0 0 1 0 1 0 -1  0 -1 0 0 1 0 -1 0 -1", "0, 0, 0.375", up},
        SharedEdge{"concave",
                   "in a furrow, over the common edge of two facets: a push of each face",
                   "0 -1 0 0 1 0 1 0 1  0 -1 0 0 1 0 -1 0 1",
                   "0, 0, 0.625",
                   {"0", "0", "sqrt(0.5)-0.625"},
                   2}}) {
    list.push_back(shared_edge(c));
    list.back().title = "a sphere " + list.back().title;
  }
  return list;
}

}  // namespace ulpgate
