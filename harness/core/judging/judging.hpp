// Batches of results, their points as MPFR values, and FullJudging, which holds every sample against the full
// reference.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/core/judging/row_tally.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

// A batch of points of one function: args holds count * arity values, results count * parts.
template <RealType Real>
struct Batch {
  const FunctionInfo& function;
  std::span<const Real> args;
  std::span<const Real> results;
  std::span<const std::uint8_t> threw;
  std::uint64_t first_index = 0;  // of the row's points; the others follow

  [[nodiscard]] std::size_t count() const { return threw.size(); }
  [[nodiscard]] const Real* args_of(std::size_t i) const {
    return &args[i * static_cast<std::size_t>(function.arity)];
  }
  [[nodiscard]] const Real& result_of(std::size_t i, std::size_t part) const {
    return results[i * static_cast<std::size_t>(function.parts) + part];
  }
};

// A reference that was rounded to a number of Real, or to a midpoint of two, hides on which side of it the
// exact value lies: which binade's spacing counts at a power of two, and which number is the nearest at a
// midpoint.  Where the rounding's direction is known, sets `beside` to a number on that side of `value`,
// 2^-64 of value's last bit from it; false where there is nothing to tell or nothing known.
template <RealType Real>
[[nodiscard]] bool lean_to_exact(MpfrValue& beside, mpfr_srcptr value, Exactness exactness) {
  if (exactness != Exactness::rounded_up && exactness != Exactness::rounded_down) return false;
  if (mpfr_regular_p(value) == 0 || mpfr_min_prec(value) > float_format<Real>().precision + 1) return false;
  const WideExponentRange wide;
  mpfr_set_prec(beside, mpfr_get_prec(value) + 64);
  mpfr_set(beside, value, MPFR_RNDN);
  if (exactness == Exactness::rounded_up) {
    mpfr_nextbelow(beside);
  } else {
    mpfr_nextabove(beside);
  }
  return true;
}

// Evaluates the exact value; what it promises is what exact_value promises.
using ExactFunction = ExactParts (*)(const FunctionInfo&, std::span<const MpfrValue>, std::span<MpfrValue>);

// The points of a batch, one at a time, as MPFR values, and exact values of them at one precision.
template <RealType Real>
class PointJudge {
 public:
  PointJudge(const FunctionInfo& f, long reference_bits, ExactFunction evaluate = exact_value)
      : function_(f), evaluate_(evaluate), got_(float_format<Real>().precision) {
    for (int j = 0; j < f.arity; ++j) args_.emplace_back(float_format<Real>().precision);
    for (int j = 0; j < f.parts; ++j) exact_.emplace_back(reference_bits);
  }

  // Evaluates the exact values of point i.
  void load(const Batch<Real>& batch, std::size_t i) {
    Heartbeat::mine().beat(WorkPhase::reference, i);
    const Real* args = batch.args_of(i);
    for (std::size_t j = 0; j < args_.size(); ++j) to_mpfr(args_[j].get(), args[j]);
    exactness_ = evaluate_(function_, args_, exact_);
  }

  [[nodiscard]] MpfrValue& exact(std::size_t part) { return exact_[part]; }
  [[nodiscard]] Exactness exactness(std::size_t part) const { return exactness_[part]; }
  // Whether the exact value is a number beyond MPFR's own range, which it is at any precision: a zero or an
  // infinity that is none.  Of a special function a zero may be one that needs more bits.
  [[nodiscard]] bool is_beyond_mpfr(std::size_t part) const {
    return mpfr_regular_p(exact_[part].get()) == 0 &&
           (is_rounded(exactness_[part]) || function_.function_class == FunctionClass::complex);
  }
  [[nodiscard]] long double value(std::size_t part) const { return mpfr_get_ld(exact_[part], MPFR_RNDN); }
  [[nodiscard]] const MpfrValue& got(const Batch<Real>& batch, std::size_t i, std::size_t part) {
    to_mpfr(got_.get(), batch.result_of(i, part));
    return got_;
  }

  [[nodiscard]] Judgement judge(mpfr_srcptr got, mpfr_srcptr exact) const {
    const Judgement judgement = ulpgate::judge(got, exact, float_format<Real>());
    // The series of a special function define a value, not the sign of its zeros.
    if (judgement.outcome == Outcome::zero_sign && function_.function_class == FunctionClass::special)
      return {};
    return judgement;
  }

  // Of a result that is equal to a rounded reference: it is wrong by less than the reference can say, but
  // wrong.  So is a zero where the exact value has left even MPFR's range.
  [[nodiscard]] static Judgement not_exact(Judgement j, mpfr_srcptr got, mpfr_srcptr exact,
                                           Exactness exactness) {
    if (is_rounded(exactness) && mpfr_number_p(got) != 0 && mpfr_equal_p(got, exact) != 0)
      j.error.value = smallest_error;
    return j;
  }

 private:
  const FunctionInfo& function_;
  ExactFunction evaluate_;
  std::vector<MpfrValue> args_;
  std::vector<MpfrValue> exact_;
  ExactParts exactness_{};
  MpfrValue got_;
};

// Of a point that gave no value: which of the outcomes from `exception` on, counted from 1, stands in
// `threw`.
[[nodiscard]] constexpr Outcome outcome_without_value(std::uint8_t threw) {
  return static_cast<Outcome>(static_cast<int>(Outcome::exception) + threw - 1);
}
[[nodiscard]] constexpr std::uint8_t no_value(Outcome o) {
  return static_cast<std::uint8_t>(static_cast<int>(o) - static_cast<int>(Outcome::exception) + 1);
}

// Every sample against MPFR at the precision of RealHP<4>.  One object per unit of work.
template <RealType Real>
class FullJudging {
 public:
  static constexpr long reference_bits = std::numeric_limits<RealHP<4, Real>>::digits;

  // Fewer bits are for a ranking, which decides nothing.
  explicit FullJudging(const FunctionInfo& f, long bits = reference_bits) : point_(f, bits) {}

  // Evaluates point i; judgement(part) then judges its parts.
  void load(const Batch<Real>& batch, std::size_t i) {
    threw_ = batch.threw[i];
    if (threw_ == 0) point_.load(batch, i);
  }
  [[nodiscard]] Judgement judgement(const Batch<Real>& batch, std::size_t i, std::size_t part) {
    if (threw_ != 0) return {outcome_without_value(threw_), {}, 0, false};
    mpfr_srcptr got = point_.got(batch, i, part);
    mpfr_srcptr exact = point_.exact(part);
    const Exactness exactness = point_.exactness(part);
    const bool leans = lean_to_exact<Real>(beside_, exact, exactness);
    const Judgement j = point_.judge(got, leans ? static_cast<mpfr_srcptr>(beside_) : exact);
    return point_.not_exact(j, got, exact, exactness);
  }
  [[nodiscard]] long double value(std::size_t part) const { return threw_ != 0 ? 0 : point_.value(part); }

  void judge(const Batch<Real>& batch, RowTally<Real>& tally) {
    for (std::size_t i = 0; i < batch.count(); ++i) judge(batch, i, tally);
  }

  // Point i alone.
  void judge(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    load(batch, i);
    settle(batch, i, tally);
  }
  // Counts point i, which is loaded.
  void settle(const Batch<Real>& batch, std::size_t i, RowTally<Real>& tally) {
    std::array<Finding, max_parts> findings;
    std::array<long double, max_parts> values{};
    for (std::size_t part = 0; part < static_cast<std::size_t>(batch.function.parts); ++part) {
      findings[part] = finding_of(judgement(batch, i, part));
      values[part] = value(part);
    }
    tally.settle(findings, batch.first_index + i, batch.args_of(i), values);
  }

 private:
  PointJudge<Real> point_;
  MpfrValue beside_;
  std::uint8_t threw_ = 0;
};

}  // namespace ulpgate
