// Tests of the engine: planted defects are caught, every function evaluates in every type, plans cover every
// row.
#include "harness/core/functions/engine.hpp"

#include <gtest/gtest.h>

#include "harness/core/plan/plan.hpp"
#include "harness/core/testing/planted_defects.hpp"

namespace ulpgate {
namespace {

Engine<double> engine_with(FunctionId id, BatchFunction<double> replacement) {
  FunctionTable<double> table = function_table<double>();
  table[static_cast<std::size_t>(id)] = replacement;
  return {describe<double>("double", "double"), std::move(table), function_table<RealHP<4, double>>()};
}

Summary run(const TypeEngine& engine, FunctionId id, Stratum stratum, std::uint64_t count) {
  RowHint hint(1);
  ArgumentList list;
  StratumSource source{stratum, 1, count, nullptr};
  if (stratum == Stratum::edges) {
    list = edge_arguments(info_of(id), engine.descriptor().format);
    source.count = list.size();
    source.list = &list;
  }
  return engine.evaluate(info_of(id), source, 0, source.count, ReferenceMode::screened, hint)[0];
}

TEST(Mutation, OneWrongCoefficientOfExpIsCaught) {
  const auto wrong = engine_with(FunctionId::exp, &testing::batch_of<testing::wrong_exp>);
  const Summary bad = run(wrong, FunctionId::exp, Stratum::uniform, 1000);
  const Summary good = run(*find_engine("double"), FunctionId::exp, Stratum::uniform, 1000);
  EXPECT_GT(bad.max_error.value, 1e4);
  EXPECT_LT(good.max_error.value, 0.52);
}

TEST(Mutation, ANaNAtOneArgumentIsCaught) {
  const auto hole = engine_with(FunctionId::sqrt, &testing::batch_of<testing::sqrt_with_a_hole>);
  const Summary bad = run(hole, FunctionId::sqrt, Stratum::edges, 0);
  EXPECT_EQ(bad.outcomes[static_cast<std::size_t>(Outcome::nan)], 1U);
  EXPECT_EQ(bad.mismatches(), 1U);
  EXPECT_EQ(run(*find_engine("double"), FunctionId::sqrt, Stratum::edges, 0).mismatches(), 0U);
}

TEST(Engine, ThrownExceptionsAreCounted) {
  const auto throwing =
      engine_with(FunctionId::cos, [](const double*, double* r, std::uint8_t* threw, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
          r[i] = 0;
          threw[i] = 1;
        }
      });
  EXPECT_EQ(run(throwing, FunctionId::cos, Stratum::uniform, 20)
                .outcomes[static_cast<std::size_t>(Outcome::exception)],
            20U);
}

TEST(Coverage, EveryFunctionEvaluatesInEveryTypeBuilt) {
  for (const auto& engine : all_engines()) {
    for (const auto& f : all_functions()) {
      RowHint hint(f.parts);
      const auto summaries =
          engine->evaluate(f, {Stratum::uniform, 1, 3, nullptr}, 0, 3, ReferenceMode::screened, hint);
      ASSERT_EQ(summaries.size(), static_cast<std::size_t>(f.parts));
      EXPECT_EQ(summaries[0].samples, 3U) << f.name << " " << engine->descriptor().token;
    }
  }
}

TEST(Plan, HalvesSamplesAndCoversEveryRow) {
  EXPECT_EQ(Plan::drawn_count(Stratum::uniform, 20001), 10001U);
  EXPECT_EQ(Plan::drawn_count(Stratum::stratified, 20001), 10000U);
  PlanRequest request;
  request.functions = {FunctionId::sin, FunctionId::add};
  request.types = {"double"};
  request.strata = {Stratum::uniform, Stratum::edges, Stratum::hard};
  request.samples = 10000;
  const Plan plan(request, {});
  EXPECT_EQ(plan.rows().size(), 5U) << "add has no hard arguments";
  std::uint64_t planned = 0;
  for (const auto& row : plan.rows()) planned += row.source.count;
  std::uint64_t in_units = 0;
  for (const auto& unit : plan.units()) in_units += unit.last - unit.first;
  EXPECT_EQ(planned, in_units);
  request.seed = 2;
  EXPECT_NE(Plan(request, {}).hash(), plan.hash());
}

TEST(Plan, TheExhaustiveStratumHoldsEveryFloatOnce) {
  PlanRequest request;
  request.functions = {FunctionId::sin, FunctionId::add, FunctionId::csin};
  request.types = {"float", "double"};
  request.strata = {Stratum::exhaustive};
  const Plan plan(request, {});
  ASSERT_EQ(plan.rows().size(), 1U) << "real functions of one argument, of float";
  std::uint64_t next = 0;
  for (const auto& unit : plan.units()) {
    EXPECT_EQ(unit.first, next);
    next = unit.last;
  }
  EXPECT_EQ(next, exhaustive_count);
}

}  // namespace
}  // namespace ulpgate
