// StageSystem: the linear equations of a Newton iteration for the stages of an implicit Runge-Kutta method.
//
// (I - h A (x) J) dz = r, J the Jacobian of all stages or one of each (E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II (1996), IV.8).  What is solved is a correction, so that a type of more than 113
// bits is served by a decomposition in long double as well: residuals have all digits of the type, and each
// iteration gains those of the narrow solution (C. B. Moler, J. ACM 14 (1967) 316; N. J. Higham, Accuracy and
// Stability of Numerical Algorithms (2002), 12).
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/ode/algebra/lu.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate::ode {

template <RealType Real>
class StageSystem {
 public:
  static constexpr bool can_be_narrow = std::numeric_limits<Real>::digits > 113;

  // `a`: the method's coefficients; `jacobians`: row by row, one for all stages or one a stage.  `narrow` is
  // heeded where the type has a narrower one and no entry leaves its range.
  void decompose(const Real& h, const std::vector<std::vector<Real>>& a,
                 std::vector<std::vector<Real>> jacobians, bool narrow) {
    h_ = h;
    a_ = &a;
    jacobians_ = std::move(jacobians);
    n_ = 0;
    while (n_ * n_ < jacobians_.front().size()) ++n_;
    narrow_ = false;
    if constexpr (can_be_narrow) narrow_ = narrow && decompose_narrow();
    if (!narrow_) decompose_wide();
  }

  [[nodiscard]] bool is_narrow() const { return narrow_; }
  // Decomposes the same matrix in the type itself.
  void widen() {
    if (!narrow_) return;
    narrow_ = false;
    decompose_wide();
  }

  // Both are of all components of the first stage, then of the second and so on.
  [[nodiscard]] std::vector<Real> solve(const std::vector<Real>& residual) {
    if constexpr (can_be_narrow) {
      std::vector<Real> x(residual.size());
      if (narrow_ && solve_narrow(residual, x)) return x;
      widen();
    }
    return lu_.solve(residual);
  }
  // In the type itself, row by row.
  [[nodiscard]] std::vector<Real> inverse() const {
    if (!narrow_) return lu_.inverse();
    LuDecomposition<Real> wide;
    wide.decompose(matrix<Real>(), rows());
    return wide.inverse();
  }

 private:
  [[nodiscard]] std::size_t rows() const { return a_->size() * n_; }

  template <class Number>
  [[nodiscard]] std::vector<Number> matrix() const {
    const std::size_t s = a_->size();
    std::vector<Number> m(rows() * rows());
    std::vector<Number> of_stage;
    for (std::size_t j = 0; j < s; ++j) {
      if (j == 0 || jacobians_.size() > 1) {
        of_stage.clear();
        for (const Real& x : jacobians_[jacobians_.size() > 1 ? j : 0])
          of_stage.push_back(static_cast<Number>(x));
      }
      for (std::size_t i = 0; i < s; ++i) {
        const Number factor = static_cast<Number>(Real(h_ * (*a_)[i][j]));
        for (std::size_t r = 0; r < n_; ++r) {
          for (std::size_t c = 0; c < n_; ++c)
            m[(i * n_ + r) * rows() + j * n_ + c] =
                (i == j && r == c ? Number(1) : Number(0)) - factor * of_stage[r * n_ + c];
        }
      }
    }
    return m;
  }

  void decompose_wide() { lu_.decompose(matrix<Real>(), rows()); }
  [[nodiscard]] bool decompose_narrow() {
    narrow_lu_.decompose(matrix<long double>(), rows());
    return narrow_lu_.is_regular();
  }

  // The residual is scaled by a power of two, since corrections of many digits leave the narrow range.
  [[nodiscard]] bool solve_narrow(const std::vector<Real>& residual, std::vector<Real>& x) const {
    using std::abs, std::frexp, std::isfinite, std::ldexp;
    Real largest(0);
    for (const Real& r : residual) {
      if (abs(r) > largest) largest = abs(r);
    }
    int exponent = 0;
    if (largest > 0) (void)frexp(largest, &exponent);
    std::vector<long double> scaled(residual.size());
    for (std::size_t i = 0; i < residual.size(); ++i)
      scaled[i] = static_cast<long double>(Real(ldexp(residual[i], -exponent)));
    const std::vector<long double> solved = narrow_lu_.solve(scaled);
    for (std::size_t i = 0; i < residual.size(); ++i) {
      if (!isfinite(solved[i])) return false;
      x[i] = ldexp(Real(solved[i]), exponent);
    }
    return true;
  }

  Real h_{0};
  const std::vector<std::vector<Real>>* a_ = nullptr;
  std::vector<std::vector<Real>> jacobians_;
  std::size_t n_ = 0;
  bool narrow_ = false;
  LuDecomposition<Real> lu_;
  LuDecomposition<long double> narrow_lu_;
};

}  // namespace ulpgate::ode
