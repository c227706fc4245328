// ScreenedJudging<Real>: MPFR a little above Real's own precision decides nearly every sample; what it cannot
// decide climbs to the full reference, and a fixed share is always checked against it.
#pragma once

#include <string>

#include "harness/core/judging.hpp"
#include "harness/core/reference_disagreement.hpp"
#include "reference/text.hpp"

namespace ulpgate {

// The stage's value is within one ulp of its own precision of the exact value: MPFR and MPC round correctly,
// our compositions of them carry 32 guard bits, the special series 16 (oracle.hpp).  A sample is decided when
// the ends of that interval lead to the same record.  The full reference lies in the interval as well, and
// the error in ULP is monotone on either side of the result, so it leads to that record, too.
template <RealType Real>
class ScreenedJudging final : public Judging<Real> {
 public:
  // At 64 bits beyond Real one sample in 2^24 falls next to a step of the recorded error; that many climb.
  static constexpr long stage_bits = std::numeric_limits<Real>::digits + 64;
  static constexpr std::uint64_t check_stride = 1024;

  explicit ScreenedJudging(typename PointJudge<Real>::ExactFunction stage = exact_value) : stage_(stage) {}

  void judge(const Batch<Real>& batch, std::span<Judgement> out) const override {
    const auto parts = static_cast<std::size_t>(batch.function.parts);
    PointJudge<Real> stage(batch.function, stage_bits, stage_);
    PointJudge<Real> full(batch.function, FullJudging<Real>::reference_bits);
    std::vector<std::uint8_t> decided(parts);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      const std::span<Judgement> judgements = out.subspan(i * parts, parts);
      if (batch.threw[i] != 0) {
        std::fill(judgements.begin(), judgements.end(), exception_judgement);
        continue;
      }
      const ExactParts exactly = stage.load(batch, i);
      bool all_decided = true;
      for (std::size_t j = 0; j < parts; ++j) {
        decided[j] = decide(stage, stage.got(batch, i, j), stage.exact(j), exactly[j], judgements[j]) ? 1 : 0;
        all_decided = all_decided && decided[j] != 0;
      }
      if (all_decided && (batch.first_index + i) % check_stride != 0) continue;
      full.load(batch, i);
      for (std::size_t j = 0; j < parts; ++j) {
        const Judgement judgement = full.judge(full.got(batch, i, j), full.exact(j));
        if (decided[j] != 0 && !same_record(judgement, judgements[j])) disagree(batch, i, j);
        judgements[j] = judgement;
      }
    }
  }

 private:
  static bool decide(const PointJudge<Real>& stage, mpfr_srcptr got, mpfr_ptr value, bool exact,
                     Judgement& judgement) {
    if (exact || mpfr_nan_p(value)) {
      judgement = stage.judge(got, value);
      return true;
    }
    // An inexact zero or infinity has left even MPFR's range.
    if (!mpfr_regular_p(value)) return false;
    static thread_local MpfrValue upper(stage_bits);
    mpfr_set(upper, value, MPFR_RNDN);
    mpfr_nextabove(upper);
    mpfr_nextbelow(value);
    // Within the interval the error may be anything down to an exact zero.
    if (!mpfr_nan_p(got) && mpfr_lessequal_p(value, got) && mpfr_lessequal_p(got, upper)) return false;
    judgement = stage.judge(got, value);
    return same_record(judgement, stage.judge(got, upper));
  }

  [[noreturn]] static void disagree(const Batch<Real>& batch, std::size_t i, std::size_t part) {
    std::string text = "the screened reference disagrees with the full one in part " + std::to_string(part) +
                       " of " + std::string(batch.function.name) + " at";
    const auto arity = static_cast<std::size_t>(batch.function.arity);
    for (std::size_t j = 0; j < arity; ++j) text += " " + to_hexfloat(batch.args[i * arity + j]);
    throw ReferenceDisagreement(text);
  }

  typename PointJudge<Real>::ExactFunction stage_;
};

}  // namespace ulpgate
