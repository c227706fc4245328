// KernelSubject<Real>: a DEM kernel in one Real type as a subject; instantiated in one translation unit per
// type.
#pragma once

#include <chrono>
#include <cmath>

#include "harness/core/kernels/kernel_states.hpp"
#include "harness/core/subject/registry.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "kernels/dem/formulas/safe_range.hpp"
#include "kernels/dem/table/kernel_table.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

// Normwise condition number of a quantity f with respect to componentwise perturbations of its inputs
// (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 1.6 and 3.1): sum over the inputs x of
// max |f(x (1 +- h)) - f(x)| / (h |f(x)|), h = 32 units of roundoff.  A finite h on purpose: where a branch
// lies within a few roundings of the state, the jump across it belongs to the condition of the problem, not
// to the kernel.

[[nodiscard]] SubjectInfo subject_info(const dem::KernelInfo& kernel);

template <RealType Real>
class KernelSubject final : public Subject {
 public:
  using Reference = RealHP<4, Real>;

  // `evaluate` is the code under test, `reference` the same kernel in RealHP<4>.
  KernelSubject(const RealDescriptor& type, const dem::KernelInfo& kernel, dem::BatchKernel<Real> evaluate,
                dem::BatchKernel<Reference> reference)
      : Subject(subject_info(kernel), type), kernel_(kernel), call_(evaluate), reference_(reference) {}

  [[nodiscard]] ArgumentList listed(Stratum) const override { return {}; }
  [[nodiscard]] bool can_exhaust() const override { return false; }
  [[nodiscard]] std::size_t narrow_arguments() const override { return 0; }

  // The reference is RealHP<4> alone: there is nothing to screen with.
  [[nodiscard]] std::vector<Summary> evaluate(const StratumSource& source, std::uint64_t first,
                                              std::uint64_t last, ReferenceMode,
                                              RowHint& hint) const override {
    const States<Real> states(kernel_, source);
    Evaluation e(*this);
    const HandScope hand(e);
    std::vector<Summary> summaries(kernel_.outputs.size());
    for (std::uint64_t k = first; k < last; ++k) {
      states.make(k, e.inputs.data());
      e.run();
      for (std::size_t q = 0; q < summaries.size(); ++q) {
        Judgement judgement = e.judge(q);
        judgement.error = recorded(judgement.error);
        summaries[q].add(judgement, k);
        if (judgement.outcome != Outcome::finite) continue;
        const double error = recorded({e.normwise_error(q)}).value;
        summaries[q].normwise.add(error, k);
        // A result that is right to a rounding cannot be unstable; a smaller error cannot raise the quotient.
        if (error <= 1 || error < hint.error_over_condition[q].load(std::memory_order_relaxed)) continue;
        const double condition = e.condition(q);
        double ratio = condition > 1 ? error / condition : error;
        if (ratio != ratio) ratio = 0;  // infinite error at infinite condition says nothing
        summaries[q].max_error_over_condition = std::max(summaries[q].max_error_over_condition, ratio);
        hint.raise_error_over_condition(q, ratio);
      }
    }
    return summaries;
  }

  [[nodiscard]] Point point(const StratumSource& source, std::uint64_t k) const override {
    Evaluation e(*this);
    States<Real>(kernel_, source).make(k, e.inputs.data());
    return describe_point(e);
  }
  [[nodiscard]] Point point(const std::vector<MpfrValue>& inputs) const override {
    Evaluation e(*this);
    for (std::size_t i = 0; i < inputs.size(); ++i) e.inputs[i] = from_mpfr<Real>(inputs[i]);
    return describe_point(e);
  }

  [[nodiscard]] TimedBatch timed_batch(std::size_t count) const override {
    std::vector<Real> inputs(count * kernel_.input_components());
    std::vector<Real> results(count * kernel_.output_components());
    const States<Real> states(kernel_, {Stratum::typical, 1, count, nullptr});
    for (std::size_t i = 0; i < count; ++i) states.make(i, &inputs[i * kernel_.input_components()]);
    return [call = call_, inputs, results, threw = std::vector<std::uint8_t>(count)](std::size_t n,
                                                                                     int rounds) mutable {
      using Clock = std::chrono::steady_clock;
      const auto start = Clock::now();
      for (int i = 0; i < rounds; ++i) {
        Heartbeat::mine().beat(WorkPhase::none);
        call(inputs.data(), results.data(), threw.data(), n);
      }
      return std::chrono::duration<double>(Clock::now() - start).count();
    };
  }

 private:
  // One kernel in one state: inputs, results and reference, with buffers that are used again for the next
  // state.
  struct Evaluation final : WorkInHand {
    explicit Evaluation(const KernelSubject& subject)
        : kernel(subject.kernel_),
          inputs(kernel.input_components()),
          results(kernel.output_components()),
          exact(kernel.output_components()),
          subject_(subject),
          wide_(kernel.input_components()),
          shifted_(kernel.input_components()),
          moved_(kernel.output_components()),
          got_(std::numeric_limits<Real>::digits),
          true_(std::numeric_limits<Reference>::digits) {
      std::size_t at = 0;
      for (const auto& q : kernel.outputs) {
        first_.push_back(at);
        at += q.components;
      }
    }

    [[nodiscard]] std::size_t count() const override { return 1; }
    [[nodiscard]] std::string arguments(std::size_t) const override {
      std::string text;
      for (const auto& x : inputs) text += (text.empty() ? "" : " ") + to_hexfloat(x);
      return text;
    }
    void repeat(std::size_t) const override {
      auto again = results;
      std::uint8_t threw = 0;
      subject_.call_(inputs.data(), again.data(), &threw, 1);
    }

    void run() {
      threw_ = 0;
      Heartbeat::mine().beat(WorkPhase::calls, 1);
      subject_.call_(inputs.data(), results.data(), &threw_, 1);
      Heartbeat::mine().beat(WorkPhase::reference);
      for (std::size_t i = 0; i < inputs.size(); ++i) wide_[i] = widen<Reference>(inputs[i]);
      std::uint8_t reference_threw = 0;
      subject_.reference_(wide_.data(), exact.data(), &reference_threw, 1);
      if (reference_threw != 0) threw_ = 1;
    }

    // The worst component: a mismatch, or else the largest error.
    Judgement judge(std::size_t q) {
      if (threw_ != 0) return {Outcome::exception, {}, 0, false};
      Judgement worst;
      for (std::size_t i = first_[q]; i < first_[q] + kernel.outputs[q].components; ++i) {
        const Judgement j = judge_component(i);
        if (j.outcome != Outcome::finite) return j;
        worst.correctly_rounded = worst.correctly_rounded && j.correctly_rounded;
        worst.distance = std::max(worst.distance, j.distance);
        worst.error = std::max(worst.error, j.error);
      }
      return worst;
    }

    // |got - exact| / |exact| in units of 2^-p; 0 where both are 0, infinite where only the exact one is.
    double normwise_error(std::size_t q) {
      const int unit = unit_exponent(q);
      return scaled_root(distance2(results, q, unit), norm2(q, unit), std::numeric_limits<Real>::digits);
    }

    double condition(std::size_t q) {
      using std::ldexp;
      constexpr int step_exponent = 5 - std::numeric_limits<Real>::digits;
      const int unit = unit_exponent(q);
      const Reference norm = norm2(q, unit);
      double sum = 0;
      shifted_ = wide_;
      for (std::size_t j = 0; j < wide_.size(); ++j) {
        if (wide_[j] == 0) continue;
        double largest = 0;
        for (const int direction : {1, -1}) {
          shifted_[j] = wide_[j] + ldexp(Reference(direction * wide_[j]), step_exponent);
          std::uint8_t threw = 0;
          subject_.reference_(shifted_.data(), moved_.data(), &threw, 1);
          if (threw != 0) return std::numeric_limits<double>::infinity();
          largest = std::max(largest, scaled_root(distance2(moved_, q, unit), norm, -step_exponent));
        }
        shifted_[j] = wide_[j];
        sum += largest;
      }
      return sum;
    }

    const dem::KernelInfo& kernel;
    std::vector<Real> inputs;
    std::vector<Real> results;
    std::vector<Reference> exact;

   private:
    Judgement judge_component(std::size_t i) {
      to_mpfr(got_.get(), results[i]);
      to_mpfr(true_.get(), exact[i]);
      Judgement j = ulpgate::judge(got_, true_, descriptor_format());
      // The sign of a zero moves nothing; a value that cancels to zero is a large error, not a lost exponent.
      if (j.outcome == Outcome::zero_sign) return {};
      if (j.outcome == Outcome::underflow_spurious) {
        j = {Outcome::finite, ulp_error(got_, true_, descriptor_format()), 0, false};
        round_to_format(true_, descriptor_format());
        j.distance = float_distance(got_, true_, descriptor_format());
      }
      return j;
    }

    static constexpr FloatFormat descriptor_format() { return float_format<Real>(); }

    // Of the largest exact component of a quantity.  Squares are taken in units of 2^exponent: a reference
    // that reaches no further than the type has none of its largest numbers.
    [[nodiscard]] int unit_exponent(std::size_t q) const {
      using std::abs;
      using std::frexp;
      Reference largest(0);
      for (std::size_t i = first_[q]; i < first_[q] + kernel.outputs[q].components; ++i) {
        if (abs(exact[i]) > largest) largest = abs(exact[i]);
      }
      int exponent = 0;
      if (largest > 0 && largest <= dem::largest_number<Reference>()) (void)frexp(largest, &exponent);
      return exponent;
    }

    // |values - exact|^2 over the components of a quantity.
    template <class Value>
    Reference distance2(const std::vector<Value>& values, std::size_t q, int unit) const {
      using std::ldexp;
      Reference sum(0);
      for (std::size_t i = first_[q]; i < first_[q] + kernel.outputs[q].components; ++i) {
        const Reference d = ldexp(Reference(widen<Reference>(values[i]) - exact[i]), -unit);
        sum += d * d;
      }
      return sum;
    }
    Reference norm2(std::size_t q, int unit) const {
      using std::ldexp;
      Reference sum(0);
      for (std::size_t i = first_[q]; i < first_[q] + kernel.outputs[q].components; ++i) {
        const Reference x = ldexp(exact[i], -unit);
        sum += x * x;
      }
      return sum;
    }

    // sqrt(a/b) 2^exponent as a double.
    static double scaled_root(const Reference& a, const Reference& b, int exponent) {
      using std::ldexp;
      using std::sqrt;
      if (a == 0) return 0;
      if (b == 0) return std::numeric_limits<double>::infinity();
      return static_cast<double>(Reference(ldexp(Reference(sqrt(Reference(a / b))), exponent)));
    }

    const KernelSubject& subject_;
    std::vector<Reference> wide_;
    std::vector<Reference> shifted_;
    std::vector<Reference> moved_;
    std::vector<std::size_t> first_;
    MpfrValue got_;
    MpfrValue true_;
    std::uint8_t threw_ = 0;

    friend class KernelSubject;
  };

  [[nodiscard]] static Point describe_point(Evaluation& e) {
    const HandScope hand(e);
    e.run();
    Point p;
    for (const auto& x : e.inputs) {
      p.args_hex.push_back(to_hexfloat(x));
      p.args_decimal.push_back(to_decimal(x));
    }
    for (std::size_t q = 0; q < e.kernel.outputs.size(); ++q) {
      PointPart& part = p.parts.emplace_back();
      part.judgement = e.judge(q);
      part.normwise_error = 0;
      if (e.threw_ != 0) continue;
      part.normwise_error = e.normwise_error(q);
      part.condition = e.condition(q);
      for (std::size_t i = e.first_[q]; i < e.first_[q] + e.kernel.outputs[q].components; ++i) {
        part.got_hex.push_back(to_hexfloat(e.results[i]));
        part.got_decimal.push_back(to_decimal(e.results[i]));
        to_mpfr(e.true_.get(), e.exact[i]);
        part.exact_decimal.push_back(to_decimal(e.true_.get(), 30));
      }
    }
    return p;
  }

  const dem::KernelInfo& kernel_;
  dem::BatchKernel<Real> call_;
  dem::BatchKernel<Reference> reference_;
};

// Every kernel of kernels.def as a subject in Real.
template <RealType Real>
void add_kernels(SubjectList& list, const RealDescriptor& type) {
  const auto& table = dem::kernel_table<Real>();
  const auto& reference = dem::kernel_table<RealHP<4, Real>>();
  for (const auto& kernel : dem::all_kernels()) {
    const auto i = static_cast<std::size_t>(kernel.id);
    list.push_back(std::make_unique<KernelSubject<Real>>(type, kernel, table[i], reference[i]));
  }
}

}  // namespace ulpgate
