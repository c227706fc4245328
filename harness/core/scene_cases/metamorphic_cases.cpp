// Scenes that are run again transformed: the same bytes after mapping back, or within the condition.
#include <algorithm>
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_cases.hpp"
#include "harness/core/scene_cases/scene_transform.hpp"
#include "harness/core/scenes/scene_compare.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate {

namespace {

using dem::DemEngine;

// A transformation, and what it must leave as it is.
struct MetamorphicTransform {
  std::string name;
  std::string title;
  SceneTransform transform;
  // Why rounding may differ; empty: the same bytes are owed.
  std::string reason;
  // Energies stay as they are but for the scale (a shift changes the potential).
  bool keeps_energy = true;
};

SpaceMap map_of(std::array<std::array<int, 3>, 3> m, int divisor = 1) {
  SpaceMap map;
  map.m = m;
  map.divisor = divisor;
  return map;
}

const std::string axis_sums =
    "sums over the axes run x, y, z, and two of the three change places with the third";
const std::string pair_sums =
    "a body's forces are summed in the order of the bodies' numbers, and so are the two spins of a contact";

std::vector<MetamorphicTransform> transforms() {
  std::vector<MetamorphicTransform> list;
  const auto add = [&](const std::string& name, const std::string& title, SceneTransform t,
                       const std::string& reason) {
    list.push_back({name, title, std::move(t), reason});
  };
  add("scaled", "lengths by 2^4, masses by 2^6, times by 2^-2", {.scale = {4, 6, -2}}, "");
  add("scaled_far", "lengths by 2^-36, masses by 2^-40, times by 2^-30", {.scale = {-36, -40, -30}}, "");
  add("turned_90_z", "a quarter turn about z", {.map = map_of({{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}})}, "");
  add("turned_90_x", "a quarter turn about x", {.map = map_of({{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}})},
      axis_sums);
  add("turned_90_y", "a quarter turn about y", {.map = map_of({{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}})},
      axis_sums);
  add("mirrored_x", "x reversed", {.map = map_of({{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})}, "");
  add("mirrored_y", "y reversed", {.map = map_of({{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}})}, "");
  add("mirrored_z", "z reversed", {.map = map_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}})}, "");
  add("renumbered", "the spheres in the opposite order", {.renumber = true}, pair_sums);
  add("rotated", "turned by 70.5 degrees about an oblique axis, all components thirds",
      {.map = map_of({{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}}, 3)}, "a general turn rounds every coordinate");
  add("rotated_again", "turned by the integers of 2^2 + 3^2 + 6^2 = 7^2",
      {.map = map_of({{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}}, 7)}, "a general turn rounds every coordinate");
  SceneTransform shifted;
  shifted.map.shift = {"8", "-16", "32"};
  add("translated", "moved by (8, -16, 32)", shifted, "positions round to other ulps");
  list.back().keeps_energy = false;
  return list;
}

// "the energy `friction`" where an account differs by more than `allowed` of its largest entry; empty:
// nothing.
std::string differing_energy(const DemEngine& base, const DemEngine& moved, const UnitScale& scale,
                             double allowed) {
  double largest = 0;
  for (const auto& name : base.energy_names()) largest = std::max(largest, std::fabs(base.energy(name)));
  for (const auto& name : base.energy_names()) {
    const double want = std::ldexp(base.energy(name), scale.mass + 2 * scale.length - 2 * scale.time);
    const double size = std::ldexp(largest, scale.mass + 2 * scale.length - 2 * scale.time);
    if (!(std::fabs(moved.energy(name) - want) <= allowed * size)) return "the energy '" + name + "'";
  }
  return "";
}

std::string differing_step(const DemEngine& base, const DemEngine& moved, int time) {
  for (const char* rule : {"p_wave", "rayleigh", "stiffness"}) {
    const dem::CriticalStep first = base.critical_step(rule);
    const dem::CriticalStep second = moved.critical_step(rule);
    if (second.step_s != std::ldexp(first.step_s, time) || second.refusal != first.refusal)
      return std::string("the critical step '") + rule + "'";
  }
  return "";
}

StressRow run_transformed(const MetamorphicScene& s, const MetamorphicTransform& t, std::string_view token,
                          const ode::StopFlag& stop) {
  StressRow row;
  const double u = unit_roundoff(find_type(token)->significand_bits);
  const scenes::Scene scene = scene_of(s.toml);
  std::unique_ptr<DemEngine> base;
  std::unique_ptr<DemEngine> moved;
  try {
    base = dem::make_engine(token, dem::Level::own, scene, {});
    moved = dem::make_engine(token, dem::Level::own, t.transform.apply(scene), {});
  } catch (const scenes::SceneFault& fault) {
    row.why = fault.what();
    return row;
  }
  const bool bytes = t.reason.empty();
  TransformedDistance d;
  std::string difference;
  std::uint64_t differs_at = 0;
  for (const std::uint64_t at : comparison_steps(s.steps)) {
    stop.check();
    base->step(at - base->iteration());
    moved->step(at - moved->iteration());
    d = compare_transformed(*base, *moved, scene, t.transform);
    std::string found = d.first;
    if (found.empty() && t.keeps_energy) found = differing_energy(*base, *moved, t.transform.scale, 0);
    if (found.empty() && bytes) found = differing_step(*base, *moved, t.transform.scale.time);
    if (!found.empty() && difference.empty()) {
      difference = found;
      differs_at = at;
    }
  }
  row.error = d.distance;
  row.figures["same_bytes"] = difference.empty() ? 1 : 0;
  row.figures["contacts"] = static_cast<double>(base->contacts().size());
  row.verdict = judge_stress(d.distance, 1, u);
  if (!difference.empty()) {
    row.first_wrong = "step " + std::to_string(differs_at);
    // Of the transformed scene: far from the origin positions round to larger ulps.
    row.condition = trajectory_condition(token, t.transform.apply(scene), s.steps, 4, stop);
    row.verdict = judge_stress(d.distance, *row.condition, u);
    if (!std::isfinite(*row.condition)) row.condition.reset();
    if (bytes) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = difference + " differs, where the same bytes are owed";
    } else {
      row.why = difference + " differs first: " + t.reason;
      if (row.verdict != StressVerdict::unstable) row.first_wrong.clear();
    }
  }
  // Beyond the condition's own allowance an energy account that differs is another physics.
  if (row.verdict != StressVerdict::wrong_outcome && t.keeps_energy) {
    const double allowed = 16 * u * std::max(1.0, row.condition.value_or(HUGE_VAL)) + 64 * u;
    if (const auto name = differing_energy(*base, *moved, t.transform.scale, allowed); !name.empty()) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = name + " differs by more than the condition lets it";
    }
  }
  const double most = std::log10(2.0) * find_type(token)->significand_bits;
  row.correct_digits = d.distance > 0 ? std::clamp(-std::log10(d.distance), 0.0, most) : most;
  if (!std::isfinite(*row.error)) row.error.reset();
  return row;
}

bool applies(const MetamorphicScene& s, const MetamorphicTransform& t) {
  const scenes::Scene scene = scene_of(s.toml);
  if (t.transform.renumber && (scene.spheres.size() < 2 || !scene.bonds.empty())) return false;
  // A wall lies across an axis.
  return scene.walls.empty() || t.transform.map.divisor == 1;
}

}  // namespace

std::vector<StressCase> metamorphic_cases() {
  std::vector<StressCase> cases;
  for (const auto& s : metamorphic_scenes()) {
    for (auto t : transforms()) {
      if (!applies(s, t)) continue;
      if (t.name == "renumbered" && s.same_when_renumbered) t.reason.clear();
      if (t.name == "translated" && s.same_when_translated) t.reason.clear();
      StressCase c;
      c.kind = "metamorphic";
      c.name = t.name;
      c.form = s.name;
      c.title =
          s.title + ": " + t.title +
          (t.reason.empty() ? "; the same bytes are owed" : "; within the condition, because " + t.reason);
      c.cost = 2e-5 * static_cast<double>(s.steps);
      for (const auto& k : s.known) {
        if (k.transform.empty() || k.transform == t.name) c.known.push_back(k.verdict);
      }
      c.run = [s, t](std::string_view token, const ode::StopFlag& stop) -> std::optional<StressRow> {
        if (find_type(token) == nullptr) return std::nullopt;
        return run_transformed(s, t, token, stop);
      };
      cases.push_back(std::move(c));
    }
  }
  for (auto& c : triangulation_cases()) cases.push_back(std::move(c));
  for (auto& c : critical_step_cases()) cases.push_back(std::move(c));
  return cases;
}

}  // namespace ulpgate
