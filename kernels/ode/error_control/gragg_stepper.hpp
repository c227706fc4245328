// Extrapolation of the modified midpoint rule with 2, 4, ..., 2k substeps: order 2k for any k.
//
// W. B. Gragg, SIAM J. Numer. Anal. 2 (1965) 384; E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
// Differential Equations I (1993), II.9.
#pragma once

#include <cmath>
#include <string>

#include "kernels/ode/stepper/error_stepper.hpp"

namespace ulpgate::ode {

template <RealType Real>
class GraggStepper final : public ErrorStepper<Real> {
 public:
  // Throws std::invalid_argument for fewer than 2 columns.
  GraggStepper(Problem<Real> problem, int columns) : ErrorStepper<Real>(std::move(problem)), k_(columns) {
    if (columns < 2) throw std::invalid_argument("extrapolation needs two columns or more");
  }

  [[nodiscard]] int error_order() const override { return 2 * k_ - 1; }

  [[nodiscard]] bool attempt(const Real& t, const Real& h) override {
    using std::isfinite;
    const std::size_t n = this->state().size();
    // row[m] is T_{j, m + 1}, of the last row done.
    std::vector<std::vector<Real>> row;
    for (int j = 1; j <= k_; ++j) {
      this->stop().check();
      std::vector<Real> entry = midpoint(t, h, 2 * j);
      for (int m = 1; m < j; ++m) {
        // (n_j / n_{j-m})^2 - 1 as a ratio of integers.
        const Real below(static_cast<int>((j - m) * (j - m)));
        const Real above(static_cast<int>(j * j - (j - m) * (j - m)));
        std::vector<Real> next(n);
        for (std::size_t d = 0; d < n; ++d) {
          const Real difference = entry[d] - row[static_cast<std::size_t>(m - 1)][d];
          next[d] = entry[d] + difference * below / above;
        }
        row[static_cast<std::size_t>(m - 1)] = std::move(entry);
        entry = std::move(next);
      }
      row.push_back(std::move(entry));
    }
    this->candidate_ = row.back();
    this->error_.resize(n);
    for (std::size_t d = 0; d < n; ++d) {
      this->error_[d] = row[row.size() - 1][d] - row[row.size() - 2][d];
      if (!isfinite(this->candidate_[d])) return false;
    }
    return true;
  }

 protected:
  [[nodiscard]] std::string failure() const override { return "extrapolation: the step left the numbers"; }

 private:
  [[nodiscard]] std::vector<Real> midpoint(const Real& t, const Real& h, int substeps) const {
    const std::size_t n = this->state().size();
    const Real step = h / substeps;
    std::vector<Real> before(this->state().begin(), this->state().end());
    std::vector<Real> slope(n);
    this->problem().slope(t, before, slope);
    std::vector<Real> now(n);
    for (std::size_t d = 0; d < n; ++d) now[d] = before[d] + step * slope[d];
    for (int i = 1; i < substeps; ++i) {
      this->problem().slope(Real(t + i * step), now, slope);
      for (std::size_t d = 0; d < n; ++d) {
        Real next = before[d] + 2 * step * slope[d];
        before[d] = std::move(now[d]);
        now[d] = std::move(next);
      }
    }
    return now;
  }

  int k_;
};

}  // namespace ulpgate::ode
