// Small linear systems for coefficients, which need few of them and no library.
#pragma once

#include <utility>
#include <vector>

#include "kernels/ode/algebra/lu.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate::ode::detail {

// x of a x = b for a small square matrix.
template <RealType Real>
[[nodiscard]] std::vector<Real> solved_linear(const std::vector<std::vector<Real>>& a,
                                              const std::vector<Real>& b) {
  std::vector<Real> rows;
  for (const std::vector<Real>& row : a) rows.insert(rows.end(), row.begin(), row.end());
  LuDecomposition<Real> lu;
  lu.decompose(std::move(rows), b.size());
  return lu.solve(b);
}

}  // namespace ulpgate::ode::detail
