// Tests of the DEM kernels: known closed values and the table's coverage.
#include <gtest/gtest.h>

#include "kernels/dem/table/kernel_table_impl.hpp"

namespace ulpgate::dem {
namespace {

using V = Vec3<double>;

TEST(SphereSphere, KnownValues) {
  struct Case {
    V x1;
    double r1;
    V x2;
    double r2, overlap;
    V normal, point;
    const char* why;
  };
  const Case cases[] = {
      {{0, 0, 0}, 1, {1.5, 0, 0}, 1, 0.5, {1, 0, 0}, {0.75, 0, 0}, "equal spheres: point half way"},
      {{0, 0, 0},
       2,
       {0, 2.5, 0},
       1,
       0.5,
       {0, 1, 0},
       {0, 1.75, 0},
       "the point lies in the middle of the overlap"},
      {{0, 0, 0}, 1, {0, 0, -2}, 1, 0, {0, 0, -1}, {0, 0, -1}, "touching exactly"},
      {{0, 0, 0}, 1, {3, 4, 0}, 1, -3, {0.6, 0.8, 0}, {1.5, 2, 0}, "apart: negative overlap"},
  };
  for (const Case& c : cases) {
    const auto g = sphere_sphere(c.x1, c.r1, c.x2, c.r2);
    EXPECT_DOUBLE_EQ(g.overlap, c.overlap) << c.why;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_DOUBLE_EQ(g.normal[i], c.normal[i]) << c.why;
      EXPECT_DOUBLE_EQ(g.point[i], c.point[i]) << c.why;
    }
  }
}

TEST(FlatGeometry, FaceEdgeVertex) {
  struct Case {
    V x;
    double overlap;
    V normal;
    const char* why;
  };
  const Facet<double> t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Case cases[] = {
      {{0.25, 0.25, 0.5}, 0.5, {0, 0, 1}, "above the face"},
      {{0.25, 0.25, -0.5}, 0.5, {0, 0, -1}, "below the face: the normal is on the sphere's side"},
      {{0.5, -0.6, 0.8}, 0, {0, -0.6, 0.8}, "nearest to the edge ab"},
      {{-0.6, 0.5, 0}, 0.4, {-1, 0, 0}, "nearest to the edge ca, in the plane"},
      {{1.6, 0, 0.8}, 0, {0.6, 0, 0.8}, "nearest to the vertex b"},
      {{-0.3, 0, 0.4}, 0.5, {-0.6, 0, 0.8}, "nearest to the vertex a"},
      {{0, 1.3, 0.4}, 0.5, {0, 0.6, 0.8}, "nearest to the vertex c"},
  };
  for (const Case& c : cases) {
    const auto g = facet_sphere(t, c.x, 1.0);
    EXPECT_NEAR(g.overlap, c.overlap, 1e-15) << c.why;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(g.normal[i], c.normal[i], 1e-15) << c.why;
  }
  // The hypotenuse, by symmetry.
  EXPECT_NEAR(facet_sphere(t, V{1, 1, 0}, 1.0).overlap, 1 - std::sqrt(0.5), 1e-15);
}

TEST(FlatGeometry, WallAndBox) {
  EXPECT_EQ(wall_sphere(1, 0.0, V{7, 0.75, 3}, 1.0).overlap, 0.25);
  EXPECT_EQ(wall_sphere(1, 0.0, V{7, -0.75, 3}, 1.0).normal.y, -1);
  const Quaternion<double> q;
  EXPECT_EQ(box_sphere(V{}, V{1, 1, 1}, q, V{1.5, 0, 0}, 1.0).overlap, 0.5) << "face";
  EXPECT_NEAR(box_sphere(V{}, V{1, 1, 1}, q, V{1.6, 1.8, 0}, 1.0).overlap, 0, 1e-15) << "edge";
  EXPECT_EQ(box_sphere(V{}, V{1, 1, 1}, q, V{0.75, 0, 0}, 1.0).overlap, 1.25) << "centre inside";
  const auto turned_box = from_angle_axis(std::acos(-1.0) / 4, V{0, 0, 1});
  EXPECT_NEAR(box_sphere(V{}, V{1, 1, 1}, turned_box, V{2, 0, 0}, 1.0).overlap, std::sqrt(2) - 1, 1e-15)
      << "turned";
}

TEST(Shear, RotationFollowsTheNormalToFirstOrder) {
  const double angle = 1e-5;
  const V s = rotate_shear(V{0, 1, 0}, V{1, 0, 0}, V{std::cos(angle), std::sin(angle), 0}, V{}, V{}, 1.0);
  EXPECT_NEAR(s.x, -std::sin(angle), 1e-14);
  EXPECT_NEAR(s.y, std::cos(angle), 1e-9);
  // Both bodies spin about the normal: the shear turns with them.
  const V spun = rotate_shear(V{0, 1, 0}, V{1, 0, 0}, V{1, 0, 0}, V{2, 0, 0}, V{2, 0, 0}, 1e-6);
  EXPECT_NEAR(spun.z, 2e-6, 1e-15);
}

TEST(Shear, Cone) {
  const auto inside = cut_to_cone(V{0, 3, 4}, 5.0, 2.0);
  EXPECT_FALSE(inside.sliding) << "exactly on the cone sticks";
  const auto cut = cut_to_cone(V{0, 6, 8}, 5.0, 2.0);
  EXPECT_TRUE(cut.sliding);
  EXPECT_DOUBLE_EQ(cut.shear.y, 3);
  EXPECT_DOUBLE_EQ(cut.dissipation, 12.5) << "slip 5/2 m times 5 N";
  EXPECT_EQ(cut_to_cone(V{0, 6, 8}, 0.0, 2.0).shear, V{}) << "no limit, no shear";
}

TEST(Shear, TwistAndBending) {
  const Quaternion<double> unit;
  const auto q2 = from_angle_axis(0.5, V{1, 0, 0});
  const auto twisted = twist_and_bending(unit, unit, unit, q2, V{1, 0, 0});
  EXPECT_NEAR(twisted.twist, 0.5, 1e-15);
  EXPECT_NEAR(norm(twisted.bending), 0, 1e-15);
  const auto bent = twist_and_bending(unit, unit, unit, q2, V{0, 1, 0});
  EXPECT_NEAR(bent.bending.x, 0.5, 1e-15);
  const double pi = std::acos(-1.0);
  const auto over = twist_and_bending(unit, unit, unit, from_angle_axis(1.5 * pi, V{0, 0, 1}), V{0, 0, 1});
  EXPECT_NEAR(over.twist, -pi / 2, 1e-15) << "angles lie on (-pi, pi]";
}

TEST(Physics, DepositionConstantsToAllPrintedDigits) {
  const double r = 0.5 / 30.77;
  const double m = sphere_mass(r, 2300.0);
  EXPECT_NEAR(m, 0.04133747731443931, 2e-17);
  const Collision<double> c{1e-3, 3e-3, 3e-3, 35 * std::acos(-1.0) / 180};
  const auto p = viscoelastic_physics(c, reduced_mass(m, m));
  EXPECT_NEAR(p.kn, 901482.4695, 5e-5);
  EXPECT_NEAR(p.ks, 257566.4199, 5e-5);
  EXPECT_NEAR(p.cn, 240.1353166, 5e-8);
  EXPECT_NEAR(p.cs, 68.61009045, 5e-9);
}

TEST(Physics, PendulumRodHas100NewtonPerMetre) {
  const Elastic<double> rod{1e5, 0, 0};
  EXPECT_EQ(frictional_physics(rod, 0.1 / 100, rod, 0.1 / 100).kn, 100);
  EXPECT_EQ(frictional_physics(rod, 0.1 / 100, rod, 0.1 / 100).ks, 0);
  // A stiffness stands in for young * radius: in float the product of four factors misses 100 by two ulp.
  const Elastic<float> product{1e5F, 0, 0};
  const Elastic<float> given{1e5F, 0, 0, 100};
  const Elastic<float> sheared{1, 0.25F, 0, 100};
  EXPECT_EQ(frictional_physics(product, 0.1F / 100, product, 0.1F / 100).kn, 0x1.900004p+6F);
  EXPECT_EQ(frictional_physics(given, 0.1F / 100, given, 0.1F / 100).kn, 100);
  EXPECT_EQ(frictional_physics(given, 0.1F / 100, product, 1e-3F).kn, 100);
  EXPECT_EQ(frictional_physics(sheared, 3.F, sheared, 7.F).ks, 25);
}

TEST(Physics, HertzOfEqualBodies) {
  // E* = E/(2 (1 - nu^2)), R = r/2: Fn = 4/3 E* sqrt(R) u^(3/2).
  const Elastic<double> m{1e9, 0.25, 0};
  const double e_star = 1e9 / (2 * (1 - 0.0625));
  EXPECT_NEAR(hertz_mindlin_physics(m, 0.02, m, 0.02).kn / (4.0 / 3 * e_star * std::sqrt(0.01)), 1, 1e-15);
  // Mindlin: kt = 8 G* sqrt(R u), G* = G/(2 (2 - nu)).
  const double g_star = 1e9 / (2 * 1.25) / (2 * 1.75);
  EXPECT_NEAR(hertz_mindlin_physics(m, 0.02, m, 0.02).ks / (8 * g_star * std::sqrt(0.01)), 1, 1e-15);
}

TEST(Physics, TheSmallerFrictionOfTwoMaterialsHolds) {
  const Elastic<double> rough{1e9, 0.25, 0.5};
  const Elastic<double> smooth{1e9, 0.25, 0.125};
  EXPECT_EQ(hertz_mindlin_physics(rough, 0.02, smooth, 0.02).tan_friction, std::tan(0.125));
  EXPECT_EQ(hertz_mindlin_physics(smooth, 0.02, rough, 0.02).tan_friction, std::tan(0.125));
}

TEST(Newton, DampingWeakensWhatSpeedsUp) {
  EXPECT_EQ(damped(2.0, 1.0, 0.1, 0.25), 1.5) << "speeding up";
  EXPECT_EQ(damped(2.0, -1.0, 0.1, 0.25), 2.5) << "slowing down";
  EXPECT_EQ(damped(0.0, 1.0, 0.1, 0.25), 0.0);
  EXPECT_EQ(damped(2.0, -0.1, 0.1, 0.25), 2.0) << "at rest half a step on: sgn(0) = 0";
}

TEST(Newton, FreeAsphericalBodyKeepsMomentumAndEnergy) {
  AsphericalState<double> s{{}, {1, 0.1, 2}, {}};
  const V inertia{1, 2, 3};
  double energy = 0;
  for (int i = 0; i < 10000; ++i) {
    s = turned_aspherical(s, inertia, V{}, 1e-4);
    const V w = divided(rotate(conjugate(s.orientation), s.angular_momentum), inertia);
    const double now = rotational_energy(inertia, w);
    if (i == 0) energy = now;
    ASSERT_NEAR(now, energy, 1e-8);
  }
  EXPECT_EQ(s.angular_momentum, (V{1, 0.1, 2}));
}

// A point of a convex set is the nearest one to p if and only if no corner of the set is on p's side of it.
TEST(Facet, TheNearestPointIsTheProjection) {
  const Facet<double> facets[] = {{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}},
                                  {{0.5, 0.25, 0}, {3, -0.5, 0.25}, {2.5, 1.75, 1}},
                                  {{0, 0, 0}, {3, 0, 0.5}, {-2, 1, 0}}};
  for (const auto& t : facets) {
    int faces = 0;
    for (int i = 0; i < 1000; ++i) {
      const int hundreds = i / 100;
      const V p{-3 + 0.7 * (i % 10), -3 + 0.7 * (i / 10 % 10), -1 + 0.3 * hundreds};
      const V q = nearest_on_facet(t, p);
      for (const V& corner : {t.a, t.b, t.c}) EXPECT_LE(dot(p - q, corner - q), 1e-13) << i;
      const V normal = cross(t.b - t.a, t.c - t.a);
      EXPECT_NEAR(dot(normal, q - t.a), 0, 1e-13) << "it lies in the plane, " << i;
      double area = 0;
      for (const auto& [a, b] : {std::pair{t.a, t.b}, std::pair{t.b, t.c}, std::pair{t.c, t.a}})
        area += norm(cross(a - q, b - q));
      EXPECT_NEAR(area, norm(normal), 1e-12) << "and inside, " << i;
      faces += norm(q - t.a) > 0 && norm(q - t.b) > 0 && norm(q - t.c) > 0 ? 1 : 0;
    }
    EXPECT_GT(faces, 100) << "edges and faces were met as well as corners";
  }
}

// What is scaled by a power of two comes out scaled, to the last bit, where squares and fourth powers of
// lengths have long left the range.
TEST(SafeRange, GeometryIsTheSameInEveryUnit) {
  using F = Vec3<float>;
  const Facet<float> t{{0, 0, 0}, {1, 0.25F, 0}, {0.125F, 1, 0.5F}};
  const F places[] = {{0.3F, 0.4F, 0.5F}, {0.6F, -0.6F, 0.3F}, {-0.6F, 0.4F, 0.1F},
                      {1.3F, 0.2F, 0.3F}, {0.7F, 0.9F, 0},     {0.1F, 1.4F, 0.6F}};
  const Quaternion<float> q = from_angle_axis(0.7F, F{0.6F, 0, 0.8F});
  for (const int exponent : {-100, -70, -40, 40, 70, 100}) {
    const auto in_unit = [&](const F& v) { return ScaledVec3<float>{v, exponent}.value(); };
    const float r = std::ldexp(1.0F, exponent);
    const Facet<float> small{in_unit(t.a), in_unit(t.b), in_unit(t.c)};
    for (const F& x : places) {
      const struct {
        ContactGeometry<float> one, scaled;
        const char* what;
      } pairs[] = {
          {facet_sphere(t, x, 1.0F), facet_sphere(small, in_unit(x), r), "facet"},
          {box_sphere(F{}, t.c, q, x, 1.0F), box_sphere(F{}, in_unit(t.c), q, in_unit(x), r), "box"},
          {sphere_sphere(t.b, 1.0F, x, 1.0F), sphere_sphere(in_unit(t.b), r, in_unit(x), r), "sphere"},
      };
      for (const auto& g : pairs) {
        EXPECT_EQ(g.scaled.overlap, std::ldexp(g.one.overlap, exponent)) << g.what << ' ' << exponent;
        EXPECT_EQ(g.scaled.normal, g.one.normal) << g.what << ' ' << exponent;
        EXPECT_EQ(g.scaled.point, in_unit(g.one.point)) << g.what << ' ' << exponent;
      }
    }
  }
}

TEST(SafeRange, LengthsAtTheEnds) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(norm(V{3e-200, 0, -4e-200}), 5e-200);
  EXPECT_DOUBLE_EQ(norm(V{0, 3e200, 4e200}), 5e200);
  EXPECT_EQ(norm(V{0x1p-1074, 0, 0}), 0x1p-1074) << "the least number";
  EXPECT_EQ(norm(V{}), 0);
  EXPECT_EQ(norm(V{1, -inf, 0}), inf);
  EXPECT_TRUE(std::isnan(norm(V{1, NAN, 0})));
  EXPECT_TRUE(std::isnan(norm(V{NAN, NAN, NAN})));
  const V least{3 * 0x1p-1074, 4 * 0x1p-1074, 0};
  EXPECT_EQ(direction(least, norm(least)), (V{0.6, 0.8, 0})) << "also of a length of few digits";
  const V most{1.5e308, 1.5e308, 1.5e308};
  EXPECT_EQ(norm(most), inf) << "longer than any number";
  EXPECT_DOUBLE_EQ(direction(most, norm(most)).x, std::sqrt(1.0 / 3));
  EXPECT_TRUE(std::isnan(direction(V{}, 0.0).x)) << "no vector has no direction";
  const V ordinary{0.1, 0.7, -0.3};
  EXPECT_EQ(norm(ordinary), std::sqrt(squared_norm(ordinary)));
}

TEST(SafeRange, ProductsAtTheEnds) {
  EXPECT_DOUBLE_EQ(reduced_mass(3e-200, 6e-200), 2e-200);
  EXPECT_DOUBLE_EQ(reduced_mass(3e200, 6e200), 2e200);
  EXPECT_DOUBLE_EQ(reduced_mass(1e-300, 1e300), 1e-300);
  EXPECT_DOUBLE_EQ(series_stiffness(1e200, 3.0, 2e200, 3.0), 4e200);
  EXPECT_DOUBLE_EQ(kinetic_energy(1e-10, V{3e155, 0, 4e155}), 1.25e301);
  EXPECT_DOUBLE_EQ(kinetic_energy(1e10, V{3e-165, 0, 4e-165}), 1.25e-319);
  EXPECT_EQ(kinetic_energy(2.0, V{}), 0);
  for (const double f : {1e-200, 1e200}) {
    const auto cut = cut_to_cone(V{6 * f, 8 * f, 0}, 5 * f, f);
    EXPECT_TRUE(cut.sliding) << f;
    EXPECT_DOUBLE_EQ(cut.shear.x, 3 * f);
    EXPECT_DOUBLE_EQ(cut.shear.y, 4 * f);
    EXPECT_DOUBLE_EQ(cut.dissipation, 25 * f);
    EXPECT_FALSE(cut_to_cone(V{3 * f, 3 * f, 0}, 5 * f, f).sliding) << f;
  }
  EXPECT_FALSE(cut_to_cone(V{}, 5.0, 1.0).sliding);
  // 1e-200 rad/s for 1e200 s.
  EXPECT_NEAR(turned(Quaternion<double>{}, V{0, 0, 1e-200}, 1e200).z, std::sin(0.5), 1e-15);
}

// Centres 1e-9 of a radius apart: the overlap has lost seven digits of it.
TEST(SphereSphere, RelativeVelocityDeepInEachOther) {
  const auto g = sphere_sphere(V{}, 1.0, V{1e-9, 0, 0}, 1.0);
  EXPECT_EQ(g.distance, 1e-9);
  EXPECT_DOUBLE_EQ(sphere_relative_velocity(g.distance, 1.0, 1.0, V{}, V{0, 1, 0}).y, 2e9);
  EXPECT_GT(std::abs(2 / (2 - g.overlap) / 2e9 - 1), 1e-8);
}

TEST(SphereBody, DensityIsThatOfItsMass) {
  EXPECT_DOUBLE_EQ(sphere_density(sphere_mass(0.01, 2500.0), 0.01), 2500);
  EXPECT_FLOAT_EQ(sphere_density(4.18879020e-32F, 1e-12F), 1e4F) << "whose cube is 0 in float";
}

TEST(CriticalStep, ClosedValues) {
  EXPECT_DOUBLE_EQ(p_wave_step(0.01, 2500.0, 1e8), 5e-5);
  // nu = 0: G = E/2, fit 0.8766.
  EXPECT_DOUBLE_EQ(rayleigh_step(0.01, 2500.0, 2e8, 0.0),
                   std::acos(-1.0) * 0.01 * std::sqrt(2500 / 1e8) / 0.8766);
  EXPECT_DOUBLE_EQ(stiffness_step(2.0, V{1, 4, 3}), 0.8 * std::sqrt(2.0) * std::sqrt(0.5));
  EXPECT_EQ(stiffness_step(2.0, V{}), 0) << "no stiffness, no limit";
}

TEST(KernelTable, EveryRowHasInputsOutputsAndAnEvaluator) {
  EXPECT_EQ(kernel_table<double>().size(), all_kernels().size());
  for (const KernelInfo& k : all_kernels()) {
    EXPECT_EQ(find_kernel(k.name), &k);
    EXPECT_GT(k.input_components(), 0U) << k.name;
    EXPECT_GT(k.output_components(), 0U) << k.name;
  }
  EXPECT_EQ(find_kernel("nothing"), nullptr);
}

}  // namespace
}  // namespace ulpgate::dem
