// Generators of bodies: hexagonal packing in a ball, jittered grid, closed box of facets.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/dem/formulas/flat_geometry.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate::scenes {

// Hexagonal closest packing of spheres (radius r, surfaces `gap` apart, m) that lie wholly in the ball of
// `ball_radius` about the origin.  Lattice a/2 (2i + (j+k) mod 2, sqrt3 (j + (k mod 2)/3), 2 sqrt6/3 k), a =
// 2r + gap, counted from `corner`.  J. H. Conway & N. J. A. Sloane, Sphere Packings, Lattices and Groups
// (1999).
template <RealType Real>
struct HexagonalBall {
  Real r, gap, ball_radius;
  dem::Vec3<Real> corner;

  [[nodiscard]] Real spacing() const { return 2 * r + gap; }
  [[nodiscard]] static Real row() {
    using std::sqrt;
    return sqrt(Real(3));
  }
  [[nodiscard]] static Real layer() {
    using std::sqrt;
    return 2 * sqrt(Real(6)) / 3;
  }
};

inline constexpr int most_lattice_planes = 1 << 20;

// How many planes of the lattice are tried along each axis; empty where there are more than
// most_lattice_planes, or where the lattice has no finite spacing.
template <RealType Real>
[[nodiscard]] std::optional<std::array<int, 3>> hexagonal_counts(const HexagonalBall<Real>& ball) {
  const Real a = ball.spacing();
  const std::array<Real, 3> step{a, Real(ball.row() * a / 2), Real(ball.layer() * a / 2)};
  std::array<int, 3> counts{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Real& from = ball.corner[axis];
    if (!(step[axis] > 0) || !is_finite(step[axis])) return std::nullopt;
    if (!((ball.ball_radius - from) / step[axis] < most_lattice_planes)) return std::nullopt;
    int n = 0;
    while (from + Real(n) * step[axis] <= ball.ball_radius) ++n;
    counts[axis] = n + 1;
  }
  return counts;
}

// About how many of those points lie in the ball: its share, pi/6, of the cube around it.
[[nodiscard]] inline std::uint64_t points_inside(const std::array<int, 3>& counts) {
  double points = 0.53;
  for (const int n : counts) points *= n;
  return static_cast<std::uint64_t>(points);
}

template <RealType Real>
[[nodiscard]] std::vector<dem::Vec3<Real>> hexagonal_ball(const HexagonalBall<Real>& ball,
                                                          const std::array<int, 3>& counts) {
  const Real a = ball.spacing();
  const Real sqrt3 = ball.row();
  const Real layer = ball.layer();
  std::vector<dem::Vec3<Real>> centres;
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int k = 0; k < counts[2]; ++k) {
        const dem::Vec3<Real> p =
            (a / 2) * dem::Vec3<Real>{Real(2 * i + (j + k) % 2), sqrt3 * (Real(j) + Real(k % 2) / 3),
                                      layer * Real(k)} +
            ball.corner;
        if (dem::norm(p) <= ball.ball_radius - ball.r) centres.push_back(p);
      }
    }
  }
  return centres;
}

// A random number on [0, 1) with 24 bits, the same exact value in every Real.  Philox4x64-10: Salmon et al.,
// "Parallel random numbers: as easy as 1, 2, 3", SC'11.
template <RealType Real>
[[nodiscard]] Real uniform(int seed, std::uint64_t point, std::size_t coordinate) {
  const r123::Philox4x64::ctr_type counter{{point, 0, 0, 0}};
  const r123::Philox4x64::key_type key{{static_cast<std::uint64_t>(seed), 0x756c7067617465ULL}};
  const auto words = r123::Philox4x64()(counter, key);
  return Real(static_cast<int>(words[coordinate] >> 40U)) / 16777216;
}

template <RealType Real>
struct GridNode {
  dem::Vec3<Real> position;
  Real radius;
  int i;  // layer along x
};

// Spheres at corner + (i, j, k) * spacing, each moved by up to `jitter` along every axis (m), of radius
// `radius` (1 -+ spread).
template <RealType Real>
[[nodiscard]] std::vector<GridNode<Real>> grid(const std::array<int, 3>& counts,
                                               const dem::Vec3<Real>& spacing, const dem::Vec3<Real>& corner,
                                               const Real& jitter, const Real& radius, const Real& spread,
                                               int seed) {
  std::vector<GridNode<Real>> nodes;
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int k = 0; k < counts[2]; ++k) {
        const auto signed_unit = [&, point = nodes.size()](std::size_t c) {
          return Real(2 * uniform<Real>(seed, point, c) - 1);
        };
        const dem::Vec3<Real> p{corner.x + Real(i) * spacing.x + jitter * signed_unit(0),
                                corner.y + Real(j) * spacing.y + jitter * signed_unit(1),
                                corner.z + Real(k) * spacing.z + jitter * signed_unit(2)};
        nodes.push_back({p, radius * (1 + spread * signed_unit(3)), i});
      }
    }
  }
  return nodes;
}

// Two triangles for each side of a box.
template <RealType Real>
[[nodiscard]] std::vector<dem::Facet<Real>> facet_box(const dem::Vec3<Real>& centre,
                                                      const dem::Vec3<Real>& half) {
  const auto at = [&](int sx, int sy, int sz) {
    return dem::Vec3<Real>{centre.x + Real(sx) * half.x, centre.y + Real(sy) * half.y,
                           centre.z + Real(sz) * half.z};
  };
  std::vector<dem::Facet<Real>> facets;
  const auto quad = [&](const auto& a, const auto& b, const auto& c, const auto& d) {
    facets.push_back({a, b, c});
    facets.push_back({c, d, a});
  };
  quad(at(-1, -1, -1), at(-1, -1, 1), at(-1, 1, 1), at(-1, 1, -1));
  quad(at(1, -1, -1), at(1, 1, -1), at(1, 1, 1), at(1, -1, 1));
  quad(at(-1, -1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1));
  quad(at(-1, 1, -1), at(-1, 1, 1), at(1, 1, 1), at(1, 1, -1));
  quad(at(-1, -1, -1), at(-1, 1, -1), at(1, 1, -1), at(1, -1, -1));
  quad(at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1));
  return facets;
}

}  // namespace ulpgate::scenes
