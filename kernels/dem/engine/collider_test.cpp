// Tests of what the collider does for a simulation: pairs that double cannot tell apart, and the memory it
// says it takes.
#include <gtest/gtest.h>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/step/contact_pass.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

scenes::Scene scene_of(const std::string& bodies, const std::string& contacts) {
  const std::string text = "name = \"t\"\n" + bodies + "[contacts]\n" + contacts +
                           "[run]\ndt = \"1e-9\"\nuntil = \"1e-6\"\n[[material]]\nname = \"m\"\n";
  auto result = scenes::read_scene(text, "t.toml");
  for (const auto& e : result.errors) ADD_FAILURE() << e.text();
  return result.scene.value_or(scenes::Scene{});
}

std::string sphere(const std::string& position, const std::string& radius) {
  return "[[sphere]]\nposition = [" + position + "]\nradius = \"" + radius + "\"\n";
}

// Next to 1e9 a double has steps of u = 2^-23.  Two centres, 17.1 u apart, whose spheres reach 17.2 u:
// rounded to double they are 18 u apart.
TEST(Collider, FindsPairsThatDoubleTakesForApart) {
  const std::array<std::string, 3> places = {"\"X\", \"0\", \"0\"", "\"0\", \"X\", \"0\"",
                                             "\"0\", \"0\", \"X\""};
  const std::string u = "1.1920928955078125e-7";
  for (const std::string& place : places) {
    const auto at = [&](const std::string& x) {
      std::string text = place;
      return text.replace(text.find('X'), 1, "1e9+" + x + "*" + u);
    };
    const scenes::Scene scene =
        scene_of(sphere(at("0.45"), "8.6*" + u) + sphere(at("17.55"), "8.6*" + u), "sweep = \"1e-12\"\n");
    const auto e = make_engine("mpfr62", Level::own, scene, {});
    if (e == nullptr) GTEST_SKIP() << "no mpfr62 in this build";
    e->step(1);
    EXPECT_EQ(e->contacts(), (std::vector<BodyPair>{{0, 1}})) << place;
  }
}

// Bytes that an engine says it has taken more after a step.
std::size_t taken(const scenes::Scene& scene, std::string_view token, int threads) {
  const auto e = make_engine(token, Level::own, scene, {false, threads, false});
  const std::size_t before = e->memory_bytes();
  e->step(1);
  return e->memory_bytes() - before;
}

TEST(Collider, CountsItsMemory) {
  std::string apart;
  std::string row;
  constexpr std::size_t count = 40;
  for (std::size_t i = 0; i < count; ++i) {
    apart += sphere("\"" + std::to_string(i) + "\", \"0\", \"0\"", "0.1");
    row += sphere("\"" + std::to_string(i) + "\", \"0\", \"0\"", "0.51");
  }
  const scenes::Scene none = scene_of(apart, "sweep = \"1e-3\"\n");
  const std::size_t places = count * (sizeof(CoarseBody) + 3 * sizeof(double));
  EXPECT_EQ(taken(none, "double", 1), places);
  if (make_engine("mpfr62", Level::own, none, {}) != nullptr) {
    EXPECT_EQ(taken(none, "mpfr62", 1), places + count * sizeof(CoarseSphere));
  }
  // Threads want to know the pairs of each body, twice a pair, and a place for the force of each.
  const scenes::Scene touching = scene_of(row, "sweep = \"1e-3\"\n");
  EXPECT_EQ(taken(touching, "double", 2) - taken(touching, "double", 1),
            (count - 1) * (2 * sizeof(std::int32_t) + sizeof(PairForce<double>)));
  // A pair is kept twice, beside the arrays of the contacts.
  EXPECT_GE(taken(touching, "double", 1), places + (count - 1) * 2 * sizeof(BodyPair));
}

}  // namespace
}  // namespace ulpgate::dem
