// Stages of the reference: what a sample is held against.
#pragma once

#include <array>
#include <string_view>

namespace ulpgate {

// References in the order of their cost.  A sample is decided by the first at which no statistic can depend
// on what the reference leaves open.
enum class Stage { binary64, x87_extended, double_double, binary128, triple_double, mpfr, full };
inline constexpr std::array<std::string_view, 7> stage_names = {
    "binary64", "x87_extended", "double_double", "binary128", "triple_double", "mpfr", "full"};
inline constexpr std::size_t stage_count = stage_names.size();
[[nodiscard]] inline std::string_view name_of(Stage s) {
  return stage_names[static_cast<std::size_t>(s)];
}

// What results are held against; the records are the same for both.
enum class ReferenceMode {
  screened,  // cheap stages decide what they can, the rest climbs
  full,      // the precision of RealHP<4> for every sample
};

}  // namespace ulpgate
