// Orbits, chaos and stiff springs; constants are decimal text, read in the type.
//
// E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.0 and II.10
// (Arenstorf's orbit, Pleiades); M. Henon, C. Heiles, Astron. J. 69 (1964) 73; E. Hairer, C. Lubich,
// G. Wanner, Geometric Numerical Integration (2006), I.2.4 (outer solar system), I.5.1 (Fermi, Pasta, Ulam,
// Tsingou with stiff springs).
#pragma once

#include <array>

#include "kernels/ode/problems/initial_value_case.hpp"

namespace ulpgate::ode::detail {

// Seven stars of masses 1 to 7 in a plane: state x1..x7, y1..y7, then the velocities.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> pleiades() {
  constexpr std::size_t n = 7;
  const auto a = []<class T>(std::span<const T> q, std::span<T> out) {
    using std::sqrt;
    for (std::size_t i = 0; i < n; ++i) {
      T ax{Real(0)};
      T ay{Real(0)};
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        const T dx = q[j] - q[i];
        const T dy = q[n + j] - q[n + i];
        const T r2 = dx * dx + dy * dy;
        const T strength = static_cast<Real>(j + 1) / (r2 * sqrt(r2));
        ax = ax + strength * dx;
        ay = ay + strength * dy;
      }
      out[i] = ax;
      out[n + i] = ay;
    }
  };
  const auto energy = [](std::span<const Real> y) {
    using std::sqrt;
    Real sum(0);
    for (std::size_t i = 0; i < n; ++i) {
      const Real m = static_cast<Real>(i + 1);
      sum += m * (y[2 * n + i] * y[2 * n + i] + y[3 * n + i] * y[3 * n + i]) / 2;
      for (std::size_t j = 0; j < i; ++j) {
        const Real dx = y[i] - y[j];
        const Real dy = y[n + i] - y[n + j];
        sum -= m * static_cast<Real>(j + 1) / sqrt(Real(dx * dx + dy * dy));
      }
    }
    return sum;
  };
  return {
      "pleiades",
      false,
      {"3"},
      autonomous_second_order_problem<Real>(
          read_all<Real>({"3", "3", "-1", "-3", "2", "-2", "2", "3", "-3", "2", "0", "0", "-4", "4"}),
          read_all<Real>({"0", "0", "0", "0", "0", "1.75", "-1.5", "0", "0", "0", "-1.25", "1", "0", "0"}),
          a),
      energy};
}

// The restricted three-body problem in the rotating frame; state x, y, x', y'.  It keeps Jacobi's constant.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> arenstorf() {
  const Real mu = real<Real>("0.012277471");
  const Real rest = Real(1) - mu;
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    using std::sqrt;
    const T near2 = (y[0] + mu) * (y[0] + mu) + y[1] * y[1];
    const T far2 = (y[0] - rest) * (y[0] - rest) + y[1] * y[1];
    const T d1 = near2 * sqrt(near2);
    const T d2 = far2 * sqrt(far2);
    out[0] = y[2];
    out[1] = y[3];
    out[2] = y[0] + Real(2) * y[3] - rest * (y[0] + mu) / d1 - mu * (y[0] - rest) / d2;
    out[3] = y[1] - Real(2) * y[2] - rest * y[1] / d1 - mu * y[1] / d2;
  };
  const auto jacobi = [=](std::span<const Real> y) {
    using std::sqrt;
    const Real r1 = sqrt(Real((y[0] + mu) * (y[0] + mu) + y[1] * y[1]));
    const Real r2 = sqrt(Real((y[0] - rest) * (y[0] - rest) + y[1] * y[1]));
    return Real((y[2] * y[2] + y[3] * y[3]) / 2 - (y[0] * y[0] + y[1] * y[1]) / 2 - rest / r1 - mu / r2);
  };
  return {
      "arenstorf",
      false,
      {"17.0652165601579625588917206249"},
      autonomous_problem<Real>(read_all<Real>({"0.994", "0", "0", "-2.00158510637908252240537862224"}), f),
      jacobi};
}

template <RealType Real>
[[nodiscard]] InitialValueCase<Real> henon_heiles(std::string name, std::vector<Real> q,
                                                  std::vector<Real> p) {
  const auto a = []<class T>(std::span<const T> x, std::span<T> out) {
    out[0] = -(x[0] + Real(2) * x[0] * x[1]);
    out[1] = x[1] * x[1] - x[1] - x[0] * x[0];
  };
  const auto energy = [](std::span<const Real> y) {
    return Real((y[2] * y[2] + y[3] * y[3]) / 2 + (y[0] * y[0] + y[1] * y[1]) / 2 + y[0] * y[0] * y[1] -
                y[1] * y[1] * y[1] / 3);
  };
  return {std::move(name),
          false,
          {"100", "1000"},
          autonomous_second_order_problem<Real>(std::move(q), p, a),
          energy};
}

// Six masses between walls, stiff harmonic and soft quartic springs in turn; omega = 50.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> fput() {
  constexpr std::size_t n = 6;
  const Real stiffness = Real(2500) / 2;  // of omega^2/4 d^2
  const auto a = [=]<class T>(std::span<const T> q, std::span<T> out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = T{Real(0)};
    // Springs between masses i - 1 and i; the walls are at 0.
    for (std::size_t i = 0; i <= n; ++i) {
      const T left = i == 0 ? T{Real(0)} : q[i - 1];
      const T right = i == n ? T{Real(0)} : q[i];
      const T d = right - left;
      const T pull = i % 2 == 1 ? stiffness * d : Real(4) * d * d * d;
      if (i > 0) out[i - 1] = out[i - 1] + pull;
      if (i < n) out[i] = out[i] - pull;
    }
  };
  const auto energy = [=](std::span<const Real> y) {
    Real sum(0);
    for (std::size_t i = 0; i < n; ++i) sum += y[n + i] * y[n + i] / 2;
    for (std::size_t i = 0; i <= n; ++i) {
      const Real d = (i == n ? Real(0) : y[i]) - (i == 0 ? Real(0) : y[i - 1]);
      sum += i % 2 == 1 ? Real(stiffness * d * d / 2) : Real(d * d * d * d);
    }
    return sum;
  };
  // Slow and fast coordinates of the first pair: sum and difference over sqrt 2.
  using std::sqrt;
  const Real root = sqrt(Real(2));
  const Real fast = Real(1) / 50;
  std::vector<Real> q(n, Real(0));
  std::vector<Real> p(n, Real(0));
  q[0] = (1 - fast) / root;
  q[1] = (1 + fast) / root;
  p[1] = root;
  return {"fput", false, {"10", "200"}, autonomous_second_order_problem<Real>(std::move(q), p, a), energy};
}

// Unit mass on a spring of unit length, in a plane under unit gravity; state x, y, x', y'.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> stiff_pendulum(int omega) {
  const Real k = static_cast<Real>(omega) * static_cast<Real>(omega);
  const auto a = [=]<class T>(std::span<const T> q, std::span<T> out) {
    using std::sqrt;
    const T r = sqrt(q[0] * q[0] + q[1] * q[1]);
    const T pull = k * (r - Real(1)) / r;
    out[0] = -(pull * q[0]);
    out[1] = -(pull * q[1]) - Real(1);
  };
  const auto energy = [=](std::span<const Real> y) {
    using std::sqrt;
    const Real stretch = sqrt(Real(y[0] * y[0] + y[1] * y[1])) - 1;
    return Real((y[2] * y[2] + y[3] * y[3]) / 2 + k * stretch * stretch / 2 + y[1]);
  };
  return {"stiff_pendulum_" + std::to_string(omega),
          false,
          {"10"},
          autonomous_second_order_problem<Real>({Real(1), Real(0)}, {Real(0), Real(0)}, a),
          energy};
}

// Two bodies, GM = 1, from the perihelion of an ellipse of eccentricity 0.99; one turn takes 2 pi.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> kepler_099() {
  using std::sqrt;
  const auto a = []<class T>(std::span<const T> q, std::span<T> out) {
    using std::sqrt;
    const T r2 = q[0] * q[0] + q[1] * q[1];
    const T r3 = r2 * sqrt(r2);
    out[0] = -q[0] / r3;
    out[1] = -q[1] / r3;
  };
  const auto energy = [](std::span<const Real> y) {
    using std::sqrt;
    return Real((y[2] * y[2] + y[3] * y[3]) / 2 - 1 / sqrt(Real(y[0] * y[0] + y[1] * y[1])));
  };
  return {"kepler",
          false,
          {"2 pi"},
          autonomous_second_order_problem<Real>({Real(1) / 100, Real(0)}, {Real(0), sqrt(Real(199))}, a),
          energy};
}

// The sun with the inner planets, Jupiter, Saturn, Uranus, Neptune, Pluto; astronomical units, days, solar
// masses; from 5 September 1994, 0h00.  State: three positions a body, then the velocities.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> outer_solar_system() {
  constexpr std::size_t bodies = 6;
  const Real g = real<Real>("2.95912208286e-4");
  auto m = read_all<Real>({"1.00000597682", "0.000954786104043", "0.000285583733151", "0.0000437273164546",
                           "0.0000517759138449"});
  m.push_back(1 / real<Real>("1.3e8"));
  const auto a = [=]<class T>(std::span<const T> q, std::span<T> out) {
    using std::sqrt;
    for (std::size_t i = 0; i < bodies; ++i) {
      std::array<T, 3> sum{T{Real(0)}, T{Real(0)}, T{Real(0)}};
      for (std::size_t j = 0; j < bodies; ++j) {
        if (j == i) continue;
        std::array<T, 3> d{};
        for (std::size_t c = 0; c < 3; ++c) d[c] = q[3 * j + c] - q[3 * i + c];
        const T r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        const T strength = g * m[j] / (r2 * sqrt(r2));
        for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] + strength * d[c];
      }
      for (std::size_t c = 0; c < 3; ++c) out[3 * i + c] = sum[c];
    }
  };
  const auto energy = [=](std::span<const Real> y) {
    using std::sqrt;
    const std::span<const Real> v = y.subspan(3 * bodies);
    Real sum(0);
    for (std::size_t i = 0; i < bodies; ++i) {
      for (std::size_t c = 0; c < 3; ++c) sum += m[i] * v[3 * i + c] * v[3 * i + c] / 2;
      for (std::size_t j = 0; j < i; ++j) {
        Real r2(0);
        for (std::size_t c = 0; c < 3; ++c)
          r2 += (y[3 * i + c] - y[3 * j + c]) * (y[3 * i + c] - y[3 * j + c]);
        sum -= g * m[i] * m[j] / sqrt(r2);
      }
    }
    return sum;
  };
  return {
      "outer_solar_system",
      false,
      {"2e5"},
      autonomous_second_order_problem<Real>(
          read_all<Real>({"0", "0", "0", "-3.5023653", "-3.8169847", "-1.5507963", "9.0755314", "-3.0458353",
                          "-1.6483708", "8.3101420", "-16.2901086", "-7.2521278", "11.4707666", "-25.7294829",
                          "-10.8169456", "-15.5387357", "-25.2225594", "-3.1902382"}),
          read_all<Real>({"0", "0", "0", "0.00565429", "-0.00412490", "-0.00190589", "0.00168318",
                          "0.00483525", "0.00192462", "0.00354178", "0.00137102", "0.00055029", "0.00288930",
                          "0.00114527", "0.00039677", "0.00276725", "-0.00170702", "-0.00136504"}),
          a),
      energy};
}

}  // namespace ulpgate::ode::detail
