// Tests of the two references at results next to midpoints: every figure is the same, in whichever order the
// samples come.  ULPGATE_HARD_POINTS=100000 asks for that many arguments a function instead of 400.
#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/records/summary_text.hpp"
#include "harness/core/testing/near_midpoints.hpp"
#include "kernels/math/function_table.hpp"
#include "tests/built_types.hpp"

namespace ulpgate {
namespace {

// Of the given points as one unit of a row, and, backwards, as several that tell each other their maxima.
template <class Judging, class Real>
Summary judged(const FunctionInfo& f, const std::vector<Real>& args, std::size_t units) {
  const std::size_t count = args.size();
  std::vector<Real> results(count);
  const std::vector<std::uint8_t> threw(count);
  std::vector<std::uint8_t> thrown(count);
  function_table<Real>()[static_cast<std::size_t>(f.id)](args.data(), results.data(), thrown.data(), count);
  RowHint hint(1);
  Summary total;
  for (std::size_t unit = units; unit-- > 0;) {
    RowTally<Real> tally(f, hint);
    Judging judging(f);
    const std::size_t last = count * (unit + 1) / units;
    std::size_t n = 0;
    for (std::size_t i = count * unit / units; i < last; i += n) {
      n = std::min<std::size_t>(last - i, 256);
      judging.judge(Batch<Real>{f, {&args[i], n}, {&results[i], n}, {&threw[i], n}, i}, tally);
    }
    total.merge(tally.take()[0]);
  }
  return total;
}

template <class Real>
void expect_one_record(const FunctionInfo& f, const std::vector<Real>& args) {
  if (args.empty()) return;
  const std::string want = summary_to_text(judged<FullJudging<Real>>(f, args, 1));
  EXPECT_EQ(summary_to_text(judged<ScreenedJudging<Real>>(f, args, 1)), want) << f.name;
  EXPECT_EQ(summary_to_text(judged<FullJudging<Real>>(f, args, 3)), want) << f.name << ", other order";
  EXPECT_EQ(summary_to_text(judged<ScreenedJudging<Real>>(f, args, 3)), want) << f.name << ", other order";
}

// Errors of 1/2 ULP and less than 2^-40 more are recorded as one number; their condition numbers differ.  The
// references reach the second of each pair by different stages, so that they meet the two in different order.
TEST(HardRoundingOfDouble, ErrorsThatAreRecordedAsOneAreToldApartByTheirConditions) {
  struct Pair {
    FunctionId id;
    double first, second;
  };
  for (const auto& [id, first, second] : {
           Pair{FunctionId::expm1, -0x1.8938fb37bc9dap-46, 0x1.c4b092bff7fbap-43},
           Pair{FunctionId::tan, -0x1.3652dd0d71dadp-24, -0x1.f301a155dad16p-24},
           Pair{FunctionId::tan, -0x1.c4bd22db691e7p-24, -0x1.576af4f349374p-23},
           Pair{FunctionId::asin, 0x1.e7257aefa1218p-23, 0x1.be406eb9a5618p-23},
           Pair{FunctionId::log1p, -0x1.06251e9784cd7p-40, -0x1.edac054c8f925p-47},
           Pair{FunctionId::sinh, 0x1.9c1d1c006a7fap-23, -0x1.f0e454245e4bep-24},
       }) {
    expect_one_record<double>(info_of(id), {first, second});
  }
}

std::size_t points_a_function() {
  const char* wanted = std::getenv("ULPGATE_HARD_POINTS");
  return wanted == nullptr ? 400 : std::strtoull(wanted, nullptr, 10);
}

template <class Real>
class HardRounding : public ::testing::Test {};
using BuiltTypes = ::testing::Types<ULPGATE_TEST_TYPES>;
TYPED_TEST_SUITE(HardRounding, BuiltTypes);

// In types without native stages the two references are one.
TYPED_TEST(HardRounding, RecordsNextToMidpointsAreTheSame) {
  using Real = TypeParam;
  if constexpr (NativeReal<Real>) {
    for (const FunctionInfo& f : all_functions()) {
      std::vector<Real> all;
      std::vector<Real> closest;  // their errors are recorded as 1/2 ULP or as the next number
      for (const NearMidpoint& p : near_midpoints(f, float_format<Real>(), points_a_function(), 1)) {
        all.push_back(from_mpfr<Real>(p.argument));
        if (p.distance_ulp < 0x1p-41) closest.push_back(all.back());
      }
      expect_one_record(f, all);
      expect_one_record(f, closest);
    }
  } else {
    GTEST_SKIP() << "float, double and long double alone have native stages";
  }
}

}  // namespace
}  // namespace ulpgate
