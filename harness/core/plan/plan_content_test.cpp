// Tests of what a plan holds: worst cases first and as they were given, units without gaps, a text that tells
// plans apart.
#include <gtest/gtest.h>

#include "harness/core/plan/plan.hpp"

namespace ulpgate {
namespace {

ArgumentList points(const std::vector<double>& values) {
  ArgumentList list;
  for (const double x : values) {
    std::vector<MpfrValue> point;
    point.emplace_back(53);
    mpfr_set_d(point[0], x, MPFR_RNDN);
    list.push_back(std::move(point));
  }
  return list;
}

PlanRequest request_for(SubjectKind kind, const std::vector<Stratum>& strata, std::uint64_t samples) {
  PlanRequest request;
  request.kind = kind;
  request.subjects = {kind == SubjectKind::function ? "sin" : "sphere_sphere"};
  request.types = {"double"};
  request.strata = strata;
  request.samples = samples;
  return request;
}

TEST(Plan, WorstCasesAreAnsweredFirstAndAsTheyWereGiven) {
  const std::vector<double> given = {0x1.921fb54442d18p+1, -3.25, 0x1p-1074};
  WorstCases worst;
  worst[{"sin", "double"}] = points(given);
  worst[{"cos", "double"}] = points({1});
  const Plan plan(
      request_for(SubjectKind::function, {Stratum::uniform, Stratum::worst, Stratum::edges}, 5000), worst);
  const PlanRow& first = plan.rows().at(plan.units().at(0).row);
  ASSERT_EQ(first.source.stratum, Stratum::worst);
  EXPECT_EQ(first.source.count, given.size());
  ASSERT_EQ(first.source.list->size(), given.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    EXPECT_EQ(mpfr_get_d((*first.source.list)[i].at(0), MPFR_RNDN), given[i]);
  for (std::size_t u = 1; u < plan.units().size(); ++u)
    EXPECT_NE(plan.rows()[plan.units()[u].row].source.stratum, Stratum::worst) << "it is one unit";
  EXPECT_EQ(mpfr_get_d(worst.at({"sin", "double"})[1][0], MPFR_RNDN), -3.25) << "the caller's stay";
}

TEST(Plan, OneWorstCaseIsARowToo) {
  WorstCases worst;
  worst[{"sin", "double"}] = points({0.75});
  const Plan plan(request_for(SubjectKind::function, {Stratum::worst}, 1), worst);
  ASSERT_EQ(plan.rows().size(), 1U);
  EXPECT_EQ(plan.rows()[0].source.count, 1U);
}

TEST(Plan, UnitsFollowEachOtherWithoutGapsOrEmptyOnes) {
  for (const std::uint64_t samples :
       {unit_size - 1, unit_size, unit_size + 1, 2 * unit_size, 5 * unit_size / 2}) {
    const Plan plan(request_for(SubjectKind::function, {Stratum::uniform}, samples), {});
    std::uint64_t next = 0;
    for (const WorkUnit& unit : plan.units()) {
      EXPECT_EQ(unit.row, 0U);
      EXPECT_EQ(unit.first, next);
      EXPECT_GT(unit.last, unit.first);
      EXPECT_EQ(unit.last, std::min(samples, unit.first + unit_size));
      next = unit.last;
    }
    EXPECT_EQ(next, samples);
    EXPECT_EQ(plan.units().size(), (samples + unit_size - 1) / unit_size);
  }
}

bool says(const Plan& plan, const std::string& line) {
  return ("\n" + plan.text()).find("\n" + line + "\n") != std::string::npos;
}

TEST(Plan, SaysInItsTextWhatFixesTheNumbers) {
  using enum Stratum;
  auto request = request_for(SubjectKind::function, {uniform, stratified, edges}, 700);
  request.seed = 9;
  const Plan functions(request, {});
  for (const char* line : {"ulpgate math plan", "seed 9", "samples 700", "types double",
                           "strata uniform,stratified,edges", "functions sin"})
    EXPECT_TRUE(says(functions, line)) << line << "\n" << functions.text();
  EXPECT_NE(functions.text().find("worst_cases "), std::string::npos);

  const Plan alone(request_for(SubjectKind::function, {uniform, edges}, 700), {});
  EXPECT_TRUE(says(alone, "samples 700 undivided")) << alone.text();

  const Plan kernels(request_for(SubjectKind::kernel, {uniform, edges}, 700), {});
  for (const char* line :
       {"ulpgate kernel plan", "samples 700", "functions sphere_sphere", "kernels sphere_sphere"})
    EXPECT_EQ(says(kernels, line), std::string(line).find("functions") != 0) << line << "\n"
                                                                             << kernels.text();
  EXPECT_EQ(kernels.text().find("worst_cases "), std::string::npos) << "kernels have none";

  request.worst_cases_text = "sin 1\n";
  EXPECT_NE(Plan(request, {}).hash(), functions.hash());
  request.worst_cases_text.clear();
  EXPECT_EQ(Plan(request, {}).hash(), functions.hash());
}

// What a record says of its largest errors is said of points that were looked at.
TEST(FinishRow, NamesTheArgumentsOfWhatItsSummariesHold) {
  struct Case {
    SubjectKind kind;
    const char* subject;
    Stratum stratum;
    bool normwise;
  };
  for (const Case& c : {Case{SubjectKind::function, "exp", Stratum::uniform, false},
                        Case{SubjectKind::kernel, "rotation", Stratum::typical, true}}) {
    PlanRequest request;
    request.kind = c.kind;
    request.subjects = {c.subject};
    request.types = {"double"};
    request.strata = {c.stratum};
    request.samples = 20;
    const Plan plan(request, {});
    ASSERT_EQ(plan.rows().size(), 1U);
    const PlanRow& row = plan.rows()[0];
    RowHint hint(row.subject->info().parts.size());
    const auto summaries = row.subject->evaluate(row.source, 0, row.source.count, ReferenceMode::full, hint);
    const auto records = finish_row(plan, row, summaries);
    ASSERT_EQ(records.size(), summaries.size());
    for (std::size_t part = 0; part < records.size(); ++part) {
      const RowPoints& points = records[part].points;
      EXPECT_EQ(points.argmax, row.subject->point(row.source, summaries[part].max_error.index).args_hex);
      EXPECT_TRUE(points.first_mismatch.empty());
      EXPECT_EQ(points.normwise_argmax.empty(), !c.normwise) << c.subject;
      if (!c.normwise) continue;
      const Point worst = row.subject->point(row.source, summaries[part].normwise.index);
      EXPECT_EQ(points.normwise_argmax, worst.args_hex);
      EXPECT_EQ(points.condition, worst.parts[part].condition);
    }
  }
}

}  // namespace
}  // namespace ulpgate
