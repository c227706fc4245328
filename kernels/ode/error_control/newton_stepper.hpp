// Collocation methods for stiff problems: their stage equations solved by Newton's iteration.
//
// Stages Z_i = h sum_j a_ij f(y + Z_j): E. Hairer, G. Wanner, Solving Ordinary Differential Equations II
// (1996), IV.8.  The iteration begins with one Jacobian for all stages (simplified Newton) and goes on with
// one a stage where that converges too slowly for the digits that are wanted.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/ode/algebra/linear.hpp"
#include "kernels/ode/algebra/lu.hpp"
#include "kernels/ode/algebra/stage_system.hpp"
#include "kernels/ode/coefficients/collocation.hpp"
#include "kernels/ode/stepper/error_stepper.hpp"

namespace ulpgate::ode {

namespace detail {

// d of sum_i d_i a_ij = b_j: the weights of the stages themselves in the step, y + sum d_i Z_i, which
// multiply no large slope by a small weight.
template <RealType Real>
[[nodiscard]] std::vector<Real> weights_of_stages(const CollocationTableau<Real>& t) {
  const std::size_t s = t.c.size();
  std::vector<std::vector<Real>> transposed(s, std::vector<Real>(s));
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) transposed[j][i] = t.a[i][j];
  }
  return solved_linear(std::move(transposed), t.b);
}

}  // namespace detail

// What a stepper derives from a tableau besides it.
template <RealType Real>
struct ImplicitWeights {
  std::vector<Real> stages;   // d: y1 = y + sum d_i Z_i
  std::vector<Real> at_zero;  // l_j(0): the collocation polynomial's slope extrapolated to the step's start
};

// Computed with guard digits, rounded once and kept.
template <RealType Real>
[[nodiscard]] const ImplicitWeights<Real>& implicit_weights(CollocationNodes nodes, int stages) {
  static std::mutex mutex;
  static std::map<std::pair<CollocationNodes, int>, ImplicitWeights<Real>> known;
  const std::scoped_lock lock(mutex);
  const std::pair key{nodes, stages};
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const auto wide = nodes == CollocationNodes::gauss ? compute_gauss_tableau<Guarded<Real>>(stages)
                                                     : compute_radau_tableau<Guarded<Real>>(stages);
  ImplicitWeights<Real> w;
  if (nodes == CollocationNodes::radau) {
    w.stages.assign(wide.c.size(), Real(0));
    w.stages.back() = Real(1);
  } else {
    for (const auto& x : detail::weights_of_stages(wide)) w.stages.push_back(rounded<Real>(x));
  }
  for (std::size_t j = 0; j < wide.c.size(); ++j) {
    Guarded<Real> l(1);
    for (std::size_t m = 0; m < wide.c.size(); ++m) {
      if (m != j) l *= wide.c[m] / (wide.c[m] - wide.c[j]);
    }
    w.at_zero.push_back(rounded<Real>(l));
  }
  return known.emplace(key, std::move(w)).first->second;
}

// Of s stages: order 2s (Gauss) or 2s - 1 (Radau IIA); the error's estimate is of order s + 1.
template <RealType Real>
class NewtonStepper final : public ErrorStepper<Real> {
 public:
  NewtonStepper(Problem<Real> problem, CollocationNodes nodes, int stages)
      : ErrorStepper<Real>(std::move(problem)),
        nodes_(nodes),
        t_(collocation_tableau<Real>(nodes, stages)),
        w_(implicit_weights<Real>(nodes, stages)) {}

  [[nodiscard]] int error_order() const override { return static_cast<int>(s()) + 1; }
  // Relative, of each component of the stages; that of rounding where it is smaller.
  void set_newton_tolerance(const Real& tolerance) { tolerance_ = tolerance; }
  // Leave out the error's estimate, which needs a decomposition of its own.
  void estimate_errors(bool wanted) { estimates_ = wanted; }

  [[nodiscard]] bool attempt(const Real& t, const Real& h) override {
    using std::isfinite;
    slopes_.assign(s(), std::vector<Real>(n()));
    jacobian(t, this->state(), jacobian_);
    // No step is given up for what a narrow decomposition did to its stages.
    if (!solve_stages(t, h, true) && !(StageSystem<Real>::can_be_narrow && solve_stages(t, h, false)))
      return false;
    finish(t, h);
    return true;
  }

 protected:
  [[nodiscard]] std::string failure() const override {
    return std::string(nodes_ == CollocationNodes::gauss ? "Gauss-Legendre" : "Radau IIA") +
           ": Newton's iteration for the stages does not converge at this step size";
  }

 private:
  [[nodiscard]] std::size_t n() const { return this->state().size(); }
  [[nodiscard]] std::size_t s() const { return t_.c.size(); }

  // df/dy, row by row; by differences where the problem does not know it, which Newton's iteration forgives.
  void jacobian(const Real& t, std::span<const Real> y, std::vector<Real>& out) {
    using std::abs, std::sqrt;
    out.resize(n() * n());
    if (this->problem().jacobian) return this->problem().jacobian(t, y, out);
    Real size(0);
    for (const Real& x : y) size = abs(x) > size ? Real(abs(x)) : size;
    if (size == 0) size = Real(1);
    const Real small = sqrt(std::numeric_limits<Real>::epsilon());
    std::vector<Real> moved(y.begin(), y.end());
    std::vector<Real> slope(n());
    std::vector<Real> slope_moved(n());
    this->problem().slope(t, y, slope);
    for (std::size_t j = 0; j < n(); ++j) {
      moved[j] = y[j] + small * size;
      const Real step = moved[j] - y[j];
      this->problem().slope(t, moved, slope_moved);
      for (std::size_t i = 0; i < n(); ++i) out[i * n() + j] = (slope_moved[i] - slope[i]) / step;
      moved[j] = y[j];
    }
  }

  [[nodiscard]] bool solve_stages(const Real& t, const Real& h, bool narrow) {
    z_.assign(s(), std::vector<Real>(n(), Real(0)));
    system_.decompose(h, t_.a, {jacobian_}, narrow);
    return iterate(t, h);
  }
  void decompose_with_each(const Real& t, const Real& h) {
    std::vector<std::vector<Real>> of_stages(s());
    std::vector<Real> stage(n());
    for (std::size_t j = 0; j < s(); ++j) {
      for (std::size_t d = 0; d < n(); ++d) stage[d] = this->state()[d] + z_[j][d];
      jacobian(Real(t + t_.c[j] * h), stage, of_stages[j]);
    }
    system_.decompose(h, t_.a, std::move(of_stages), system_.is_narrow());
  }

  void evaluate_stages(const Real& t, const Real& h) {
    std::vector<Real> stage(n());
    for (std::size_t j = 0; j < s(); ++j) {
      for (std::size_t d = 0; d < n(); ++d) stage[d] = this->state()[d] + z_[j][d];
      this->problem().slope(Real(t + t_.c[j] * h), stage, slopes_[j]);
    }
  }

  // How much a correction moved the stages: the largest component relative to the size of that component, and
  // relative to the size of the largest one.
  struct Change {
    Real componentwise{0};
    Real normwise{0};
  };
  [[nodiscard]] Change correct(const Real& h) {
    using std::abs;
    std::vector<Real> residual(s() * n());
    for (std::size_t i = 0; i < s(); ++i) {
      for (std::size_t d = 0; d < n(); ++d) {
        Real sum(0);
        for (std::size_t j = 0; j < s(); ++j) sum += t_.a[i][j] * slopes_[j][d];
        residual[i * n() + d] = h * sum - z_[i][d];
      }
    }
    correction_ = system_.solve(residual);
    // Below this, a component has not all digits of the type.
    const Real least = std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon();
    Change largest;
    Real whole(0);
    Real most(0);
    for (std::size_t d = 0; d < n(); ++d) {
      Real size = std::max<Real>(abs(this->state()[d]), least);
      Real moved(0);
      for (std::size_t i = 0; i < s(); ++i) {
        const Real& dz = correction_[i * n() + d];
        z_[i][d] += dz;
        if (abs(z_[i][d]) > size) size = abs(z_[i][d]);
        if (!(abs(dz) <= moved)) moved = abs(dz);
      }
      if (size > whole) whole = size;
      if (!(moved <= most)) most = moved;
      const Real relative = moved / size;
      if (!(relative <= largest.componentwise)) largest.componentwise = relative;
    }
    largest.normwise = most / whole;
    return largest;
  }

  // Of each component, or where the problem is q'' = a(q) of all positions and of all velocities: their axes
  // are nobody's choice.
  [[nodiscard]] std::vector<Real> sizes_of_stages() const {
    using std::abs;
    std::vector<Real> size(n(), Real(0));
    for (std::size_t d = 0; d < n(); ++d) {
      size[d] = abs(this->state()[d]);
      for (std::size_t j = 0; j < s(); ++j) size[d] = std::max<Real>(size[d], abs(z_[j][d]));
    }
    if (!this->problem().acceleration) return size;
    const auto half = size.begin() + static_cast<std::ptrdiff_t>(n() / 2);
    std::fill(size.begin(), half, Real(*std::max_element(size.begin(), half)));
    std::fill(half, size.end(), Real(*std::max_element(half, size.end())));
    return size;
  }

  // Whether the last correction is no more than what roundings of one evaluation of the stage equations come
  // to: |M^-1| h |A| u (|J| |Y| + |f|), Y the stages, rounded arguments of the slope.  That is the limiting
  // accuracy of Newton's iteration (F. Tisseur, SIAM J. Matrix Anal. Appl. 22 (2001) 1038).  Never where it
  // exceeds a quarter of the size of what moves: there the equations determine nothing.
  [[nodiscard]] bool at_rounding(const Real& t, const Real& h) {
    using std::abs;
    const Real u = std::numeric_limits<Real>::epsilon() / 2;
    std::vector<std::vector<Real>> of_slope(s(), std::vector<Real>(n()));
    std::vector<Real> stage(n());
    std::vector<Real> j_of_stage;
    for (std::size_t j = 0; j < s(); ++j) {
      for (std::size_t d = 0; d < n(); ++d) stage[d] = this->state()[d] + z_[j][d];
      jacobian(Real(t + t_.c[j] * h), stage, j_of_stage);
      for (std::size_t d = 0; d < n(); ++d) {
        Real sum = abs(slopes_[j][d]);
        for (std::size_t c = 0; c < n(); ++c) sum += abs(j_of_stage[d * n() + c]) * abs(stage[c]);
        of_slope[j][d] = u * sum;
      }
    }
    std::vector<Real> residual(s() * n());
    for (std::size_t i = 0; i < s(); ++i) {
      for (std::size_t d = 0; d < n(); ++d) {
        Real sum(0);
        for (std::size_t j = 0; j < s(); ++j) sum += abs(t_.a[i][j]) * of_slope[j][d];
        residual[i * n() + d] = abs(h) * sum + u * abs(z_[i][d]);
      }
    }
    const std::vector<Real> size = sizes_of_stages();
    const std::vector<Real> inverse = system_.inverse();
    for (std::size_t k = 0; k < s() * n(); ++k) {
      Real bound(0);
      for (std::size_t c = 0; c < s() * n(); ++c)
        bound += abs(inverse[k * residual.size() + c]) * residual[c];
      if (!(abs(correction_[k]) <= 2 * bound) || !(4 * bound <= size[k % n()])) return false;
    }
    return true;
  }

  // Until the stages' error is below the tolerance, or rounding keeps it from falling on.
  [[nodiscard]] bool iterate(const Real& t, const Real& h) {
    using std::isfinite, std::log, std::sqrt;
    const Real u = std::numeric_limits<Real>::epsilon() / 2;
    // The rate falls behind its first estimate, and errors of many steps add up with one sign.
    const Real wanted = (tolerance_ > u ? tolerance_ : u) / 1024;
    // A decomposition costs about as much as a third of the equations' number of corrections where it is one
    // of the type's own, and about four of them in a narrower type.
    const auto worth = [&] {
      return static_cast<Real>(system_.is_narrow() ? 4 : std::max<std::size_t>(4, s() * n() / 3));
    };
    Real before(0);
    int without_progress = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
      this->stop().check();
      evaluate_stages(t, h);
      const Change moved = correct(h);
      const Real& change = moved.componentwise;
      if (!isfinite(change)) return false;
      if (change == 0) return true;
      if (iteration > 0) {
        const Real rate = change / before;
        if (rate < 1 && change * rate <= wanted * (1 - rate)) return true;
        if (rate > Real(1) / 2) {
          ++without_progress;
          const bool rounding = moved.normwise <= 256 * u;
          // A narrow decomposition that no longer helps may be what keeps the error from falling.
          if (without_progress >= 3 && system_.is_narrow() && !rounding) {
            system_.widen();
            without_progress = 0;
            before = change;
            continue;
          }
          const bool small = change < sqrt(u) / 16 || rounding;
          if (without_progress >= 3 && (small || at_rounding(t, h))) return true;
          // Far from the solution a small component may wander for a while.
          if (without_progress >= 12) return false;
        }
        const bool slow = !(rate < 1) || log(Real(wanted / change)) < worth() * log(rate);
        if (slow) decompose_with_each(t, h);
      }
      before = change;
    }
    return false;
  }

  void finish(const Real& t, const Real& h) {
    this->candidate_.assign(this->state().begin(), this->state().end());
    for (std::size_t d = 0; d < n(); ++d) {
      Real sum(0);
      for (std::size_t i = 0; i < s(); ++i) sum += w_.stages[i] * z_[i][d];
      this->candidate_[d] += sum;
    }
    if (!estimates_) return;
    // h g (I - h g J)^-1 (f(y) - p'(0)), p the collocation polynomial: of order s + 1, and damped where the
    // problem is stiff (Hairer, Wanner IV.8, with any g > 0 in the place of the real eigenvalue).
    const Real g = h / static_cast<Real>(2 * s());
    evaluate_stages(t, h);
    std::vector<Real> slope(n());
    this->problem().slope(t, this->state(), slope);
    std::vector<Real> difference(n());
    std::vector<Real> m(n() * n());
    for (std::size_t d = 0; d < n(); ++d) {
      Real sum = slope[d];
      for (std::size_t j = 0; j < s(); ++j) sum -= w_.at_zero[j] * slopes_[j][d];
      difference[d] = g * sum;
      for (std::size_t c = 0; c < n(); ++c)
        m[d * n() + c] = (d == c ? Real(1) : Real(0)) - g * jacobian_[d * n() + c];
    }
    LuDecomposition<Real> damping;
    damping.decompose(std::move(m), n());
    this->error_ = damping.solve(difference);
  }

  CollocationNodes nodes_;
  const CollocationTableau<Real>& t_;
  const ImplicitWeights<Real>& w_;
  Real tolerance_{0};
  bool estimates_ = true;
  std::vector<Real> jacobian_;
  std::vector<std::vector<Real>> z_;
  std::vector<std::vector<Real>> slopes_;
  StageSystem<Real> system_;
  std::vector<Real> correction_;  // of the stages, the last one
};

}  // namespace ulpgate::ode
