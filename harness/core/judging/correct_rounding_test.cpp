// Tests of every type that was built: a correctly rounded result is off by 1/2 ULP at most and no mismatch,
// in all functions and strata, and nothing else is.
#include <gtest/gtest.h>

#include "harness/core/arguments/sampling.hpp"
#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/records/recorded_figures.hpp"
#include "kernels/math/function_table.hpp"
#include "tests/built_types.hpp"

namespace ulpgate {
namespace {

template <class Real>
class CorrectRounding : public ::testing::Test {
 protected:
  // Points of one row with results that are correctly rounded.
  struct Row {
    const FunctionInfo& f;
    Stratum stratum;
    std::vector<Real> args;
    std::vector<Real> rounded;
    std::vector<std::uint8_t> threw;

    [[nodiscard]] Batch<Real> batch(const std::vector<Real>& results) const {
      return {f, args, results, threw};
    }
    [[nodiscard]] std::string at(std::size_t i) const {
      std::string text = std::string(f.name) + " " + std::string(name_of(stratum)) + " at";
      for (std::size_t j = 0; j < static_cast<std::size_t>(f.arity); ++j)
        text += " " + to_hexfloat(args[i * static_cast<std::size_t>(f.arity) + j]);
      return text;
    }
  };

  // MPFR costs more in the wide types.
  static constexpr std::size_t most_points = std::numeric_limits<Real>::digits <= 64 ? 200 : 60;

  // Calls visit(row) for every function and stratum.
  template <class Visit>
  static void for_all_rows(Visit&& visit) {
    for (const FunctionInfo& f : all_functions()) {
      const ArgumentList edges = edge_arguments(f, float_format<Real>());
      const ArgumentList hard = hard_arguments(f, float_format<Real>());
      for (const StratumSource& source : {StratumSource{Stratum::uniform, 5, most_points},
                                          StratumSource{Stratum::stratified, 5, most_points},
                                          StratumSource{Stratum::binades, 5, most_points},
                                          StratumSource{Stratum::edges, 5, edges.size(), &edges},
                                          StratumSource{Stratum::hard, 5, hard.size(), &hard},
                                          StratumSource{Stratum::exhaustive, 5, exhaustive_count}}) {
        const bool in_plan =
            source.stratum != Stratum::exhaustive ||
            (std::same_as<Real, float> && f.arity == 1 && f.function_class == FunctionClass::real);
        if (in_plan && source.count > 0) visit(row_of(f, source));
      }
    }
  }

 private:
  // Of a longer row points from all over it, the last, where results leave the range, among them.
  static Row row_of(const FunctionInfo& f, const StratumSource& source) {
    const auto arity = static_cast<std::size_t>(f.arity);
    const auto parts = static_cast<std::size_t>(f.parts);
    const std::size_t count = std::min<std::size_t>(source.count, most_points);
    Row row{f, source.stratum, std::vector<Real>(count * arity), {}, std::vector<std::uint8_t>(count)};
    const Arguments<Real> arguments(f, source);
    std::vector<MpfrValue> exact;
    for (std::size_t j = 0; j < parts; ++j) exact.emplace_back(FullJudging<Real>::reference_bits);
    for (std::size_t i = 0; i < count; ++i) {
      arguments.make(source.count - 1 - i * (source.count / count), &row.args[i * arity]);
      const ExactParts exactness = exact_value(f, exact_arguments(f, &row.args[i * arity]), exact);
      for (std::size_t j = 0; j < parts; ++j) row.rounded.push_back(rounded(exact[j], exactness[j]));
    }
    return row;
  }

  // The number of Real nearest to what `exact` stands for: next to a midpoint the direction of its rounding
  // decides.
  static Real rounded(const MpfrValue& exact, Exactness exactness) {
    const WideExponentRange wide;
    MpfrValue value(mpfr_get_prec(exact.get()) + 300);
    mpfr_set(value, exact, MPFR_RNDN);
    if (mpfr_regular_p(value) != 0) {
      if (exactness == Exactness::rounded_up) mpfr_nextbelow(value);
      if (exactness == Exactness::rounded_down) mpfr_nextabove(value);
    }
    return from_mpfr<Real>(value);
  }
};

using BuiltTypes = ::testing::Types<ULPGATE_TEST_TYPES>;
TYPED_TEST_SUITE(CorrectRounding, BuiltTypes);

TYPED_TEST(CorrectRounding, IsOffByHalfAnUlpAtMost) {
  using Real = TypeParam;
  this->for_all_rows([](const auto& row) {
    const Batch<Real> batch = row.batch(row.rounded);
    FullJudging<Real> judging(row.f);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      judging.load(batch, i);
      for (std::size_t part = 0; part < static_cast<std::size_t>(row.f.parts); ++part) {
        const Judgement j = judging.judgement(batch, i, part);
        EXPECT_EQ(name_of(j.outcome), "finite") << row.at(i);
        EXPECT_LE(j.error.value, 0.5) << row.at(i);
        EXPECT_TRUE(j.correctly_rounded) << row.at(i);
        EXPECT_EQ(j.distance, 0) << row.at(i);
      }
    }
    RowHint hint(static_cast<std::size_t>(row.f.parts));
    RowTally<Real> full(row.f, hint);
    FullJudging<Real>(row.f).judge(batch, full);
    RowTally<Real> screened(row.f, hint);
    ScreenedJudging<Real>(row.f).judge(batch, screened);
    const std::vector<Summary> a = full.take();
    const std::vector<Summary> b = screened.take();
    for (std::size_t part = 0; part < a.size(); ++part)
      EXPECT_EQ(recorded_figures(a[part]), recorded_figures(b[part])) << row.at(0);
  });
}

TYPED_TEST(CorrectRounding, IsWhatTheFunctionsAreHeldAgainst) {
  using Real = TypeParam;
  const FunctionTable<Real>& functions = function_table<Real>();
  this->for_all_rows([&](const auto& row) {
    const std::size_t count = row.threw.size();
    const auto parts = static_cast<std::size_t>(row.f.parts);
    std::vector<Real> results(count * parts);
    std::vector<std::uint8_t> threw(count);
    functions[static_cast<std::size_t>(row.f.id)](row.args.data(), results.data(), threw.data(), count);
    const Batch<Real> batch = row.batch(results);
    FullJudging<Real> judging(row.f);
    for (std::size_t i = 0; i < count; ++i) {
      if (threw[i] != 0) continue;
      judging.load(batch, i);
      for (std::size_t part = 0; part < parts; ++part) {
        const Judgement j = judging.judgement(batch, i, part);
        const Real& got = results[i * parts + part];
        const Real& want = row.rounded[i * parts + part];
        if (j.outcome != Outcome::finite) continue;
        if (got == want) {
          EXPECT_LE(j.error.value, 0.5) << row.at(i);
        }
        const bool agreed = got == want || (got != got && want != want);
        EXPECT_EQ(j.correctly_rounded, agreed) << row.at(i);
        EXPECT_EQ(j.distance == 0, agreed) << row.at(i);
        EXPECT_TRUE(agreed || j.error.value >= 0.5) << row.at(i) << ": " << j.error.value;
      }
    }
  });
}

}  // namespace
}  // namespace ulpgate
