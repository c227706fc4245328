// Stiff problems without a closed form.
//
// Constants are decimal text, read in the type: no double stands between.  Sources: H. H. Robertson (1966);
// B. van der Pol, Phil. Mag. 2 (1926) 978; E. Schaefer, Physiol. Plant. 33 (1975) 37 (HIRES); R. J. Field,
// R. M. Noyes, J. Chem. Phys. 60 (1974) 1877 (Oregonator); W. H. Enright, T. E. Hull, B. Lindberg, BIT 15
// (1975) 10 (E5); F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers (2008) (Chemical Akzo
// Nobel).
#pragma once

#include "kernels/ode/problems/initial_value_case.hpp"

namespace ulpgate::ode::detail {

// 1 component a term; the second slope is minus the others, as mass is kept.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> robertson() {
  const Real slow = real<Real>("0.04");
  const Real back = real<Real>("1e4");
  const Real fast = real<Real>("3e7");
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    out[0] = back * y[1] * y[2] - slow * y[0];
    out[2] = fast * y[1] * y[1];
    out[1] = -out[0] - out[2];
  };
  return {"robertson",
          true,
          {"40", "1e11", "4e11"},
          autonomous_problem<Real>({Real(1), Real(0), Real(0)}, f),
          [](std::span<const Real> y) { return Real(y[0] + y[1] + y[2]); }};
}

template <RealType Real>
[[nodiscard]] InitialValueCase<Real> van_der_pol() {
  const Real eps = real<Real>("1e-6");
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    out[0] = y[1];
    out[1] = ((Real(1) - y[0] * y[0]) * y[1] - y[0]) / eps;
  };
  return {"van_der_pol", true, {"2"}, autonomous_problem<Real>({Real(2), Real(0)}, f), {}};
}

template <RealType Real>
[[nodiscard]] InitialValueCase<Real> hires() {
  const auto k = read_all<Real>(
      {"1.71", "0.43", "8.32", "0.0007", "8.75", "10.03", "0.035", "1.12", "1.745", "280", "0.69", "1.81"});
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    const T joined = k[9] * y[5] * y[7];
    out[0] = k[1] * y[1] - k[0] * y[0] + k[2] * y[2] + k[3];
    out[1] = k[0] * y[0] - k[4] * y[1];
    out[2] = k[1] * y[3] - k[5] * y[2] + k[6] * y[4];
    out[3] = k[2] * y[1] + k[0] * y[2] - k[7] * y[3];
    out[4] = k[1] * (y[5] + y[6]) - k[8] * y[4];
    out[5] = k[10] * y[3] - joined + k[0] * y[4] - k[1] * y[5] + k[10] * y[6];
    out[6] = joined - k[11] * y[6];
    out[7] = -out[6];
  };
  std::vector<Real> start(8, Real(0));
  start[0] = Real(1);
  start[7] = real<Real>("0.0057");
  return {"hires",
          true,
          {"321.8122"},
          autonomous_problem<Real>(std::move(start), f),
          [](std::span<const Real> y) { return Real(y[6] + y[7]); }};
}

template <RealType Real>
[[nodiscard]] InitialValueCase<Real> oregonator() {
  const auto k = read_all<Real>({"77.27", "8.375e-6", "0.161"});
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    out[0] = k[0] * (y[1] + y[0] * (Real(1) - k[1] * y[0] - y[1]));
    out[1] = (y[2] - (Real(1) + y[0]) * y[1]) / k[0];
    out[2] = k[2] * (y[0] - y[2]);
  };
  return {"oregonator", true, {"360"}, autonomous_problem<Real>({Real(1), Real(2), Real(3)}, f), {}};
}

template <RealType Real>
[[nodiscard]] InitialValueCase<Real> e5() {
  const auto k = read_all<Real>({"7.89e-10", "1.1e7", "1.13e9", "1.13e3"});
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    const T p1 = k[0] * y[0];
    const T p2 = k[1] * y[0] * y[2];
    const T p3 = k[2] * y[1] * y[2];
    const T p4 = k[3] * y[3];
    out[0] = -p1 - p2;
    out[1] = p1 - p3;
    out[3] = p2 - p4;
    out[2] = out[1] - out[3];
  };
  return {"e5",
          true,
          {"1e13"},
          autonomous_problem<Real>({real<Real>("1.76e-3"), Real(0), Real(0), Real(0)}, f),
          [](std::span<const Real> y) { return Real(y[1] - y[2] - y[3]); }};
}

// As a system of five equations, the sixth unknown put in.
template <RealType Real>
[[nodiscard]] InitialValueCase<Real> chemakzo() {
  const auto k = read_all<Real>({"18.7", "0.58", "0.09", "0.42", "3.3", "115.83"});
  const Real r3_rate = k[1] / real<Real>("34.4");
  const Real inflow = real<Real>("0.9") / 737;
  const auto f = [=]<class T>(std::span<const T> y, std::span<T> out) {
    using std::sqrt;
    const T root = sqrt(y[1]);
    const T square = y[0] * y[0];
    const T y6 = k[5] * y[0] * y[3];
    const T r1 = k[0] * square * square * root;
    const T r2 = k[1] * y[2] * y[3];
    const T r3 = r3_rate * y[0] * y[4];
    const T r4 = k[2] * y[0] * y[3] * y[3];
    const T r5 = k[3] * y6 * y6 * root;
    out[0] = r2 - Real(2) * r1 - r3 - r4;
    out[1] = k[4] * (inflow - y[1]) - r1 / Real(2) - r4 - r5 / Real(2);
    out[2] = r1 - r2 + r3;
    out[3] = r3 - r2 - Real(2) * r4;
    out[4] = r2 - r3 + r5;
  };
  return {"chemakzo",
          true,
          {"180"},
          autonomous_problem<Real>(read_all<Real>({"0.444", "0.00123", "0", "0.007", "0"}), f),
          {}};
}

}  // namespace ulpgate::ode::detail
