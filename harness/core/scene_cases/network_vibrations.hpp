// The linear vibrations of a scene's contacts as they are now, assembled and solved in double.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "kernels/dem/engine/engine.hpp"

namespace ulpgate {

// One contact of two bodies, body 2 a sphere; its tangent stiffnesses.
struct ContactSpring {
  std::size_t first, second;
  Eigen::Vector3d normal;  // from first to second
  double kn = 0, ks = 0;   // N/m
  double cn = 0, cs = 0;   // N s/m
  double moment = 0;       // N m/rad, of a bond that bends and twists
};

// Mass, stiffness and damping of all movable bodies, three displacements and three turns each: M of
// displacements m, of turns 2/5 m r^2; a contact adds kn n n^T + ks (1 - n n^T) of the relative displacement
// of the two surfaces, u2 - u1 - (r2 t2 + r1 t1) x n, and a bond's moment that of the relative turn.
class NetworkVibrations {
 public:
  NetworkVibrations(const dem::DemEngine& engine, const std::vector<ContactSpring>& springs, bool rotation);

  // Largest circular frequency, rad/s.
  [[nodiscard]] double largest_frequency() const;
  // Largest step (s) at which the leapfrog with dashpot forces from velocities half a step old does not grow:
  // the spectral radius of x' = x + dt v', v' = v - dt M^-1 (K x + C v) is 1 at most.  By bisection from 0.
  [[nodiscard]] double largest_stable_step() const;

 private:
  Eigen::VectorXd mass_;
  Eigen::MatrixXd stiffness_, damping_;
};

// The contacts of an engine whose laws are linear: constants as the engine holds them, normals from the
// positions of spheres, or the axis `wall_axis` where body 1 is a wall.
[[nodiscard]] std::vector<ContactSpring> linear_springs(const dem::DemEngine& engine, int wall_axis = 1);

}  // namespace ulpgate
