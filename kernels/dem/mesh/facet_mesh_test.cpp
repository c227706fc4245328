// Tests of facets as one surface: each point of it that is nearest to a centre counts once, in any cut.
#include "kernels/dem/mesh/facet_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/dem/testing/scenes.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::dem {
namespace {

using Points = std::vector<std::array<double, 3>>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

scenes::Scene scene_of(const std::string& more) {
  return testing::read(
      "name = \"mesh\"\n[[material]]\nname = \"m\"\n[[sphere]]\nposition = [0, 9, 0]\nradius = 1\n" + more +
      "[run]\ndt = 1e-5\nuntil = 1\n");
}

template <RealType Real>
struct Surface {
  std::vector<Facet<Real>> facets;
  FacetMesh<Real> mesh;

  Surface(const Points& points, const Triangles& triangles) {
    MeshTopology topology;
    std::vector<std::int32_t> bodies;
    for (const auto& [a, b, c] : triangles) {
      const auto at = [&](std::size_t i) {
        return Vec3<Real>{static_cast<Real>(points[i][0]), static_cast<Real>(points[i][1]),
                          static_cast<Real>(points[i][2])};
      };
      facets.push_back({at(a), at(b), at(c)});
      topology.corners.push_back(
          {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
      bodies.push_back(static_cast<std::int32_t>(bodies.size()));
    }
    mesh = FacetMesh<Real>(topology, bodies);
    mesh.measure([&](std::size_t k) { return facets[k]; });
  }

  struct Found {
    std::vector<std::size_t> facets;  // that count
    Real least{HUGE_VALF};            // distance to the surface, m
    Real counted{HUGE_VALF};          // to what counts
  };
  // Of the facets that a sphere of centre x and radius r (m) overlaps.
  [[nodiscard]] Found touch(const Vec3<Real>& x, const Real& r) const {
    Found found;
    for (std::size_t k = 0; k < facets.size(); ++k) {
      const FacetContact<Real> c = mesh.contact(k, x, r);
      if (!(c.geometry.overlap > 0)) continue;
      const Real distance = r - mesh.geometry(k, c).overlap;
      found.least = std::min(found.least, distance);
      const bool counts = mesh.counts(k, c, x, r);
      EXPECT_EQ(counts, mesh.successor(k, x, r) < 0) << k;
      if (!counts) continue;
      found.facets.push_back(k);
      found.counted = std::min(found.counted, distance);
    }
    return found;
  }
};

// A plane square of n by n quadrangles of random shape, each cut along a random diagonal, in any orientation;
// each is `size` m wide.
template <RealType Real>
void one_contact_wherever_a_plane_is_cut(int n, double offset, double size = 1) {
  std::mt19937 draw(7);
  const auto uniform = [&] { return static_cast<double>(draw()) / 4294967296.0; };
  const double tilt = 0.7;
  const auto place = [&](double u, double v, double w) -> std::array<double, 3> {
    // Turned about z, then about x.
    const double y = u * std::sin(0.4) + v * std::cos(0.4);
    return {size * (u * std::cos(0.4) - v * std::sin(0.4) + offset),
            size * (y * std::cos(tilt) - w * std::sin(tilt)),
            size * (y * std::sin(tilt) + w * std::cos(tilt))};
  };
  Points plane;
  Points points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool inside = i > 0 && j > 0 && i < n && j < n;
      plane.push_back(
          {i + (inside ? 0.6 * uniform() - 0.3 : 0), j + (inside ? 0.6 * uniform() - 0.3 : 0), 0});
      points.push_back(place(plane.back()[0], plane.back()[1], 0));
    }
  }
  Triangles triangles;
  const auto node = [&](int i, int j) {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(n + 1) + static_cast<std::size_t>(j);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const std::size_t corner[] = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      const std::size_t s = draw() % 2;
      triangles.push_back({corner[s], corner[s + 1], corner[s + 2]});
      triangles.push_back({corner[s + 2], corner[(s + 3) % 4], corner[s]});
    }
  }
  std::shuffle(triangles.begin(), triangles.end(), draw);
  const Surface<Real> surface(points, triangles);
  int seams = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto& t = triangles[draw() % triangles.size()];
    double a = uniform();
    double b = (1 - a) * uniform();
    // Half of the centres stand over a seam or a corner, some roundings to its side.
    if (i % 4 == 1) b = 0;
    if (i % 4 == 2) a = b = 0;
    const auto weigh = [&](std::size_t k) {
      return plane[t[0]][k] * (1 - a - b) + plane[t[1]][k] * a + plane[t[2]][k] * b;
    };
    const double height = (i % 3 == 0 ? -1 : 1) * (0.05 + uniform());
    const auto c = place(weigh(0), weigh(1), height);
    Vec3<Real> x{static_cast<Real>(c[0]), static_cast<Real>(c[1]), static_cast<Real>(c[2])};
    for (std::size_t k = 0; k < 3; ++k)
      x[k] +=
          std::numeric_limits<Real>::epsilon() * x[k] * static_cast<Real>(static_cast<int>(draw() % 7) - 3);
    const auto found = surface.touch(x, static_cast<Real>(1.5 * size));
    ASSERT_EQ(found.facets.size(), 1U) << "centre " << i;
    const double nearest =
        64 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * (1 + offset) * size;
    EXPECT_LE(static_cast<double>(found.counted - found.least), nearest) << i;
    seams += i % 4 == 1 || i % 4 == 2 ? 1 : 0;
  }
  EXPECT_EQ(seams, 3000);
}

TEST(FacetMesh, APlaneIsTouchedOnceHoweverItIsCut) {
  one_contact_wherever_a_plane_is_cut<double>(6, 0);
  one_contact_wherever_a_plane_is_cut<float>(6, 0);
  one_contact_wherever_a_plane_is_cut<double>(3, 1e6);
}

// Squares of areas leave a float below 1e-10 m and above 1e9 m.
TEST(FacetMesh, APlaneOfAnySizeIsTouchedOnce) {
  for (const double size : {1e-15, 1e-12, 1e12, 1e15}) {
    SCOPED_TRACE(size);
    one_contact_wherever_a_plane_is_cut<float>(4, 0, size);
  }
  one_contact_wherever_a_plane_is_cut<double>(4, 0, 1e-100);
  one_contact_wherever_a_plane_is_cut<double>(4, 0, 1e100);
}

// Beyond its border the nearest point of a plane is one of the border, whose strips are narrower than the
// contact reaches.
TEST(FacetMesh, TheBorderOfNarrowStripsIsTouchedOnce) {
  Points points;
  Triangles strips;
  for (std::size_t i = 0; i < 8; ++i) {
    points.push_back({0.125 * static_cast<double>(i), 0, -4});
    points.push_back({0.125 * static_cast<double>(i), 0, 4});
    if (i > 0) {
      strips.push_back({2 * i - 2, 2 * i - 1, 2 * i});
      strips.push_back({2 * i, 2 * i - 1, 2 * i + 1});
    }
  }
  const Surface<double> surface(points, strips);
  for (const double beyond : {-0.5, -0.25, 0., 0.3, 0.875, 1., 1.2}) {
    const auto found = surface.touch({beyond, 0.5, 0.1}, 1);
    ASSERT_EQ(found.facets.size(), 1U) << beyond;
    const double aside = beyond < 0 ? -beyond : beyond > 0.875 ? beyond - 0.875 : 0;
    EXPECT_NEAR(found.counted, std::hypot(0.5, aside), 1e-15) << beyond;
  }
}

const Triangles cube = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                        {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};

// Outside, a convex body has one nearest point; inside, a cube has one on each face that the sphere reaches.
TEST(FacetMesh, ACubeIsTouchedOnceOutsideAndOnceAFaceInside) {
  std::mt19937 draw(11);
  const auto uniform = [&](double size) { return size * (static_cast<double>(draw()) / 2147483648.0 - 1); };
  Points corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? 1. : -1., (i & 2) != 0 ? 1. : -1., (i & 4) != 0 ? 1. : -1.});
  Triangles shuffled = cube;
  int edges = 0;
  int concave = 0;
  for (int i = 0; i < 5000; ++i) {
    std::shuffle(shuffled.begin(), shuffled.end(), draw);
    for (auto& t : shuffled) std::shuffle(t.begin(), t.end(), draw);
    const Surface<double> surface(corners, shuffled);
    Vec3<double> x{uniform(1.6), uniform(1.6), uniform(1.6)};
    // Some over edges, diagonals and corners exactly.
    if (i % 3 == 0) x = {std::round(4 * x.x) / 4, std::round(4 * x.y) / 4, std::round(4 * x.z) / 4};
    std::size_t beyond = 0;
    std::size_t near = 0;
    double outside2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double out = std::fabs(x[k]) - 1;
      if (out > 0) ++beyond;
      if (out > 0) outside2 += out * out;
      if (out == 0) near = 99;  // in the plane of a face: on the border between inside and outside
      if (out < 0 && out > -0.7) ++near;
    }
    if (near >= 99) continue;
    const auto found = surface.touch(x, 0.7);
    if (beyond == 0) {
      EXPECT_EQ(found.facets.size(), near) << x.x << ' ' << x.y << ' ' << x.z;
      concave += near > 1 ? 1 : 0;
    } else if (std::sqrt(outside2) < 0.7) {
      ASSERT_EQ(found.facets.size(), 1U) << x.x << ' ' << x.y << ' ' << x.z;
      EXPECT_NEAR(found.counted, std::sqrt(outside2), 1e-14);
      edges += beyond > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(edges, 500);
  EXPECT_GT(concave, 300);
}

TEST(FacetMesh, ACornerOfSixFacetsIsTouchedOnceByTheLowest) {
  Points points{{0, 0, 0}};
  Triangles fan;
  for (std::size_t i = 0; i < 6; ++i) {
    points.push_back(
        {std::cos(1.0472 * static_cast<double>(i)), 0, std::sin(1.0472 * static_cast<double>(i))});
    fan.push_back({0, i + 1, (i + 1) % 6 + 1});
  }
  for (const double apex : {0., 0.5, -0.5}) {
    points[0][1] = apex;
    const Surface<double> surface(points, fan);
    // Over a plane or a summit one contact; in a funnel that is met from above one on each side.
    EXPECT_EQ(surface.touch({0, apex + 0.3, 0}, 0.5).facets.size(), apex < 0 ? 6U : 1U) << apex;
    EXPECT_EQ(surface.touch({0, apex + 0.3, 0}, 0.5).facets.front(), 0U) << apex;
  }
}

TEST(FacetMesh, AFacetThatStandsThereTwiceCountsOnce) {
  const Surface<double> surface({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}, {2, 0, 1}, {1, 0, 2}});
  for (const Vec3<double>& x : {Vec3<double>{0.2, 0.3, 0.2}, {-0.2, 0.3, 0.4}, {0, 0.3, 0}, {0.7, -0.3, 0.7}})
    EXPECT_EQ(surface.touch(x, 0.5).facets, std::vector<std::size_t>{0});
}

// Beside the edge of two facets, over one of them: who goes on with the contact of the other.
TEST(FacetMesh, TheSuccessorIsTheFacetThatCounts) {
  const Surface<double> surface({{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(surface.mesh.successor(0, {-0.01, 0.3, 0}, 0.5), 1);
  EXPECT_EQ(surface.mesh.successor(1, {-0.01, 0.3, 0}, 0.5), -1) << "it counts itself";
  EXPECT_EQ(surface.mesh.successor(1, {0.01, 0.3, 0}, 0.5), 0);
  EXPECT_EQ(surface.mesh.around(0), std::vector<std::size_t>{1});
}

TEST(MeshTopology, CornersAreOnePointWhereTheTextSaysSo) {
  const std::string one = "[[facet]]\nvertices = [[0, 0, 0], [1, 0, 0], [\"0.1\", 0, 1]]\n";
  struct Case {
    const char* vertices;
    bool shares;
    const char* why;
  };
  for (const Case& c :
       {Case{"[[0, -1, 0], [1, 0, 0], [-0.0, 0, 0.0]]", true, "of two corners, one with negative zeros"},
        Case{"[[5, 0, 0], [6, 0, 1], [\"1/10\", 0, \"2/2\"]]", true, "one corner, written in another way"},
        Case{"[[5, 0, 0], [6, 0, 1], [\"0.1+1e-30\", 0, 1]]", false, "no corner, though double sees one"},
        Case{"[[5, 0, 0], [6, 0, 1], [0.5, 0, 0]]", false, "a corner within an edge"}}) {
    const auto mesh = mesh_topology(scene_of(one + "[[facet]]\nvertices = " + c.vertices + "\n"));
    EXPECT_EQ(!mesh.corners.empty(), c.shares) << c.why;
  }
  EXPECT_TRUE(mesh_topology(scene_of(one)).corners.empty());
  EXPECT_TRUE(mesh_topology(scene_of("")).corners.empty());
  // Generated facets stand before those that are written out, and share corners with them.
  const auto box =
      mesh_topology(scene_of("[[generator]]\nkind = \"facet_box\"\nhalf_size = [1, 2, \"1/3\"]\n"
                             "[[facet]]\nvertices = [[-1, -2, \"-1/3\"], [5, 0, 0], [5, 1, 0]]\n"));
  ASSERT_EQ(box.corners.size(), 13U);
  EXPECT_EQ(box.corners[12][0], box.corners[0][0]);
  std::int32_t most = 0;
  for (const auto& corners : box.corners) most = std::max({most, corners[0], corners[1], corners[2]});
  EXPECT_EQ(most, 9) << "eight corners of the box and two";
}

}  // namespace
}  // namespace ulpgate::dem
