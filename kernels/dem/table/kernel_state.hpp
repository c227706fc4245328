// KernelState<Real>: the state of a pair of bodies and their contact, of which every kernel takes some
// fields.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// FIELD(name, kind); kinds are scalar, vector (3 components) and quaternion (w, x, y, z).  SI units
// throughout.
// clang-format off
#define ULPGATE_DEM_FIELDS(FIELD) \
  FIELD(x1, vector) FIELD(x2, vector) FIELD(r1, scalar) FIELD(r2, scalar) FIELD(v1, vector) \
  FIELD(v2, vector) FIELD(w1, vector) FIELD(w2, vector) FIELD(q1, quaternion) FIELD(q2, quaternion) \
  FIELD(q1_start, quaternion) FIELD(q2_start, quaternion) FIELD(normal, vector) FIELD(normal_old, vector) FIELD(overlap, scalar) \
  FIELD(rest_overlap, scalar) FIELD(shear, vector) FIELD(velocity, vector) FIELD(closing_speed, scalar) \
  FIELD(arm1, vector) FIELD(arm2, vector) FIELD(force, vector) FIELD(torque, vector) \
  FIELD(mass1, scalar) FIELD(mass2, scalar) FIELD(inertia1, scalar) FIELD(principal_inertia, vector) \
  FIELD(angular_momentum, vector) FIELD(dt, scalar) FIELD(young1, scalar) FIELD(young2, scalar) \
  FIELD(poisson1, scalar) FIELD(poisson2, scalar) FIELD(friction1, scalar) FIELD(friction2, scalar) \
  FIELD(density, scalar) FIELD(kn, scalar) FIELD(ks, scalar) FIELD(cn, scalar) FIELD(cs, scalar) \
  FIELD(tan_friction, scalar) FIELD(adhesion, scalar) FIELD(bending_stiffness, scalar) \
  FIELD(gravity, vector) FIELD(damping, scalar) FIELD(sweep, scalar) FIELD(collision_time, scalar) \
  FIELD(restitution_n, scalar) FIELD(restitution_t, scalar) FIELD(facet_a, vector) \
  FIELD(facet_b, vector) FIELD(facet_c, vector) FIELD(half_size, vector)
// clang-format on

enum class Field {
#define FIELD(name, kind) name,
  ULPGATE_DEM_FIELDS(FIELD)
#undef FIELD
};

template <RealType Real>
struct KernelState {
  using scalar = Real;
  using vector = Vec3<Real>;
  using quaternion = Quaternion<Real>;
#define FIELD(name, kind) kind name;
  ULPGATE_DEM_FIELDS(FIELD)
#undef FIELD
};

namespace detail {
enum class FieldKind { scalar = 1, vector = 3, quaternion = 4 };
struct FieldInfo {
  std::string_view name;
  FieldKind kind;
};
inline constexpr std::array fields = {
#define FIELD(name, kind) FieldInfo{#name, FieldKind::kind},
    ULPGATE_DEM_FIELDS(FIELD)
#undef FIELD
};
}  // namespace detail

[[nodiscard]] constexpr std::size_t components_of(Field f) {
  return static_cast<std::size_t>(detail::fields[static_cast<std::size_t>(f)].kind);
}
[[nodiscard]] constexpr std::string_view name_of(Field f) {
  return detail::fields[static_cast<std::size_t>(f)].name;
}

// Calls visit(component) on every component of a field, in order.
template <class State, class Visit>
void each_component(State& s, Field f, Visit visit) {
  const auto scalar = [&](auto& value) { visit(value); };
  const auto vector = [&](auto& value) { visit(value.x), visit(value.y), visit(value.z); };
  const auto quaternion = [&](auto& value) {
    visit(value.w), visit(value.x), visit(value.y), visit(value.z);
  };
  switch (f) {
#define FIELD(name, kind) \
  case Field::name:       \
    kind(s.name);         \
    break;
    ULPGATE_DEM_FIELDS(FIELD)
#undef FIELD
  }
}

}  // namespace ulpgate::dem
