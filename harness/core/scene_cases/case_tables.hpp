// The tables of states and scenes that state_cases(), scene_cases() and metamorphic_cases() put together.
#pragma once

#include <string>
#include <vector>

#include "harness/core/scene_cases/kernel_state_case.hpp"
#include "harness/core/scene_cases/scene_trial.hpp"

namespace ulpgate {

// States of kernels.
[[nodiscard]] std::vector<KernelStateCase> geometry_states();  // spheres, facets, walls and boxes
[[nodiscard]] std::vector<KernelStateCase> law_states();       // friction, dashpots, bonds, shear
[[nodiscard]] std::vector<KernelStateCase> motion_states();    // velocities, integration, energies
// A sphere on facets with common edges, as the engine has it.
[[nodiscard]] std::vector<StressCase> shared_edge_states();

// Scenes.
[[nodiscard]] std::vector<SceneCase> contact_scenes();  // restitution, duration, energy of single contacts
[[nodiscard]] std::vector<SceneCase> extreme_scenes();  // places, sizes, masses and spins at the ends

// A scene that is run again transformed.
struct MetamorphicScene {
  struct Known {
    std::string transform;  // empty: of all
    KnownVerdict verdict;
  };
  std::string name, title, toml;
  std::uint64_t steps = 1;
  bool same_when_renumbered = false;  // two bodies whose sums have two terms
  bool same_when_translated = false;  // positions and all that they come to are short binary numbers
  std::vector<Known> known{};
};
[[nodiscard]] std::vector<MetamorphicScene> metamorphic_scenes();

// Kind "metamorphic": a ball on a square floor, cut along one diagonal or the other, or in four, or with its
// corners in another order.
[[nodiscard]] std::vector<StressCase> triangulation_cases();
// Kind "metamorphic", name "critical_step": the step rules against the largest frequency of networks of
// contacts, in many orientations.
[[nodiscard]] std::vector<StressCase> critical_step_cases();

}  // namespace ulpgate
