// ScreenedJudging<Real>: cheap references with proven bounds first; what a stage cannot settle climbs to the
// next, at the end to the full reference, and a fixed share is always checked against it.
#pragma once

#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include "harness/core/judging/judging.hpp"
#include "harness/core/stages/native_stage.hpp"
#include "harness/core/stages/triple_stage.hpp"
#include "reference/double_double/double_double_functions.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

// The stages before the full reference; tests plant wrong ones.
struct ScreenStages {
  BoundedFunction<double> binary64 = nullptr;
  BoundedFunction<long double> x87_extended = nullptr;
  BoundedFunction<DoubleDouble> double_double = nullptr;
#ifdef ULPGATE_HAVE_FLOAT128
  BoundedFunction<Binary128> binary128 = nullptr;
#endif
  TripleDoubleFunction triple_double = nullptr;
  ExactFunction mpfr = exact_value;
};

// The stages of f: functions of native types where they have trusted bounds.
[[nodiscard]] inline ScreenStages screen_stages(const FunctionInfo& f) {
  ScreenStages stages;
  stages.double_double = double_double_function(f.id);
  if (f.function_class != FunctionClass::real) {
    if constexpr (std::numeric_limits<long double>::digits == 64)
      stages.x87_extended = extended_function<long double>(f.id);
#ifdef ULPGATE_HAVE_FLOAT128
    stages.binary128 = extended_function<Binary128>(f.id);
#endif
    return stages;
  }
  stages.binary64 = bounded_function<double>(f.id);
  if constexpr (std::numeric_limits<long double>::digits == 64)
    stages.x87_extended = bounded_function<long double>(f.id);
#ifdef ULPGATE_HAVE_FLOAT128
  stages.binary128 = bounded_function<Binary128>(f.id);
#endif
  stages.triple_double = triple_double_function(f.id);
  return stages;
}

// One object per unit of work.
template <RealType Real>
class ScreenedJudging {
 public:
  // The MPFR stage is within one ulp of its own precision of the exact value (oracle.hpp).
  static constexpr long stage_bits = std::numeric_limits<Real>::digits + 32;
  static constexpr std::uint64_t check_stride = 1024;
  // Of all floats: 2^18 of them.
  static constexpr std::uint64_t exhaustive_check_stride = 16 * check_stride;
  // Of the checked samples most go to the full reference at once, these through all stages, so that those
  // which are rarely reached are held to their bounds as well.
  static constexpr std::uint64_t deep_checks = 16;
  static constexpr std::uint64_t deep_check_stride = deep_checks * check_stride;

  // Checks every `stride`-th sample.
  explicit ScreenedJudging(const FunctionInfo& f, std::uint64_t stride = check_stride)
      : ScreenedJudging(f, screen_stages(f), stride) {}
  ScreenedJudging(const FunctionInfo& f, const ScreenStages& stages, std::uint64_t stride = check_stride)
      : parts_(static_cast<std::size_t>(f.parts)),
        natives_(native_stages(f.id, stages)),
        stage_(f, stage_bits, stages.mpfr),
        full_(f),
        stride_(stride) {}

  // Throws ReferenceDisagreement.
  void judge(const Batch<Real>& batch, RowTally<Real>& tally) {
    checks_.clear();
    spared_.clear();
    pending_.resize(batch.count());
    if (!may_scan(batch)) std::iota(pending_.begin(), pending_.end(), std::size_t{0});
    std::apply([&](auto&... stages) { (judge_natively(stages, batch, tally), ...); }, natives_);
    // What the full reference finds spares the samples behind it from being a maximum.
    for (const std::size_t i : pending_) {
      if (!judge_by_mpfr(batch, i, tally)) judge_in_full(batch, i, tally);
    }
    for (const std::size_t i : spared_) judge_in_full(batch, i, tally);
  }

  // Samples that each stage decided so far.
  [[nodiscard]] const std::array<std::uint64_t, stage_count>& decided() const { return decided_; }

 private:
  // Stages that settle the ordinary samples of a whole batch many at a time, where they are the first.
  template <class Native>
  static constexpr bool scans = std::same_as<Native, NativeStage<float, double, Stage::binary64>> ||
                                std::same_as<Native, NativeStage<double, DoubleDouble, Stage::double_double>>;

  // What a stage would have decided of a sample that goes to the full reference in any case.
  struct Check {
    std::size_t i;
    Stage stage;
    std::array<Finding, max_parts> findings;
  };

  static auto x87_stage([[maybe_unused]] FunctionId f, [[maybe_unused]] const ScreenStages& s) {
    if constexpr (NativeBits<long double>) {
      return std::tuple(NativeStage<Real, long double, Stage::x87_extended>(f, s.x87_extended));
    } else {
      return std::tuple();
    }
  }
  static auto double_double_stage(FunctionId f, const ScreenStages& s) {
    return std::tuple(NativeStage<Real, DoubleDouble, Stage::double_double>(f, s.double_double));
  }
  static auto binary128_stage([[maybe_unused]] FunctionId f, [[maybe_unused]] const ScreenStages& s) {
#ifdef ULPGATE_HAVE_FLOAT128
    return std::tuple(NativeStage<Real, Binary128, Stage::binary128>(f, s.binary128));
#else
    return std::tuple();
#endif
  }
  // Of real functions of float x87 does as well.
  static ScreenStages without_x87(FunctionId f, ScreenStages s) {
    if (info_of(f).function_class == FunctionClass::real) s.double_double = nullptr;
    return s;
  }
  // What is not real is double-double in other numbers: x87's have all that those of float and double say.
  static ScreenStages without_double([[maybe_unused]] FunctionId f, ScreenStages s) {
#ifdef ULPGATE_HAVE_FLOAT128
    if (info_of(f).function_class != FunctionClass::real) s.binary128 = nullptr;
#endif
    return s;
  }
  // For an erfc below double's range libquadmath needs microseconds.
  static ScreenStages beyond_double([[maybe_unused]] FunctionId f, ScreenStages s) {
#ifdef ULPGATE_HAVE_FLOAT128
    if (f == FunctionId::erfc && s.binary128 != nullptr) s.binary128 = extended_function<Binary128>(f);
#endif
    return s;
  }
  static auto native_stages([[maybe_unused]] FunctionId f, [[maybe_unused]] const ScreenStages& s) {
    if constexpr (std::same_as<Real, float>) {
      return std::tuple_cat(std::tuple(NativeStage<Real, double, Stage::binary64>(f, s.binary64)),
                            double_double_stage(f, without_x87(f, s)), x87_stage(f, s),
                            binary128_stage(f, without_double(f, s)));
    } else if constexpr (std::same_as<Real, double>) {
      // What double-double leaves are mostly the ends of the range, which the wider exponents of x87 reach.
      return std::tuple_cat(double_double_stage(f, s), x87_stage(f, s),
                            binary128_stage(f, without_double(f, s)));
    } else if constexpr (std::same_as<Real, long double> && NativeBits<long double>) {
      return std::tuple_cat(double_double_stage(f, s), binary128_stage(f, beyond_double(f, s)));
#ifdef ULPGATE_HAVE_FLOAT128
    } else if constexpr (Float128Backed<Real>) {
      return std::tuple(TripleStage(f, s.triple_double));
#endif
    } else {
      return std::tuple();
    }
  }

  [[nodiscard]] bool is_checked(const Batch<Real>& batch, std::size_t i) const {
    return (batch.first_index + i) % stride_ == 0;
  }

  [[nodiscard]] bool is_checked_by_all(const Batch<Real>& batch, std::size_t i) const {
    return (batch.first_index + i) % (deep_checks * stride_) == 0;
  }

  // Whether a whole batch is scanned first, which leaves in pending_ what is left over.
  [[nodiscard]] bool may_scan(const Batch<Real>& batch) const {
    bool is_first = true;
    bool may = false;
    const auto look = [&]<class Native>(const Native& native) {
      if (!native.exists()) return;
      may = may || (is_first && scans<Native> && parts_ == 1 &&
                    (std::same_as<Real, double> || batch.function.arity == 1));
      is_first = false;
    };
    std::apply([&](const auto&... natives) { (look(natives), ...); }, natives_);
    return may;
  }

  template <class Native>
  void judge_natively(Native& native, const Batch<Real>& batch, RowTally<Real>& tally) {
    if (!native.exists() || pending_.empty()) return;
    const auto arity = static_cast<std::size_t>(batch.function.arity);
    const bool whole = pending_.size() == batch.count();
    if (whole) {
      native.load(batch.args, batch.count());
      if constexpr (scans<Native>) {
        if (may_scan(batch)) settle_ordinary(native, batch, tally);
      }
    } else {
      gathered_.clear();
      for (const std::size_t i : pending_)
        gathered_.insert(gathered_.end(), batch.args_of(i), batch.args_of(i) + arity);
      native.load(gathered_, pending_.size());
    }
    std::size_t left = 0;
    for (std::size_t p = 0; p < pending_.size(); ++p) {
      const std::size_t i = pending_[p];
      const std::size_t n = whole ? i : p;
      std::array<Finding, max_parts> findings;
      std::array<long double, max_parts> values{};
      if (find_parts(native, n, batch, i, findings, values)) {
        if (is_checked(batch, i)) {
          checks_.push_back({i, Native::id, findings});
          if (!is_checked_by_all(batch, i)) {
            spared_.push_back(i);
            continue;
          }
        } else if (tally.settle({findings.data(), parts_}, batch.first_index + i, batch.args_of(i),
                                {values.data(), parts_})) {
          ++decided_[static_cast<std::size_t>(Native::id)];
          continue;
        }
      }
      pending_[left++] = i;
    }
    pending_.resize(left);
  }

  // What `native` knows of all parts of sample i, its point n; false where of one it knows nothing.
  template <class Native>
  [[nodiscard]] bool find_parts(const Native& native, std::size_t n, const Batch<Real>& batch, std::size_t i,
                                std::array<Finding, max_parts>& findings,
                                std::array<long double, max_parts>& values) const {
    if (batch.threw[i] != 0) return false;
    for (std::size_t part = 0; part < parts_; ++part) {
      if (!native.find(n, part, batch.args_of(i), batch.result_of(i, part), findings[part])) return false;
      values[part] = native.value(n, part);
    }
    return true;
  }

  // Calls `look` with each index of eight bytes that have one of the bits of `mask`, and with the last few.
  template <class Look>
  static void for_marked(std::span<const std::uint8_t> bytes, std::uint64_t mask, Look&& look) {
    constexpr std::size_t step = 32;
    const auto word = [&](std::size_t i) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, &bytes[i], sizeof eight);
      return eight & mask;
    };
    std::size_t i = 0;
    for (; i + step <= bytes.size(); i += step) {
      if ((word(i) | word(i + 8) | word(i + 16) | word(i + 24)) == 0) continue;
      for (std::size_t from = i; from < i + step; from += 8) {
        if (word(from) == 0) continue;
        for (std::size_t j = from; j < from + 8; ++j) look(j);
      }
    }
    for (; i < bytes.size(); ++i) look(i);
  }

  // The ordinary ones of a whole batch, many at a time.
  template <class Native>
  void settle_ordinary(const Native& native, const Batch<Real>& batch, RowTally<Real>& tally) {
    verdicts_.resize(batch.count());
    scan_ordinary(
        native.scan_input(batch.args, batch.results, batch.first_index, tally.scan_limits(batch.first_index)),
        verdicts_.data());
    const std::uint64_t past_check = batch.first_index % stride_;
    for (std::size_t i = past_check == 0 ? 0 : stride_ - past_check; i < batch.count(); i += stride_)
      verdicts_[i] = verdict::unsettled;
    // What is no value was scanned like one.
    for_marked(batch.threw, ~std::uint64_t{0}, [&](std::size_t i) {
      if (batch.threw[i] != 0) verdicts_[i] = verdict::unsettled;
    });
    tally.count_scanned(verdicts_, batch.first_index);
    std::size_t left = 0;
    // No other verdict has the first bit of a byte.
    for_marked(verdicts_, 0x8080808080808080U, [&](std::size_t i) {
      pending_[left] = i;
      left += verdicts_[i] == verdict::unsettled ? 1U : 0U;
    });
    pending_.resize(left);
    decided_[static_cast<std::size_t>(Native::id)] += batch.count() - left;
  }

  // True where the sample is done with.
  bool judge_by_mpfr(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    std::array<Finding, max_parts> findings;
    std::array<long double, max_parts> values{};
    if (batch.threw[i] != 0) return false;
    stage_.load(batch, i);
    for (std::size_t part = 0; part < parts_; ++part) {
      values[part] = stage_.value(part);
      if (!find(stage_.got(batch, i, part), part, findings[part])) return false;
    }
    if (is_checked(batch, i)) {
      checks_.push_back({i, Stage::mpfr, findings});
      return false;
    }
    if (!tally.settle(findings, batch.first_index + i, batch.args_of(i), values)) return false;
    ++decided_[static_cast<std::size_t>(Stage::mpfr)];
    return true;
  }

  // The error in ULP is monotone on either side of the result: the ends of the interval around the stage's
  // value bound it.
  bool find(mpfr_srcptr got, std::size_t part, Finding& finding) {
    mpfr_ptr value = stage_.exact(part);
    const Exactness exactness = stage_.exactness(part);
    if (exactness == Exactness::exact || mpfr_nan_p(value)) {
      finding = finding_of(stage_.judge(got, value));
      return true;
    }
    if (stage_.is_beyond_mpfr(part)) {
      finding = finding_of(stage_.not_exact(stage_.judge(got, value), got, value, exactness));
      return true;
    }
    if (!mpfr_regular_p(value)) return false;
    const bool equal = is_rounded(exactness) && mpfr_equal_p(got, value) != 0;
    const bool leans = lean_to_exact<Real>(beside_, value, exactness);
    mpfr_set_prec(upper_, mpfr_get_prec(value));
    mpfr_set(upper_, value, MPFR_RNDN);
    if (exactness != Exactness::rounded_up) mpfr_nextabove(upper_);
    if (exactness != Exactness::rounded_down) mpfr_nextbelow(value);
    mpfr_srcptr low = leans && exactness == Exactness::rounded_down ? beside_.get() : value;
    mpfr_srcptr high = leans && exactness == Exactness::rounded_up ? beside_.get() : upper_.get();
    const Judgement a = stage_.judge(got, low);
    const Judgement b = stage_.judge(got, high);
    if (a.outcome != b.outcome) return false;
    finding = finding_of(a);
    if (a.outcome != Outcome::finite) return true;
    if (a.correctly_rounded != b.correctly_rounded) return false;
    // Within the interval the error may be anything down to an exact zero, unless that is known not to be.
    const bool inside = mpfr_lessequal_p(low, got) && mpfr_lessequal_p(got, high);
    if (inside && !equal) return false;
    constexpr double margin = 0x1p-50;
    finding.least = equal ? smallest_error : std::min(a.error, b.error).value * (1 - margin);
    finding.greatest = std::max(a.error, b.error).value * (1 + margin);
    // At a power of two the spacing jumps, and the error with it: by 2, but next to the least number of a
    // format without subnormals.
    const mpfr_exp_t top = std::max(mpfr_get_exp(low), mpfr_get_exp(high));
    if (mpfr_get_exp(low) != mpfr_get_exp(high)) {
      constexpr FloatFormat format = float_format<Real>();
      if (!format.subnormals && top - 1 == format.exponent_min) return false;
      if (!equal) finding.least /= 2;
      finding.greatest *= 2;
    }
    finding.distance = std::max(a.distance, b.distance);
    finding.distance_known = a.distance == b.distance;
    return true;
  }

  void judge_in_full(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    full_.load(batch, i);
    for (const Check& check : checks_) {
      if (check.i != i) continue;
      for (std::size_t part = 0; part < parts_; ++part) {
        if (!check.findings[part].allows(full_.judgement(batch, i, part))) disagree(check, batch, part);
      }
    }
    full_.settle(batch, i, tally);
    ++decided_[static_cast<std::size_t>(Stage::full)];
  }

  [[noreturn]] static void disagree(const Check& check, const Batch<Real>& batch, std::size_t part) {
    std::string text = "the screened reference (" + std::string(name_of(check.stage)) +
                       ") disagrees with the full one in part " + std::to_string(part) + " of " +
                       std::string(batch.function.name) + " at";
    for (std::size_t j = 0; j < static_cast<std::size_t>(batch.function.arity); ++j)
      text += " " + to_hexfloat(batch.args_of(check.i)[j]);
    throw ReferenceDisagreement(text);
  }

  std::size_t parts_;
  decltype(native_stages(FunctionId{}, ScreenStages{})) natives_;
  PointJudge<Real> stage_;
  FullJudging<Real> full_;
  std::uint64_t stride_;
  MpfrValue upper_;
  MpfrValue beside_;
  std::vector<std::size_t> pending_;
  std::vector<Real> gathered_;
  std::vector<std::uint8_t> verdicts_;  // of the batch's samples, by a scan
  std::vector<Check> checks_;
  std::vector<std::size_t> spared_;  // checked samples on their way past the other stages
  std::array<std::uint64_t, stage_count> decided_{};
};

}  // namespace ulpgate
