// Tests of exact text, and of the names that stand in it.
#include "reference/text/text.hpp"

#include <gtest/gtest.h>

#include "reference/functions/function_info.hpp"
#include "reference/types/eigen_traits.hpp"

namespace ulpgate {
namespace {

TEST(Text, OfHexadecimalNumbersHasOneForm) {
  EXPECT_EQ(to_hexfloat(1.0), "0x1p+0");
  EXPECT_EQ(to_hexfloat(-1.5), "-0x1.8p+0");
  EXPECT_EQ(to_hexfloat(2.0), "0x1p+1");
  EXPECT_EQ(to_hexfloat(0.5), "0x1p-1");
  EXPECT_EQ(to_hexfloat(0x1.23456789abcdep-1022), "0x1.23456789abcdep-1022");
  EXPECT_EQ(to_hexfloat(0x1p-1074), "0x1p-1074");
  EXPECT_EQ(to_hexfloat(-0.0), "-0x0p+0");
}

// However far behind the last bit that is kept the text goes on, it is rounded once.
TEST(Text, NextToAMidpointIsRoundedOnce) {
  const std::string midpoint = "0x1.00000000000008";  // 1 + 2^-53
  const std::string zeros(100, '0');
  for (const auto& [sign, size] : {std::pair{"", 1.0}, std::pair{"-", -1.0}}) {
    EXPECT_EQ(parse_real<double>(sign + midpoint + "p0"), size);
    EXPECT_EQ(parse_real<double>(sign + midpoint + zeros + "p0"), size);
    EXPECT_EQ(parse_real<double>(sign + midpoint + zeros + "1p0"), size * (1 + 0x1p-52));
    EXPECT_EQ(parse_real<double>(sign + midpoint.substr(0, 17) + "7" + std::string(100, 'f') + "p0"), size);
  }
  // 2^-1075, half of the least number, and its 751 decimal digits with one more.
  EXPECT_EQ(parse_real<double>("0x1p-1075"), 0);
  EXPECT_EQ(parse_real<double>("0x1." + zeros + "1p-1075"), 0x1p-1074);
}

TEST(Functions, NameTheirParts) {
  const FunctionInfo& f = info_of(FunctionId::csin);
  EXPECT_EQ(part_name(f, 0), "re");
  EXPECT_EQ(part_name(f, 1), "im");
  EXPECT_EQ(part_name(info_of(FunctionId::sin), 0), "value");
}

template <class Real>
void expect_usual_tolerance() {
  Eigen::Matrix<Real, 2, 1> a, b, c;
  a << Real(1), Real(2);
  b << Real(1), Real(2) + Real(2) * sqrt(std::numeric_limits<Real>::epsilon());
  c << Real(1), Real(2) + Real(16) * std::numeric_limits<Real>::epsilon();
  EXPECT_TRUE(a.isApprox(a));
  EXPECT_TRUE(a.isApprox(c)) << "a few ulps";
  EXPECT_FALSE(a.isApprox(b)) << "half of the digits";
}

TEST(EigenTraits, NumbersWithHalfOfTheirDigitsAlikeAreNotApproximatelyEqual) {
  expect_usual_tolerance<CppBinFloatReal<62>>();
  expect_usual_tolerance<MpfrReal<62>>();
}

}  // namespace
}  // namespace ulpgate
