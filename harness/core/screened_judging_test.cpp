// Tests of the screened reference: the records of the full one, and a lying stage is found.
#include "harness/core/screened_judging.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/type_engine.hpp"

namespace ulpgate {
namespace {

// Everything that a record takes from a summary.
auto recorded_figures(const Summary& s) {
  return std::tuple(s.samples, s.correctly_rounded, s.outcomes, s.first_index, s.max_error.value,
                    s.max_error.index, s.max_distance, s.max_error_over_condition, s.histogram.exact,
                    s.histogram.counts, s.sum.to_text());
}

TEST(ScreenedJudging, GivesTheRecordsOfTheFullReference) {
  for (const auto& engine : all_engines()) {
    for (const auto& f : all_functions()) {
      const ArgumentList edges = edge_arguments(f, engine->descriptor().format);
      for (const StratumSource& source :
           {StratumSource{Stratum::uniform, 7, 40, nullptr}, StratumSource{Stratum::binades, 7, 20, nullptr},
            StratumSource{Stratum::edges, 7, std::min<std::uint64_t>(edges.size(), 100), &edges}}) {
        RowHint hint(f.parts);
        RowHint other_hint(f.parts);
        const auto full = engine->evaluate(f, source, 0, source.count, ReferenceMode::full, hint);
        const auto screened =
            engine->evaluate(f, source, 0, source.count, ReferenceMode::screened, other_hint);
        for (std::size_t part = 0; part < full.size(); ++part) {
          EXPECT_EQ(recorded_figures(full[part]), recorded_figures(screened[part]))
              << f.name << " part " << part << " " << engine->descriptor().token << " "
              << name_of(source.stratum);
        }
      }
    }
  }
}

// Off by a few units of its own precision: more than a stage may be.
ExactParts lying_stage(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out) {
  exact_value(f, args, out);
  for (int step = 0; step < 1000; ++step) mpfr_nextabove(out[0]);
  // Told as exact, so that the lie decides.
  return {true, true};
}

TEST(ScreenedJudging, ALyingStageIsFoundAndTheArgumentNamed) {
  const double x = 0.5;
  const double y = std::exp(x);
  const std::uint8_t threw = 0;
  Judgement out;
  const ScreenedJudging<double> screened(lying_stage);
  const FunctionInfo& exp = info_of(FunctionId::exp);
  // Index 1 is not among the checked: there the lie would pass.
  EXPECT_NO_THROW(screened.judge({exp, {&x, 1}, {&y, 1}, {&threw, 1}, 1}, {&out, 1}));
  const double zero = 0;
  const double one = 1;  // exp(0) is exact; the stage says otherwise
  try {
    screened.judge({exp, {&zero, 1}, {&one, 1}, {&threw, 1}, 0}, {&out, 1});
    FAIL() << "the checked share must find the lie";
  } catch (const ReferenceDisagreement& e) {
    EXPECT_NE(std::string(e.what()).find("exp at 0x0p+0"), std::string::npos) << e.what();
  }
}

TEST(RecordedError, IsRoundedUpToFortyBits) {
  struct Case {
    double error;
    double want;
    const char* why;
  };
  for (const auto& [error, want, why] : {
           Case{0, 0, "an exact result stays exact"},
           Case{0.5, 0.5, "half a ULP is a multiple"},
           Case{1e-30, 0x1p-40, "no error looks exact"},
           Case{0.5 + 0x1p-50, 0.5 + 0x1p-40, "up, never down"},
           Case{0x1p60, 0x1p60, "powers of two stay"},
           Case{0x1p60 + 0x1p10, 0x1p60 + 0x1p21, "forty bits of a large error"},
           Case{HUGE_VAL, HUGE_VAL, "infinity stays"},
       }) {
    EXPECT_EQ(recorded({error}).value, want) << why;
  }
}

}  // namespace
}  // namespace ulpgate
