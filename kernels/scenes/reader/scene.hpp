// Scene: what a simulation consists of, independent of any number type; every number is kept as its text.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ulpgate::scenes {

// An expression (expression.hpp), evaluated once in the Real of the run: "0.1", "0.5/30.77",
// "L*cos(20*pi/180)".
using Expression = std::string;
using Triple = std::array<Expression, 3>;

// frictional: Cundall-Strack; viscoelastic: Pournin; hertz_mindlin; cohesive: bonds that pull, frictional
// once broken.
enum class ContactLaw { frictional, viscoelastic, hertz_mindlin, cohesive };
// Which bodies may touch: all, or only those that a bond joins.
enum class ContactsBetween { all, bonded };
// What facets that have corners in common do where a sphere touches an edge or a corner of theirs.  once:
// they are one surface, whose contacts do not depend on how it is cut into triangles; each: every facet
// pushes on its own, so that near a seam several do.
enum class SharedEdges { once, each };
// full: every constant in the precision of the run; yade: 4/3 pi of the masses of spheres computed in double,
// the contamination described in the scene `pendulum3`.
enum class MassRule { full, yade };
// How the constants of float are made (every other type makes its own): rounded_once: in double, then
// rounded; stepwise: each operation in float, as a program does that computes its setup in the type of its
// run.
enum class ConstantsRule { rounded_once, stepwise };

struct Material {
  std::string name;
  Expression density = "1000";  // kg/m^3
  Expression young = "1e7";     // Pa
  // N/m of a body's own spring in linear contacts, not young * radius (p_wave and rayleigh then say nothing).
  std::optional<Expression> stiffness;
  Expression poisson = "0";         //
  Expression friction_angle = "0";  // degrees
  // viscoelastic
  Expression collision_time = "1e-3";       // s
  Expression restitution_normal = "1";      // (0, 1]
  Expression restitution_tangential = "1";  // (0, 1]
  // cohesive; a bond without `cohesion` never breaks
  std::optional<Expression> cohesion;          // Pa: breaks when it pulls more than cohesion * min(r)^2
  Expression adhesion = "0";                   // Pa: shear limit at no normal force over min(r)^2
  std::optional<Expression> moment_stiffness;  // alpha of kr = ktw = r1 r2 ks alpha; none: no moments
};

struct SphereSpec {
  Triple position{"0", "0", "0"};          // m
  Triple velocity{"0", "0", "0"};          // m/s
  Triple angular_velocity{"0", "0", "0"};  // rad/s
  Expression radius;                       // m
  std::string material;
  bool fixed = false;
  std::optional<Expression> mass;  // kg; else density * volume
  std::optional<Triple> inertia;   // kg m^2, principal moments: the body is aspherical
};

// Fixed bodies.
struct FacetSpec {
  std::array<Triple, 3> vertices;
  std::string material;
};
struct WallSpec {
  int axis = 1;               // 0, 1, 2: the plane's normal
  Expression position = "0";  // m along it
  Expression velocity = "0";  // m/s along it, prescribed
  std::string material;
};
struct BoxSpec {
  Triple centre{"0", "0", "0"};
  Triple half_size;
  Triple axis{"0", "0", "1"};  // rotated about it (any length)
  Expression angle = "0";      // degrees
  std::string material;
};

// hexagonal_ball: closest packing clipped by a ball; grid: rows, columns and layers, with optional jitter;
// facet_box: closed box of 12 facets.
enum class GeneratorKind { hexagonal_ball, grid, facet_box };

struct Generator {
  GeneratorKind kind{};
  std::string material;
  Expression radius;                        // hexagonal_ball, grid
  Expression gap = "0";                     // hexagonal_ball, between neighbours
  Expression ball_radius;                   // hexagonal_ball
  Triple corner{"0", "0", "0"};             // hexagonal_ball, grid: of the first lattice point
  std::array<int, 3> counts{1, 1, 1};       // grid
  Triple spacing{"0", "0", "0"};            // grid
  Expression jitter = "0";                  // grid: each centre moves by up to this along each axis (m)
  Expression radius_spread = "0";           // grid: radii on radius (1 - spread, 1 + spread)
  int seed = 1;                             // grid
  int fixed_layers = 0;                     // grid: so many first layers along x are fixed
  Triple centre{"0", "0", "0"}, half_size;  // facet_box
};

struct Bond {
  int first = 0, second = 0;
};

struct Scene {
  std::string name;
  std::string title;
  std::vector<std::pair<std::string, Expression>> constants;  // each may use those before it
  std::vector<Material> materials;
  std::vector<SphereSpec> spheres;    // the bodies' numbers run in this order:
  std::vector<Generator> generators;  // spheres, generators, facets, boxes, walls
  std::vector<FacetSpec> facets;
  std::vector<BoxSpec> boxes;
  std::vector<WallSpec> walls;
  std::vector<Bond> bonds;
  std::optional<Expression>
      bond_reach;  // spheres nearer than this times the sum of radii are bonded at the start

  ContactLaw law = ContactLaw::frictional;
  ContactsBetween between = ContactsBetween::all;
  SharedEdges shared_edges = SharedEdges::once;
  MassRule mass_rule = MassRule::full;
  ConstantsRule constants_rule = ConstantsRule::rounded_once;

  Expression dt;                    // s
  Expression until;                 // s
  Triple gravity{"0", "0", "0"};    // m/s^2
  Expression damping = "0";         // lambda
  std::optional<Expression> sweep;  // m, Verlet distance; else from the smallest radius
  std::vector<std::string> record;  // quantities a run reports: "energy", "positions", "orientation", ...
  Expression record_every;          // s; empty: at the end only

  [[nodiscard]] bool records(std::string_view what) const {
    for (const std::string& r : record) {
      if (r == what) return true;
    }
    return false;
  }
};

}  // namespace ulpgate::scenes
