// The search of a function in one type: target and portfolio together; one translation unit per type.
#pragma once

#include "harness/core/functions/subject_call.hpp"
#include "harness/core/search/function_search.hpp"
#include "harness/core/search/function_target.hpp"

namespace ulpgate {

template <RealType Real, class Wide>
class TypedSearch final : public FunctionSearch {
 public:
  using Position = PositionOf<Real>;

  // Without `known` the hard arguments are evaluated first.
  TypedSearch(const Subject& subject, std::uint64_t seed, const ArgumentList* known)
      : TypedSearch(subject, info_of(find_function(subject.name())->id), seed, known) {}

  std::size_t begin_round(std::uint64_t most) override { return search_.begin_round(most); }
  void run_batch(std::size_t batch) override { search_.run_batch(batch); }
  void end_round() override { search_.end_round(); }
  [[nodiscard]] std::uint64_t evaluations() const override { return search_.evaluations(); }
  [[nodiscard]] double best_error_ulp() const override { return search_.best().error; }
  [[nodiscard]] SearchBest best() const override {
    const auto& found = search_.best();
    SearchBest best;
    if (found.error >= 0) best.args = target_.values(found.at);
    best.error_ulp = found.error;
    best.distance = found.distance;
    best.evaluations = found.evaluations;
    return best;
  }
  [[nodiscard]] std::map<Outcome, SearchMismatch> mismatches() const override {
    std::map<Outcome, SearchMismatch> out;
    for (const auto& [outcome, m] : search_.mismatches()) {
      SearchMismatch& to = out[outcome];
      to.args = target_.values(m.at);
      to.confirmed = m.confirmed;
    }
    return out;
  }

 private:
  TypedSearch(const Subject& subject, const FunctionInfo& f, std::uint64_t seed, const ArgumentList* known)
      : target_(f, call_of<Real>(subject)),
        search_(target_, target_.ordinary_boxes(),
                target_.seeds(known == nullptr ? subject.listed(Stratum::hard) : ArgumentList{}), seed,
                size(f)) {
    if (known != nullptr) target_.pass_over(*known);
  }

  // Rounds of a few hundredths of a second: what is found steers what is tried next.
  static SearchSize size(const FunctionInfo& f) {
    if (f.function_class != FunctionClass::real) return {1U << 12U};
    return {std::same_as<Wide, NoWideType> || f.arity > 1 ? std::size_t{1} << 14U : std::size_t{1} << 18U};
  }

  FunctionTarget<Real, Wide> target_;
  Search<Position> search_;
};

}  // namespace ulpgate
