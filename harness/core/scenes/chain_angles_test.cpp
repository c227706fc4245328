// Tests of the angles of a chain: against the law of cosines, which takes the distances of nodes alone.
#include "harness/core/scenes/chain_angles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "harness/core/scene_cases/scene_text.hpp"
#include "harness/core/scene_cases/scene_trial.hpp"

namespace ulpgate {
namespace {

using Node = std::array<int, 3>;

std::unique_ptr<dem::DemEngine> chain(const std::vector<Node>& nodes) {
  std::string text = scene_text::begin("chain", "m", {{"density", "2500"}});
  for (const Node& n : nodes) {
    text += scene_text::sphere(
        std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]), "0.01");
  }
  text += scene_text::contacts("frictional") + scene_text::run("1e-6", "1e-3");
  return dem::make_engine("double", dem::Level::own, scene_of(text), {});
}

long squared_distance(const Node& a, const Node& b) {
  long sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += static_cast<long>(a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// No component of a difference is 0, no two angles and no two lengths are the same.
const std::vector<Node> uneven = {{0, 0, 0}, {3, -1, 2}, {4, 3, 7}, {-2, 5, 1}, {-9, 4, 3}};

// cos of the angle at b: (ab^2 + bc^2 - ac^2) / (2 ab bc), to `bits`.
MpfrValue angle_at(const Node& a, const Node& b, const Node& c, mpfr_prec_t bits) {
  MpfrValue denominator(bits);
  mpfr_set_si(denominator, 4 * squared_distance(a, b) * squared_distance(b, c), MPFR_RNDN);
  mpfr_sqrt(denominator, denominator, MPFR_RNDN);
  MpfrValue angle(bits);
  mpfr_si_div(angle, squared_distance(a, b) + squared_distance(b, c) - squared_distance(a, c), denominator,
              MPFR_RNDN);
  mpfr_acos(angle, angle, MPFR_RNDN);
  return angle;
}

TEST(ChainAngles, AreThoseOfTheLawOfCosines) {
  const auto engine = chain(uneven);
  const auto angles = chain_angles(*engine);
  const auto exact = exact_chain_angles(*engine, 200);
  ASSERT_EQ(angles.size(), uneven.size() - 2);
  ASSERT_EQ(exact.angles.size(), angles.size());
  MpfrValue product(400);
  mpfr_set_ui(product, 1, MPFR_RNDN);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const MpfrValue want = angle_at(uneven[i], uneven[i + 1], uneven[i + 2], 400);
    EXPECT_NEAR(angles[i], mpfr_get_d(want, MPFR_RNDN), 4e-16) << "node " << i + 1;
    MpfrValue difference(64);
    mpfr_sub(difference, exact.angles[i], want, MPFR_RNDN);
    EXPECT_LT(std::fabs(mpfr_get_d(difference, MPFR_RNDN)), 0x1p-240) << "node " << i + 1;
    mpfr_mul(product, product, want, MPFR_RNDN);
  }
  EXPECT_NEAR(product_of(angles) / mpfr_get_d(product, MPFR_RNDN), 1, 1e-15);
  mpfr_sub(product, product, exact.product, MPFR_RNDN);
  EXPECT_LT(std::fabs(mpfr_get_d(product, MPFR_RNDN)), 0x1p-240);
  EXPECT_GE(mpfr_get_prec(exact.product.get()), 200);
}

TEST(ChainAngles, OfStraightAndFoldedChains) {
  const auto engine = chain({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {1, 2, 2}});
  const auto angles = chain_angles(*engine);
  ASSERT_EQ(angles.size(), 2U);
  EXPECT_EQ(angles[0], std::numbers::pi);
  EXPECT_LT(angles[1], 0.3) << "folded back";
  EXPECT_GT(angles[1], 0);
  const auto exact = exact_chain_angles(*engine, 100);
  EXPECT_EQ(mpfr_get_d(exact.angles[0].get(), MPFR_RNDN), std::numbers::pi);
}

TEST(ChainAngles, OfFewerThanThreeBodiesAreNone) {
  const auto engine = chain({{0, 0, 0}, {1, 2, 3}});
  EXPECT_TRUE(chain_angles(*engine).empty());
  EXPECT_EQ(product_of({}), 1);
  EXPECT_EQ(product_of({2, 3, 0.5}), 3);
  EXPECT_EQ(mpfr_cmp_ui(exact_chain_angles(*engine, 100).product, 1), 0);
}

}  // namespace
}  // namespace ulpgate
