// Strata of DEM states: the named situations in which every kernel is tried.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace ulpgate {

enum class StateStratum {
  uniform,     // everything drawn independently over wide ranges
  stratified,  // the same, every number equidistributed over cells
  typical,     // small overlaps, moderate speeds: what a simulation is made of
  grazing,     // relative velocity almost across the normal
  touching,    // overlaps down to the last bit of the radii
  deep,        // overlaps up to 0.9 of the smaller radius
  ratio,       // radii up to 2^40 (1e12) apart
  far,         // positions up to 2^40 from the origin
  slow,        // velocities and rotations down to 2^-60
  parallel,    // normals and orientations that hardly turn
  cone,        // shear force on the friction cone, no slip in the step
};

struct StateStratumInfo {
  StateStratum id;
  std::string_view name;
  std::string_view description;
};

inline constexpr std::array<StateStratumInfo, 11> all_state_strata = {{
    {StateStratum::uniform, "uniform", "everything drawn independently over wide ranges"},
    {StateStratum::stratified, "stratified", "as uniform, every number equidistributed over cells"},
    {StateStratum::typical, "typical", "small overlaps, moderate speeds: what a simulation is made of"},
    {StateStratum::grazing, "grazing", "relative velocity almost across the normal"},
    {StateStratum::touching, "touching", "overlaps down to the last bit of the radii"},
    {StateStratum::deep, "deep", "overlaps up to 0.9 of the smaller radius"},
    {StateStratum::ratio, "ratio", "radii up to 2^40 (1e12) apart"},
    {StateStratum::far, "far", "positions up to 2^40 from the origin"},
    {StateStratum::slow, "slow", "velocities and rotations down to 2^-60"},
    {StateStratum::parallel, "parallel", "normals and orientations that hardly turn"},
    {StateStratum::cone, "cone", "shear force on the friction cone, no slip in the step"},
}};

[[nodiscard]] constexpr std::string_view name_of(StateStratum s) {
  return all_state_strata[static_cast<std::size_t>(s)].name;
}

[[nodiscard]] constexpr std::optional<StateStratum> find_state_stratum(std::string_view name) {
  for (const auto& s : all_state_strata) {
    if (s.name == name) return s.id;
  }
  return std::nullopt;
}

}  // namespace ulpgate
