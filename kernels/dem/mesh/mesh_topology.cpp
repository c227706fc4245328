// Finding the corners of facets that are one point.
#include "kernels/dem/mesh/mesh_topology.hpp"

#include <algorithm>

#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/lattices.hpp"

namespace ulpgate::dem {

namespace {

using Wide = MpfrReal<150>;

struct Corner {
  Vec3<Wide> point;
  std::size_t number;  // 3 * facet + 0, 1, 2
};

Vec3<Wide> point_of(const scenes::Evaluator<Wide>& evaluate, const scenes::Triple& t) {
  return {evaluate(t[0]), evaluate(t[1]), evaluate(t[2])};
}

std::vector<Corner> corners_of(const scenes::Scene& scene) {
  scenes::Evaluator<Wide> evaluate;
  for (const auto& [name, text] : scene.constants) evaluate.define(name, evaluate(text));
  std::vector<Corner> corners;
  const auto add = [&](const Vec3<Wide>& point) { corners.push_back({point, corners.size()}); };
  for (const scenes::Generator& g : scene.generators) {
    if (g.kind != scenes::GeneratorKind::facet_box) continue;
    for (const auto& f : scenes::facet_box(point_of(evaluate, g.centre), point_of(evaluate, g.half_size))) {
      for (const auto& point : {f.a, f.b, f.c}) add(point);
    }
  }
  for (const scenes::FacetSpec& f : scene.facets) {
    for (const auto& vertex : f.vertices) add(point_of(evaluate, vertex));
  }
  return corners;
}

// By coordinates; a NaN, which no scene that a run accepts has, stands behind all numbers.
int compare(const Wide& a, const Wide& b) {
  if (a < b) return -1;
  if (b < a) return 1;
  return static_cast<int>(a != a) - static_cast<int>(b != b);
}

int compare(const Vec3<Wide>& a, const Vec3<Wide>& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (const int order = compare(a[k], b[k]); order != 0) return order;
  }
  return 0;
}

}  // namespace

MeshTopology mesh_topology(const scenes::Scene& scene) {
  const bool boxes = std::any_of(scene.generators.begin(), scene.generators.end(),
                                 [](const auto& g) { return g.kind == scenes::GeneratorKind::facet_box; });
  if (!boxes && scene.facets.size() < 2) return {};
  std::vector<Corner> corners = corners_of(scene);
  const std::size_t facets = corners.size() / 3;
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    const int order = compare(a.point, b.point);
    return order != 0 ? order < 0 : a.number < b.number;
  });
  MeshTopology mesh;
  mesh.corners.resize(facets);
  std::int32_t points = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0 && compare(corners[i - 1].point, corners[i].point) != 0) ++points;
    mesh.corners[corners[i].number / 3][corners[i].number % 3] = points;
  }
  if (static_cast<std::size_t>(points) + 1 == corners.size()) mesh.corners.clear();
  return mesh;
}

}  // namespace ulpgate::dem
