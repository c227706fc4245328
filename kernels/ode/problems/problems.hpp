// Problems with exact solutions that need no solver: oscillator, pendulum, Kepler's ellipse, free rigid body.
//
// Parameters and starts are exact in every Real for the values of standard_problems(), so an error is that of
// the integrator alone.  The solutions are computed with guard digits and rounded once.
#pragma once

#include <array>
#include <string>

#include "kernels/ode/problems/jacobi_elliptic.hpp"
#include "kernels/ode/problems/problem.hpp"
#include "reference/types/guard_digits.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct SolvedProblem {
  std::string name;
  Problem<Real> problem;
  std::function<std::vector<Real>(const Real& t)> exact;  // y(t)
  // What the solution keeps, of a state.
  std::function<Real(std::span<const Real> y)> energy;
};

namespace detail {

template <RealType Real>
[[nodiscard]] std::vector<Real> rounded_all(const std::vector<Guarded<Real>>& wide) {
  std::vector<Real> out;
  out.reserve(wide.size());
  for (const auto& x : wide) out.push_back(rounded<Real>(x));
  return out;
}

template <RealType Real>
void require(const Real& value, bool good, const char* what) {
  using std::isfinite;
  if (!good || !isfinite(value)) throw std::invalid_argument(what);
}

}  // namespace detail

// q'' = -w^2 q from q = 1 at rest: q = cos(w t).
template <RealType Real>
[[nodiscard]] SolvedProblem<Real> harmonic_oscillator(const Real& w) {
  detail::require(w, w > 0, "harmonic_oscillator: the angular frequency must be positive");
  const auto acceleration = [w]<class T>(std::span<const T> q, std::span<T> a) { a[0] = -(w * w * q[0]); };
  const auto exact = [w](const Real& t) {
    const Guarded<Real> wide = guarded(w);
    const Guarded<Real> phase = wide * guarded(t);
    return detail::rounded_all<Real>({cos(phase), -wide * sin(phase)});
  };
  const auto energy = [w](std::span<const Real> y) { return Real((y[1] * y[1] + w * w * y[0] * y[0]) / 2); };
  return {"oscillator", autonomous_second_order_problem<Real>({Real(1)}, {Real(0)}, acceleration), exact,
          energy};
}

// q'' = -w^2 sin q from the lowest point with the speed 2 k w, 0 <= k < 1: it swings to sin(q/2) = k, and
// sin(q/2) = k sn(w t, k), q' = 2 k w cn(w t, k).  E. T. Whittaker, Analytical Dynamics (1937), section 44.
template <RealType Real>
[[nodiscard]] SolvedProblem<Real> pendulum(const Real& w, const Real& k) {
  detail::require(w, w > 0, "pendulum: the angular frequency must be positive");
  detail::require(k, k >= 0 && k < 1, "pendulum: the modulus is not in [0, 1)");
  const auto acceleration = [w]<class T>(std::span<const T> q, std::span<T> a) {
    using std::sin;
    a[0] = -(w * w * sin(q[0]));
  };
  const auto exact = [w, k](const Real& t) {
    const Guarded<Real> wide = guarded(w);
    const Guarded<Real> modulus = guarded(k);
    const auto f = jacobi_elliptic<Guarded<Real>>(wide * guarded(t), modulus);
    // asin(k sn) from its sine and cosine; the cosine of half the angle is dn.
    return detail::rounded_all<Real>(
        {2 * atan2(Guarded<Real>(modulus * f.sn), f.dn), 2 * modulus * wide * f.cn});
  };
  const auto energy = [w](std::span<const Real> y) {
    using std::cos;
    return Real(y[1] * y[1] / 2 + w * w * (1 - cos(y[0])));
  };
  return {"pendulum", autonomous_second_order_problem<Real>({Real(0)}, {Real(2 * k * w)}, acceleration),
          exact, energy};
}

// Two bodies, GM = 1, from the perihelion (1, 0) with the speed v, 1 <= v^2 < 2: an ellipse of eccentricity
// v^2 - 1.  State (x, y, x', y').
template <RealType Real>
[[nodiscard]] SolvedProblem<Real> kepler(const Real& v) {
  detail::require(v, v >= 1 && v * v < 2, "kepler: the squared speed at the perihelion is not in [1, 2)");
  const auto acceleration = []<class T>(std::span<const T> q, std::span<T> a) {
    using std::sqrt;
    const T r2 = q[0] * q[0] + q[1] * q[1];
    const T r3 = r2 * sqrt(r2);
    a[0] = -q[0] / r3;
    a[1] = -q[1] / r3;
  };
  const auto exact = [v](const Real& t) {
    using Wide = Guarded<Real>;
    const Wide e = guarded(v) * guarded(v) - 1;
    const Wide a = 1 / (1 - e);
    const Wide n = 1 / (a * sqrt(a));
    const Wide two_pi = 2 * acos(Wide(-1));
    Wide mean = n * guarded(t);
    mean -= two_pi * floor(mean / two_pi + Wide(1) / 2);
    // Kepler's equation E - e sin E = M: the left side is convex on (0, pi), so Newton's iteration falls
    // monotonically from pi to the root; odd in M.
    Wide anomaly = mean > 0 ? Wide(two_pi / 2) : mean < 0 ? Wide(-two_pi / 2) : Wide(0);
    const Wide settled = ldexp(Wide(1), -std::numeric_limits<Wide>::digits / 2 - 8);
    for (bool last = false; !last;) {
      const Wide step = (anomaly - e * sin(anomaly) - mean) / (1 - e * cos(anomaly));
      anomaly -= step;
      last = abs(step) < settled;
    }
    const Wide s = sin(anomaly);
    const Wide c = cos(anomaly);
    const Wide minor = a * sqrt((1 - e) * (1 + e));
    const Wide rate = n / (1 - e * c);
    return detail::rounded_all<Real>({a * (c - e), minor * s, -a * rate * s, minor * rate * c});
  };
  const auto energy = [](std::span<const Real> y) {
    using std::sqrt;
    return Real((y[2] * y[2] + y[3] * y[3]) / 2 - 1 / sqrt(y[0] * y[0] + y[1] * y[1]));
  };
  return {"kepler", autonomous_second_order_problem<Real>({Real(1), Real(0)}, {Real(0), v}, acceleration),
          exact, energy};
}

// Euler's equations I1 w1' = (I2 - I3) w2 w3 and cyclic, I1 < I2 < I3, from w = (w1, 0, w3), w1, w3 > 0, near
// the axis of the largest moment: I1 (I2 - I1) w1^2 < I3 (I3 - I2) w3^2.  Then w = (w1 cn, W2 sn, w3 dn).
// L. D. Landau, E. M. Lifshitz, Mechanics (1976), section 37.
template <RealType Real>
[[nodiscard]] SolvedProblem<Real> rigid_body(const std::array<Real, 3>& inertia, const Real& w1,
                                             const Real& w3) {
  const auto [i1, i2, i3] = inertia;
  detail::require(w1, i1 > 0 && i1 < i2 && i2 < i3 && w1 > 0 && w3 > 0,
                  "rigid_body: moments must increase and the angular velocities be positive");
  detail::require(w3, i1 * (i2 - i1) * w1 * w1 < i3 * (i3 - i2) * w3 * w3,
                  "rigid_body: the rotation is not about the axis of the largest moment");
  const auto slope = [inertia]<class T>(std::span<const T> w, std::span<T> out) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      out[i] = (inertia[j] - inertia[k]) / inertia[i] * (w[j] * w[k]);
    }
  };
  const auto exact = [inertia, w1, w3](const Real& t) {
    using Wide = Guarded<Real>;
    const Wide a = guarded(inertia[0]);
    const Wide b = guarded(inertia[1]);
    const Wide c = guarded(inertia[2]);
    const Wide x = guarded(w1);
    const Wide z = guarded(w3);
    const Wide y = x * sqrt(a * (c - a) / (b * (c - b)));
    const Wide rate = z * sqrt((c - b) * (c - a) / (a * b));
    const Wide modulus = x / z * sqrt(a * (b - a) / (c * (c - b)));
    const auto f = jacobi_elliptic<Wide>(rate * guarded(t), modulus);
    return detail::rounded_all<Real>({x * f.cn, y * f.sn, z * f.dn});
  };
  const auto energy = [inertia](std::span<const Real> w) {
    return Real(((inertia[0] * w[0] * w[0] + inertia[1] * w[1] * w[1]) + inertia[2] * w[2] * w[2]) / 2);
  };
  return {"rigid_body", autonomous_problem<Real>({w1, Real(0), w3}, slope), exact, energy};
}

// w = 1; k = 1/2; eccentricity 9/16; moments 1, 2, 3: exact in every Real.
template <RealType Real>
[[nodiscard]] std::vector<SolvedProblem<Real>> standard_problems() {
  return {harmonic_oscillator(Real(1)), pendulum(Real(1), Real(Real(1) / 2)), kepler(Real(Real(5) / 4)),
          rigid_body<Real>({Real(1), Real(2), Real(3)}, Real(1), Real(1))};
}

}  // namespace ulpgate::ode
