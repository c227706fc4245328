// Strata: the named ways of drawing the arguments of functions and the states of kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace ulpgate {

// What each is stands in the tables below; uniform and stratified are of functions and of kernels.
enum class Stratum {
  worst,
  uniform,
  stratified,
  binades,
  edges,
  hard,
  narrow,
  exhaustive,
  typical,
  grazing,
  touching,
  deep,
  ratio,
  far,
  slow,
  parallel,
  cone,
};

struct StratumInfo {
  Stratum id;
  std::string_view name;
  std::string_view description;
};

inline constexpr std::array<StratumInfo, 8> function_strata = {{
    {Stratum::worst, "worst", "known worst cases from ci/worst_cases, replayed first"},
    {Stratum::uniform, "uniform", "random on (-100, 100), mapped to the domain once"},
    {Stratum::stratified, "stratified",
     "equidistant cells on (-100, 100), one random point each, mapped once"},
    {Stratum::binades, "binades", "every exponent that the domain allows, random significands, both signs"},
    {Stratum::edges, "edges", "zeros, infinities, NaN, extremes, 1, integers, halves, poles and neighbours"},
    {Stratum::hard, "hard", "nearest to multiples of pi/2, zeros, over- and underflow; powers near 1"},
    {Stratum::narrow, "narrow",
     "the most suspicious of each block of thousands, by a cheap reference; float and double, real "
     "functions; "
     "not part of `all`"},
    {Stratum::exhaustive, "exhaustive",
     "all 2^32 values of float, real functions of one argument; a proof; not part of `all`"},
}};

inline constexpr std::array<StratumInfo, 11> kernel_strata = {{
    {Stratum::uniform, "uniform", "everything drawn independently over wide ranges"},
    {Stratum::stratified, "stratified", "as uniform, every number equidistributed over cells"},
    {Stratum::typical, "typical", "small overlaps, moderate speeds: what a simulation is made of"},
    {Stratum::grazing, "grazing", "relative velocity almost across the normal"},
    {Stratum::touching, "touching", "overlaps down to the last bit of the radii"},
    {Stratum::deep, "deep", "overlaps up to 0.9 of the smaller radius"},
    {Stratum::ratio, "ratio", "radii up to 2^40 (1e12) apart"},
    {Stratum::far, "far", "positions up to 2^40 from the origin"},
    {Stratum::slow, "slow", "velocities and rotations down to 2^-60"},
    {Stratum::parallel, "parallel", "normals and orientations that hardly turn"},
    {Stratum::cone, "cone", "shear force on the friction cone, no slip in the step"},
}};

[[nodiscard]] constexpr std::optional<Stratum> find_stratum(std::string_view name,
                                                            std::span<const StratumInfo> among) {
  const auto* it = std::ranges::find(among.data(), among.data() + among.size(), name, &StratumInfo::name);
  return it == among.data() + among.size() ? std::nullopt : std::optional(it->id);
}
// Among all of them: one name is one stratum.
[[nodiscard]] constexpr std::optional<Stratum> find_stratum(std::string_view name) {
  const auto found = find_stratum(name, function_strata);
  return found ? found : find_stratum(name, kernel_strata);
}

[[nodiscard]] constexpr std::string_view name_of(Stratum s) {
  const auto* it = std::ranges::find(function_strata, s, &StratumInfo::id);
  if (it != function_strata.end()) return it->name;
  return std::ranges::find(kernel_strata, s, &StratumInfo::id)->name;
}

// A drawn stratum grows with --samples; a listed one has the size of its list, the exhaustive one that of the
// type.
[[nodiscard]] constexpr bool is_listed(Stratum s) {
  return s == Stratum::worst || s == Stratum::edges || s == Stratum::hard;
}
[[nodiscard]] constexpr bool is_drawn(Stratum s) {
  return !is_listed(s) && s != Stratum::exhaustive;
}

// Runs of their own, which `all` does not mean.
[[nodiscard]] constexpr bool is_asked_for_by_name(Stratum s) {
  return s == Stratum::narrow || s == Stratum::exhaustive;
}

// Every bit pattern of float, each once.
inline constexpr std::uint64_t exhaustive_count = std::uint64_t{1} << 32U;

}  // namespace ulpgate
