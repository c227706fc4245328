// MeshTopology: which corners of a scene's facets are one point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::dem {

struct MeshTopology {
  // Of each facet, in the order of the bodies' numbers, the numbers of its corners a, b, c: equal where the
  // corners are one point.  Empty where no two facets have a corner in common.
  std::vector<std::array<std::int32_t, 3>> corners;
};

// Two corners are one point where their coordinates are equal in 150 digits: what the text of the scene says,
// alike in every type of a run.  For a scene that scenes::assemble has accepted in some type.
[[nodiscard]] MeshTopology mesh_topology(const scenes::Scene& scene);

}  // namespace ulpgate::dem
