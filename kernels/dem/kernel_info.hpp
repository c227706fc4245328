// KernelInfo: the facts about a DEM kernel that stand in its row of kernels.def.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace ulpgate::dem {

enum class KernelId : int {
#define KERNEL(name, inputs, outputs) name,
#include "kernels/dem/kernels.def"
#undef KERNEL
};

// What an input is, so that a generator draws a state that can occur.  SI units.
enum class Role {
  position,          // m, any sign
  coordinate,        // m, one axis
  length,            // m, > 0
  radius,            // m, > 0
  arm,               // m, vector from a centre to a contact
  overlap,           // m, any sign; small against a radius
  velocity,          // m/s
  speed,             // m/s, one axis, any sign
  angular_velocity,  // rad/s
  acceleration,      // m/s^2
  unit_vector,       // length 1 to rounding
  orientation,       // quaternion w, x, y, z of length 1 to rounding
  angle,             // rad, (-pi, pi]
  rotation,          // rad, vector shorter than pi
  force,             // N
  torque,            // N m
  angular_momentum,  // kg m^2/s
  strength,          // N, >= 0
  mass,              // kg, > 0
  inertia,           // kg m^2, > 0
  density,           // kg/m^3, > 0
  young,             // Pa, > 0
  poisson,           // [0, 1/2)
  friction_angle,    // rad, [0, pi/2)
  tan_friction,      // >= 0
  stiffness,         // N/m, > 0
  viscosity,         // N s/m, >= 0
  restitution,       // (0, 1]
  damping,           // [0, 1)
  time_step,         // s, > 0
};

struct InputQuantity {
  std::string_view name;
  Role role;
  int components;
};

struct OutputQuantity {
  std::string_view name;
  int components;
};

struct KernelInfo {
  KernelId id;
  std::string_view name;
  std::span<const InputQuantity> inputs;
  std::span<const OutputQuantity> outputs;
  int input_size;   // numbers in a state: the components of all inputs, in this order
  int output_size;  // numbers in a result
};

[[nodiscard]] std::span<const KernelInfo> all_kernels();
[[nodiscard]] std::optional<KernelInfo> find_kernel(std::string_view name);
[[nodiscard]] inline const KernelInfo& info_of(KernelId id) {
  return all_kernels()[static_cast<std::size_t>(id)];
}
[[nodiscard]] std::string_view name_of(Role role);

}  // namespace ulpgate::dem
