// How many steps a scene's times are: type-independent, so that every type takes the same steps.
#pragma once

#include <cstdint>
#include <string_view>

#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::scenes {

// What more steps than can be counted are counted as.
inline constexpr std::uint64_t countless_steps = std::uint64_t{1} << 60U;

// The number of steps of scene.dt nearest to `seconds` (an expression with the scene's constants), 0 at
// least.  Throws ExpressionError on malformed text, and SceneFault where dt is not positive or either is not
// finite: the constants in them may have been changed since the scene was read.
[[nodiscard]] std::uint64_t steps_for(const Scene& scene, std::string_view seconds);

// Steps from the start to scene.until.
[[nodiscard]] std::uint64_t steps_until_end(const Scene& scene);

// Steps between two records; 0 where the scene records at its end only.  Throws a SceneFault where the time
// between them is less than half a step.
[[nodiscard]] std::uint64_t steps_between_records(const Scene& scene);

}  // namespace ulpgate::scenes
