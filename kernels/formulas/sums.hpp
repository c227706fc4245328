// Sums and what is made of them.
#pragma once

#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

template <RealType Real>
[[nodiscard]] Real sum_naive(std::span<const Real> x) {
  Real sum(0);
  for (const Real& v : x) sum += v;
  return sum;
}

// W. Kahan, Further remarks on reducing truncation errors (1965): the last addition's error joins the next
// term.
template <RealType Real>
[[nodiscard]] Real sum_kahan(std::span<const Real> x) {
  Real sum(0);
  Real compensation(0);
  for (const Real& v : x) {
    const Real y(v - compensation);
    const Real t(sum + y);
    compensation = (t - sum) - y;
    sum = t;
  }
  return sum;
}

// A sum that keeps the errors of its additions beside it (A. Neumaier, ZAMM 54, 1974).
template <RealType Real>
class CompensatedSum {
 public:
  void add(const Real& v) {
    using std::abs;
    const Real t(sum_ + v);
    if (abs(sum_) >= abs(v)) {
      compensation_ += (sum_ - t) + v;
    } else {
      compensation_ += (v - t) + sum_;
    }
    sum_ = t;
  }
  [[nodiscard]] Real value() const { return Real(sum_ + compensation_); }

 private:
  Real sum_{0};
  Real compensation_{0};
};

template <RealType Real>
[[nodiscard]] Real sum_neumaier(std::span<const Real> x) {
  CompensatedSum<Real> sum;
  for (const Real& v : x) sum.add(v);
  return sum.value();
}

// Terms divided by a power of two not below their number: no partial sum overflows where the sum does not.
template <RealType Real>
[[nodiscard]] Real sum_scaled(std::span<const Real> x) {
  const auto scale = Real(static_cast<long>(std::bit_ceil(x.size())));
  Real sum(0);
  for (const Real& v : x) sum += v / scale;
  return Real(sum * scale);
}

// 1 + 1/2 + ... + 1/n from the left.
template <RealType Real>
[[nodiscard]] Real harmonic_naive(long n) {
  Real sum(0);
  for (long k = 1; k <= n; ++k) sum += 1 / Real(k);
  return sum;
}

// With an error of 2 u + n u^2 at most: what is lost goes into the next term.
template <RealType Real>
[[nodiscard]] Real harmonic_kahan(long n) {
  Real sum(0);
  Real compensation(0);
  for (long k = 1; k <= n; ++k) {
    const Real y(1 / Real(k) - compensation);
    const Real t(sum + y);
    compensation = (t - sum) - y;
    sum = t;
  }
  return sum;
}

// With one of u + n^2 u^2: what is lost is a sum beside, and that one naive.
template <RealType Real>
[[nodiscard]] Real harmonic_neumaier(long n) {
  CompensatedSum<Real> sum;
  for (long k = 1; k <= n; ++k) sum.add(Real(1 / Real(k)));
  return sum.value();
}

// The first k <= n whose term leaves the sum from the left as it is; 0 where every term counts.
template <RealType Real>
[[nodiscard]] long harmonic_stall(long n) {
  Real sum(0);
  for (long k = 1; k <= n; ++k) {
    const Real next(sum + 1 / Real(k));
    if (next == sum) return k;
    sum = next;
  }
  return 0;
}

// Sample variance from the sums of x and of x^2, as calculators did it.
template <RealType Real>
[[nodiscard]] Real variance_one_pass(std::span<const Real> x) {
  const auto n = Real(static_cast<long>(x.size()));
  Real sum(0);
  Real squares(0);
  for (const Real& v : x) {
    sum += v;
    squares += v * v;
  }
  return Real((squares - sum * sum / n) / (n - 1));
}

// The mean first, then the squares of what differs from it.
template <RealType Real>
[[nodiscard]] Real variance_two_pass(std::span<const Real> x) {
  const auto n = Real(static_cast<long>(x.size()));
  const Real mean(sum_naive(x) / n);
  Real squares(0);
  for (const Real& v : x) {
    const Real d(v - mean);
    squares += d * d;
  }
  return Real(squares / (n - 1));
}

// B. P. Welford (Technometrics 4, 1962): one pass, mean and squares updated together.
template <RealType Real>
[[nodiscard]] Real variance_welford(std::span<const Real> x) {
  Real mean(0);
  Real squares(0);
  Real k(0);
  for (const Real& v : x) {
    const Real d(v - mean);
    k += 1;
    mean += d / k;
    squares += d * (v - mean);
  }
  return Real(squares / (k - 1));
}

// log(e^x1 + e^x2 + ...) as it stands.
template <RealType Real>
[[nodiscard]] Real log_sum_exp_naive(std::span<const Real> x) {
  using std::exp;
  using std::log;
  Real sum(0);
  for (const Real& v : x) sum += exp(v);
  return Real(log(sum));
}

// The same with the largest argument taken out: no exponential is above 1.
template <RealType Real>
[[nodiscard]] Real log_sum_exp_shifted(std::span<const Real> x) {
  using std::exp;
  using std::log;
  Real largest(x[0]);
  for (const Real& v : x) {
    if (largest < v) largest = v;
  }
  Real sum(0);
  for (const Real& v : x) sum += exp(Real(v - largest));
  return Real(largest + log(sum));
}

}  // namespace ulpgate::formulas
