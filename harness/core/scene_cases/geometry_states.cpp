// Spheres, facets and boxes in degenerate positions, at extreme sizes and far from the origin.
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"

namespace ulpgate {

namespace {

// Part 0 of a geometry is the overlap: contact while it is not negative.
std::string must_touch(const KernelPoint& p) {
  return p.got[0][0] >= 0 ? "" : "no contact where the bodies overlap";
}
std::string must_not_touch(const KernelPoint& p) {
  return p.got[0][0] < 0 ? "" : "a contact of bodies that are apart";
}
// Part 1 is the normal.
std::string unit_normal(const KernelPoint& p) {
  WideReal sum(0);
  for (const auto& x : p.got[1]) sum += x * x;
  return std::fabs(static_cast<double>(WideReal(sum - 1))) < 0.01
             ? ""
             : "the normal is no unit vector: its length squared is " +
                   std::to_string(static_cast<double>(sum));
}

void add_spheres(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "coincident_centres",
                  .form = "exact",
                  .title = "two spheres about one point: no direction between them",
                  .kernel = "sphere_sphere",
                  .inputs = "1 2 3 1 1 2 3 1",
                  .known = {{"all", StressVerdict::diverged,
                             "Two centres in one point have no direction between them: the normal is 0/0, a "
                             "property of the formula; scenes refuse such a start."}}});
  list.push_back({.name = "coincident_centres",
                  .form = "one_ulp_apart",
                  .title = "two centres one ulp apart: the normal is exact, the overlap that of a radius",
                  .kernel = "sphere_sphere",
                  .inputs = "1 2 3 1 1+2*u 2 3 1",
                  .truth = {{1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "overlap_one_ulp",
                  .form = "along_an_axis",
                  .title = "an overlap of one ulp, along x",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1 2-2*u 0 0 1",
                  .truth = {{0, {"2*u"}}},
                  .outcome = must_touch});
  list.push_back({.name = "overlap_one_ulp",
                  .form = "oblique",
                  .title = "an overlap of one ulp, the centres 0.5 apart along (0.6, 0.8, 0)",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 0.25 0.3 0.4 0 0.25*(1+2*u)"});
  list.push_back({.name = "gap_one_ulp",
                  .form = "along_an_axis",
                  .title = "a gap of one ulp, along x",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1 2+4*u 0 0 1",
                  .truth = {{0, {"-4*u"}}},
                  .outcome = must_not_touch});
  list.push_back({.name = "overlap_of_a_radius",
                  .form = "",
                  .title = "an overlap near two radii",
                  .kernel = "sphere_sphere",
                  .inputs = "0.1 0.2 0.3 1 0.1+1e-4 0.2 0.3 1",
                  .outcome = must_touch});
  list.push_back({.name = "size_ratio",
                  .form = "1e12_to_1",
                  .title = "a grain of 1 m on a sphere of 1e12 m, overlap 0.5 m",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1e12 0.6*(1e12+0.5) 0.8*(1e12+0.5) 0 1",
                  .truth = {{0, {"0.5"}}},
                  .outcome = must_touch});
  list.push_back({.name = "size_ratio",
                  .form = "scan",
                  .title = "a sphere of radius s on one of 1 m, overlap s/2: where the contact is lost",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1 0.6*(1+s/2) 0.8*(1+s/2) 0 s",
                  .scan_step = -1,
                  .scan_end = -100,
                  .truth = {{0, {"s/2"}}},
                  .outcome = must_touch});
  list.push_back({.name = "size_scale",
                  .form = "1e-12",
                  .title = "two spheres of 1e-12 m, overlap 0.1 of it",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1e-12 1.52e-12 1.14e-12 0 1e-12",
                  .outcome = must_touch});
  list.push_back({.name = "size_scale",
                  .form = "1e12",
                  .title = "two spheres of 1e12 m, overlap 0.1 of it",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 1e12 1.52e12 1.14e12 0 1e12",
                  .outcome = must_touch});
  list.push_back({.name = "size_scale",
                  .form = "squares_underflow",
                  .title = "spheres so small that the square of their distance has no full precision",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 small/1e3 1.3*small/1e3 0.9*small/1e3 0 small/1e3",
                  .outcome = unit_normal});
  list.push_back({.name = "size_scale",
                  .form = "squares_overflow",
                  .title = "spheres so large that the square of their distance overflows",
                  .kernel = "sphere_sphere",
                  .inputs = "0 0 0 large*4 5*large 4*large 0 large*4",
                  .outcome = unit_normal});
  list.push_back({.name = "far_from_the_origin",
                  .form = "scan",
                  .title = "two spheres of 1 m, overlap 0.5 m, moved to (s, s, s): where the contact is lost",
                  .kernel = "sphere_sphere",
                  .inputs = "s s s 1 s+0.9 s+1.2 s 1",
                  .scan_step = 1,
                  .scan_end = 620,
                  .truth = {{0, {"0.5"}}},
                  .outcome = must_touch,
                  .known = {{"all", StressVerdict::diverged,
                             "Positions round to multiples of ulp(s): both centres become one point where s "
                             "passes 2^p, a property of the type."}}});
  list.push_back(
      {.name = "far_from_the_origin",
       .form = "1e7",
       .title = "spheres of 1 mm, 3.2 nm overlapping, at 1e7 m",
       .kernel = "sphere_sphere",
       .inputs = "1e7 0 0 1e-3 1e7+2e-3-3.2e-9 0 0 1e-3",
       .truth = {{0, {"3.2e-9"}}},
       .outcome = must_touch,
       .known = {{"float", StressVerdict::diverged,
                  "The ulp of float at 1e7 m is 1 m: both centres are one point, a property of the type."}}});
}

void add_facets(std::vector<KernelStateCase>& list) {
  const std::string triangle = "0 0 0 1 0 0 0 1 0 ";
  list.push_back({.name = "centre_on_a_facet",
                  .form = "inside",
                  .title = "a centre in the plane of a triangle, over its face",
                  .kernel = "facet_sphere",
                  .inputs = triangle + "0.25 0.25 0 0.5",
                  .truth = {{0, {"0.5"}}, {1, {"0", "0", "1"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_facet",
                  .form = "on_an_edge",
                  .title = "a centre on the edge of a triangle",
                  .kernel = "facet_sphere",
                  .inputs = triangle + "0.5 0.5 0 0.5",
                  .truth = {{0, {"0.5"}}, {1, {"0", "0", "1"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_facet",
                  .form = "on_a_corner",
                  .title = "a centre on the corner of a triangle",
                  .kernel = "facet_sphere",
                  .inputs = triangle + "0 0 0 0.5",
                  .truth = {{0, {"0.5"}}, {1, {"0", "0", "1"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_facet",
                  .form = "beside_it",
                  .title = "a centre in the plane of a triangle, beyond an edge",
                  .kernel = "facet_sphere",
                  .inputs = triangle + "0.25 -0.25 0 0.5",
                  .truth = {{0, {"0.25"}}, {1, {"0", "-1", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_facet",
                  .form = "oblique",
                  .title = "the centroid of an oblique triangle: the side is a matter of rounding",
                  .kernel = "facet_sphere",
                  .inputs = "0.1 0.2 0.3 1.3 0.1 0.7 0.2 1.1 -0.4 1.6/3 1.4/3 0.2 0.5",
                  .outcome = must_touch});
  list.push_back({.name = "facet_needle",
                  .form = "1e-4",
                  .title = "a triangle 1e-4 as wide as long",
                  .kernel = "facet_sphere",
                  .inputs = "0 0 0 1 0.3 0.2 0.5 0.15+1e-4 0.1 0.5 0.15 0.4 0.5",
                  .outcome = unit_normal});
  list.push_back({.name = "facet_scale",
                  .form = "1e-12",
                  .title = "a triangle and a sphere of 1e-12 m",
                  .kernel = "facet_sphere",
                  .inputs = "0 0 0 1e-12 0 0 0 1e-12 0 2.5e-13 2.5e-13 2e-13 5e-13",
                  .truth = {{0, {"3e-13"}}, {1, {"0", "0", "1"}}},
                  .outcome = must_touch});
  list.push_back({.name = "facet_scale",
                  .form = "1e12",
                  .title = "a triangle and a sphere of 1e12 m",
                  .kernel = "facet_sphere",
                  .inputs = "0 0 0 1e12 0 0 0 1e12 0 2.5e11 2.5e11 2e11 5e11",
                  .truth = {{0, {"3e11"}}, {1, {"0", "0", "1"}}},
                  .outcome = must_touch});
  list.push_back({.name = "facet_scale",
                  .form = "1e-12_beyond_an_edge",
                  .title = "a sphere of 1e-12 m beyond the long edge of a triangle as small",
                  .kernel = "facet_sphere",
                  .inputs = "0 0 0 1e-12 0 0 0 1e-12 0 1e-12 1e-12 0 1e-12",
                  .truth = {{0, {"1e-12*(1-sqrt(0.5))"}}, {1, {"sqrt(0.5)", "sqrt(0.5)", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "facet_far_from_the_origin",
                  .form = "scan",
                  .title = "a triangle and a sphere, overlap 0.25, moved to (s, s, s)",
                  .kernel = "facet_sphere",
                  .inputs = "s s s s+1 s s s s+1 s s+0.25 s+0.25 s+0.25 0.5",
                  .scan_step = 1,
                  .scan_end = 620,
                  .truth = {{0, {"0.25"}}},
                  .outcome = must_touch,
                  .known = {{"all", StressVerdict::diverged,
                             "Vertices round to multiples of ulp(s): the facet has no area where s reaches "
                             "2^p, a property of the type; scenes refuse it."}}});
  list.push_back({.name = "wall_far_along_itself",
                  .form = "1e12",
                  .title = "a sphere on a wall x = 0, at y = z = 1e12: nothing is lost",
                  .kernel = "wall_sphere",
                  .inputs = "0 0 0 0.5 1e12 1e12 1",
                  .truth = {{0, {"0.5"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
}

void add_boxes(std::vector<KernelStateCase>& list) {
  list.push_back({.name = "centre_inside_a_box",
                  .form = "nearest_face",
                  .title = "a centre inside a box leaves through the nearest face",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 2 3 1 0 0 0 0.25 0 0 0.5",
                  .truth = {{0, {"1.25"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_inside_a_box",
                  .form = "its_centre",
                  .title = "the centre of a cube: x wins, upwards",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 1 1 1 0 0 0 0 0 0 0.5",
                  .truth = {{0, {"1.5"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_inside_a_box",
                  .form = "turned",
                  .title = "a centre inside a box that is turned by 2 atan(4/3)",
                  .kernel = "box_sphere",
                  .inputs = "0.5 0 0 1 2 3 0.6 0 0 0.8 0.6 0.1 0.2 0.5",
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_box",
                  .form = "on_the_face",
                  .title = "a centre on the face itself",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 2 3 1 0 0 0 1 0.5 0.5 0.5",
                  .truth = {{0, {"0.5"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_box",
                  .form = "one_ulp_outside",
                  .title = "a centre one ulp outside the face",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 2 3 1 0 0 0 1+2*u 0.5 0.5 0.5",
                  .truth = {{0, {"0.5-2*u"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "centre_on_a_box",
                  .form = "least_step_outside",
                  .title = "a box so small that the square of a step out of it is 0",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 small small small 1 0 0 0 small*(1+2*u) 0 0 small",
                  .outcome = unit_normal});
  list.push_back({.name = "medial_plane",
                  .form = "straight",
                  .title = "a centre as far from one face as from another: the lower axis wins",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 1 1 1 0 0 0 0.5 0.5 0 0.5",
                  .truth = {{0, {"1"}}, {1, {"1", "0", "0"}}},
                  .outcome = must_touch});
  list.push_back({.name = "medial_plane",
                  .form = "turned",
                  .title = "the same in a box turned by 45 degrees: rounding decides",
                  .kernel = "box_sphere",
                  .inputs = "0 0 0 1 1 1 sqrt((1+sqrt(0.5))/2) 0 0 sqrt((1-sqrt(0.5))/2) 0 sqrt(0.5) 0 0.5",
                  .outcome = must_touch});
}

}  // namespace

std::vector<KernelStateCase> geometry_states() {
  std::vector<KernelStateCase> list;
  add_spheres(list);
  add_facets(list);
  add_boxes(list);
  return list;
}

}  // namespace ulpgate
