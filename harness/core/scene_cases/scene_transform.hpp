// SceneTransform: a scene moved, scaled, turned, mirrored, renumbered or cut into other facets, and the way
// back.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "harness/core/scene_cases/scene_trial.hpp"

namespace ulpgate {

// A linear map of space with small integers over one of them, x' = (M x)/divisor + shift: exact in binary
// where the divisor is 1.
struct SpaceMap {
  std::array<std::array<int, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  int divisor = 1;
  std::array<std::string, 3> shift{"0", "0", "0"};

  [[nodiscard]] bool mirrors() const;  // the determinant is negative: turns change their sense
};

// Powers of two by which lengths, masses and times grow.
struct UnitScale {
  int length = 0;
  int mass = 0;
  int time = 0;
};

struct SceneTransform {
  SpaceMap map{};
  UnitScale scale{};
  bool renumber = false;  // the spheres of the scene in the opposite order

  // Throws std::invalid_argument where the scene has what the transform does not know: generators under
  // renumbering, walls that would no longer lie across an axis.
  [[nodiscard]] scenes::Scene apply(scenes::Scene scene) const;
  // The number of a body in the transformed scene.
  [[nodiscard]] std::size_t body(const scenes::Scene& scene, std::size_t i) const;
};

// How two engines' states differ, of which `moved` runs the transformed scene.
struct TransformedDistance {
  double distance = 0;  // state_distance of what is mapped, in the units of the moved scene
  std::string first;    // "the velocity of body 1"; empty: the same numbers
};
[[nodiscard]] TransformedDistance compare_transformed(const dem::DemEngine& base, const dem::DemEngine& moved,
                                                      const scenes::Scene& scene,
                                                      const SceneTransform& transform);

}  // namespace ulpgate
