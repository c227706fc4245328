// Judging<Real>: how a batch of results is held against the truth; the full reference, and room for others
// beside it.
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

  [[nodiscard]] std::size_t count() const { return threw.size(); }
};

// A strategy of judging; one call per batch, so that a strategy can screen cheaply before it climbs to the
// full reference.  Every strategy gives the same judgements of every sample that a statistic can depend on.
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

// Every sample against MPFR at the precision of RealHP<4>.
template <RealType Real>
class FullJudging final : public Judging<Real> {
 public:
  void judge(const Batch<Real>& batch, std::span<Judgement> out) const override {
    constexpr long reference_bits = std::numeric_limits<RealHP<4, Real>>::digits;
    constexpr FloatFormat format = float_format<Real>();
    const auto arity = static_cast<std::size_t>(batch.function.arity);
    const auto parts = static_cast<std::size_t>(batch.function.parts);
    std::vector<MpfrValue> args;
    std::vector<MpfrValue> exact;
    for (std::size_t j = 0; j < arity; ++j) args.emplace_back(format.precision);
    for (std::size_t j = 0; j < parts; ++j) exact.emplace_back(reference_bits);
    MpfrValue got(format.precision);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      if (batch.threw[i] != 0) {
        for (std::size_t j = 0; j < parts; ++j) out[i * parts + j] = {Outcome::exception, {}, 0, false};
        continue;
      }
      for (std::size_t j = 0; j < arity; ++j) to_mpfr(args[j].get(), batch.args[i * arity + j]);
      exact_value(batch.function, args, exact);
      for (std::size_t j = 0; j < parts; ++j) {
        to_mpfr(got.get(), batch.results[i * parts + j]);
        Judgement& judgement = out[i * parts + j];
        judgement = ulpgate::judge(got, exact[j], format);
        // The series of a special function define a value, not the sign of its zeros.
        if (judgement.outcome == Outcome::zero_sign &&
            batch.function.function_class == FunctionClass::special) {
          judgement = {};
        }
      }
    }
  }
};

}  // namespace ulpgate
