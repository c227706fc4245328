// Tests of the gate's judgement: regressions, missing rows, incomplete runs, updates.
#include "harness/core/gate/budgets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/core/gate/limits.hpp"

namespace ulpgate {
namespace {

RowRecord record(const std::string& function, double ulp, const std::string& stratum = "uniform") {
  RowRecord r;
  r.subject = function;
  r.part = "value";
  r.type = "double";
  r.stratum = stratum;
  r.planned = 10;
  r.seed = 1;
  for (std::uint64_t k = 0; k < 10; ++k) r.summary.add({Outcome::finite, {ulp}, 0, true}, k);
  r.points.argmax = {"0x1p+0"};
  return r;
}

Budgets budgets_of(const std::vector<RowRecord>& records) {
  return measured_budgets(records, 20, 1);
}

std::vector<FindingKind> kinds(const std::vector<GateFinding>& findings) {
  std::vector<FindingKind> out;
  // One change may exceed several limits of its row.
  for (const auto& f : findings)
    if (out.empty() || out.back() != f.kind) out.push_back(f.kind);
  return out;
}

using Kinds = std::vector<FindingKind>;

TEST(Gate, PassesWhatItWasMeasuredBy) {
  const std::vector<RowRecord> records = {record("exp", 0.512), record("sin", 0.55)};
  EXPECT_TRUE(judge_records(records, budgets_of(records), MissingRecords::fail).empty());
}

TEST(Gate, FindsEveryKind) {
  const auto budgets = budgets_of({record("exp", 0.512), record("sin", 0.55)});
  EXPECT_EQ(kinds(judge_records({record("exp", 0.53), record("sin", 0.55)}, budgets, MissingRecords::fail)),
            Kinds{FindingKind::regression});
  EXPECT_EQ(kinds(judge_records({record("exp", 0.5)}, budgets, MissingRecords::fail)),
            Kinds{FindingKind::missing_record});
  EXPECT_TRUE(judge_records({record("exp", 0.5)}, budgets, MissingRecords::ignore).empty());
  EXPECT_EQ(kinds(judge_records({record("exp", 0.5), record("cos", 0.5)}, budgets, MissingRecords::ignore)),
            Kinds{FindingKind::missing_budget});
  EXPECT_EQ(kinds(judge_records({record("exp", 0.1), record("sin", 0.55)}, budgets, MissingRecords::fail)),
            Kinds{FindingKind::could_lower});
  EXPECT_TRUE(judge_records({record("exp", 0.1)}, budgets, MissingRecords::ignore).empty())
      << "a smaller run says nothing about budgets that could fall";
  RowRecord torn = record("exp", 0.5);
  --torn.summary.samples;
  EXPECT_EQ(kinds(judge_records({torn}, budgets, MissingRecords::ignore)), Kinds{FindingKind::incomplete});
  EXPECT_EQ(kinds(judge_records({record("exp", HUGE_VAL)}, budgets, MissingRecords::ignore)),
            Kinds{FindingKind::regression});
}

TEST(Gate, WorstRegressionComesFirst) {
  const auto budgets = budgets_of({record("exp", 0.5), record("sin", 0.5)});
  const auto findings = judge_records({record("sin", 1), record("exp", 100)}, budgets, MissingRecords::fail);
  ASSERT_EQ(kinds(findings), Kinds{FindingKind::regression});
  EXPECT_EQ(findings[0].row, "exp");
  EXPECT_EQ(findings.back().row, "sin");
  EXPECT_EQ(findings[0].at, std::vector<std::string>{"0x1p+0"});
}

TEST(Gate, CountsMismatchesByStratumAndClass) {
  RowRecord one_nan = record("sqrt", 0.5, "edges");
  one_nan.summary.add({Outcome::nan, {}, 0, false}, 10);
  one_nan.planned = 11;
  one_nan.points.first_mismatch[Outcome::nan] = {"0x1.4p+5"};
  const auto without = budgets_of({record("sqrt", 0.5, "edges")});
  const auto findings = judge_records({one_nan}, without, MissingRecords::fail);
  ASSERT_EQ(kinds(findings), Kinds{FindingKind::regression});
  EXPECT_EQ(findings[0].at, std::vector<std::string>{"0x1.4p+5"});
  EXPECT_TRUE(judge_records({one_nan}, budgets_of({one_nan}), MissingRecords::fail).empty());
}

TEST(Budgets, FallFreelyAndRiseWithAReasonOnly) {
  auto budgets = budgets_of({record("exp", 0.512)});
  EXPECT_TRUE(update_budgets(budgets, budgets_of({record("exp", 0.505)}), "").empty());
  EXPECT_EQ(budgets["double"].rows["exp"].max_ulp["uniform"], 0.505);
  const auto raises = update_budgets(budgets, budgets_of({record("exp", 0.6)}), "");
  ASSERT_EQ(raises.size(), 1U);
  EXPECT_EQ(budgets["double"].rows["exp"].max_ulp["uniform"], 0.505);
  EXPECT_EQ(update_budgets(budgets, budgets_of({record("exp", 0.6)}), "new libm").size(), 1U);
  EXPECT_EQ(budgets["double"].rows["exp"].max_ulp["uniform"], 0.6);
  EXPECT_EQ(budgets["double"].rows["exp"].reason, "new libm");
}

TEST(Gate, HoldsEveryStratumToItsOwnLimit) {
  const auto budgets = budgets_of({record("sin", 0.515), record("sin", 1.4e5, "hard")});
  const auto findings =
      judge_records({record("sin", 5), record("sin", 1.4e5, "hard")}, budgets, MissingRecords::fail);
  ASSERT_EQ(kinds(findings), Kinds{FindingKind::regression});
  EXPECT_TRUE(std::ranges::any_of(findings, [](const GateFinding& f) {
    return f.message.find("maximum error in ULP 5, budget 0.515 (uniform") != std::string::npos;
  }));
  EXPECT_EQ(kinds(judge_records({record("sin", 0.51), record("sin", 0.51, "edges")}, budgets,
                                MissingRecords::ignore)),
            Kinds{FindingKind::missing_budget});
}

TEST(Budgets, StrataThatWereNotMeasuredStay) {
  RowRecord edges = record("sqrt", 0.5, "edges");
  edges.summary.add({Outcome::nan, {}, 0, false}, 10);
  auto budgets = budgets_of({record("sqrt", 0.5), edges});
  const auto before = budgets;
  EXPECT_TRUE(update_budgets(budgets, budgets_of({record("sqrt", 0.5)}), "").empty());
  EXPECT_EQ(budgets, before);
  EXPECT_TRUE(update_budgets(budgets, budgets_of({record("sqrt", 0.5, "hard")}), "").empty());
  EXPECT_EQ(budgets["double"].rows["sqrt"].max_ulp.size(), 3U);
  // The NaN is gone: the count falls with the next measurement of its stratum.
  EXPECT_TRUE(update_budgets(budgets, budgets_of({record("sqrt", 0.5, "edges")}), "").empty());
  EXPECT_TRUE(budgets["double"].rows["sqrt"].mismatch.empty());
}

TEST(Budgets, RoundUpToThreeDigits) {
  for (const double x : {0.5, 0.51234, 1.0, 7.19999, 8.0e18, 5.3e4, 123456.0, 1e-310}) {
    const double up = budgets_of({record("exp", x)})["double"].rows["exp"].max_ulp["uniform"];
    EXPECT_GE(up, x);
    EXPECT_LE(up, x * 1.011);
  }
}

TEST(Gate, SaysWhichCodeBudgetsAreOf) {
  RowRecord then = record("exp", 0.512);
  then.implementation = "glibc 2.36";
  RowRecord now = then;
  const Budgets budgets = budgets_of({then});
  EXPECT_TRUE(other_codes({now}, budgets).empty());
  now.implementation = "glibc 2.41";
  const auto found = other_codes({now}, budgets);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].type, "double");
  EXPECT_EQ(found[0].budgeted, "glibc 2.36");
  EXPECT_EQ(found[0].measured, "glibc 2.41");
  EXPECT_EQ(found[0].rows, 1U);
}

}  // namespace
}  // namespace ulpgate
