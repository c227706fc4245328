// The scenes whose largest stable steps are measured, as models of the scene reader.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "harness/core/contact_network/contact_network.hpp"
#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate {

struct LimitScene {
  std::string name;                       // "cubic_turned_111"
  scenes::Scene scene;                    // at rest, in equilibrium; its dt is tiny
  std::vector<std::array<int, 2>> walls;  // axis and direction into the scene, as network_of() takes them
  double disturbance = 0;                 // m, the amplitude at which the motion is linear
  bool along_mode = false;  // the motion stays along the disturbance: nothing else is to be disturbed
};

// Three rods in a line down from a fixed node, the geometry and material of the scene pendulum3; stiffness of
// a rod: young (Pa) times 1e-3 m.
[[nodiscard]] LimitScene rod_pendulum(double young);
// A sphere that gravity presses into a wall by a tenth of its radius, by the visco-elastic law of this
// restitution.
[[nodiscard]] LimitScene sphere_on_wall(double restitution);
// The same by the law of Hertz and Mindlin, pressed in by a thousandth.
[[nodiscard]] LimitScene hertz_on_wall();
// By the frictional law without friction, away from the point by which the wall is given.
[[nodiscard]] LimitScene sphere_far_along_wall();
// Two free spheres that touch, bonded so that they may pull; poisson is ks/kn, 0: no shear.
[[nodiscard]] LimitScene free_pair(double poisson, const std::array<double, 3>& direction);
// Touching spheres, bonded so that nothing is pressed and yet nothing separates: the stiffness of a
// frictional packing at rest.  lattice: "chain" of 5, "cubic" of 3 by 3 by 3, "fcc" of 19.
[[nodiscard]] LimitScene bonded_packing(std::string_view lattice, double poisson, std::string_view turn);
// The turns of a packing: "aligned", "turned_45", "turned_111", "turned_any".
[[nodiscard]] const std::vector<std::string>& packing_turns();
// A cubic packing pressed between six walls, by the visco-elastic law with friction, as in the scene
// deposition.
[[nodiscard]] LimitScene boxed_packing(double restitution);

// Adds velocities of `amplitude` (m) times 2/step along the mode, and a tenth of that in other directions
// where the scene allows it.
void disturb(LimitScene& scene, const CriticalMode& mode, double amplitude);

}  // namespace ulpgate
