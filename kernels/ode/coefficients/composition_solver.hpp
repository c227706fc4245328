// Solves the order conditions of a published composition to the full precision of a type.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/ode/algebra/dual.hpp"
#include "kernels/ode/algebra/linear.hpp"
#include "kernels/ode/coefficients/composition_rows.hpp"
#include "kernels/ode/coefficients/order_conditions.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode {

namespace detail {

template <class Scalar>
[[nodiscard]] std::vector<Factor<Scalar>> mirrored(std::vector<Factor<Scalar>> half) {
  for (std::size_t i = half.size() - 1; i-- > 0;) half.push_back(half[i]);
  return half;
}

// The shortest d with J d = residual: d = J^T (J J^T)^-1 residual; columns[j] is column j of J.
template <RealType Real>
[[nodiscard]] std::vector<Real> shortest_solution(const std::vector<std::vector<Real>>& columns,
                                                  const std::vector<Real>& residual) {
  const std::size_t rows = residual.size();
  std::vector<std::vector<Real>> gram(rows, std::vector<Real>(rows, Real(0)));
  for (const std::vector<Real>& column : columns) {
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < rows; ++k) gram[i][k] += column[i] * column[k];
    }
  }
  const std::vector<Real> multipliers = solved_linear(std::move(gram), residual);
  std::vector<Real> d;
  for (const std::vector<Real>& column : columns) {
    Real sum(0);
    for (std::size_t i = 0; i < rows; ++i) sum += column[i] * multipliers[i];
    d.push_back(sum);
  }
  return d;
}

}  // namespace detail

// The product whose word coefficients are the order conditions: symmetric steps, or kicks and drifts.
template <class Scalar>
[[nodiscard]] std::vector<Factor<Scalar>> condition_factors(CompositionKind kind,
                                                            const std::vector<Scalar>& p) {
  std::vector<Factor<Scalar>> half;
  if (kind == CompositionKind::position_extended_fr) {
    const Scalar one(1);
    const Scalar two(2);
    half = {{kDrift, p[0]},
            {kKick, (one - two * p[1]) / two},
            {kDrift, p[2]},
            {kKick, p[1]},
            {kDrift, one - two * (p[2] + p[0])}};
  } else {
    for (const Scalar& weight : p) half.push_back({Factor<Scalar>::kSymmetricStep, weight});
  }
  return detail::mirrored(std::move(half));
}

// Residuals: what the coefficients of the words miss; all zero for a method of this order.
template <class Scalar>
[[nodiscard]] std::vector<Scalar> order_residuals(const CompositionRow& row, const std::vector<Scalar>& p) {
  const std::vector<Factor<Scalar>> factors = condition_factors(row.kind, p);
  const bool letters = row.kind == CompositionKind::position_extended_fr;
  std::vector<Scalar> residuals;
  for (const Word& word : letters ? splitting_words(row.order) : symmetric_step_words(row.order)) {
    // Even grades vanish by symmetry; the first grade of the extended form does by its parametrisation.
    if (letters && word.size() != 3) continue;
    Scalar wanted(word.size() == 1 && word[0] == 1 ? 1 : 0);
    if (letters) wanted = Scalar(1) / Scalar(6);
    residuals.push_back(word_coefficient(std::span<const Factor<Scalar>>(factors), word) - wanted);
  }
  return residuals;
}

// Parameters that meet the order conditions of `row` to the last digits of Real, by Newton's iteration from
// the published digits.  Where there are more parameters than conditions, each correction is the shortest
// one: the result is the member of the family nearest to the published one.  Nothing where the published
// digits do not lead to a solution within 2^-26 of them.
template <RealType Real>
[[nodiscard]] std::optional<std::vector<Real>> solve_composition(const CompositionRow& row) {
  using std::abs, std::ldexp;
  const std::size_t n = row.published.size();
  std::vector<Real> p;
  for (std::string_view digits : row.published) p.push_back(real<Real>(digits));
  const std::vector<Real> published = p;
  const Real settled = ldexp(Real(1), -std::numeric_limits<Real>::digits + 16);
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::vector<std::vector<Real>> columns;
    std::vector<Real> residual;
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<Dual<Real>> direction;
      for (std::size_t k = 0; k < n; ++k) direction.emplace_back(p[k], Real(k == j ? 1 : 0));
      columns.emplace_back();
      residual.clear();
      for (const Dual<Real>& condition : order_residuals(row, direction)) {
        columns.back().push_back(condition.slope);
        residual.push_back(condition.value);
      }
    }
    const std::vector<Real> correction = detail::shortest_solution(columns, residual);
    Real largest(0);
    for (std::size_t k = 0; k < n; ++k) {
      p[k] -= correction[k];
      if (abs(correction[k]) > largest) largest = abs(correction[k]);
      if (!(abs(p[k] - published[k]) < ldexp(Real(1), -26))) return std::nullopt;
    }
    if (largest < settled) return p;
  }
  return std::nullopt;
}

// The parameters that a method is run with.  Wrong digits are run as they stand: a measured order then names
// the method, and everything else goes on.
template <RealType Real>
[[nodiscard]] std::vector<Real> composition_parameters(const CompositionRow& row) {
  if (row.published.empty()) return {};
  if (auto solved = solve_composition<Real>(row)) return *std::move(solved);
  std::vector<Real> published;
  for (const std::string_view digits : row.published) published.push_back(real<Real>(digits));
  return published;
}

}  // namespace ulpgate::ode
