// TrajectoryEngineOf<Real>: TrajectoryEngine over the integrators; included only by the one translation unit
// of each type.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/core/trajectories/trajectory_engine.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace detail {

// Signs from a seed: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
class Signs {
 public:
  explicit Signs(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] int next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return ((z ^ (z >> 31U)) & 1U) != 0 ? 1 : -1;
  }

 private:
  std::uint64_t state_;
};

}  // namespace detail

template <RealType Real>
class TrajectoryEngineOf final : public TrajectoryEngine {
 public:
  TrajectoryEngineOf() : cases_(ode::initial_value_cases<Real>()) {}

  [[nodiscard]] int significand_bits() const override { return std::numeric_limits<Real>::digits; }

  [[nodiscard]] bool applies(std::string_view integrator, std::string_view problem) const override {
    const ode::Problem<Real>& p = find(problem).problem;
    return ode::find_integrator(integrator).kind != ode::IntegratorKind::splitting ||
           static_cast<bool>(p.acceleration);
  }

  using TrajectoryEngine::equal_steps;
  [[nodiscard]] Trajectory equal_steps(std::string_view problem, std::string_view integrator,
                                       std::string_view end, std::uint64_t steps,
                                       const TrajectoryOptions& options,
                                       const ode::StopFlag& stop) const override {
    if (steps < 1) throw std::invalid_argument("a trajectory needs at least one step");
    const Real h = ode::end_time<Real>(end) / static_cast<Real>(steps);
    return run(
        problem, integrator, steps, [&](std::uint64_t) { return h; }, options, stop);
  }

  [[nodiscard]] Trajectory planned_steps(std::string_view problem, std::string_view integrator,
                                         std::string_view end, const StepPlan& plan, int parts,
                                         const TrajectoryOptions& options,
                                         const ode::StopFlag& stop) const override {
    if (parts < 1) throw std::invalid_argument("a planned step is cut into at least one part");
    using Wide = MpfrReal<124>;
    Wide left = ode::end_time<Wide>(end);
    std::vector<Real> steps;
    for (const double h : plan.steps) {
      left -= static_cast<Wide>(h);
      steps.push_back(static_cast<Real>(h));
    }
    steps.push_back(from_mpfr<Real>(left.backend().data()));
    // Exact where the parts are a power of two.
    for (Real& h : steps) h /= static_cast<Real>(parts);
    const auto count = static_cast<std::uint64_t>(parts);
    return run(
        problem, integrator, steps.size() * count, [&](std::uint64_t i) { return steps[i / count]; }, options,
        stop);
  }

 private:
  [[nodiscard]] const ode::InitialValueCase<Real>& find(std::string_view name) const {
    for (const auto& c : cases_) {
      if (c.name == name) return c;
    }
    throw std::invalid_argument("no initial value problem is called '" + std::string(name) + "'");
  }

  // A problem that counts the evaluations of its slope or acceleration.
  [[nodiscard]] static ode::Problem<Real> counting(const ode::Problem<Real>& problem, std::uint64_t& count) {
    ode::Problem<Real> counted = problem;
    counted.slope = [slope = problem.slope, &count](const Real& t, std::span<const Real> y,
                                                    std::span<Real> out) {
      ++count;
      slope(t, y, out);
    };
    if (problem.acceleration) {
      counted.acceleration = [a = problem.acceleration, &count](std::span<const Real> q,
                                                                std::span<Real> out) {
        ++count;
        a(q, out);
      };
    }
    return counted;
  }

  template <class StepSize>
  [[nodiscard]] Trajectory run(std::string_view name, std::string_view integrator, std::uint64_t steps,
                               StepSize&& size_of, const TrajectoryOptions& options,
                               const ode::StopFlag& stop) const {
    const ode::InitialValueCase<Real>& c = find(name);
    Trajectory out;
    InvariantWatch watch(c);
    const auto stepper = ode::make_stepper<Real>(integrator, counting(c.problem, out.evaluations));
    stepper->set_stop(stop);
    out.sizes.assign(stepper->state().size(), 0);
    detail::Signs signs(options.seed);
    const Real perturbation = static_cast<Real>(options.perturbation);
    Real t(0);
    try {
      for (std::uint64_t i = 0; i < steps; ++i) {
        stop.check();
        const Real h = size_of(i);
        stepper->advance(t, h);
        t += h;
        if (options.perturbation != 0) perturb(*stepper, perturbation, signs);
        out.steps = i + 1;
        if (!look_at(stepper->state(), out)) return out;
        watch.look(stepper->state());
        keep_checkpoint(stepper->state(), steps, options, out);
      }
    } catch (const std::runtime_error& e) {
      out.refusal = e.what();
      return out;
    }
    out.state = texts(stepper->state());
    watch.tell(out);
    return out;
  }

  static void perturb(ode::Stepper<Real>& stepper, const Real& by, detail::Signs& signs) {
    std::vector<Real> state(stepper.state().begin(), stepper.state().end());
    for (Real& x : state) x += static_cast<Real>(signs.next()) * by * x;
    const auto memory = stepper.memory();
    stepper.restore(std::move(state), memory.value_or(std::vector<Real>()));
  }

  // Sizes of the components; false where the state has left the numbers.
  [[nodiscard]] static bool look_at(std::span<const Real> state, Trajectory& out) {
    using std::abs, std::isfinite;
    for (std::size_t i = 0; i < state.size(); ++i) {
      if (!isfinite(state[i])) {
        out.finite = false;
        out.first_not_finite = out.steps;
        return false;
      }
      out.sizes[i] = std::max(out.sizes[i], static_cast<double>(Real(abs(state[i]))));
    }
    return true;
  }

  static void keep_checkpoint(std::span<const Real> state, std::uint64_t steps,
                              const TrajectoryOptions& options, Trajectory& out) {
    if (std::ranges::binary_search(options.behind, out.steps)) out.checkpoints.push_back(texts(state));
    const auto wanted = static_cast<std::uint64_t>(options.checkpoints);
    if (wanted == 0) return;
    // Behind step k of n where floor(k wanted / n) goes up.
    if (out.steps * wanted / steps != (out.steps - 1) * wanted / steps)
      out.checkpoints.push_back(texts(state));
  }

  [[nodiscard]] static std::vector<std::string> texts(std::span<const Real> state) {
    std::vector<std::string> out;
    for (const Real& x : state) out.push_back(to_hexfloat(x));
    return out;
  }

  // How far the conserved quantity has moved.
  class InvariantWatch {
   public:
    explicit InvariantWatch(const ode::InitialValueCase<Real>& c) : c_(c) {
      if (c_.invariant) start_ = c_.invariant(c_.problem.start);
    }
    void look(std::span<const Real> state) {
      using std::abs;
      if (!c_.invariant) return;
      const Real moved = abs(c_.invariant(state) - start_);
      last_ = static_cast<double>(start_ == 0 ? moved : Real(moved / abs(start_)));
      if (!(last_ <= largest_)) largest_ = last_;
    }
    void tell(Trajectory& out) const {
      if (!c_.invariant) return;
      out.largest_invariant_error = largest_;
      out.final_invariant_error = last_;
    }

   private:
    const ode::InitialValueCase<Real>& c_;
    Real start_{0};
    double last_ = 0;
    double largest_ = 0;
  };

  std::vector<ode::InitialValueCase<Real>> cases_;
};

}  // namespace ulpgate
