// Tests of the scan: what it settles, NativeStage settles too, and both count it alike.
#include "harness/core/judging/ordinary_scan.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "harness/core/judging/native_stage.hpp"
#include "harness/core/judging/row_tally.hpp"
#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/records/recorded_figures.hpp"
#include "kernels/math/function_table.hpp"

namespace ulpgate {
namespace {

// Bit patterns of every kind, plateaus where a result stays at 0, 1, 2 or its argument among them.
std::vector<float> many_floats() {
  std::mt19937 words(7);
  std::vector<float> list;
  for (int i = 0; i < 30000; ++i) list.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(words())));
  for (int i = -4000; i <= 4000; ++i) {
    list.push_back(static_cast<float>(i) * 0.0625F);
    list.push_back(std::ldexp(1.0F + static_cast<float>(i) * 0x1p-23F, i % 140));
  }
  return list;
}

void count_one_by_one(const NativeStage<float, double, Stage::binary64>& stage,
                      const std::vector<float>& args, const std::vector<float>& results,
                      const std::vector<std::uint8_t>& verdicts, RowTally<float>& tally) {
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (verdicts[i] == verdict::unsettled) continue;
    Finding finding;
    ASSERT_TRUE(stage.find(i, &args[i], results[i], finding)) << args[i];
    const long double value = stage.value(i);
    ASSERT_TRUE(tally.settle({&finding, 1}, i, &args[i], {&value, 1})) << args[i];
  }
}

TEST(OrdinaryScan, SettlesNothingThatTheStageWouldNotAndCountsItAlike) {
  const std::vector<float> args = many_floats();
  const FunctionTable<float>& functions = function_table<float>();
  for (const FunctionInfo& f : all_functions()) {
    const ScreenStages stages = screen_stages(f);
    if (f.arity != 1 || stages.binary64 == nullptr) continue;
    std::vector<float> results(args.size());
    std::vector<std::uint8_t> threw(args.size());
    functions[static_cast<std::size_t>(f.id)](args.data(), results.data(), threw.data(), args.size());
    NativeStage<float, double, Stage::binary64> stage(f.id, stages.binary64);
    stage.load(args, args.size());
    for (const double largest : {0.3, 5.0}) {
      for (const OrdinaryScan scan : ordinary_scans()) {
        std::vector<std::uint8_t> verdicts(args.size());
        scan(stage.scan_input(args, results, 0, largest), verdicts.data());
        RowHint hint(1);
        hint.raise_max_error(0, {largest, 0});
        RowTally<float> at_once(f, hint);
        RowTally<float> one_by_one(f, hint);
        at_once.count_scanned(verdicts, 0);
        count_one_by_one(stage, args, results, verdicts, one_by_one);
        const Summary a = at_once.take()[0];
        const Summary b = one_by_one.take()[0];
        EXPECT_EQ(recorded_figures(a), recorded_figures(b)) << f.name;
        const double settled = static_cast<double>(a.samples) / static_cast<double>(args.size());
        EXPECT_GT(settled, largest > 1 ? 0.4 : 0.1) << f.name;
      }
    }
  }
}

TEST(OrdinaryScan, WritesTheSameVerdictsWithEveryInstructionSet) {
  const std::vector<float> args = many_floats();
  NativeStage<float, double, Stage::binary64> stage(FunctionId::tanh,
                                                    bounded_function<double>(FunctionId::tanh));
  stage.load(args, args.size());
  std::vector<float> results;
  for (const float x : args) results.push_back(std::tanh(x));
  std::vector<std::vector<std::uint8_t>> all;
  for (const OrdinaryScan scan : ordinary_scans()) {
    all.emplace_back(args.size());
    scan(stage.scan_input(args, results, 123456789, 1.5), all.back().data());
    all.back().resize(args.size() - 8);
    EXPECT_EQ(all.back(), all.front());
  }
}

}  // namespace
}  // namespace ulpgate
