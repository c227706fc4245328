// FunctionSubject<Real>: a math function in one Real type as a subject; instantiated in one translation unit
// per type.
#pragma once

#include <algorithm>
#include <chrono>

#include "harness/core/arguments/sampling.hpp"
#include "harness/core/functions/calls_in_hand.hpp"
#include "harness/core/functions/narrow_scan.hpp"
#include "harness/core/functions/subject_call.hpp"
#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/math/function_table.hpp"
#include "kernels/math/implementation.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

// One in this many samples is also evaluated with the family's RealHP<4>, chosen by its index: of a large row
// fewer, since it costs hundreds of times the sample.
[[nodiscard]] constexpr std::uint64_t oracle_stride(const StratumSource& source) {
  constexpr std::uint64_t small_row = std::uint64_t{1} << 18U;
  constexpr std::uint64_t large_row = std::uint64_t{1} << 22U;
  if (source.count > large_row) return 65537;
  return source.count <= small_row ? 251 : 16381;
}
// The oracles agree when they differ by less than this, in ULP of Real; both carry some 3 p bits more than
// Real.
inline constexpr double oracle_tolerance_ulp = 0x1p-16;

[[nodiscard]] SubjectInfo subject_info(const FunctionInfo& f, RealFamily family);

template <RealType Real>
class FunctionSubject final : public Subject {
 public:
  using Reference = RealHP<4, Real>;

  // `evaluate` is the code under test, `family` the same function in RealHP<4>.
  FunctionSubject(const RealDescriptor& type, const FunctionInfo& f, BatchFunction<Real> evaluate,
                  BatchFunction<Reference> family)
      : Subject(subject_info(f, family_of<Real>()), type), function_(f), call_(evaluate), family_(family) {}

  // `code` is under test, and `info` says whose it is.
  FunctionSubject(const RealDescriptor& type, const FunctionInfo& f, SubjectInfo info, const BatchCode& code,
                  BatchFunction<Reference> family)
      : Subject(std::move(info), type), function_(f), call_(code), family_(family) {}

  [[nodiscard]] BatchFunction<Real> call() const { return call_; }

  [[nodiscard]] std::unique_ptr<Subject> with_code(const BatchCode& code,
                                                   const CodeNames& names) const override {
    // Of other types the bytes are no value that another process could know.
    if constexpr (NativeReal<Real> || Float128Backed<Real>) {
      SubjectInfo info = this->info();
      info.implementation = names.implementation;
      info.claimed_ulp = names.claimed_ulp;
      info.selection = names.selection;
      info.code_facts = names.facts;
      return std::make_unique<FunctionSubject>(type(), function_, std::move(info), code, family_);
    } else {
      return nullptr;
    }
  }

  [[nodiscard]] ArgumentList listed(Stratum s) const override {
    if (s == Stratum::edges) return edge_arguments(function_, type().format);
    if (s == Stratum::hard) return hard_arguments(function_, type().format);
    return {};
  }
  [[nodiscard]] bool can_exhaust() const override {
    return std::same_as<Real, float> && function_.function_class == FunctionClass::real &&
           function_.arity == 1;
  }

  [[nodiscard]] std::size_t narrow_arguments() const override {
    return has_narrow_scan<Real> ? narrow_block(function_, std::same_as<Real, float>) : 0;
  }

  [[nodiscard]] std::vector<Summary> evaluate(const StratumSource& source, std::uint64_t first,
                                              std::uint64_t last, ReferenceMode mode,
                                              RowHint& hint) const override {
    if (mode == ReferenceMode::screened) preview(source, first, last, hint);
    RowTally<Real> tally(function_, hint);
    if (mode == ReferenceMode::full) {
      FullJudging<Real> judging(function_);
      run(source, first, last, judging, tally);
      hint.decided[static_cast<std::size_t>(Stage::full)] += last - first;
    } else {
      using Judging = ScreenedJudging<Real>;
      Judging judging(function_, source.stratum == Stratum::exhaustive ? Judging::exhaustive_check_stride
                                                                       : Judging::check_stride);
      run(source, first, last, judging, tally);
      for (std::size_t s = 0; s < stage_count; ++s) hint.decided[s] += judging.decided()[s];
    }
    return tally.take();
  }

  [[nodiscard]] Point point(const StratumSource& source, std::uint64_t k) const override {
    std::vector<Real> args(static_cast<std::size_t>(function_.arity));
    ScannedArguments<Real>(function_, source, call_).make_all(k, 1, args.data());
    return describe_point(args);
  }
  [[nodiscard]] Point point(const std::vector<MpfrValue>& values) const override {
    std::vector<Real> args;
    args.reserve(values.size());
    for (const auto& v : values) args.push_back(from_mpfr<Real>(v));
    return describe_point(args);
  }

  [[nodiscard]] TimedBatch timed_batch(std::size_t count) const override {
    std::vector<Real> args(count * static_cast<std::size_t>(function_.arity));
    std::vector<Real> results(count * static_cast<std::size_t>(function_.parts));
    Arguments<Real>(function_, {Stratum::uniform, 1, count, nullptr}).make_all(0, count, args.data());
    return [call = call_, args, results, threw = std::vector<std::uint8_t>(count)](std::size_t n,
                                                                                   int rounds) mutable {
      if (call.code() != nullptr) return call.code()->call(args.data(), results.data(), n, rounds);
      using Clock = std::chrono::steady_clock;
      const auto start = Clock::now();
      for (int i = 0; i < rounds; ++i) {
        Heartbeat::mine().beat(WorkPhase::none);
        call(args.data(), results.data(), threw.data(), n);
      }
      return std::chrono::duration<double>(Clock::now() - start).count();
    };
  }

 private:
  // Tells the hint of a row of which nothing is known the largest error of a few points all over the run.
  // Where a function is next to a constant all errors are tiny, and each would climb for being the maximum;
  // of a stratified row, which is sorted, that may be all of a unit.
  void preview(const StratumSource& source, std::uint64_t first, std::uint64_t last, RowHint& hint) const {
    constexpr std::uint64_t points = 32;
    if (RowTally<Real>(function_, hint).knows_maxima() || last - first < 8 * points) return;
    // The run's units meet these points again and count them then, which goes for their conditions as well.
    const std::vector<RowHint::Range> unit = {{first, last}};
    const std::vector<RowHint::Range>& ranges = hint.ranges.empty() ? unit : hint.ranges;
    std::uint64_t count = 0;
    for (const auto& range : ranges) count += range.last - range.first;
    const auto parts = static_cast<std::size_t>(function_.parts);
    RowHint found(parts);
    RowTally<Real> tally(function_, found);
    ScreenedJudging<Real> judging(function_);
    auto range = ranges.begin();
    std::uint64_t before = 0;  // samples of the ranges before this one
    for (std::uint64_t j = 0; j < points; ++j) {
      const std::uint64_t position = count * (2 * j + 1) / (2 * points);
      for (; position - before >= range->last - range->first; ++range) before += range->last - range->first;
      const std::uint64_t k = range->first + (position - before);
      run(source, k, k + 1, judging, tally);
    }
    static_cast<void>(tally.take());
    for (std::size_t part = 0; part < parts; ++part) hint.raise_max_error(part, found.max_error(part));
  }

  // All buffers are those of the batch: nothing is allocated a sample, and the one indirect call is a
  // batch's.
  template <class JudgingOfUnit>
  void run(const StratumSource& source, std::uint64_t first, std::uint64_t last, JudgingOfUnit& judging,
           RowTally<Real>& tally) const {
    constexpr std::size_t batch_size = 256;
    const FunctionInfo& f = function_;
    const auto arity = static_cast<std::size_t>(f.arity);
    const auto parts = static_cast<std::size_t>(f.parts);
    ScannedArguments<Real> arguments(f, source, call_);
    // Other code is asked for as many points as suit it, whatever is known: its results may depend on that.
    const std::size_t block = call_.code() != nullptr ? call_.code()->batch() : batch_size;
    std::vector<Real> args(block * arity);
    std::vector<Real> results(block * parts);
    std::vector<std::uint8_t> threw(block);
    const CallsInHand<Real> calls(f, call_, args);
    const HandScope hand(calls);
    Heartbeat& heart = Heartbeat::mine();
    const std::uint64_t stride = oracle_stride(source);
    // Nothing is known yet of a row's maxima: small batches find them before many samples climb for being
    // one.
    std::size_t most = tally.knows_maxima() ? batch_size : 4;
    const auto judge = [&](std::uint64_t k, std::size_t from, std::size_t n) {
      heart.beat(WorkPhase::references, n);
      judging.judge(
          Batch<Real>{
              f, {&args[from * arity], n * arity}, {&results[from * parts], n * parts}, {&threw[from], n}, k},
          tally);
      for (std::size_t i = (stride - k % stride) % stride; i < n; i += stride) {
        heart.beat(WorkPhase::reference, from + i);
        compare_oracles(&args[(from + i) * arity], k + i, tally);
      }
    };
    std::size_t n = 0;
    for (std::uint64_t k = first; k < last; k += n) {
      n = std::min<std::uint64_t>(call_.code() != nullptr ? block : most, last - k);
      arguments.make_all(k, n, args.data());
      std::fill(threw.begin(), threw.end(), std::uint8_t{0});
      heart.beat(WorkPhase::calls, n);
      call_(args.data(), results.data(), threw.data(), n);
      for (std::size_t from = 0; from < n; most = std::min(2 * most, batch_size)) {
        const std::size_t some = std::min(most, n - from);
        judge(k + from, from, some);
        from += some;
      }
    }
  }

  void compare_oracles(const Real* args, std::uint64_t k, RowTally<Real>& tally) const {
    const FunctionInfo& f = function_;
    const auto parts = static_cast<std::size_t>(f.parts);
    std::vector<Reference> wide;
    wide.reserve(static_cast<std::size_t>(f.arity));
    for (int j = 0; j < f.arity; ++j) wide.push_back(widen<Reference>(args[j]));
    std::vector<Reference> family(parts);
    std::uint8_t threw = 0;
    family_(wide.data(), family.data(), &threw, 1);
    const auto values = exact_arguments(f, args);
    std::vector<MpfrValue> exact;
    for (std::size_t j = 0; j < parts; ++j) exact.emplace_back(type().reference_bits);
    exact_value(f, values, exact);
    MpfrValue other(type().reference_bits);
    for (std::size_t j = 0; j < parts; ++j) {
      OracleComparison& comparison = tally.oracle(j);
      ++comparison.compared;
      to_mpfr(other.get(), family[j]);
      // Beyond Real's range both mean the same: compare what Real would make of them.
      const bool in_range =
          mpfr_zero_p(exact[j].get()) != 0 ||
          (mpfr_regular_p(exact[j].get()) && binade(exact[j]) <= type().format.exponent_max &&
           binade(exact[j]) >= type().format.exponent_least());
      if (!in_range) {
        round_to_format(other, type().format);
        round_to_format(exact[j], type().format);
      }
      double difference = std::numeric_limits<double>::infinity();
      if (threw != 0) {
        // No value at all: the largest difference there is.
      } else if (mpfr_number_p(other.get()) && mpfr_number_p(exact[j].get())) {
        difference = ulp_error(other, exact[j], type().format).value;
      } else if ((mpfr_nan_p(other.get()) && mpfr_nan_p(exact[j].get())) ||
                 (mpfr_inf_p(other.get()) && mpfr_equal_p(other.get(), exact[j].get()))) {
        difference = 0;
      }
      comparison.difference.add(difference, k);
      if (difference > oracle_tolerance_ulp) ++comparison.disagreed;
    }
  }

  [[nodiscard]] Point describe_point(const std::vector<Real>& args) const {
    const FunctionInfo& f = function_;
    const auto parts = static_cast<std::size_t>(f.parts);
    std::vector<Real> results(parts);
    std::uint8_t threw = 0;
    const CallsInHand<Real> calls(f, call_, args);
    const HandScope hand(calls);
    Heartbeat::mine().beat(WorkPhase::calls, 1);
    call_(args.data(), results.data(), &threw, 1);
    const Batch<Real> batch{f, args, results, {&threw, 1}};
    FullJudging<Real> judging(f);
    judging.load(batch, 0);
    const auto values = exact_arguments(f, args.data());
    std::vector<MpfrValue> exact;
    for (std::size_t j = 0; j < parts; ++j) exact.emplace_back(type().reference_bits);
    exact_value(f, values, exact);
    Point p;
    for (const auto& x : args) {
      p.args_hex.push_back(to_hexfloat(x));
      p.args_decimal.push_back(to_decimal(x));
    }
    const int digits = std::max(30, type().decimal_places + 5);
    for (std::size_t j = 0; j < parts; ++j) {
      const bool none = threw != 0;
      const std::string why(none ? name_of(outcome_without_value(threw)) : "");
      p.parts.push_back({{none ? why : to_hexfloat(results[j])},
                         {none ? why : to_decimal(results[j])},
                         {to_decimal(exact[j].get(), digits)},
                         judging.judgement(batch, 0, j),
                         {},
                         condition_number(f, values, static_cast<int>(j), type().format.precision)});
    }
    return p;
  }

  const FunctionInfo& function_;
  BatchFunction<Real> call_;
  BatchFunction<Reference> family_;
};

template <RealType Real>
BatchFunction<Real> call_of(const Subject& subject) {
  return dynamic_cast<const FunctionSubject<Real>&>(subject).call();
}

// Every function of functions.def as a subject in Real.
template <RealType Real>
void add_functions(SubjectList& list, const RealDescriptor& type) {
  const auto& table = function_table<Real>();
  const auto& family = function_table<RealHP<4, Real>>();
  for (const auto& f : all_functions()) {
    const auto i = static_cast<std::size_t>(f.id);
    list.push_back(std::make_unique<FunctionSubject<Real>>(type, f, table[i], family[i]));
  }
}

}  // namespace ulpgate
