// Tests of the types, the ladder RealHP<N>, widening, mixed precision and the Eigen traits.
#include <gtest/gtest.h>

#include "reference/text/literal.hpp"
#include "reference/types/descriptor.hpp"
#include "reference/types/eigen_traits.hpp"
#include "reference/types/mixed_precision.hpp"
#include "reference/types/widen.hpp"

namespace ulpgate {
namespace {

template <class Real>
class Ladder : public testing::Test {};
using Bases = testing::Types<float, double, long double,
#ifdef ULPGATE_HAVE_FLOAT128
                             Float128Real,
#endif
                             MpfrReal<62>, MpfrReal<150>, CppBinFloatReal<62>>;
TYPED_TEST_SUITE(Ladder, Bases);

template <class Base, unsigned N>
void expect_enough_digits_at() {
  using Level = RealHP<N, Base>;
  constexpr int wanted = static_cast<int>(N) * std::numeric_limits<Base>::digits10;
  EXPECT_GE(std::numeric_limits<Level>::digits10, wanted) << "N = " << N;
}

template <class Base, unsigned... N>
void expect_enough_digits(std::integer_sequence<unsigned, N...>) {
  (expect_enough_digits_at<Base, N>(), ...);
}

TYPED_TEST(Ladder, HasAtLeastNTimesTheDigits) {
  static_assert(std::same_as<RealHP<1, TypeParam>, TypeParam>);
  expect_enough_digits<TypeParam>(std::integer_sequence<unsigned, 1, 2, 3, 4, 8, 10, 20>());
}

TYPED_TEST(Ladder, WidensExactlyAndOnlyUpwards) {
  using Wide = RealHP<4, TypeParam>;
  static_assert(widens_exactly<TypeParam, Wide>);
  static_assert(!widens_exactly<Wide, TypeParam>);
  const TypeParam third = TypeParam(1) / TypeParam(3);
  const Wide wide = widen<Wide>(third);
  EXPECT_EQ(static_cast<TypeParam>(wide), third);
  EXPECT_NE(wide, Wide(1) / Wide(3)) << "the extra bits must be zero";
}

TYPED_TEST(Ladder, ConstantsHaveFullPrecision) {
  const TypeParam x = real<TypeParam>("0.1");
  EXPECT_EQ(x, TypeParam(1) / TypeParam(10));
  EXPECT_THROW(static_cast<void>(real<TypeParam>("0.1x")), std::invalid_argument);
}

TYPED_TEST(Ladder, TextRoundTrips) {
  using L = std::numeric_limits<TypeParam>;
  const TypeParam values[] = {TypeParam(0),
                              TypeParam(-0.0),
                              TypeParam(1) / TypeParam(3),
                              L::epsilon(),
                              (L::max)(),
                              (L::min)(),
                              -(L::max)(),
                              real<TypeParam>("1e-30"),
                              L::denorm_min(),
                              TypeParam(1) + L::epsilon(),
                              L::infinity()};
  for (const TypeParam& x : values) {
    for (const auto& text : {to_hexfloat(x), to_decimal(x)}) {
      const TypeParam back = parse_real<TypeParam>(text);
      EXPECT_EQ(back, x) << text;
      using std::signbit;
      EXPECT_EQ(signbit(back), signbit(x)) << text;
    }
  }
  const TypeParam nan = parse_real<TypeParam>("nan");
  EXPECT_NE(nan, nan);
}

TYPED_TEST(Ladder, FormatHasTheRangeOfTheType) {
  using L = std::numeric_limits<TypeParam>;
  const FloatFormat f = float_format<TypeParam>();
  MpfrValue x(L::digits);
  to_mpfr(x.get(), (L::max)());
  EXPECT_EQ(binade(x), f.exponent_max);
  to_mpfr(x.get(), (L::min)());
  EXPECT_EQ(binade(x), f.exponent_min);
}

TYPED_TEST(Ladder, EigenLowestIsTheLeastNumber) {
  EXPECT_EQ(Eigen::NumTraits<TypeParam>::lowest(), -(std::numeric_limits<TypeParam>::max)());
  AlignedBoxrHP<1, TypeParam, 3> box;
  box.setEmpty();
  const Vector3rHP<1, TypeParam> below(TypeParam(-3), TypeParam(-2), TypeParam(-1));
  box.extend(below);
  EXPECT_EQ(box.max(), below) << "a wrong lowest() leaves a positive corner behind";
  EXPECT_EQ(box.min(), below);
}

TYPED_TEST(Ladder, EigenAlgebraWorksAtEveryLevel) {
  using Real = RealHP<4, TypeParam>;
  using Vector = Vector3rHP<4, TypeParam>;
  const QuaternionrHP<4, TypeParam> turn(
      AngleAxisrHP<4, TypeParam>(Real(2), Vector(Real(0), Real(0), Real(1))));
  const Vector x = turn * Vector(Real(1), Real(0), Real(0));
  using std::abs;
  using std::cos;
  EXPECT_LE(abs(Real(x[0] - cos(Real(2)))), Real(8) * std::numeric_limits<Real>::epsilon());
  MatrixXrHP<4, TypeParam> m = MatrixXrHP<4, TypeParam>::Identity(4, 4) * Real(3);
  EXPECT_EQ(m.trace(), Real(12));
  const ComplexHP<4, TypeParam> i(Real(0), Real(1));
  const ComplexHP<4, TypeParam> square = i * i;
  EXPECT_EQ(square.real(), Real(-1));
}

TEST(MixedPrecision, OptInHeaderWidensTheNarrowerOperand) {
  const MpfrReal<62> third = MpfrReal<62>(1) / 3;
  const MpfrReal<248> sum = third + MpfrReal<248>(1);
  EXPECT_EQ(sum, widen<MpfrReal<248>>(third) + MpfrReal<248>(1));
}

TEST(Descriptor, AgreesWithThePublishedTable) {
  struct Row {
    RealDescriptor d;
    int total, places, exponent, significand;
  };
  const Row rows[] = {{describe<float>("", ""), 32, 6, 8, 24},
                      {describe<double>("", ""), 64, 15, 11, 53},
                      {describe<long double>("", ""), 80, 18, 15, 64},
#ifdef ULPGATE_HAVE_FLOAT128
                      {describe<Float128Real>("", ""), 128, 33, 15, 113},
#endif
                      {describe<MpfrReal<62>>("", ""), 0, 62, 0, 207},
                      {describe<MpfrReal<150>>("", ""), 0, 150, 0, 500},
                      {describe<CppBinFloatReal<62>>("", ""), 0, 62, 0, 207}};
  for (const auto& r : rows) {
    EXPECT_EQ(r.d.total_bits, r.total);
    EXPECT_EQ(r.d.decimal_places, r.places);
    EXPECT_EQ(r.d.exponent_bits, r.exponent);
    EXPECT_EQ(r.d.significand_bits, r.significand);
  }
}

TEST(Parse, RoundsOnceEvenAmongSubnormals) {
  // Just above half of the least double: a first rounding to 53 bits would land on the tie and then on zero.
  EXPECT_EQ(parse_real<double>("0x1.00000000000000000001p-1075"), 0x1p-1074);
  EXPECT_EQ(parse_real<double>("0x1p-1075"), 0.0);
  EXPECT_EQ(parse_real<float>("3.4028236e38"), std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace ulpgate
