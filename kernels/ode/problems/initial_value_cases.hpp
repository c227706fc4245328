// The list of stiff problems, orbits and chaos: initial value problems without a closed form, but for one.
#pragma once

#include "kernels/ode/problems/orbit_cases.hpp"
#include "kernels/ode/problems/stiff_cases.hpp"

namespace ulpgate::ode {

// Made anew by each call; the order of the list is that of every report.
template <RealType Real>
[[nodiscard]] std::vector<InitialValueCase<Real>> initial_value_cases() {
  using namespace detail;
  std::vector<InitialValueCase<Real>> list{
      robertson<Real>(), van_der_pol<Real>(), hires<Real>(), oregonator<Real>(), e5<Real>(), chemakzo<Real>(),
      pleiades<Real>(), arenstorf<Real>(),
      // E = 0.13, a regular orbit, and E = 0.1247, a chaotic one.
      henon_heiles<Real>("henon_heiles", read_all<Real>({"0.1", "0"}), read_all<Real>({"0", "0.5"})),
      henon_heiles<Real>("henon_heiles_chaotic", read_all<Real>({"0", "-0.25"}),
                         read_all<Real>({"0.42", "0"})),
      fput<Real>(), stiff_pendulum<Real>(100), stiff_pendulum<Real>(1000), kepler_099<Real>(),
      outer_solar_system<Real>()};
  return list;
}

}  // namespace ulpgate::ode
