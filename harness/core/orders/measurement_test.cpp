// Tests of measurements in pieces: sizes that change nothing, pieces taken over, torn pieces, stopping.
#include "harness/core/orders/measurement.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "harness/core/orders/order_engine.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate {
namespace {

std::vector<std::string> pieces_of(Measurement& m, long steps) {
  std::vector<std::string> pieces;
  while (!m.complete()) pieces.push_back(m.proceed(steps));
  return pieces;
}

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

// 6 units of 8 steps, 2 in the wide types: more than a step of bulirsch_stoer's own.
std::unique_ptr<DriftMeasurement> short_drift(const std::string& token, const std::string& integrator) {
  return find_order_engine(token)->drift(integrator, "kepler", 8,
                                         token == "mpfr62" || token == "float128" ? 2 : 6);
}

// Cut after every few steps and continued by a new measurement, which makes a new stepper.
TEST(Measurement, ADriftInSlicesHasTheBitsOfOneInOneGo) {
  for (const std::string token : {"float", "double", "float128", "mpfr62"}) {
    if (find_order_engine(token) == nullptr) continue;
    for (const auto& info : ode::integrators()) {
      // More stages of the same method and more digits show nothing more, and take seconds.
      if (token != "double" && info.order.value_or(0) > 8) continue;
      if (token == "mpfr62" && info.name == "bulirsch_stoer") continue;
      const auto whole = short_drift(token, info.name);
      (void)pieces_of(*whole, 1'000'000);
      for (const long steps : token == "double" ? std::vector{1L, 3L, 8L} : std::vector{3L}) {
        std::vector<std::string> kept;
        for (int process = 0; process < 100; ++process) {
          const auto part = short_drift(token, info.name);
          for (const auto& piece : kept) ASSERT_TRUE(part->take(piece)) << info.name << ": " << piece;
          if (!part->complete()) {
            kept.push_back(part->proceed(steps));
            continue;
          }
          EXPECT_EQ(part->steps_done(), whole->steps_done());
          EXPECT_EQ(bits(part->drift().largest()), bits(whole->drift().largest()))
              << token << " " << info.name;
          // The last state in full precision.
          const auto again = short_drift(token, info.name);
          const auto one = pieces_of(*again, 1'000'000).back();
          const auto state = [](const std::string& piece) {
            const auto second = piece.find(' ', piece.find(' ') + 1) + 1;
            return piece.substr(second, piece.find(' ', second) - second);
          };
          EXPECT_EQ(state(kept.back()), state(one)) << token << " " << info.name;
          break;
        }
      }
    }
  }
}

TEST(Measurement, ALadderOfTakenRungsIsTheOneMeasured) {
  const OrderEngine& engine = *find_order_engine("double");
  const auto whole = engine.ladder("velocity_verlet", "kepler", 2048);
  const auto pieces = pieces_of(*whole, 1);
  ASSERT_GE(pieces.size(), 6U);
  const auto resumed = engine.ladder("velocity_verlet", "kepler", 2048);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(resumed->take(pieces[i]));
  EXPECT_FALSE(resumed->take(pieces[5])) << "one is missing";
  EXPECT_EQ(pieces_of(*resumed, 1), std::vector(pieces.begin() + 4, pieces.end()));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(bits(resumed->ladder().rungs[i].error), bits(whole->ladder().rungs[i].error));
    EXPECT_EQ(resumed->ladder().rungs[i].order, whole->ladder().rungs[i].order);
  }
  EXPECT_EQ(resumed->ladder().measured_order, whole->ladder().measured_order);
}

TEST(Measurement, TornPiecesAreNotTaken) {
  const auto whole = short_drift("double", "pefrl");
  const auto pieces = pieces_of(*whole, 20);
  const auto part = short_drift("double", "pefrl");
  for (const std::string& torn : {std::string(), std::string("20"), pieces[0].substr(0, 30), pieces[1],
                                  pieces[0] + " 1", "x" + pieces[0], "99" + pieces[0]}) {
    EXPECT_FALSE(part->take(torn)) << torn;
  }
  EXPECT_EQ(part->steps_done(), 0U);
  EXPECT_TRUE(part->take(pieces[0]));
  EXPECT_FALSE(part->take(pieces[0])) << "it is there already";
  const auto ladder = find_order_engine("double")->ladder("pefrl", "kepler", 8);
  for (const std::string torn : {"", "1", "2 0x1p-3", "1 0x1p-3 4", "2 left out: x", "1 zero"})
    EXPECT_FALSE(ladder->take(torn));
}

// Steps that are too large for the iteration of a Gauss method are left out of a ladder; the others count.
TEST(Measurement, ALadderBeginsWhereTheMethodDoes) {
  const OrderEngine* engine = find_order_engine("float");
  if (engine == nullptr) GTEST_SKIP() << "no float in this build";
  const auto whole = engine->ladder("gauss1", "kepler", 2048);
  const auto pieces = pieces_of(*whole, 1);
  EXPECT_FALSE(whole->refusal().has_value());
  ASSERT_FALSE(whole->ladder().rungs.empty());
  EXPECT_LT(whole->ladder().rungs.size(), pieces.size()) << pieces[0];
  EXPECT_GT(whole->ladder().rungs[0].steps, 1);
  EXPECT_FALSE(whole->ladder().rungs[0].order.has_value());
  const auto resumed = engine->ladder("gauss1", "kepler", 2048);
  for (const auto& piece : pieces) EXPECT_TRUE(resumed->take(piece)) << piece;
  EXPECT_EQ(resumed->ladder().measured_order, whole->ladder().measured_order);
}

// A step that is too large for the iteration of a Gauss method.
TEST(Measurement, ARefusalEndsItAndIsKept) {
  const OrderEngine& engine = *find_order_engine("double");
  const auto drift = engine.drift("gauss1", "kepler", 1, 64);
  const auto pieces = pieces_of(*drift, 1);
  ASSERT_TRUE(drift->refusal().has_value());
  EXPECT_NE(drift->refusal()->find("do not converge"), std::string::npos);
  const auto resumed = engine.drift("gauss1", "kepler", 1, 64);
  for (const auto& piece : pieces) EXPECT_TRUE(resumed->take(piece));
  EXPECT_TRUE(resumed->complete());
  EXPECT_EQ(resumed->refusal(), drift->refusal());
}

TEST(Measurement, ARaisedFlagStopsEveryIntegratorAtItsNextStep) {
  const std::atomic<bool> raised{true};
  for (const auto& info : ode::integrators()) {
    const OrderEngine& engine = *find_order_engine("double");
    EXPECT_THROW(
        (void)engine.drift(info.name, "kepler", 64, 1L << 40)->proceed(1L << 40, ode::StopFlag(raised)),
        ode::Stopped)
        << info.name;
    EXPECT_THROW((void)engine.ladder(info.name, "kepler", 1L << 24)->proceed(1, ode::StopFlag(raised)),
                 ode::Stopped)
        << info.name;
  }
}

}  // namespace
}  // namespace ulpgate
