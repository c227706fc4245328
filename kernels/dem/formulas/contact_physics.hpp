// Contact physics: the stiffnesses, viscosities and friction of a pair from materials, radii and masses.
#pragma once

#include <algorithm>
#include <boost/math/constants/constants.hpp>

#include "kernels/dem/formulas/vec3.hpp"

namespace ulpgate::dem {

// Everything a contact law reads; what a law does not use stays 0.
template <RealType Real>
struct ContactPhysics {
  Real kn{0};            // N/m; Hertz-Mindlin: N/m^(3/2)
  Real ks{0};            // N/m; Hertz-Mindlin: N/m^(3/2)
  Real cn{0};            // N s/m
  Real cs{0};            // N s/m
  Real tan_friction{0};  // of the smaller friction angle
};

template <RealType Real>
struct Elastic {
  Real young;  // Pa
  Real poisson;
  Real friction_angle;  // rad
  Real stiffness{0};    // N/m, a body's own spring in linear contacts; 0: young * radius
};

// The stiffness of two springs E r in series, times two; 0 where either is 0.  This order of products is that
// of the reference trajectory of the pendulum.
template <RealType Real>
[[nodiscard]] Real series_stiffness(const Real& e1, const Real& r1, const Real& e2, const Real& r2) {
  const Real sum = e1 * r1 + e2 * r2;
  if (sum == 0) return Real(0);
  const Real product = 2 * e1 * r1 * e2 * r2;
  return is_safe(product) ? Real(product / sum) : Real(2 * in_series(Real(e1 * r1), Real(e2 * r2)));
}

// Linear frictional contact of spheres of radius r1, r2 (m); a flat body takes the sphere's radius.
template <RealType Real>
[[nodiscard]] ContactPhysics<Real> frictional_physics(const Elastic<Real>& m1, const Real& r1,
                                                      const Elastic<Real>& m2, const Real& r2) {
  using std::tan;
  ContactPhysics<Real> p;
  const bool given1 = m1.stiffness != 0;
  const bool given2 = m2.stiffness != 0;
  const Real e1 = given1 ? m1.stiffness : m1.young;
  const Real e2 = given2 ? m2.stiffness : m2.young;
  const Real l1 = given1 ? Real(1) : r1;
  const Real l2 = given2 ? Real(1) : r2;
  p.kn = series_stiffness(e1, l1, e2, l2);
  // Either Poisson ratio 0 means a contact without shear.
  if (m1.poisson != 0 && m2.poisson != 0) {
    p.ks = series_stiffness(Real(e1 * m1.poisson), l1, Real(e2 * m2.poisson), l2);
  }
  p.tan_friction = tan(m2.friction_angle < m1.friction_angle ? m2.friction_angle : m1.friction_angle);
  return p;
}

// Reduced mass (kg); a fixed body counts as its partner's equal.
template <RealType Real>
[[nodiscard]] Real reduced_mass(const Real& m1, const Real& m2) {
  return in_series(m1, m2);
}

template <RealType Real>
struct Collision {
  Real time;            // s, duration of a free head-on collision
  Real normal;          // coefficient of restitution along the normal, (0, 1]
  Real tangential;      // across it
  Real friction_angle;  // rad
};

// Visco-elastic contact from the collision's duration and restitution.  O. Pournin, T. M. Liebling, A.
// Mocellin, Phys. Rev. E 65 (2001) 011302.
template <RealType Real>
[[nodiscard]] ContactPhysics<Real> viscoelastic_physics(const Collision<Real>& c, const Real& m_reduced) {
  using std::log;
  using std::tan;
  const Real& pi = boost::math::constants::pi<Real>();
  const Real ln = log(c.normal);
  const Real lt = log(c.tangential);
  const Real time2 = c.time * c.time;
  ContactPhysics<Real> p;
  p.kn = m_reduced * (pi * pi + ln * ln) / time2;
  p.cn = -2 * m_reduced * ln / c.time;
  p.ks = 2 * (m_reduced * (pi * pi + lt * lt) / time2) / 7;
  p.cs = -4 * (m_reduced * lt / c.time) / 7;
  p.tan_friction = tan(c.friction_angle);
  return p;
}

// Hertz-Mindlin coefficients: Fn = kn u^(3/2), tangential stiffness ks u^(1/2) (no slip).  H. Hertz (1881);
// R. D. Mindlin & H. Deresiewicz, J. Appl. Mech. 20 (1953) 327; K. L. Johnson, Contact Mechanics (1985), 4.2
// and 7.2.
template <RealType Real>
[[nodiscard]] ContactPhysics<Real> hertz_mindlin_physics(const Elastic<Real>& m1, const Real& r1,
                                                         const Elastic<Real>& m2, const Real& r2) {
  using std::sqrt;
  using std::tan;
  // 1/E* = sum (1 - nu^2)/E, 1/G* = sum (2 - nu)/G with G = E/(2 (1 + nu)).
  const Real compliance_n =
      (1 - m1.poisson * m1.poisson) / m1.young + (1 - m2.poisson * m2.poisson) / m2.young;
  const Real compliance_s =
      2 * (2 - m1.poisson) * (1 + m1.poisson) / m1.young + 2 * (2 - m2.poisson) * (1 + m2.poisson) / m2.young;
  const Real root = sqrt(in_series(r1, r2));
  ContactPhysics<Real> p;
  p.kn = 4 * root / (3 * compliance_n);
  p.ks = 8 * root / compliance_s;
  p.tan_friction = tan(m2.friction_angle < m1.friction_angle ? m2.friction_angle : m1.friction_angle);
  return p;
}

}  // namespace ulpgate::dem
