// Tests of facets that are one surface in whole simulations: what a sphere does on it does not depend on how
// it is cut, on threads or on a restart.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

using testing::changed;
using testing::read;

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "[[facet]]\nvertices = [[" + a + "], [" + b + "], [" + c + "]]\n";
}

// A square of 1 m about the origin at height 0, as a whole and cut in other ways.
const std::string wall = "[[wall]]\naxis = \"y\"\nposition = 0\n";
const std::string p = "-0.5, 0, -0.5";
const std::string q = "0.5, 0, -0.5";
const std::string r = "0.5, 0, 0.5";
const std::string s = "-0.5, 0, 0.5";
const std::string two = facet(p, q, r) + facet(p, r, s);
const std::string other_two = facet(p, q, s) + facet(q, r, s);
const std::string four =
    facet(p, q, "0, 0, 0") + facet(q, r, "0, 0, 0") + facet(r, s, "0, 0, 0") + facet(s, p, "0, 0, 0");

// n by n squares of two facets each.
std::string many(int n) {
  std::string text;
  const auto at = [n](int i, int j) {
    return "\"" + std::to_string(i) + "/" + std::to_string(n) + "-1/2\", 0, \"" + std::to_string(j) + "/" +
           std::to_string(n) + "-1/2\"";
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      text += facet(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      text += facet(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return text;
}

struct Ball {
  std::string position, velocity = "0, 0, 0";
};

scenes::Scene ball_on(const std::string& floor, const Ball& ball, const std::string& law = "frictional",
                      const std::string& more = "") {
  return read(R"(name = "floor"
[[material]]
name = "ball"
density = 2500
young = 1e7
poisson = 0.3
friction_angle = 20
collision_time = 1e-3
restitution_normal = 0.6
[[sphere]]
position = [)" +
              ball.position + "]\nvelocity = [" + ball.velocity + "]\nradius = 0.01\n" + floor +
              "[contacts]\nlaw = \"" + law + "\"\n" + more +
              "[run]\ndt = 4e-6\nuntil = 1\ngravity = [0, -9.81, 0]\nrecord = [\"energy\"]\n");
}

std::unique_ptr<DemEngine> engine_of(const scenes::Scene& scene, EngineOptions options = {},
                                     std::string_view token = "double") {
  return make_engine(token, Level::own, scene, options);
}

// The largest difference of two engines' first bodies, relative to the largest component.
double difference(const DemEngine& a, const DemEngine& b) {
  double worst = 0;
  for (const BodyQuantity quantity :
       {BodyQuantity::position, BodyQuantity::velocity, BodyQuantity::angular_velocity}) {
    double size = 0;
    double apart = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      size = std::max(size, std::fabs(b.approximate(quantity, 0, c)));
      apart = std::max(apart, std::fabs(a.approximate(quantity, 0, c) - b.approximate(quantity, 0, c)));
    }
    if (apart > 0) worst = std::max(worst, apart / size);
  }
  return worst;
}

// Over corners, seams, beside them and in the middle of a facet.
TEST(SharedEdges, TheForceOfAPlaneDoesNotDependOnItsCut) {
  for (const std::string place : {"0, 0.0099, 0", "0.1, 0.0099, 0.1", "0.1, 0.0099, 0.1001",
                                  "0.25, 0.0099, 0", "1e-9, 0.0099, 2e-9", "0.3, 0.0099, -0.2"}) {
    for (const char* token : {"double", "float"}) {
      const Ball ball{place, "0.1, -0.2, 0.05"};
      const auto plane = engine_of(ball_on(wall, ball), {}, token);
      plane->step(3);
      for (const std::string& floor : {two, other_two, four, many(4), many(4) + many(4)}) {
        const auto cut = engine_of(ball_on(floor, ball), {}, token);
        cut->step(3);
        EXPECT_EQ(cut->contacts().size(), 1U) << place;
        EXPECT_LE(difference(*cut, *plane), token == std::string("float") ? 4e-7 : 1e-15)
            << place << ' ' << token;
      }
    }
  }
}

// Of facets whose normals round: as near as the overlap, a hundredth of the radius, is known.
TEST(SharedEdges, TheForceOfATiltedPlaneDoesNotDependOnItsCut) {
  const std::string a = "-0.5, -0.5, -0.375";
  const std::string b = "0.5, -0.5, -0.375";
  const std::string c = "0.5, 0.5, 0.375";
  const std::string d = "-0.5, 0.5, 0.375";
  const std::string m = "0.125, 0.25, 0.1875";
  const std::string one = facet("-4, -4, -3", "4, -4, -3", "0, 4, 3");
  const std::string cuts[] = {facet(a, b, c) + facet(c, d, a), facet(b, d, a) + facet(b, c, d),
                              facet(m, a, b) + facet(b, c, m) + facet(c, d, m) + facet(m, d, a)};
  for (int i = 0; i < 40; ++i) {
    // Along the one diagonal, the other and towards the inner corner; above the plane by 0.0099.
    const double t = (i % 20 - 10) / 21.;
    const double x = i % 3 == 2 ? 0.125 : t;
    const double y = i % 3 == 0 ? t : i % 3 == 1 ? -t : 0.25;
    const auto text = [](double value) { return std::to_string(value); };
    const Ball ball{text(x) + ", \"" + text(y) + "-0.6*0.0099\", \"0.75*(" + text(y) + ")+0.8*0.0099\"",
                    "0.1, -0.2, 0.05"};
    const auto plane = engine_of(ball_on(one, ball));
    plane->step(1);
    for (const std::string& floor : cuts) {
      const auto cut = engine_of(ball_on(floor, ball));
      cut->step(1);
      EXPECT_EQ(cut->contacts().size(), 1U) << x << ' ' << y;
      EXPECT_LE(difference(*cut, *plane), 1e-12) << x << ' ' << y;
      const auto narrow = engine_of(ball_on(floor, ball), {}, "float");
      narrow->step(1);
      EXPECT_EQ(narrow->contacts().size(), 1U) << x << ' ' << y;
    }
  }
}

TEST(SharedEdges, EachFacetPushesOnItsOwnWhereTheSceneSaysSo) {
  const Ball ball{"0, 0.0099, 0"};
  const auto once = engine_of(ball_on(four, ball));
  const auto each = engine_of(ball_on(four, ball, "frictional", "shared_edges = \"each\"\n"));
  const auto changed_to_each = engine_of(changed(ball_on(four, ball), {"shared_edges=each"}), {true, 1});
  for (auto* e : {once.get(), each.get(), changed_to_each.get()}) e->step(1);
  EXPECT_EQ(once->contacts().size(), 1U);
  EXPECT_EQ(each->contacts().size(), 4U);
  EXPECT_EQ(each->save().substr(0, 12), changed_to_each->save().substr(0, 12));
  EXPECT_EQ(each->text(BodyQuantity::velocity, 0, 1), changed_to_each->text(BodyQuantity::velocity, 0, 1));
  const double weight = 9.81 * 4e-6;
  EXPECT_NEAR(each->approximate(BodyQuantity::velocity, 0, 1) + weight,
              4 * (once->approximate(BodyQuantity::velocity, 0, 1) + weight), 1e-9);
}

TEST(SharedEdges, ConvexEdgesPushOnceAndConcaveOnesFromBothFaces) {
  const auto contacts = [](const std::string& floor, const std::string& place) {
    const auto e = engine_of(ball_on(floor, {place}));
    e->step(1);
    return e->contacts();
  };
  const std::string roof =
      facet("0, 0, -1", "0, 0, 1", "1, -1, 0") + facet("0, 0, -1", "0, 0, 1", "-1, -1, 0");
  const std::string gutter =
      facet("0, 0, -1", "0, 0, 1", "1, 1, 0") + facet("0, 0, -1", "0, 0, 1", "-1, 1, 0");
  EXPECT_EQ(contacts(roof, "0, 0.0099, 0"), (std::vector<BodyPair>{{0, 1}}));
  EXPECT_EQ(contacts(roof, "1e-3, 0.0099, 0"), (std::vector<BodyPair>{{0, 1}}));
  EXPECT_EQ(contacts(roof, "-1e-3, 0.0099, 0"), (std::vector<BodyPair>{{0, 1}}));
  EXPECT_EQ(contacts(roof, "0.02, -0.007, 0"), (std::vector<BodyPair>{{0, 1}}));
  EXPECT_EQ(contacts(roof, "-0.02, -0.007, 0"), (std::vector<BodyPair>{{0, 2}}));
  EXPECT_EQ(contacts(gutter, "0, 0.0141, 0"), (std::vector<BodyPair>{{0, 1}, {0, 2}}));
  EXPECT_EQ(contacts(gutter, "1e-4, 0.0139, 0"), (std::vector<BodyPair>{{0, 1}, {0, 2}}));
}

// A hair apart they are facets like any others, with the same bytes whatever the scene says of shared edges.
TEST(SharedEdges, FacetsWithoutACommonCornerActOnTheirOwn) {
  const std::string apart = facet(p, q, r) + facet("-0.5, 0, \"-0.5+1e-12\"", "0.5, 0, \"0.5+1e-12\"", s);
  const Ball ball{"0.1, 0.0099, 0.1", "0.1, -0.2, 0.05"};
  const auto once = engine_of(ball_on(apart, ball));
  const auto each = engine_of(ball_on(apart, ball, "frictional", "shared_edges = \"each\"\n"));
  for (auto* e : {once.get(), each.get()}) e->step(5);
  EXPECT_EQ(once->contacts().size(), 2U);
  once->step(200);
  each->step(200);
  EXPECT_EQ(once->save(), each->save());
}

// A sliding ball, then a rolling one, crosses seams at a slant; what it carries goes along.
TEST(SharedEdges, WhatCrossesASeamGoesOnAsOnAPlane) {
  for (const std::string law : {"frictional", "viscoelastic", "hertz_mindlin"}) {
    const std::string height = law == "frictional" ? "0.00999" : "0.009999";
    const Ball ball{"-0.31, " + height + ", -0.21", "0.7, 0, 0.31"};
    const auto plane = engine_of(ball_on(wall, ball, law), {.collisions = true});
    const auto cut = engine_of(ball_on(many(20), ball, law), {.collisions = true});
    plane->step(30000);
    cut->step(30000);
    EXPECT_GT(cut->approximate(BodyQuantity::position, 0, 0), -0.25) << "a cell on";
    EXPECT_LT(difference(*cut, *plane), 1e-8) << law;
    for (const std::string& e : plane->energy_names())
      EXPECT_NEAR(cut->energy(e), plane->energy(e), 1e-8 * plane->energy("sum")) << law << ' ' << e;
    auto mine = cut->take_collisions();
    auto theirs = plane->take_collisions();
    ASSERT_EQ(mine.size(), theirs.size()) << law << ": a collision is one, whatever facets it passes";
    ASSERT_EQ(cut->open_collisions().size(), plane->open_collisions().size()) << law;
    for (std::size_t i = 0; i < mine.size(); ++i) {
      EXPECT_EQ(mine[i].begin_step, theirs[i].begin_step) << law;
      EXPECT_EQ(mine[i].steps_inside, theirs[i].steps_inside) << law;
      EXPECT_FALSE(mine[i].beyond_condition) << law << ' ' << i;
    }
  }
}

// Many balls between the sides of a box and on a cut floor.
scenes::Scene crowd(const std::string& law) {
  return read(R"(name = "crowd"
[[material]]
name = "m"
density = 2500
young = 1e7
poisson = 0.3
friction_angle = 20
collision_time = 5e-4
restitution_normal = 0.7
[[generator]]
kind = "grid"
radius = 0.01
radius_spread = 0.2
counts = [4, 3, 4]
spacing = [0.023, 0.023, 0.023]
corner = [-0.034, -0.02, -0.034]
jitter = 0.002
[[generator]]
kind = "facet_box"
half_size = [0.05, 0.045, 0.05]
)" + facet("-0.05, -0.045, -0.05", "0, 0, 0", "0.05, -0.045, 0.05") +
              facet("0.05, -0.045, 0.05", "0, 0, 0", "0, -0.045, -0.05") + "[contacts]\nlaw = \"" + law + R"("
[run]
dt = 1e-5
until = 1
gravity = [1, -40, 2]
record = ["energy"]
)");
}

TEST(SharedEdges, ThreadsPartsAndRestartsKeepTheBits) {
  for (const std::string law : {"frictional", "viscoelastic", "hertz_mindlin"}) {
    const auto scene = crowd(law);
    auto serial = engine_of(scene);
    auto threads = engine_of(scene, {.all_parts = true, .threads = 2});
    auto ledger = engine_of(scene, {.threads = 2, .collisions = true});
    serial->step(1500);
    const std::string state = serial->save();
    auto resumed = engine_of(scene, {.threads = 2});
    resumed->restore(state, Constants::from_text);
    EXPECT_EQ(resumed->save(), state);
    serial->step(1500);
    resumed->step(1500);
    threads->step(3000);
    ledger->step(3000);
    EXPECT_EQ(resumed->save(), serial->save()) << law;
    std::size_t facets = 0;
    for (const BodyPair& pair : serial->contacts())
      facets += serial->shape(static_cast<std::size_t>(pair.second)) == scenes::Shape::facet ? 1 : 0;
    EXPECT_GE(facets, 3U) << law;
    for (std::size_t i = 0; i < serial->bodies(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::string place = serial->text(BodyQuantity::position, i, c);
        EXPECT_EQ(threads->text(BodyQuantity::position, i, c), place) << law << ' ' << i;
        EXPECT_EQ(ledger->text(BodyQuantity::position, i, c), place) << law << ' ' << i;
      }
    }
    for (const std::string& e : serial->energy_names()) EXPECT_EQ(threads->energy(e), serial->energy(e)) << e;
    std::size_t met = 0;
    for (const auto& collision : ledger->take_collisions()) {
      met += collision.second >= 48 ? 1 : 0;
      EXPECT_FALSE(collision.beyond_condition)
          << law << ": bodies " << collision.first << '-' << collision.second << " from step "
          << collision.begin_step << " gained " << collision.energy_gained << " J";
    }
    EXPECT_GT(met, 20U) << law << ": balls met facets";
  }
}

TEST(SharedEdges, WhatASceneNeedsNotIsLeftOut) {
  const auto why = [](const scenes::Scene& scene) -> std::string {
    const auto e = engine_of(scene);
    for (const auto& part : e->explain().left_out) {
      if (part.part == "shared edges") return part.why;
    }
    return "";
  };
  const Ball ball{"0, 0.1, 0"};
  EXPECT_EQ(why(ball_on(two, ball)), "");
  EXPECT_EQ(why(ball_on(wall, ball)), "no two facets have a corner in common");
  EXPECT_EQ(why(ball_on(facet(p, q, r), ball)), "no two facets have a corner in common");
  EXPECT_EQ(why(ball_on(two, ball, "frictional", "shared_edges = \"each\"\n")),
            "contacts.shared_edges is 'each': every facet acts on its own");
  EXPECT_EQ(why(testing::load("pendulum3")), "") << "flats are left out as a whole";
}

TEST(SharedEdges, OtherWordsAreRefused) {
  const auto read = scenes::read_scene(
      "name = \"x\"\n[[material]]\nname = \"m\"\n[[sphere]]\nposition = [0, 0, 0]\nradius = 1\n"
      "[contacts]\nshared_edges = \"twice\"\n[run]\ndt = 1e-5\nuntil = 1\n",
      "x");
  ASSERT_EQ(read.errors.size(), 1U);
  EXPECT_EQ(read.errors.front().text(), "x:8: contacts.shared_edges: 'twice' is none of once, each");
  auto scene = testing::load("deposition");
  EXPECT_EQ(scene.shared_edges, scenes::SharedEdges::each) << "as in the codes that it is compared with";
  const auto error = apply_override(scene, "shared_edges=twice");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->text(), "override: shared_edges: 'twice' is none of once, each");
}

}  // namespace
}  // namespace ulpgate::dem
