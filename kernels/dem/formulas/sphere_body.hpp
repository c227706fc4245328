// Mass, density and moment of inertia of a solid sphere.
#pragma once

#include <boost/math/constants/constants.hpp>

#include "reference/types/real_types.hpp"

namespace ulpgate::dem {

// 4/3 pi r^3 rho (kg), multiplied left to right.
template <RealType Real>
[[nodiscard]] Real sphere_mass(const Real& radius, const Real& density) {
  const Real volume = Real(4) / 3 * boost::math::constants::pi<Real>() * radius * radius * radius;
  return volume * density;
}

// Of a solid sphere of this mass (kg/m^3); no power of the radius leaves the range of the type on the way.
template <RealType Real>
[[nodiscard]] Real sphere_density(const Real& mass, const Real& radius) {
  return mass / (Real(4) / 3 * boost::math::constants::pi<Real>()) / radius / radius / radius;
}

// 2/5 m r^2 (kg m^2).
template <RealType Real>
[[nodiscard]] Real sphere_inertia(const Real& mass, const Real& radius) {
  return 2 * mass * radius * radius / 5;
}

}  // namespace ulpgate::dem
