// Tests of plans: every row is covered, samples are shared, the hash tells plans apart.
#include "harness/core/plan/plan.hpp"

#include <gtest/gtest.h>

#include <map>

namespace ulpgate {
namespace {

TEST(Plan, HalvesSamplesAndCoversEveryRow) {
  const std::vector<Stratum> both = {Stratum::uniform, Stratum::stratified};
  EXPECT_EQ(drawn_count(SubjectKind::function, Stratum::uniform, 20001, both), 10001U);
  EXPECT_EQ(drawn_count(SubjectKind::function, Stratum::stratified, 20001, both), 10000U);
  PlanRequest request;
  request.subjects = {"sin", "add"};
  request.types = {"double"};
  request.strata = {Stratum::uniform, Stratum::stratified, Stratum::edges, Stratum::hard};
  request.samples = 10000;
  const Plan plan(request, {});
  EXPECT_EQ(plan.rows().size(), 7U) << "add has no hard arguments";
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
  request.subjects = {"sin", "add", "csin"};
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

// N samples are shared among those of uniform and stratified that were chosen.
TEST(Plan, OneDrawnStratumAloneGetsAllSamples) {
  struct Case {
    std::vector<Stratum> chosen;
    std::map<Stratum, std::uint64_t> want;
    const char* why;
  };
  using enum Stratum;
  for (const auto& [chosen, want, why] : {
           Case{{uniform}, {{uniform, 1001}}, "nobody to share with"},
           Case{{stratified, edges}, {{stratified, 1001}}, "edges are a list"},
           Case{{uniform, stratified}, {{uniform, 501}, {stratified, 500}}, "halves"},
           Case{{uniform, binades}, {{uniform, 1001}, {binades, 500}}, "binades get half as many again"},
       }) {
    PlanRequest request;
    request.subjects = {"sin"};
    request.types = {"double"};
    request.strata = chosen;
    request.samples = 1001;
    const Plan plan(request, {});
    std::map<Stratum, std::uint64_t> found;
    for (const auto& row : plan.rows())
      if (is_drawn(row.source.stratum)) found[row.source.stratum] = row.source.count;
    EXPECT_EQ(found, want) << why;
    std::uint64_t in_units = 0;
    for (const auto& unit : plan.units())
      if (is_drawn(plan.rows()[unit.row].source.stratum)) in_units += unit.last - unit.first;
    std::uint64_t wanted = 0;
    for (const auto& [stratum, count] : want) wanted += count;
    EXPECT_EQ(in_units, wanted) << why;
  }
}

TEST(Plan, KernelsGetAllStatesInEveryStratum) {
  PlanRequest request;
  request.kind = SubjectKind::kernel;
  request.subjects = {"sphere_sphere"};
  request.types = {"double"};
  request.strata = {Stratum::uniform, Stratum::stratified, Stratum::deep};
  request.samples = 30;
  const Plan plan(request, {});
  ASSERT_EQ(plan.rows().size(), 3U);
  for (const auto& row : plan.rows()) EXPECT_EQ(row.source.count, 30U);
}

}  // namespace
}  // namespace ulpgate
