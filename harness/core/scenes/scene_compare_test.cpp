// Tests of the comparison of two precisions and of the ladder over a scene's constants.
#include "harness/core/scenes/scene_compare.hpp"

#include <gtest/gtest.h>

#include "harness/core/kernels/kernel_audit.hpp"
#include "harness/core/scene_cases/scene_text.hpp"
#include "harness/core/scene_cases/scene_trial.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "reference/types/descriptor.hpp"

namespace ulpgate {
namespace {

scenes::Scene two_spheres() {
  return scene_of(
      scene_text::begin(
          "two", "m", {{"density", "2500"}, {"young", "1e7"}, {"poisson", "0.3"}, {"friction_angle", "20"}}) +
      scene_text::sphere("0, 0, 0", "0.01", {{"velocity", "0.3, 0.1, 0"}}) +
      scene_text::sphere("0.02, 0, 0", "0.01") + scene_text::contacts("frictional") +
      scene_text::run("1e-6", "1e-3"));
}

TEST(Compare, SameStateSameNumbersThenApart) {
  const auto scene = two_spheres();
  const auto tested = dem::make_engine("double", dem::Level::own, scene, {});
  const auto reference = dem::make_engine("double", dem::Level::reference, scene, {});
  reference->restore(tested->save(), dem::Constants::from_text);
  const auto format = float_format<double>();
  const auto start = compare_engines(*tested, *reference, format);
  EXPECT_EQ(start.position_error_m, 0);
  EXPECT_EQ(start.velocity_error_ulp, 0);
  tested->step(1000);
  reference->step(1000);
  const auto end = compare_engines(*tested, *reference, format);
  EXPECT_EQ(end.step, 1000U);
  EXPECT_GT(end.position_error_ulp, 0);
  EXPECT_LT(end.position_error_m, 1e-12);
}

TEST(Compare, StepsFollowTheDecades) {
  EXPECT_EQ(comparison_steps(0), (std::vector<std::uint64_t>{}));
  EXPECT_EQ(comparison_steps(1), (std::vector<std::uint64_t>{1}));
  EXPECT_EQ(comparison_steps(30), (std::vector<std::uint64_t>{1, 2, 5, 10, 20, 30}));
}

TEST(Ladder, NamesTheDoubleInAMass) {
  auto scene = two_spheres();
  EXPECT_TRUE(short_constants(*dem::make_engine("double", dem::Level::reference, scene, {})).empty());
  EXPECT_TRUE(audit_scene(scene).empty());
  ASSERT_FALSE(scenes::apply_override(scene, "mass=yade"));
  EXPECT_EQ(audit_scene(scene), (std::vector<double>{4.1887902047863905})) << "4/3 pi in double";
}

TEST(Ladder, NamesAConstantThatEndsWithDouble) {
  auto scene = two_spheres();
  // 0.1 as a double would write it, in a scene that was written by a program.
  scene.spheres[0].velocity[0] = "0.1000000000000000055511151231257827021181583404541015625";
  const auto found = short_constants(*dem::make_engine("double", dem::Level::reference, scene, {}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what, "velocity x of body 0");
}

}  // namespace
}  // namespace ulpgate
