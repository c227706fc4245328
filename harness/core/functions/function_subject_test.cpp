// Tests of functions as subjects: planted defects are caught, every function evaluates in every type.
#include "harness/core/functions/function_subject.hpp"

#include <gtest/gtest.h>

#include "harness/core/testing/planted_defects.hpp"

namespace ulpgate {
namespace {

FunctionSubject<double> subject_with(FunctionId id, BatchFunction<double> replacement) {
  return {*find_type("double"), info_of(id), replacement,
          function_table<RealHP<4, double>>()[static_cast<std::size_t>(id)]};
}

Summary run(const Subject& subject, Stratum stratum, std::uint64_t count) {
  RowHint hint(1);
  const ArgumentList list = subject.listed(stratum);
  StratumSource source{stratum, 1, count, nullptr};
  if (is_listed(stratum)) {
    source.count = list.size();
    source.list = &list;
  }
  return subject.evaluate(source, 0, source.count, ReferenceMode::screened, hint)[0];
}

TEST(Mutation, OneWrongCoefficientOfExpIsCaught) {
  const auto wrong = subject_with(FunctionId::exp, &testing::batch_of<testing::wrong_exp>);
  const Summary bad = run(wrong, Stratum::uniform, 1000);
  const Summary good = run(*find_subject("exp", "double"), Stratum::uniform, 1000);
  EXPECT_GT(bad.max_error.value, 1e4);
  EXPECT_LT(good.max_error.value, 0.52);
}

TEST(Mutation, ANaNAtOneArgumentIsCaught) {
  const auto hole = subject_with(FunctionId::sqrt, &testing::batch_of<testing::sqrt_with_a_hole>);
  const Summary bad = run(hole, Stratum::edges, 0);
  EXPECT_EQ(bad.outcomes[static_cast<std::size_t>(Outcome::nan)], 1U);
  EXPECT_EQ(bad.mismatches(), 1U);
  EXPECT_EQ(run(*find_subject("sqrt", "double"), Stratum::edges, 0).mismatches(), 0U);
}

TEST(Engine, ThrownExceptionsAreCounted) {
  const auto throwing =
      subject_with(FunctionId::cos, [](const double*, double* r, std::uint8_t* threw, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
          r[i] = 0;
          threw[i] = 1;
        }
      });
  EXPECT_EQ(run(throwing, Stratum::uniform, 20).outcomes[static_cast<std::size_t>(Outcome::exception)], 20U);
}

TEST(Coverage, EveryFunctionEvaluatesInEveryTypeBuilt) {
  for (const auto& type : all_types()) {
    for (const auto& f : all_functions()) {
      const Subject* subject = find_subject(f.name, type.token);
      ASSERT_NE(subject, nullptr) << f.name << " " << type.token;
      EXPECT_FALSE(subject->info().implementation.empty()) << f.name << " " << type.token;
      RowHint hint(subject->info().parts.size());
      const auto summaries =
          subject->evaluate({Stratum::uniform, 1, 3, nullptr}, 0, 3, ReferenceMode::screened, hint);
      ASSERT_EQ(summaries.size(), static_cast<std::size_t>(f.parts));
      EXPECT_EQ(summaries[0].samples, 3U) << f.name << " " << type.token;
    }
  }
}

TEST(Subjects, AreToldApartByNameAndType) {
  for (const auto& subject : all_subjects())
    EXPECT_EQ(find_subject(subject->name(), subject->type().token), subject.get()) << subject->name();
  EXPECT_EQ(find_subject("sin", "nosuch"), nullptr);
  EXPECT_EQ(find_subject("nosuch", "double"), nullptr);
}

// What IEEE 754 promises holds on this machine, next to the ends of the range as well.
TEST(Subjects, KeepTheirClaims) {
  std::size_t claims = 0;
  for (const auto& subject : all_subjects()) {
    if (!subject->info().claimed_ulp) continue;
    ++claims;
    for (const auto stratum : {Stratum::uniform, Stratum::edges}) {
      const Summary s = run(*subject, stratum, 300);
      EXPECT_LE(s.max_error.value, *subject->info().claimed_ulp)
          << subject->name() << " " << subject->type().token;
    }
  }
  EXPECT_GE(claims, 6U);
}

// Of a row of any size a few are also evaluated by the other oracle, and there the two are one.
TEST(Oracles, AreComparedAtAFixedStrideAndAgree) {
  EXPECT_EQ(oracle_stride({Stratum::uniform, 1, 1U << 18U, nullptr}), 251U);
  EXPECT_EQ(oracle_stride({Stratum::edges, 1, (1U << 18U) + 1, nullptr}), 16381U);
  EXPECT_EQ(oracle_stride({Stratum::uniform, 1, 1U << 22U, nullptr}), 16381U);
  EXPECT_EQ(oracle_stride({Stratum::uniform, 1, (1U << 22U) + 1, nullptr}), 65537U);
  EXPECT_EQ(oracle_stride({Stratum::exhaustive, 1, exhaustive_count, nullptr}), 65537U);
  const Summary s = run(*find_subject("sqrt", "double"), Stratum::uniform, 503);
  EXPECT_EQ(s.oracle.compared, 3U) << "0, 251 and 502";
  EXPECT_EQ(s.oracle.disagreed, 0U);
  EXPECT_LT(s.oracle.difference.value, oracle_tolerance_ulp);
}

}  // namespace
}  // namespace ulpgate
