// ScreenedJudging<Real>: cheap references with proven bounds first; what a stage cannot settle climbs to the
// next, at the end to the full reference, and a fixed share is always checked against better ones.
#pragma once

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include "harness/core/judging/mpfr_stage.hpp"
#include "harness/core/judging/screen_stages.hpp"
#include "harness/core/stages/native_stage.hpp"
#include "harness/core/stages/triple_stage.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

// One object per unit of work.
template <RealType Real>
class ScreenedJudging {
 public:
  static constexpr std::uint64_t check_stride = 1024;
  // Of all floats: 2^18 of them.
  static constexpr std::uint64_t exhaustive_check_stride = 16 * check_stride;
  // Of the checked samples most are held against triple-double, where there is one, or else go to the full
  // reference at once.  These go through all stages and to the full reference, so that triple-double and what
  // is rarely reached are held to their bounds as well.
  static constexpr std::uint64_t deep_checks = 16;
  static constexpr std::uint64_t deep_check_stride = deep_checks * check_stride;

  // Checks every `stride`-th sample.
  explicit ScreenedJudging(const FunctionInfo& f, std::uint64_t stride = check_stride)
      : ScreenedJudging(f, screen_stages(f), stride) {}
  ScreenedJudging(const FunctionInfo& f, const ScreenStages& stages, std::uint64_t stride = check_stride)
      : parts_(static_cast<std::size_t>(f.parts)),
        natives_(native_stages(f.id, stages)),
        checkers_(checking_stages(f.id, stages)),
        mpfr_(f, stages.mpfr),
        full_(f),
        stride_(stride) {}

  // Throws ReferenceDisagreement.
  void judge(const Batch<Real>& batch, RowTally<Real>& tally) {
    checks_.clear();
    spared_.clear();
    pending_.resize(batch.count());
    if (!may_scan(batch)) std::iota(pending_.begin(), pending_.end(), std::size_t{0});
    std::apply([&](auto&... stages) { (judge_natively(stages, batch, tally), ...); }, natives_);
    std::apply([&](auto&... checkers) { (check_by(checkers, batch, tally), ...); }, checkers_);
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
      return std::tuple(TripleStage<Real>(f, s.triple_double));
#endif
    } else {
      return std::tuple();
    }
  }

  // Of narrower types than binary128: 48 bits more than double-double has, at a hundredth of the full
  // reference's cost.  It is no other method: formulas of the two are one source (reference/multi_word).
  static auto checking_stages([[maybe_unused]] FunctionId f, [[maybe_unused]] const ScreenStages& s) {
#ifdef ULPGATE_HAVE_FLOAT128
    if constexpr (NativeReal<Real>)
      return std::tuple(TripleStage<Real>(f, s.triple_double));
    else
#endif
      return std::tuple();
  }

  [[nodiscard]] bool is_checked(const Batch<Real>& batch, std::size_t i) const {
    return (batch.first_index + i) % stride_ == 0;
  }

  [[nodiscard]] bool is_checked_by_all(const Batch<Real>& batch, std::size_t i) const {
    return (batch.first_index + i) % (deep_checks * stride_) == 0;
  }

  // The first sample of the batch whose index is a multiple of `stride`, or one behind the batch.
  [[nodiscard]] static std::size_t first_multiple(const Batch<Real>& batch, std::uint64_t stride) {
    return (stride - batch.first_index % stride) % stride;
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
    for (std::size_t i = first_multiple(batch, stride_); i < batch.count(); i += stride_)
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

  // Holds what a stage found of the samples that were spared further ones against the checker; what that
  // knows nothing of, and what may be a maximum, is left to the full reference.  Has the checker checked by
  // the full reference where all stages are.
  template <class Checker>
  void check_by(Checker& checker, const Batch<Real>& batch, RowTally<Real>& tally) {
    if (!checker.exists()) return;
    looked_at_ = spared_;
    const std::uint64_t deep_stride = deep_checks * stride_;
    for (std::size_t i = first_multiple(batch, deep_stride); i < batch.count(); i += deep_stride)
      looked_at_.push_back(i);
    if (looked_at_.empty()) return;
    gathered_.clear();
    for (const std::size_t i : looked_at_)
      gathered_.insert(gathered_.end(), batch.args_of(i), batch.args_of(i) + batch.function.arity);
    checker.load(gathered_, looked_at_.size());
    spared_.clear();
    for (std::size_t n = 0; n < looked_at_.size(); ++n) {
      const std::size_t i = looked_at_[n];
      std::array<Finding, max_parts> findings;
      std::array<long double, max_parts> values{};
      const bool is_found = find_parts(checker, n, batch, i, findings, values);
      if (is_checked_by_all(batch, i)) {
        if (is_found) checks_.push_back({i, Checker::id, findings});
        continue;
      }
      if (is_found)
        hold_checks(batch, i, name_of(Checker::id),
                    [&](const Finding& f, std::size_t part) { return f.agrees_with(findings[part]); });
      const auto held = std::ranges::find(checks_, i, &Check::i);
      if (is_found && tally.settle({held->findings.data(), parts_}, batch.first_index + i, batch.args_of(i),
                                   {values.data(), parts_})) {
        ++decided_[static_cast<std::size_t>(held->stage)];
      } else {
        spared_.push_back(i);
      }
    }
  }

  // True where the sample is done with.
  bool judge_by_mpfr(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    std::array<Finding, max_parts> findings;
    std::array<long double, max_parts> values{};
    if (batch.threw[i] != 0) return false;
    mpfr_.load(batch, i);
    for (std::size_t part = 0; part < parts_; ++part) {
      values[part] = mpfr_.value(part);
      if (!mpfr_.find(batch, i, part, findings[part])) return false;
    }
    if (is_checked(batch, i)) {
      checks_.push_back({i, Stage::mpfr, findings});
      return false;
    }
    if (!tally.settle(findings, batch.first_index + i, batch.args_of(i), values)) return false;
    ++decided_[static_cast<std::size_t>(Stage::mpfr)];
    return true;
  }

  void judge_in_full(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    full_.load(batch, i);
    hold_checks(batch, i, "full", [&](const Finding& f, std::size_t part) {
      return f.allows(full_.judgement(batch, i, part));
    });
    full_.settle(batch, i, tally);
    ++decided_[static_cast<std::size_t>(Stage::full)];
  }

  // Throws where `holds` denies what a stage found of a part of sample i.
  template <class Holds>
  void hold_checks(const Batch<Real>& batch, std::size_t i, std::string_view better, Holds&& holds) const {
    for (const Check& check : checks_) {
      if (check.i != i) continue;
      for (std::size_t part = 0; part < parts_; ++part)
        if (!holds(check.findings[part], part)) disagree(check, better, batch, part);
    }
  }

  [[noreturn]] static void disagree(const Check& check, std::string_view better, const Batch<Real>& batch,
                                    std::size_t part) {
    std::string text = "the screened reference (" + std::string(name_of(check.stage)) +
                       ") disagrees with the " + std::string(better) + " one in part " +
                       std::to_string(part) + " of " + std::string(batch.function.name) + " at";
    for (std::size_t j = 0; j < static_cast<std::size_t>(batch.function.arity); ++j)
      text += " " + to_hexfloat(batch.args_of(check.i)[j]);
    throw ReferenceDisagreement(text);
  }

  std::size_t parts_;
  decltype(native_stages(FunctionId{}, ScreenStages{})) natives_;
  decltype(checking_stages(FunctionId{}, ScreenStages{})) checkers_;
  MpfrStage<Real> mpfr_;
  FullJudging<Real> full_;
  std::uint64_t stride_;
  std::vector<std::size_t> pending_;
  std::vector<Real> gathered_;
  std::vector<std::uint8_t> verdicts_;  // of the batch's samples, by a scan
  std::vector<Check> checks_;
  std::vector<std::size_t> looked_at_;
  std::vector<std::size_t> spared_;  // checked samples that go past the other stages
  std::array<std::uint64_t, stage_count> decided_{};
};

}  // namespace ulpgate
