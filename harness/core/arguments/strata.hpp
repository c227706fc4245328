// Strata: the named ways of drawing arguments.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ulpgate {

enum class Stratum {
  worst,       // known worst cases, kept as data and replayed first
  uniform,     // random on (-100, 100), then the domain map (the paper's first set)
  stratified,  // equidistant cells, one random point in each, then the domain map (the paper's second set)
  binades,     // every exponent of the type that the domain allows, random significands, both signs
  edges,  // zeros, infinities, NaN, least and greatest numbers, 1, integers, halves, poles and neighbours
  hard,   // structured: nearest to multiples of pi/2, to zeros, to over- and underflow, powers near 1
  exhaustive,  // every value of the type; float alone, functions of one argument; never part of "all"
};

struct StratumInfo {
  Stratum id;
  std::string_view name;
  std::string_view description;
};

inline constexpr std::array<StratumInfo, 7> all_strata = {{
    {Stratum::worst, "worst", "known worst cases from ci/worst_cases, replayed first"},
    {Stratum::uniform, "uniform", "random on (-100, 100), mapped to the domain once"},
    {Stratum::stratified, "stratified",
     "equidistant cells on (-100, 100), one random point each, mapped once"},
    {Stratum::binades, "binades", "every exponent that the domain allows, random significands, both signs"},
    {Stratum::edges, "edges", "zeros, infinities, NaN, extremes, 1, integers, halves, poles and neighbours"},
    {Stratum::hard, "hard", "nearest to multiples of pi/2, zeros, over- and underflow; powers near 1"},
    {Stratum::exhaustive, "exhaustive",
     "all 2^32 values of float, real functions of one argument; a proof; not part of `all`"},
}};

[[nodiscard]] constexpr std::string_view name_of(Stratum s) {
  return all_strata[static_cast<std::size_t>(s)].name;
}

[[nodiscard]] constexpr std::optional<Stratum> find_stratum(std::string_view name) {
  for (const auto& s : all_strata) {
    if (s.name == name) return s.id;
  }
  return std::nullopt;
}

// A drawn stratum grows with --samples; a listed one has the size of its list, the exhaustive one that of the
// type.
[[nodiscard]] constexpr bool is_drawn(Stratum s) {
  return s == Stratum::uniform || s == Stratum::stratified || s == Stratum::binades;
}

// Every bit pattern of float, each once.
inline constexpr std::uint64_t exhaustive_count = std::uint64_t{1} << 32U;

}  // namespace ulpgate
