// Tests of the search for the step at which a state stopped being finite.
#include "harness/core/scenes/finite_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/scenes/scene_compare.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "reference/types/descriptor.hpp"

namespace ulpgate {
namespace {

// Two balls, the second at rest; the first falls with 1e38 m/s^2, which float cannot hold for long.
scenes::Scene falling(const std::string& bonds = "") {
  const auto result = scenes::read_scene(R"(name = "falling"
[[material]]
name = "m"
[[sphere]]
position = ["0", "0", "0"]
radius = "0.01"
fixed = true
[[sphere]]
position = ["1", "0", "0"]
radius = "0.01"
)" + bonds + R"(
[run]
dt = "1"
until = "100"
gravity = ["0", "-5e18", "0"]
)",
                                         "falling.toml");
  for (const auto& e : result.errors) ADD_FAILURE() << e.text();
  return result.scene.value();
}

std::unique_ptr<dem::DemEngine> make(const scenes::Scene& scene, const char* token = "float") {
  return dem::make_engine(token, dem::Level::own, scene, {});
}

// By taking every step alone.
LostState by_hand(const scenes::Scene& scene) {
  const auto engine = make(scene);
  for (int i = 0; i < 1000; ++i) {
    engine->step(1);
    if (const auto what = engine->not_finite()) return {engine->iteration(), *what};
  }
  ADD_FAILURE() << "stays finite";
  return {};
}

TEST(FiniteWatch, A6FindsTheStepAndTheBodyWhereverItLooks) {
  const std::string bonds =
      "[[bond]]\nbodies = [0, 1]\n[contacts]\nlaw = \"cohesive\"\nbetween = \"bonded\"\n";
  for (const auto& scene : {falling(), falling(bonds)}) {
    const LostState expected = by_hand(scene);
    EXPECT_GT(expected.step, 1U);
    EXPECT_EQ(expected.what.body, 1U) << expected.text();
    for (const std::uint64_t stretch : {1U, 3U, 7U, 200U}) {
      const auto engine = make(scene);
      FiniteWatch watch([&] { return make(scene); });
      std::optional<LostState> lost;
      while (!lost && engine->iteration() < 1000) {
        engine->step(stretch);
        lost = watch.look(*engine);
        if (stretch == 3 && !lost) watch.keep(*engine);
      }
      ASSERT_TRUE(lost) << stretch;
      EXPECT_EQ(lost->text(), expected.text()) << stretch;
    }
  }
}

TEST(FiniteWatch, SaysNothingOfAStateThatIsFinite) {
  const auto scene = falling();
  const auto engine = make(scene, "double");
  FiniteWatch watch([&] { return make(scene, "double"); });
  engine->step(50);
  EXPECT_FALSE(watch.look(*engine));
  EXPECT_FALSE(engine->not_finite());
}

TEST(Compare, A6TwoStatesThatLeftTheNumbersAreNotEqual) {
  const auto scene = falling("[[bond]]\nbodies = [0, 1]\n[contacts]\nlaw = \"cohesive\"\n");
  const auto a = make(scene);
  const auto b = make(scene);
  a->step(1000);
  b->step(1000);
  ASSERT_TRUE(a->not_finite());
  const auto d = compare_engines(*a, *b, float_format<float>());
  EXPECT_EQ(d.position_error_ulp, HUGE_VAL);
  EXPECT_EQ(d.position_error_m, HUGE_VAL);
  EXPECT_EQ(d.velocity_error_ulp, HUGE_VAL);
}

}  // namespace
}  // namespace ulpgate
