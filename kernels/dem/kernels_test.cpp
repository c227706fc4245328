// Tests of the DEM kernels: known closed values, the table's coverage, and each kernel in double against
// RealHP<4>.
#include <gtest/gtest.h>

#include <random>

#include "kernels/dem/kernel_table_impl.hpp"
#include "reference/widen.hpp"

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

TEST(CriticalStep, ClosedValues) {
  EXPECT_DOUBLE_EQ(p_wave_step(0.01, 2500.0, 1e8), 5e-5);
  // nu = 0: G = E/2, fit 0.8766.
  EXPECT_DOUBLE_EQ(rayleigh_step(0.01, 2500.0, 2e8, 0.0),
                   std::acos(-1.0) * 0.01 * std::sqrt(2500 / 1e8) / 0.8766);
  EXPECT_DOUBLE_EQ(stiffness_step(2.0, V{1, 4, 3}), 0.8 * std::sqrt(2.0) * std::sqrt(0.5));
  EXPECT_EQ(stiffness_step(2.0, V{}), 0) << "no stiffness, no limit";
}

TEST(KernelTable, RowsAreComplete) {
  EXPECT_GE(all_kernels().size(), 15U);
  EXPECT_EQ(kernel_table<double>().size(), all_kernels().size());
  for (const KernelInfo& k : all_kernels()) {
    EXPECT_EQ(find_kernel(k.name)->id, k.id);
    EXPECT_FALSE(k.inputs.empty()) << k.name;
    EXPECT_FALSE(k.outputs.empty()) << k.name;
    for (const InputQuantity& q : k.inputs) {
      const bool vector = q.role == Role::unit_vector || q.role == Role::position || q.role == Role::velocity;
      EXPECT_EQ(q.components, q.role == Role::orientation ? 4
                              : vector                    ? 3
                                                          : q.components)
          << k.name << ' ' << q.name;
      EXPECT_NE(name_of(q.role), "");
    }
  }
  EXPECT_FALSE(find_kernel("nothing"));
}

// A plain state of a kernel, all numbers of the order of 1.
std::vector<double> plain_state(const KernelInfo& k, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.5, 1);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> in;
  for (const InputQuantity& q : k.inputs) {
    std::vector<double> x;
    for (int i = 0; i < q.components; ++i) {
      const bool is_signed = q.components > 1 && q.role != Role::length && q.role != Role::inertia;
      x.push_back(is_signed ? any(random) : unit(random));
    }
    if (q.role == Role::poisson) x[0] /= 4;
    if (q.role == Role::unit_vector || q.role == Role::orientation) {
      double size = 0;
      for (const double c : x) size += c * c;
      for (double& c : x) c /= std::sqrt(size);
    }
    in.insert(in.end(), x.begin(), x.end());
  }
  return in;
}

// The double result of a plain state stays within a few roundings, relative to the largest number about, of
// RealHP<4>.
TEST(KernelTable, DoubleAgreesWithItsReference) {
  using Wide = RealHP<4, double>;
  std::mt19937_64 random(1);
  for (const KernelInfo& k : all_kernels()) {
    for (int trial = 0; trial < 200; ++trial) {
      const std::vector<double> in = plain_state(k, random);
      std::vector<Wide> wide_in;
      for (const double x : in) wide_in.push_back(widen<Wide>(x));
      std::vector<double> out(static_cast<std::size_t>(k.output_size));
      std::vector<Wide> wide_out(out.size());
      std::uint8_t threw[2] = {0, 0};
      const auto row = static_cast<std::size_t>(k.id);
      kernel_table<double>()[row](in.data(), out.data(), &threw[0], 1);
      kernel_table<Wide>()[row](wide_in.data(), wide_out.data(), &threw[1], 1);
      ASSERT_EQ(threw[0] + threw[1], 0) << k.name;
      for (std::size_t i = 0; i < out.size(); ++i) {
        const auto exact = static_cast<double>(wide_out[i]);
        const auto error = static_cast<double>(Wide(abs(Wide(wide_out[i] - Wide(out[i])))));
        ASSERT_LE(error, 1e-12 * std::max(1.0, std::abs(exact)))
            << k.name << " output " << i << " trial " << trial;
      }
    }
  }
}

// A kernel's two precisions must keep converging: where they stop at 1e-16, a double is hidden.
TEST(KernelTable, LadderConvergesBeyondDouble) {
  using Narrow = RealHP<4, double>;
  using Wide = MpfrReal<120>;
  std::mt19937_64 random(2);
  for (const KernelInfo& k : all_kernels()) {
    const std::vector<double> in = plain_state(k, random);
    std::vector<Narrow> narrow_in;
    std::vector<Wide> wide_in;
    for (const double x : in) {
      narrow_in.push_back(widen<Narrow>(x));
      wide_in.push_back(widen<Wide>(x));
    }
    std::vector<Narrow> narrow(static_cast<std::size_t>(k.output_size));
    std::vector<Wide> wide(narrow.size());
    std::uint8_t threw = 0;
    kernel_table<Narrow>()[static_cast<std::size_t>(k.id)](narrow_in.data(), narrow.data(), &threw, 1);
    kernel_table<Wide>()[static_cast<std::size_t>(k.id)](wide_in.data(), wide.data(), &threw, 1);
    for (std::size_t i = 0; i < narrow.size(); ++i) {
      const Wide difference = wide[i] - widen<Wide>(narrow[i]);
      ASSERT_LT(static_cast<double>(abs(difference)),
                1e-52 * std::max(1.0, std::abs(static_cast<double>(wide[i]))))
          << k.name << " output " << i;
    }
  }
}

}  // namespace
}  // namespace ulpgate::dem
