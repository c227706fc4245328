// The table of DEM kernels, from kernels.def.
#include "kernels/dem/kernel_info.hpp"

#include <array>
#include <vector>

namespace ulpgate::dem {

namespace {

#define IN(name, role, components) InputQuantity{#name, Role::role, components},
#define OUT(name, components)
#define KERNEL(name, in, out) constexpr auto inputs_of_##name = std::to_array<InputQuantity>({in});
#include "kernels/dem/kernels.def"
#undef KERNEL
#undef IN
#undef OUT

#define IN(name, role, components)
#define OUT(name, components) OutputQuantity{#name, components},
#define KERNEL(name, in, out) constexpr auto outputs_of_##name = std::to_array<OutputQuantity>({out});
#include "kernels/dem/kernels.def"
#undef KERNEL
#undef IN
#undef OUT

template <class Quantities>
constexpr int size_of(const Quantities& quantities) {
  int size = 0;
  for (const auto& q : quantities) size += q.components;
  return size;
}

}  // namespace

std::span<const KernelInfo> all_kernels() {
  static constexpr auto table = std::to_array<KernelInfo>({
#define KERNEL(name, in, out)           \
  KernelInfo{KernelId::name,            \
             #name,                     \
             inputs_of_##name,          \
             outputs_of_##name,         \
             size_of(inputs_of_##name), \
             size_of(outputs_of_##name)},
#include "kernels/dem/kernels.def"
#undef KERNEL
  });
  return table;
}

std::optional<KernelInfo> find_kernel(std::string_view name) {
  for (const KernelInfo& k : all_kernels()) {
    if (k.name == name) return k;
  }
  return std::nullopt;
}

std::string_view name_of(Role role) {
  constexpr auto names = std::to_array<std::string_view>({"position",
                                                          "coordinate",
                                                          "length",
                                                          "radius",
                                                          "arm",
                                                          "overlap",
                                                          "velocity",
                                                          "speed",
                                                          "angular_velocity",
                                                          "acceleration",
                                                          "unit_vector",
                                                          "orientation",
                                                          "angle",
                                                          "rotation",
                                                          "force",
                                                          "torque",
                                                          "angular_momentum",
                                                          "strength",
                                                          "mass",
                                                          "inertia",
                                                          "density",
                                                          "young",
                                                          "poisson",
                                                          "friction_angle",
                                                          "tan_friction",
                                                          "stiffness",
                                                          "viscosity",
                                                          "restitution",
                                                          "damping",
                                                          "time_step"});
  static_assert(names.size() == static_cast<std::size_t>(Role::time_step) + 1);
  return names[static_cast<std::size_t>(role)];
}

}  // namespace ulpgate::dem
