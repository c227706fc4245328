// Tests of generated bodies: boxes of facets and grids whose sides differ.
#include "kernels/scenes/reader/lattices.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace ulpgate::scenes {
namespace {

using Vector = dem::Vec3<double>;

TEST(Lattices, ABoxOfFacetsIsClosedAndSpansItsSides) {
  const Vector centre{1, 2, 4};
  const Vector half{0.5, 0.25, 0.125};
  const auto facets = facet_box<double>(centre, half);
  ASSERT_EQ(facets.size(), 12U);
  std::map<std::array<std::array<double, 3>, 2>, int> edges;
  double area = 0;
  double volume = 0;
  for (const auto& f : facets) {
    const std::array<Vector, 3> corners{f.a, f.b, f.c};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& p = corners[k];
      const Vector& q = corners[(k + 1) % 3];
      EXPECT_EQ(std::abs(p.x - centre.x), half.x);
      EXPECT_EQ(std::abs(p.y - centre.y), half.y);
      EXPECT_EQ(std::abs(p.z - centre.z), half.z);
      std::array<std::array<double, 3>, 2> edge{{{p.x, p.y, p.z}, {q.x, q.y, q.z}}};
      if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
      ++edges[edge];
    }
    const Vector normal = cross(f.b - f.a, f.c - f.a);
    area += norm(normal) / 2;
    volume += std::abs(dot(normal, f.a - centre)) / 6;
  }
  // Each edge of the twelve triangles is shared by two: 12 of the box, 6 diagonals.
  EXPECT_EQ(edges.size(), 18U);
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
  EXPECT_DOUBLE_EQ(area, 8 * (half.x * half.y + half.y * half.z + half.z * half.x));
  EXPECT_DOUBLE_EQ(volume, 8 * half.x * half.y * half.z);
}

TEST(Lattices, AGridHasItsCountsAlongEachAxis) {
  const auto nodes = grid<double>({2, 3, 5}, {1, 10, 100}, {0.5, 0, 0}, 0.0, 0.25, 0.0, 1);
  ASSERT_EQ(nodes.size(), 30U);
  std::set<double> x, y, z;
  for (const auto& n : nodes) {
    x.insert(n.position.x);
    y.insert(n.position.y);
    z.insert(n.position.z);
    EXPECT_EQ(n.radius, 0.25);
    EXPECT_EQ(n.position.x, 0.5 + n.i);
  }
  EXPECT_EQ(x, (std::set<double>{0.5, 1.5}));
  EXPECT_EQ(y, (std::set<double>{0, 10, 20}));
  EXPECT_EQ(z, (std::set<double>{0, 100, 200, 300, 400}));
}

}  // namespace
}  // namespace ulpgate::scenes
