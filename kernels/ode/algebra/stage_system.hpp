// StageSystem: the linear equations of a Newton iteration for the stages of an implicit Runge-Kutta method.
//
// (I - h A (x) J) dz = r, J the Jacobian of all stages or one of each (E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II (1996), IV.8).  What is solved is a correction, so that a type of more than 113
// bits is served by a decomposition in long double as well: residuals have all digits of the type, and each
// iteration gains those of the narrow solution (C. B. Moler, J. ACM 14 (1967) 316; N. J. Higham, Accuracy and
// Stability of Numerical Algorithms (2002), 12).
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "reference/types/eigen_traits.hpp"

namespace ulpgate::ode {

template <RealType Real>
class StageSystem {
 public:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

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
    if (!narrow_) lu_.compute(matrix<Real>());
  }

  [[nodiscard]] bool is_narrow() const { return narrow_; }
  // Decomposes the same matrix in the type itself.
  void widen() {
    if (!narrow_) return;
    narrow_ = false;
    lu_.compute(matrix<Real>());
  }

  [[nodiscard]] Vector solve(const Vector& residual) {
    if constexpr (can_be_narrow) {
      Vector x(residual.size());
      if (narrow_ && solve_narrow(residual, x)) return x;
      widen();
    }
    return lu_.solve(residual);
  }
  // In the type itself.
  [[nodiscard]] Matrix inverse() const {
    return narrow_ ? Matrix(Eigen::PartialPivLU<Matrix>(matrix<Real>()).inverse()) : Matrix(lu_.inverse());
  }

 private:
  using NarrowMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using NarrowVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  template <class Number>
  [[nodiscard]] Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> matrix() const {
    const std::size_t s = a_->size();
    const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> m(at(s * n_), at(s * n_));
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
            m(at(i * n_ + r), at(j * n_ + c)) =
                (i == j && r == c ? Number(1) : Number(0)) - factor * of_stage[r * n_ + c];
        }
      }
    }
    return m;
  }

  [[nodiscard]] bool decompose_narrow() {
    const NarrowMatrix m = matrix<long double>();
    if (!m.allFinite()) return false;
    narrow_lu_.compute(m);
    const auto& lu = narrow_lu_.matrixLU();
    return lu.allFinite() && (lu.diagonal().array() != 0).all();
  }

  // The residual is scaled by a power of two, since corrections of many digits leave the narrow range.
  [[nodiscard]] bool solve_narrow(const Vector& residual, Vector& x) const {
    using std::abs, std::frexp, std::ldexp;
    Real largest(0);
    for (const Real& r : residual) {
      if (abs(r) > largest) largest = abs(r);
    }
    int exponent = 0;
    if (largest > 0) (void)frexp(largest, &exponent);
    NarrowVector scaled(residual.size());
    for (Eigen::Index i = 0; i < residual.size(); ++i)
      scaled(i) = static_cast<long double>(Real(ldexp(residual(i), -exponent)));
    const NarrowVector solved = narrow_lu_.solve(scaled);
    if (!solved.allFinite()) return false;
    for (Eigen::Index i = 0; i < residual.size(); ++i) x(i) = ldexp(Real(solved(i)), exponent);
    return true;
  }

  Real h_{0};
  const std::vector<std::vector<Real>>* a_ = nullptr;
  std::vector<std::vector<Real>> jacobians_;
  std::size_t n_ = 0;
  bool narrow_ = false;
  Eigen::PartialPivLU<Matrix> lu_;
  Eigen::PartialPivLU<NarrowMatrix> narrow_lu_;
};

}  // namespace ulpgate::ode
