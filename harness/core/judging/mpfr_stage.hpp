// MpfrStage<Real>: MPFR at a few bits more than Real has bounds the errors of one sample.
#pragma once

#include <algorithm>
#include <limits>

#include "harness/core/judging/judging.hpp"

namespace ulpgate {

template <RealType Real>
class MpfrStage {
 public:
  // The exact value is within one ulp of this precision (oracle.hpp).
  static constexpr long bits = std::numeric_limits<Real>::digits + 32;

  MpfrStage(const FunctionInfo& f, ExactFunction evaluate) : point_(f, bits, evaluate) {}

  // Evaluates the exact values of point i.
  void load(const Batch<Real>& batch, std::size_t i) { point_.load(batch, i); }
  [[nodiscard]] long double value(std::size_t part) const { return point_.value(part); }

  // What is known of a part of the result of point i, which is loaded; once a part, whose value it changes.
  // The error in ULP is monotone on either side of the result: the ends of the interval around the stage's
  // value bound it.
  [[nodiscard]] bool find(const Batch<Real>& batch, std::size_t i, std::size_t part, Finding& finding) {
    mpfr_srcptr got = point_.got(batch, i, part);
    mpfr_ptr value = point_.exact(part);
    const Exactness exactness = point_.exactness(part);
    if (exactness == Exactness::exact || mpfr_nan_p(value)) {
      finding = finding_of(point_.judge(got, value));
      return true;
    }
    if (point_.is_beyond_mpfr(part)) {
      finding = finding_of(point_.not_exact(point_.judge(got, value), got, value, exactness));
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
    const Judgement a = point_.judge(got, low);
    const Judgement b = point_.judge(got, high);
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

 private:
  PointJudge<Real> point_;
  MpfrValue upper_;
  MpfrValue beside_;
};

}  // namespace ulpgate
