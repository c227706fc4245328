// What a scene takes in memory, estimated before any of it is taken.
#pragma once

#include <cstdint>
#include <string>

#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate::scenes {

// Bodies are numbered, and the ends of lists of pairs counted, in 32 bits.
inline constexpr std::uint64_t most_bodies = std::uint64_t{1} << 30U;
inline constexpr std::uint64_t most_pairs = std::uint64_t{1} << 29U;
// More needs to be asked for.
inline constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30U;

// Bytes of a pair that may touch, or that a bond joins, with all parts: 19 numbers of its own and 4 of a
// bond.
template <RealType Real>
inline constexpr std::uint64_t bytes_of_pair = 23 * sizeof(Real) + 64;
// Bytes of a body while a scene is loaded, which has it twice, with all parts; dense packings have some six
// contacts a body.
template <RealType Real>
inline constexpr std::uint64_t bytes_of_body = 61 * sizeof(Real) + 256 + 6 * bytes_of_pair<Real>;

// Throws SceneTooLarge: "generator[0]: 1000000000 bodies take about 1850 GB, more than 4.3 GB"; `count` may
// itself be more than can be numbered.
void refuse_large(const std::string& what, std::uint64_t count, std::uint64_t most, std::uint64_t bytes_each,
                  bool allow_large);

// The most pairs that a simulation may hold.
template <RealType Real>
[[nodiscard]] constexpr std::uint64_t pairs_allowed(bool allow_large) {
  return allow_large ? most_pairs : most_bytes / bytes_of_pair<Real>;
}

}  // namespace ulpgate::scenes
