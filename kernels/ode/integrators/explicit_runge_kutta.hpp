// The textbook explicit Runge-Kutta methods of fixed step, tableaux as exact ratios.
//
// E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.1 and II.5.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "kernels/ode/stepper/stepper.hpp"

namespace ulpgate::ode {

// An exact ratio; both numbers are exact in every type under test (below 2^24).
struct Ratio {
  int numerator = 0;
  int denominator = 1;

  template <RealType Real>
  [[nodiscard]] Real in() const {
    return Real(numerator) / Real(denominator);
  }
};

// k_i = f(t + c_i h, y + h sum_j a_ij k_j), then y + h sum_i b_i k_i; row i of a has i numbers.
struct ExplicitTableau {
  std::string_view name;
  int order;
  std::string_view citation;
  std::vector<std::vector<Ratio>> a;
  std::vector<Ratio> b;
  std::vector<Ratio> c;
};

// By rising order.  Dormand and Prince's has its six stages of order 5: the seventh of their pair only
// estimates the error.
[[nodiscard]] inline std::span<const ExplicitTableau> explicit_tableaux() {
  static const std::vector<ExplicitTableau> tableaux{
      {"euler", 1, "L. Euler, Institutionum calculi integralis I (1768), 650; forward", {{}}, {{1}}, {{0}}},
      {"rk2",
       2,
       "C. Runge, Math. Ann. 46 (1895) 167: the explicit midpoint rule",
       {{}, {{1, 2}}},
       {{0}, {1}},
       {{0}, {1, 2}}},
      {"rk3",
       3,
       "W. Kutta, Z. Math. Phys. 46 (1901) 435, third order",
       {{}, {{1, 2}}, {{-1}, {2}}},
       {{1, 6}, {2, 3}, {1, 6}},
       {{0}, {1, 2}, {1}}},
      {"rk4",
       4,
       "W. Kutta, Z. Math. Phys. 46 (1901) 435: the classical method",
       {{}, {{1, 2}}, {{0}, {1, 2}}, {{0}, {0}, {1}}},
       {{1, 6}, {1, 3}, {1, 3}, {1, 6}},
       {{0}, {1, 2}, {1, 2}, {1}}},
      {"dormand_prince54",
       5,
       "J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19: RK5(4)7M",
       {{},
        {{1, 5}},
        {{3, 40}, {9, 40}},
        {{44, 45}, {-56, 15}, {32, 9}},
        {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
        {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
       {{35, 384}, {0}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}},
       {{0}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1}}},
  };
  return tableaux;
}

// nullptr where no tableau has this name.
[[nodiscard]] inline const ExplicitTableau* find_explicit_tableau(std::string_view name) {
  for (const ExplicitTableau& t : explicit_tableaux()) {
    if (t.name == name) return &t;
  }
  return nullptr;
}

template <RealType Real>
class ExplicitRungeKuttaStepper final : public Stepper<Real> {
 public:
  ExplicitRungeKuttaStepper(Problem<Real> problem, const ExplicitTableau& tableau)
      : Stepper<Real>(std::move(problem)), stage_(this->state().size()), slopes_(tableau.b.size(), stage_) {
    for (const auto& row : tableau.a) {
      a_.emplace_back();
      for (const Ratio& x : row) a_.back().push_back(x.in<Real>());
    }
    for (const Ratio& x : tableau.b) b_.push_back(x.in<Real>());
    for (const Ratio& x : tableau.c) c_.push_back(x.in<Real>());
  }

  void advance(const Real& t, const Real& h) override {
    std::vector<Real>& y = this->state_to_advance();
    for (std::size_t i = 0; i < slopes_.size(); ++i) {
      stage_ = y;
      add(h, a_[i], stage_);
      this->problem().slope(Real(t + c_[i] * h), stage_, slopes_[i]);
    }
    add(h, b_, y);
  }

 private:
  // y += h sum_j weights_j k_j; a weight of zero is no term, whatever its slope.
  void add(const Real& h, const std::vector<Real>& weights, std::vector<Real>& y) const {
    for (std::size_t d = 0; d < y.size(); ++d) {
      Real sum(0);
      for (std::size_t j = 0; j < weights.size(); ++j) {
        if (weights[j] != 0) sum += weights[j] * slopes_[j][d];
      }
      y[d] += h * sum;
    }
  }

  std::vector<std::vector<Real>> a_;
  std::vector<Real> b_, c_;
  std::vector<Real> stage_;
  std::vector<std::vector<Real>> slopes_;
};

}  // namespace ulpgate::ode
