// Judging<Real>: how a batch of results is held against the truth, and the full reference, which is one such
// way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/oracle.hpp"
#include "reference/ulp.hpp"

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
};

// A strategy of judging; one call per batch.  Every strategy gives judgements that agree in everything that a
// summary records (see same_record).
template <RealType Real>
class Judging {
 public:
  Judging() = default;
  Judging(const Judging&) = delete;
  Judging& operator=(const Judging&) = delete;
  virtual ~Judging() = default;
  // out[i * parts + part] judges that part of point i.
  virtual void judge(const Batch<Real>& batch, std::span<Judgement> out) const = 0;
};

// The points of a batch, one at a time, as MPFR values, and exact values of them at one precision.
template <RealType Real>
class PointJudge {
 public:
  // Evaluates the exact value; what it promises is what exact_value promises.
  using ExactFunction = ExactParts (*)(const FunctionInfo&, std::span<const MpfrValue>, std::span<MpfrValue>);

  PointJudge(const FunctionInfo& f, long reference_bits, ExactFunction evaluate = exact_value)
      : function_(f), evaluate_(evaluate), got_(float_format<Real>().precision) {
    for (int j = 0; j < f.arity; ++j) args_.emplace_back(float_format<Real>().precision);
    for (int j = 0; j < f.parts; ++j) exact_.emplace_back(reference_bits);
  }

  // Evaluates the exact values of point i.
  ExactParts load(const Batch<Real>& batch, std::size_t i) {
    for (std::size_t j = 0; j < args_.size(); ++j) to_mpfr(args_[j].get(), batch.args[i * args_.size() + j]);
    return evaluate_(function_, args_, exact_);
  }

  [[nodiscard]] MpfrValue& exact(std::size_t part) { return exact_[part]; }
  [[nodiscard]] const MpfrValue& got(const Batch<Real>& batch, std::size_t i, std::size_t part) {
    to_mpfr(got_.get(), batch.results[i * exact_.size() + part]);
    return got_;
  }

  [[nodiscard]] Judgement judge(mpfr_srcptr got, mpfr_srcptr exact) const {
    const Judgement judgement = ulpgate::judge(got, exact, float_format<Real>());
    // The series of a special function define a value, not the sign of its zeros.
    if (judgement.outcome == Outcome::zero_sign && function_.function_class == FunctionClass::special)
      return {};
    return judgement;
  }

 private:
  const FunctionInfo& function_;
  ExactFunction evaluate_;
  std::vector<MpfrValue> args_;
  std::vector<MpfrValue> exact_;
  MpfrValue got_;
};

inline constexpr Judgement exception_judgement{Outcome::exception, {}, 0, false};

// Every sample against MPFR at the precision of RealHP<4>.
template <RealType Real>
class FullJudging final : public Judging<Real> {
 public:
  static constexpr long reference_bits = std::numeric_limits<RealHP<4, Real>>::digits;

  void judge(const Batch<Real>& batch, std::span<Judgement> out) const override {
    const auto parts = static_cast<std::size_t>(batch.function.parts);
    PointJudge<Real> point(batch.function, reference_bits);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      if (batch.threw[i] == 0) point.load(batch, i);
      for (std::size_t j = 0; j < parts; ++j) {
        out[i * parts + j] =
            batch.threw[i] != 0 ? exception_judgement : point.judge(point.got(batch, i, j), point.exact(j));
      }
    }
  }
};

}  // namespace ulpgate
