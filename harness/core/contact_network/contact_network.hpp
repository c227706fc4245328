// ContactNetwork: the contacts of a scene as springs and dashpots between rigid bodies, linearised where they
// stand, and the largest step at which the leapfrog is stable on them.
#pragma once

#include <array>
#include <vector>

#include "kernels/dem/engine/engine.hpp"

namespace ulpgate {

struct NetworkBody {
  bool fixed = false;
  double mass = 0;     // kg
  double inertia = 0;  // kg m^2; 0: it cannot turn
};

// From body 1 to body 2.
struct NetworkSpring {
  std::size_t first = 0, second = 0;
  std::array<double, 3> normal{};
  double arm1 = 0, arm2 = 0;              // m, from the centres to the contact; 0 of a flat body
  double kn = 0, ks = 0, cn = 0, cs = 0;  // N/m, N s/m
  double moment = 0;                      // N m/rad against relative turns, of a bond that bends and twists
};

struct ContactNetwork {
  std::vector<NetworkBody> bodies;
  std::vector<NetworkSpring> springs;
};

struct CriticalMode {
  double step = 0;  // s; 0: nothing limits it
  // What grows first: velocity and angular velocity of each body, the largest of m v^2 and I w^2 of a mass of
  // one body being 1 (m/s, rad/s).
  std::vector<std::array<double, 6>> shape;
};

// The contacts that exert a force in the engine's present state.  `walls` are the axes of its walls, by
// rising number of body, each with the direction (+1, -1) from the wall into the scene.  Contacts of Hertz
// and Mindlin have the slope of their force, 3/2 kn u^(1/2) and ks u^(1/2).  The turning of forces with the
// normals is left out: of relative size u/(2 r); and so are the moments of bonds, which the engine does not
// tell.
[[nodiscard]] ContactNetwork network_of(const dem::DemEngine& engine, scenes::ContactLaw law,
                                        const std::vector<std::array<int, 2>>& walls);

// The leapfrog with the velocities of half a step before, as in v += -dt M^-1 (K x + C v), x += dt v: stable
// as long as 4 M - 2 dt C - dt^2 K is positive definite, dt <= 2/omega_max where there is no damping and
// z <= 2 (sqrt(1 + zeta^2) - zeta) of one damped mode.
[[nodiscard]] CriticalMode critical_mode(const ContactNetwork& network);
// The largest circular frequency without the dashpots (rad/s), and the step that is stable with it, 2/omega;
// both 0 where no spring is.
[[nodiscard]] double largest_frequency(const ContactNetwork& network);
[[nodiscard]] double undamped_critical_step(const ContactNetwork& network);
// What holds for any network in any orientation, from the 6 by 6 blocks of single bodies alone: what a
// contact stores and dissipates is at most twice the sum of what the motions of its two ends alone would, so
// that 4 - 2 dt c - dt^2 k > 0 suffices, with k and c twice the largest eigenvalues of M_i^-1/2 K_ii M_i^-1/2
// and of the same of C; without dashpots dt <= sqrt 2 / sqrt(the largest).
[[nodiscard]] double block_bound_step(const ContactNetwork& network);

}  // namespace ulpgate
