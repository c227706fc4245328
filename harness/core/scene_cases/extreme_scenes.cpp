// Scenes far from the origin, with sizes, masses, spins and overlaps at the ends, and bodies that stand
// still.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"

namespace ulpgate {

namespace {

using dem::BodyQuantity;
using namespace scene_text;

std::string ball(const std::string& position, const std::string& velocity, const std::string& radius,
                 Keys more = {}) {
  more.emplace_back("velocity", velocity);
  return sphere(position, radius, more);
}

// In steps of dt (s), by springs alone.
std::string moving(const std::string& dt, const Keys& more = {}) {
  return contacts("frictional") + run(dt, "1", more);
}

const Keys heavy = {{"gravity", downwards}};
const std::string steel = begin("extreme", "steel",
                                {{"density", "7800"},
                                 {"young", "1e8"},
                                 {"poisson", "0.3"},
                                 {"friction_angle", "20"},
                                 {"stiffness", "1e5"}});

// The sign of a body's velocity along x, also where it is no double.
int sign_of_velocity(const dem::DemEngine& e, std::size_t body) {
  MpfrValue v;
  e.exact(BodyQuantity::velocity, body, 0, v);
  return mpfr_sgn(v.get());
}

std::string exact_text(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%a", x);
  return text.data();
}

double moved(const dem::DemEngine& e, std::size_t body, std::size_t axis, double from) {
  return e.approximate(BodyQuantity::position, body, axis) - from;
}

// A head-on collision of two balls of 1 mm, moved to x = `at`.
SceneCase far_away(const std::string& at) {
  SceneCase c;
  c.name = "far_from_the_origin";
  c.form = at;
  c.title = "two balls of 1 mm meet at x = " + at + " m: they must come apart with exchanged velocities";
  c.toml = steel + ball(at + ", 0, 0", "1, 0, 0", "1e-3") + ball(at + "+2.001e-3, 0, 0", "-1, 0, 0", "1e-3") +
           moving("1e-6");
  c.steps = 400;
  const std::string absorbed =
      "Positions round to multiples of an ulp as large as the overlap, and move by whole ones only, while "
      "the force "
      "acts on every step: a property of the type.";
  if (at == "1e3") c.known.push_back({"float", StressVerdict::wrong_outcome, absorbed});
  if (at == "1e7" || at == "1e12")
    c.known.push_back({"float", StressVerdict::refused, absorbed, "their centres are the same point"});
  if (at == "1e12") c.known.push_back({"double", StressVerdict::wrong_outcome, absorbed});
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double apart =
        t.own.approximate(BodyQuantity::velocity, 1, 0) - t.own.approximate(BodyQuantity::velocity, 0, 0);
    row.figures["restitution"] = apart / 2;
    return std::fabs(apart / 2 - 1) < 0.1 ? "" : fmt::format("restitution {:.3g} instead of 1", apart / 2);
  };
  return c;
}

// A free body at x = 256 with 1 m/s.
SceneCase standing_still(const std::string& dt) {
  SceneCase c;
  c.name = "motion_absorbed";
  c.form = "dt_" + dt;
  c.title = "a body at x = 256 m with 1 m/s in steps of " + dt + " s: its v dt against the ulp of x";
  c.toml = steel + ball("256, 0, 0", "1, 0, 0", "0.01") + ball("0, 0, 0", "0, 0, 0", "0.01") + moving(dt);
  c.steps = 500;
  const std::string below =
      "v dt is below half an ulp of x, and smaller steps make it worse: a property of the type "
      "and of sums that are not compensated.";
  if (dt != "1e-3")
    c.known = {{dt == "1e-14" ? "float,double" : "float", StressVerdict::wrong_outcome, below}};
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double ratio = moved(t.own, 0, 0, 256) / moved(t.reference, 0, 0, 256);
    row.figures["way_over_true_way"] = ratio;
    // The clock is the count of steps times dt: it does not stop.
    row.figures["clock_over_true_clock"] = t.own.time_s() / (500 * t.dt_s);
    return std::fabs(ratio - 1) < 0.01 ? "" : fmt::format("the body goes {:.3g} of its way", ratio);
  };
  return c;
}

// A steel ball of 1 mm let go on a wall at y = `wall`; damping brings it to rest.
SceneCase resting(const std::string& wall) {
  SceneCase c;
  c.name = "resting_contact";
  c.form = "wall_at_" + wall;
  c.title = "a steel ball of 1 mm rests 3.2e-9 m deep in a wall at y = " + wall + " m";
  c.toml = steel + ball("0, " + wall + "+1e-3, 0", "0, 0, 0", "1e-3") + scene_text::wall(wall) +
           moving("1e-6", {{"gravity", downwards}, {"damping", "0.2"}});
  c.steps = 1000;
  if (wall != "0")
    c.known = {{"float", StressVerdict::wrong_outcome,
                "The overlap at rest is at or below the ulp of the position: a property of the type."}};
  c.outcome = [wall = std::stod(wall)](const SceneTrial& t, StressRow& row) -> std::string {
    const double rest = 4.0 / 3 * std::acos(-1.0) * 7800 * 9.81e-9 / 1e5;
    const double depth = -moved(t.own, 0, 1, wall + 1e-3);
    row.figures["depth_over_depth_of_rest"] = depth / rest;
    return std::fabs(depth / rest - 1) < 0.5
               ? ""
               : fmt::format("the ball is {:.3g} times as deep as it rests", depth / rest);
  };
  return c;
}

void add_overlaps(std::vector<SceneCase>& list) {
  SceneCase c;
  c.name = "coincident_centres";
  c.form = "at_the_start";
  c.title = "two spheres begin about one point";
  c.known = {{"all", StressVerdict::refused, "Two centres in one point have no direction between them.",
              "their centres are the same point"}};
  c.toml = steel + ball("1, 2, 3", "0, 0, 0", "1e-3") + ball("1, 2, 3", "0, 0, 0", "1e-3") + moving("1e-6");
  list.push_back(c);
  c.form = "on_the_way";
  c.title = "a sphere flies onto the centre of another in one step";
  c.known = {
      {"all", StressVerdict::diverged,
       "Two centres in one point have no direction between them, and no later step looks for it: a property "
       "of the method; a run stops and names the body."}};
  c.toml = steel + ball("-1, 0, 0", "1, 0, 0", "0.25") + ball("0, 0, 0", "0, 0, 0", "0.25") + moving("1");
  c.steps = 4;
  list.push_back(c);

  c.name = "deep_overlap";
  c.form = "soft_spheres_pass";
  c.title = "two balls faster than their contact holds meet: they must not pass through each other";
  c.known = {
      {"all", StressVerdict::wrong_outcome,
       "A linear spring stores k (2 r)^2/2 at most, and beyond the centre its normal turns round and pushes "
       "on: a property of the method."}};
  c.toml = steel + ball("-1.001e-3, 0, 0", "300, 0, 0", "1e-3") +
           ball("1.001e-3, 1e-5, 0", "-300, 0, 0", "1e-3") + moving("1e-7");
  c.steps = 300;
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double order = t.reference.approximate(BodyQuantity::position, 1, 0) -
                         t.reference.approximate(BodyQuantity::position, 0, 0);
    row.figures["distance_at_the_end_m"] = order;
    return order > 0 ? "" : "the balls have passed through each other";
  };
  list.push_back(c);
  c.form = "start_99_percent";
  c.known = {};
  c.title = "two balls that begin 99 % inside each other: their energy is that of the spring";
  c.toml =
      steel + ball("-1e-5, 0, 0", "0, 0, 0", "1e-3") + ball("1e-5, 0, 0", "0, 0, 0", "1e-3") + moving("1e-7");
  c.steps = 1000;
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double stored = 1e5 * 1.98e-3 * 1.98e-3 / 2;
    row.figures["kinetic_over_stored"] = t.reference.kinetic_energy() / stored;
    return std::fabs(t.reference.kinetic_energy() / stored - 1) < 0.01
               ? ""
               : fmt::format("kinetic energy {:.3g} of what was stored",
                             t.reference.kinetic_energy() / stored);
  };
  list.push_back(c);
}

void add_ratios(std::vector<SceneCase>& list) {
  SceneCase c;
  c.name = "mass_ratio_stack";
  c.form = "1e12";
  c.title = "1e6 kg fall on 1e-6 kg that lie on a wall: the light one must hold";
  c.toml = steel + ball("0, 0.01-1e-9, 0", "0, 0, 0", "0.01", {{"mass", "1e-6"}}) +
           ball("0, 0.03+1e-9, 0", "0, -1e-3, 0", "0.01", {{"mass", "1e6"}}) + wall("0") +
           moving("1e-6", heavy);
  c.steps = 1000;
  list.push_back(c);

  c = {};
  c.name = "size_ratio_tangential";
  c.title =
      "a ball of 1 mm rolls and slides over one of 1 m: shear with half-step velocities, full-step normals";
  for (const std::string dt : {"4e-6", "1e-6", "2.5e-7"}) {
    c.form = "dt_" + dt;
    c.toml = steel + ball("0, 0, 0", "0, 0, 0", "1", {{"fixed", "true"}}) +
             ball("0, 1.001-1e-6, 0", "2, 0, 0", "1e-3") + moving(dt, heavy);
    c.steps = static_cast<std::uint64_t>(std::llround(1e-3 / std::stod(dt)));
    list.push_back(c);
  }
  c = {};
  c.name = "size_scale";
  c.title = "two balls of this many metres meet";
  for (const std::string size : {"1e-12", "1e-6", "1e6", "1e12"}) {
    c.form = size;
    c.toml = steel + ball("-1.001*" + size + ", 0, 0", size + ", 0, 0", size, {{"mass", "1"}}) +
             ball("1.001*" + size + ", 0, 0", "-" + size + ", 0, 0", size, {{"mass", "1"}}) + moving("1e-5");
    c.steps = 1400;
    c.outcome = [size = std::stod(size)](const SceneTrial& t, StressRow& row) -> std::string {
      const double apart =
          t.own.approximate(BodyQuantity::velocity, 1, 0) - t.own.approximate(BodyQuantity::velocity, 0, 0);
      row.figures["restitution"] = apart / size / 2;
      return std::fabs(apart / size / 2 - 1) < 0.01 ? "" : "they do not come apart as they met";
    };
    list.push_back(c);
  }
}

void add_spins(std::vector<SceneCase>& list) {
  SceneCase c;
  c.name = "million_turns";
  c.title =
      "a ball slides along x on a wall and spins about the normal: friction must go against the sliding";
  const std::string rest = "4/3*pi*7800*9.81e-9/1e5";
  for (const std::string turns : {"0", "0.01", "1", "1e6"}) {
    c.form = turns + "_turns_a_step";
    c.toml = steel +
             ball("0, 1e-3-" + rest + ", 0", "0.1, 0, 0", "1e-3",
                  {{"angular_velocity", "0, 2*pi*" + turns + "/1e-6, 0"}}) +
             wall("0") + moving("1e-6", heavy);
    c.steps = 1000;
    c.known = {};
    if (turns == "1" || turns == "1e6")
      c.known = {
          {"all", StressVerdict::wrong_outcome,
           "The stored shear force is turned to first order by the spin of half a step about the normal, so "
           "it is no longer against the sliding: a property of the method, below a tenth of a turn a step."}};
    c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
      const double slowed = 0.1 - t.reference.approximate(BodyQuantity::velocity, 0, 0);
      const double aside = t.reference.approximate(BodyQuantity::velocity, 0, 2);
      row.figures["slowed_m_per_s"] = slowed;
      row.figures["turned_aside_m_per_s"] = aside;
      // mu g t.
      const double truth = std::tan(20 * std::acos(-1.0) / 180) * 9.81e-3;
      row.figures["slowed_over_truth"] = slowed / truth;
      if (std::fabs(aside) > 0.1 * truth || std::fabs(slowed / truth - 1) > 0.1)
        return fmt::format("slowed by {:.3g} and turned aside by {:.3g} of mu g t", slowed / truth,
                           aside / truth);
      return "";
    };
    list.push_back(c);
  }
}

// The list of pairs that may touch is made in double for every type.
void add_broad_phases(std::vector<SceneCase>& list) {
  SceneCase c;
  c.name = "broad_phase";
  c.title = "two balls of this many metres meet from 1.2 radii apart: the list of pairs must be made anew";
  for (const std::string size : {"1e-170", "1e-100", "1e100", "1e170"}) {
    c.form = "size_" + size;
    c.toml = steel + ball("-1.6*" + size + ", 0, 0", size + ", 0, 0", size, {{"mass", "1"}}) +
             ball("1.6*" + size + ", 0, 0", "-" + size + ", 0, 0", size, {{"mass", "1"}}) + moving("2e-3");
    c.steps = 360;
    const std::string outside =
        "Radii, or the squares of them, are outside the type: a property of the type.";
    c.known = {{"float", StressVerdict::refused, outside, "sphere[0].radius: must be "}};
    if (size == "1e-170" || size == "1e170")
      c.known.push_back({"double", StressVerdict::refused, outside, "moments of inertia must be positive"});
    c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
      const bool back = sign_of_velocity(t.own, 1) > 0;
      row.figures["came_apart"] = back ? 1 : 0;
      return back ? "" : "the balls pass through each other: their contact is never looked for";
    };
    list.push_back(c);
  }
  c.known = {};
  // Each overlaps the next by a tenth of the smaller one's radius.
  c.form = "sizes_2e-20_to_2e20";
  c.title = "41 balls in a row, each twice as large as the one before: every one touches its neighbour";
  c.toml = steel;
  double x = 0;
  for (int k = -20; k <= 20; ++k) {
    const double r = std::ldexp(1.0, k);
    if (k > -20) x += r + r / 2 - r / 20;
    c.toml += ball(exact_text(x) + ", 0, 0", "0, 0, 0", "0x1p" + std::to_string(k), {{"mass", "1"}});
  }
  c.toml += moving("1e-12");
  c.steps = 2;
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    row.figures["contacts"] = static_cast<double>(t.own.contacts().size());
    return t.own.contacts().size() == 40
               ? ""
               : std::to_string(t.own.contacts().size()) + " contacts instead of 40";
  };
  list.push_back(c);
  // A jump of a thousand sweeps lands in the other ball.
  c.form = "jump_of_a_thousand_radii";
  c.title = "a ball that moves a thousand radii a step is found in the other ball";
  c.toml = steel + ball("-1.0005, 0, 0", "1e6, 0, 0", "1e-3") + ball("0, 0, 0", "0, 0, 0", "1e-3") +
           moving("1e-6");
  c.steps = 2;
  c.outcome = [](const SceneTrial& t, StressRow&) -> std::string {
    return t.own.approximate(BodyQuantity::velocity, 1, 0) != 0 ? "" : "the contact is not found";
  };
  list.push_back(c);
}

// A ball dropped on the common edge of two coplanar facets, the same floor as a wall beside it.
void add_shared_edges(std::vector<SceneCase>& list) {
  for (const std::string floor : {"wall", "one_facet", "two_facets_edge", "two_facets_beside"}) {
    SceneCase c;
    c.name = "shared_edge";
    c.form = floor;
    c.title = "a ball bounces on a floor of " + floor + ": the time in contact is that of one plane";
    const std::string x = floor == "two_facets_beside" ? "1/16384" : "0";
    c.toml = steel + ball(x + ", 0.001+1e-6, 0", "0, -0.5, 0", "1e-3");
    if (floor == "wall") {
      c.toml += wall("0");
    } else if (floor == "one_facet") {
      c.toml += "[[facet]]\nvertices = [[-4, 0, -4], [4, 0, -4], [0, 0, 4]]\n";
    } else {
      c.toml += "[[facet]]\nvertices = [[0, 0, -1], [0, 0, 1], [1, 0, 0]]\n";
      c.toml += "[[facet]]\nvertices = [[0, 0, -1], [0, 0, 1], [-1, 0, 0]]\n";
    }
    c.toml += moving("1e-6");
    c.steps = 100;
    c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
      // In contact still: half an oscillation of one plane lasts pi sqrt(m/k), 57 us; deepest after 28 us.
      const double way = t.reference.approximate(BodyQuantity::position, 0, 1);
      const double omega = std::sqrt(1e5 / t.own.mass(0));
      const double left = 100e-6 - 2e-6 - std::acos(-1.0) / omega;
      const double truth = 1e-3 + 0.5 * left;
      row.figures["rise_over_truth"] = (way - 1e-3) / (truth - 1e-3);
      row.figures["velocity_aside_m_per_s"] = t.reference.approximate(BodyQuantity::velocity, 0, 0);
      const double ratio = (way - 1e-3) / (truth - 1e-3);
      const double aside = std::fabs(t.reference.approximate(BodyQuantity::velocity, 0, 0));
      if (std::fabs(ratio - 1) < 0.01 && aside < 1e-6) return "";
      return fmt::format("rises {:.3g} of the height of a plane's bounce, aside with {:.3g} m/s", ratio,
                         aside);
    };
    list.push_back(c);
  }
}

}  // namespace

std::vector<SceneCase> extreme_scenes() {
  std::vector<SceneCase> list;
  for (const std::string at : {"0", "1", "1e3", "1e7", "1e12"}) list.push_back(far_away(at));
  for (const std::string dt : {"1e-3", "1e-5", "1e-7", "1e-14"}) list.push_back(standing_still(dt));
  for (const std::string wall : {"0", "0.027", "14e6"}) list.push_back(resting(wall));
  add_overlaps(list);
  add_ratios(list);
  add_spins(list);
  add_shared_edges(list);
  add_broad_phases(list);
  return list;
}

}  // namespace ulpgate
