// RODAS3: a linearly implicit (Rosenbrock) method of order 3 with an estimate of order 2, L-stable and
// stiffly accurate, for autonomous problems.
//
// A. Sandu, J. G. Verwer, J. G. Blom, E. J. Spee, G. R. Carmichael, F. A. Potra, Atmos. Environ. 31 (1997)
// 3459, with gamma = 1/2, in the transformed variables of E. Hairer, G. Wanner, Solving Ordinary Differential
// Equations II (1996), IV.7.
#pragma once

#include <array>
#include <cmath>

#include "kernels/ode/algebra/lu.hpp"
#include "kernels/ode/stepper/error_stepper.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate::ode {

template <RealType Real>
class RosenbrockStepper final : public ErrorStepper<Real> {
 public:
  // Throws std::invalid_argument for a problem without its Jacobian: the order depends on it.
  explicit RosenbrockStepper(Problem<Real> problem) : ErrorStepper<Real>(std::move(problem)) {
    if (!this->problem().jacobian)
      throw std::invalid_argument("rodas3 needs an autonomous problem with its Jacobian; this one has none");
  }

  [[nodiscard]] int error_order() const override { return 3; }

  [[nodiscard]] bool attempt(const Real& t, const Real& h) override {
    using std::isfinite;
    const std::span<const Real> y = this->state();
    const std::size_t n = y.size();
    jacobian_.resize(n * n);
    this->problem().jacobian(t, y, jacobian_);
    std::vector<Real> m(n * n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) m[i * n + j] = (i == j ? 2 / h : Real(0)) - jacobian_[i * n + j];
    }
    LuDecomposition<Real> lu;
    lu.decompose(std::move(m), n);
    // sum_j a_ij U_j and sum_j c_ij U_j / h of the stages U, then the step and its error.
    const Real eight_thirds = Real(8) / 3;
    std::array<std::vector<Real>, 4> u;
    std::vector<Real> stage(y.begin(), y.end());
    std::vector<Real> slope(n);
    this->problem().slope(t, stage, slope);
    std::vector<Real> right(n);
    for (std::size_t d = 0; d < n; ++d) right[d] = slope[d];
    u[0] = lu.solve(right);
    for (std::size_t d = 0; d < n; ++d) right[d] = slope[d] + 4 * u[0][d] / h;
    u[1] = lu.solve(right);
    for (std::size_t d = 0; d < n; ++d) stage[d] = y[d] + 2 * u[0][d];
    this->problem().slope(t, stage, slope);
    for (std::size_t d = 0; d < n; ++d) right[d] = slope[d] + (u[0][d] - u[1][d]) / h;
    u[2] = lu.solve(right);
    for (std::size_t d = 0; d < n; ++d) stage[d] = y[d] + (2 * u[0][d] + u[2][d]);
    this->problem().slope(t, stage, slope);
    for (std::size_t d = 0; d < n; ++d)
      right[d] = slope[d] + (u[0][d] - u[1][d] - eight_thirds * u[2][d]) / h;
    u[3] = lu.solve(right);
    this->candidate_.resize(n);
    this->error_.resize(n);
    bool finite = true;
    for (std::size_t d = 0; d < n; ++d) {
      this->candidate_[d] = stage[d] + u[3][d];
      this->error_[d] = u[3][d];
      finite = finite && isfinite(this->candidate_[d]);
    }
    return finite;
  }

 protected:
  [[nodiscard]] std::string failure() const override { return "rodas3: the step left the numbers"; }

 private:
  std::vector<Real> jacobian_;
};

}  // namespace ulpgate::ode
