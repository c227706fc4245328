// Single contacts: restitution by the steps in a collision, Hertz at a mass ratio of 1e12, grazing impacts.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"

namespace ulpgate {

namespace {

using dem::BodyQuantity;
using namespace scene_text;

const double pi = std::acos(-1.0);

double velocity(const dem::DemEngine& e, std::size_t body, std::size_t axis) {
  return e.approximate(BodyQuantity::velocity, body, axis);
}

// Restitution of a linear spring and dashpot that never pulls, of a law made for `en` with tension.  T.
// Schwager & T. Poeschel, Granular Matter 9 (2007) 465: the contact ends where k u + c u' = 0.
double restitution_without_tension(double en) {
  const double log_en = -std::log(en);
  const double zeta = log_en / std::sqrt(pi * pi + log_en * log_en);
  const double w = std::sqrt(1 - zeta * zeta);
  const double phase = std::atan2(2 * zeta * w, 1 - 2 * zeta * zeta);
  return std::exp(-zeta / w * (pi - phase));
}

// Two equal balls head on, 1 m/s each, collision time 1e-3 s in `ratio` steps.
SceneCase head_on(int ratio, const std::string& en) {
  SceneCase c;
  c.name = "viscoelastic_contact";
  c.form = "en_" + en + "_tc_over_dt_" + std::to_string(ratio);
  c.title = "two balls head on in " + std::to_string(ratio) +
            " steps a contact: restitution against that of a contact that never pulls";
  const std::string parts = "/" + std::to_string(ratio);
  c.toml = head_on_balls(en, "-0.01", "0.01+0.6e-3" + parts) + run("1e-3" + parts);
  c.steps = static_cast<std::uint64_t>(2 * ratio + 6);
  if (ratio <= (en == "0.5" ? 2 : 5))
    c.known = {
        {"all", StressVerdict::wrong_outcome,
         "The step is at or above the largest stable one of dashpot forces from velocities half a step "
         "old, z = 2 (sqrt(1 + zeta^2) - zeta): a property of the method."}};
  c.outcome = [en = std::stod(en)](const SceneTrial& t, StressRow& row) -> std::string {
    const auto measured = [](const dem::DemEngine& e) { return (velocity(e, 1, 0) - velocity(e, 0, 0)) / 2; };
    const double truth = restitution_without_tension(en);
    row.stepping_error = std::fabs(measured(t.reference) - truth) / truth;
    row.figures["restitution"] = measured(t.own);
    row.figures["restitution_without_tension"] = truth;
    row.figures["restitution_with_tension"] = en;
    return std::fabs(measured(t.reference)) > 1 + 1e-9
               ? fmt::format("the collision creates energy: restitution {:.3g}", measured(t.reference))
               : "";
  };
  return c;
}

// A grain of 1e-6 kg on a ball of 1e6 kg.
SceneCase hertz_mass_ratio() {
  SceneCase c;
  c.name = "hertz_contact";
  c.form = "mass_ratio_1e12";
  c.title = "a Hertz contact of 1e-6 kg with 1e6 kg: the light one comes back as fast, in the time of theory";
  c.toml = begin("hertz", "steel", {{"young", "1e9"}, {"poisson", "0"}}) +
           sphere("-0.01-1e-6, 0, 0", "0.01", {{"velocity", "1, 0, 0"}, {"mass", "1e-6"}}) +
           sphere("0.01, 0, 0", "0.01", {{"mass", "1e6"}}) + contacts("hertz_mindlin") + run("1e-7");
  c.steps = 160;
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double after = velocity(t.reference, 0, 0);
    row.stepping_error = std::fabs(after + 1);
    row.figures["restitution"] = -velocity(t.own, 0, 0);
    // 2.868 (m^2/(R E*^2 v))^(1/5), R = 0.005 m, E* = E/2: H. Hertz (1881).
    row.figures["contact_time_s"] = 2.868265699195331 * std::pow(1e-12 / (0.005 * 0.25e18), 0.2);
    return t.own.contacts().empty() ? "" : "still in contact after twice the time of theory";
  };
  return c;
}

// A ball that meets a wall at an angle to it, spinning or not; friction 0.5.
SceneCase grazing(const std::string& law, const std::string& form, const std::string& vx,
                  const std::string& vy, const std::string& wz,
                  const std::string& friction = "26.56505117707799") {
  SceneCase c;
  c.name = "grazing_impact_" + law;
  c.form = form;
  c.title = "a ball meets a wall with velocity (" + vx + ", " + vy + ") and spin " + wz +
            ": the impact must not create energy";
  c.toml = begin("grazing", "ball",
                 {{"density", "2500"},
                  {"young", law == "hertz_mindlin" ? "1e9" : "1e7"},
                  {"poisson", "0.3"},
                  {"friction_angle", friction},
                  {"collision_time", "5e-4"}}) +
           sphere("0, 0.01+1e-7, 0", "0.01",
                  {{"velocity", vx + ", " + vy + ", 0"}, {"angular_velocity", "0, 0, " + wz}}) +
           wall("0") + contacts(law) + run("1e-6");
  c.steps = 1200;
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double ratio = t.reference.kinetic_energy() / t.kinetic_start;
    row.figures["kinetic_energy_over_start_reference"] = ratio;
    if (!t.own.contacts().empty()) return "still in contact";
    // The leapfrog's own energy error is of the second order: 1e-4 is far above it here.
    return ratio > 1 + 1e-4 ? fmt::format("the impact creates energy: {:.3g} of that before it", ratio) : "";
  };
  return c;
}

// A ball in the middle of twelve fixed ones of closest packing, pressed by all, pushed a little: their
// dashpots act on it together.
SceneCase packed(int ratio) {
  SceneCase c;
  c.name = "viscoelastic_packed";
  c.form = "en_3e-3_tc_over_dt_" + std::to_string(ratio);
  c.title = "a ball pressed by twelve others with restitution 3e-3, in steps of tc/" + std::to_string(ratio) +
            ": it must come to rest";
  c.toml = begin("packed", "ball",
                 {{"density", "2300"}, {"collision_time", "1e-3"}, {"restitution_normal", "3e-3"}});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::string a : {"", "-"}) {
      for (const std::string b : {"", "-"}) {
        std::array<std::string, 3> x{"0", "0", "0"};
        x[(axis + 1) % 3] = a + "0.0199/sqrt(2)";
        x[(axis + 2) % 3] = b + "0.0199/sqrt(2)";
        c.toml += sphere(x[0] + ", " + x[1] + ", " + x[2], "0.01", {{"fixed", "true"}});
      }
    }
  }
  c.toml += sphere("0, 0, 0", "0.01", {{"velocity", "1e-3, 2e-4, 0"}}) + contacts("viscoelastic") +
            run("1e-3/" + std::to_string(ratio));
  c.steps = static_cast<std::uint64_t>(4 * ratio);
  if (ratio <= 12)
    c.known = {
        {"all", StressVerdict::wrong_outcome,
         "Twelve springs and dashpots act on one ball: z and zeta are sqrt(2) times those of a pair, and the "
         "step that suits a pair is above the stable one; a property of the method."}};
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    const double ratio = t.reference.kinetic_energy() / t.kinetic_start;
    row.figures["kinetic_energy_over_start_reference"] = ratio;
    return ratio > 1 ? fmt::format("the ball has {:.3g} times the energy that it was given", ratio) : "";
  };
  return c;
}

// Two spinning balls meet off centre and part; nothing but the account knows where the energy went.
SceneCase accounted(const std::string& law, const std::string& young) {
  SceneCase c;
  c.name = "energy_account";
  c.form = law;
  c.title = "an oblique collision of two spinning balls: what is stored and lost must be what there was";
  c.toml = text_of({law, young, "35", "0.010468"}, "account");
  c.steps = 1000;
  if (law == "hertz_mindlin")
    c.known = {
        {"all", StressVerdict::wrong_outcome,
         "The shear spring's stiffness follows the overlap while its force stays: what it stores changes "
         "without "
         "any work, which the account does not book; a property of the law, 0.8 % of the energy here."}};
  c.outcome = [](const SceneTrial& t, StressRow& row) -> std::string {
    if (!t.own.contacts().empty()) return "still in contact";
    const double drift = t.reference.energy("sum") / t.kinetic_start - 1;
    row.figures["sum_over_start_minus_1"] = drift;
    row.figures["friction_over_start"] = t.reference.energy("friction") / t.kinetic_start;
    // The ratchet-free velocity that shear springs see differs from the true one by overlap/radius.
    return std::fabs(drift) < 2e-3 ? "" : fmt::format("the account is off by {:.3g} of the energy", drift);
  };
  return c;
}

}  // namespace

std::vector<SceneCase> contact_scenes() {
  std::vector<SceneCase> list;
  for (const int ratio : {100, 50, 20, 10, 5, 4, 3, 2}) list.push_back(head_on(ratio, "0.5"));
  for (const int ratio : {100, 10, 5, 3}) list.push_back(head_on(ratio, "3e-3"));
  for (const int ratio : {40, 20, 15, 12, 10}) list.push_back(packed(ratio));
  list.push_back(hertz_mass_ratio());
  list.push_back(accounted("frictional", "1e8"));
  list.push_back(accounted("hertz_mindlin", "1e9"));
  list.push_back(accounted("viscoelastic", "1e8"));
  for (const std::string law : {"frictional", "hertz_mindlin", "viscoelastic"}) {
    list.push_back(grazing(law, "5_degrees", "1", "-0.0875", "0"));
    list.push_back(grazing(law, "45_degrees", "0.3", "-0.3", "0"));
    list.push_back(grazing(law, "backspin", "0.05", "-0.3", "60"));
    list.push_back(grazing(law, "sticking", "0.1", "-0.3", "0", "70"));
  }
  return list;
}

}  // namespace ulpgate
