// LadderOf<Real>: the errors of an integrator at doubling numbers of steps; a piece is a rung.
#pragma once

#include <algorithm>
#include <cmath>

#include "harness/core/orders/order_engine.hpp"
#include "harness/core/orders/piece_text.hpp"
#include "kernels/ode/integrators/error_ladder.hpp"

namespace ulpgate {

template <RealType Real>
class LadderOf final : public LadderMeasurement {
 public:
  // `solved` must outlive the measurement.
  LadderOf(std::string_view integrator, const ode::SolvedProblem<Real>& solved, long most_steps)
      : integrator_(integrator), solved_(solved), most_steps_(most_steps) {
    using std::ldexp;
    const auto order = ode::find_integrator(integrator).order;
    const int exponent = interval_exponent(order, most_steps);
    t_ = ldexp(Real(1), exponent);
    ladder_.t_end = static_cast<double>(t_);
    // Two rungs below the floor end the ladder: where (t/n)^p t meets it, and the next.
    const double p = order.value_or(1);
    const double octaves = ((p + 1) * exponent + std::numeric_limits<Real>::digits - 12) / p;
    expected_last_ =
        octaves < 40 ? std::min(most_steps, 2L << std::max(0L, std::lround(octaves))) : most_steps;
  }

  [[nodiscard]] bool complete() const override { return refusal() || below_ >= 2 || steps_ > most_steps_; }
  [[nodiscard]] const OrderLadder& ladder() const override { return ladder_; }
  [[nodiscard]] std::uint64_t steps_done() const override { return static_cast<std::uint64_t>(steps_ - 1); }
  [[nodiscard]] std::uint64_t expected_steps_left() const override {
    if (complete()) return 0;
    return static_cast<std::uint64_t>(std::max(steps_, 2 * expected_last_ - steps_));
  }

 protected:
  [[nodiscard]] std::string measure_piece(long /*steps*/, const ode::StopFlag& stop) override {
    const std::string steps = std::to_string(steps_);
    try {
      const Real error = ode::error_at(integrator_, solved_, t_, steps_, stop);
      add(error);
      return steps + " " + to_hexfloat(error);
    } catch (const std::runtime_error& e) {
      leave_out(e.what());
      return steps + " " + std::string(left_out) + e.what();
    }
  }
  [[nodiscard]] bool take_piece(std::string_view piece) override {
    const auto space = piece.find(' ');
    if (space == std::string_view::npos || count_of(piece.substr(0, space)) != steps_) return false;
    const auto rest = piece.substr(space + 1);
    if (rest.starts_with(left_out)) {
      leave_out(rest.substr(left_out.size()));
    } else {
      add(parse_real<Real>(rest));
    }
    return true;
  }

 private:
  static constexpr std::string_view left_out = "left out: ";

  // A step that is too large for the method is none of the ladder's; only all of them are a refusal.
  void leave_out(std::string_view why) {
    steps_ *= 2;
    before_ = Real(0);
    if (steps_ > most_steps_ && ladder_.rungs.empty()) refuse(why);
  }

  void add(const Real& error) {
    using std::isfinite, std::log2;
    OrderRung rung{
        steps_, static_cast<double>(t_) / static_cast<double>(steps_), static_cast<double>(error), {}};
    // An error that is no number is neither above the floor nor at it.
    const bool finite = isfinite(error);
    if (finite && before_ > 0 && error > 0) rung.order = static_cast<double>(log2(Real(before_ / error)));
    // The floor of rounding is highest where weights are large and of both signs, as in extrapolation.
    const bool above = error >= 4096 * std::numeric_limits<Real>::epsilon();
    if (above && rung.order) ladder_.measured_order = rung.order;
    if (finite && !above) ++below_;
    ladder_.rungs.push_back(rung);
    before_ = finite ? error : Real(0);
    steps_ *= 2;
  }

  // Of two: 0 for the unit interval.
  static int interval_exponent(std::optional<int> order, long most_steps) {
    if (!order) return 0;
    const double p = *order;
    const double floor = 6 - std::numeric_limits<Real>::digits;
    const double reached = p * (std::log2(static_cast<double>(most_steps)) - 1);
    return std::min(0, static_cast<int>(std::lround((floor + reached) / (p + 1))));
  }

  std::string integrator_;
  const ode::SolvedProblem<Real>& solved_;
  long most_steps_;
  long expected_last_ = 0;
  Real t_{0};
  long steps_ = 1;  // of the next rung
  int below_ = 0;
  Real before_{0};
  OrderLadder ladder_;
};

}  // namespace ulpgate
