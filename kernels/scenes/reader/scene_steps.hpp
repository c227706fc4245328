// How many steps a scene's times are: type-independent, so that every type takes the same steps.
#pragma once

#include <cstdint>
#include <string_view>

#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::scenes {

// The number of steps of scene.dt nearest to `seconds` (an expression with the scene's constants), 0 at
// least.  Throws ExpressionError on malformed text.
[[nodiscard]] std::uint64_t steps_for(const Scene& scene, std::string_view seconds);

// Steps from the start to scene.until.
[[nodiscard]] std::uint64_t steps_until_end(const Scene& scene);

// Steps between two records; 0 where the scene records at its end only.
[[nodiscard]] std::uint64_t steps_between_records(const Scene& scene);

}  // namespace ulpgate::scenes
