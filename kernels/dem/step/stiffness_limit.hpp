// The largest step of a scene: by the stiffnesses and dashpots of its contacts, and by the waves that run
// through its spheres.
#pragma once

#include <algorithm>
#include <string>

#include "kernels/dem/formulas/critical_step.hpp"
#include "kernels/dem/formulas/sphere_body.hpp"
#include "kernels/dem/step/simulation_state.hpp"

namespace ulpgate::dem {

namespace detail {

// What the contacts of one body resist: sums over them of a n n^T + b (1 - n n^T) and of b' (1 - n n^T) r^2,
// for translation and rotation, and what of it is the same in every direction.
template <RealType Real>
struct Resistance {
  SymmetricMatrix<Real> translation, rotation;
  Real bending{0};

  void add(const Real& along, const Real& across, const Real& radius, const Vec3<Real>& n) {
    translation.add_spring(along, across, n);
    rotation.add_spring(Real(0), across * radius * radius, n);
  }
  // A bound over all directions, per mass and inertia; 0 for an inertia of 0: it does not turn.
  [[nodiscard]] Real rate(const Real& mass, const Real& inertia) const {
    const Real moved = eigenvalue_bound(translation) / mass;
    return inertia > 0 ? Real(moved + (eigenvalue_bound(rotation) + bending) / inertia) : moved;
  }
};

template <RealType Real>
[[nodiscard]] Real least_inertia(const Bodies<Real>& b, std::size_t body) {
  for (std::size_t k = 0; k < b.aspherical.size(); ++k) {
    if (b.aspherical[k] != static_cast<std::int32_t>(body)) continue;
    const Vec3<Real>& i = b.principal_inertia[k];
    return std::min<Real>(i.x, std::min<Real>(i.y, i.z));
  }
  return b.inertia[body];
}

}  // namespace detail

// 0.8 of a step (s) at which the leapfrog with dashpot forces of half a step before is stable, whatever the
// orientation of the scene: what a contact stores and loses is at most twice the sum of what the motions of
// its two bodies alone would, so that no frequency exceeds that of k = 2 K_i/m_i with dashpots c = 2 C_i/m_i
// of one body i, K_i and C_i bounds of the norms of its 6 by 6 blocks (the sum of those of translation
// and of rotation), and 4 - 2 dt c - dt^2 k > 0 suffices.  Contacts of Hertz and Mindlin count with the slope
// of their force.  From the touching contacts; 0 where none limits the step.
template <RealType Real>
[[nodiscard]] Real stiffness_limit(const SimulationState<Real>& s) {
  using std::sqrt;
  const Bodies<Real>& b = s.bodies;
  const Contacts<Real>& c = s.contacts;
  const bool hertz = s.law == scenes::ContactLaw::hertz_mindlin;
  std::vector<detail::Resistance<Real>> springs(b.size());
  std::vector<detail::Resistance<Real>> dashpots(b.size());
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.touching[p] == 0) continue;
    auto i = static_cast<std::size_t>(c.pair[p].first);
    auto j = static_cast<std::size_t>(c.pair[p].second);
    if (s.parts.flats && b.shape[j] != Shape::sphere) std::swap(i, j);
    const bool flat = s.parts.flats && b.shape[i] != Shape::sphere;
    const ContactGeometry<Real> g =
        flat ? flat_contact(b, s.flats, i, j)
             : sphere_sphere(b.position[i], b.radius[i], b.position[j], b.radius[j]);
    const Real root = hertz && g.overlap > 0 ? Real(sqrt(g.overlap)) : Real(hertz ? 0 : 1);
    const Real kn = hertz ? Real(3 * c.kn[p] * root / 2) : c.kn[p];
    const Real ks = s.parts.shear ? Real(c.ks[p] * root) : Real(0);
    for (const std::size_t body : {i, j}) {
      springs[body].add(kn, ks, b.radius[body], g.normal);
      if (s.parts.viscosity) dashpots[body].add(c.cn[p], c.cs[p], b.radius[body], g.normal);
      if (s.parts.moments && c.bond[p] >= 0)
        springs[body].bending += s.bonds[static_cast<std::size_t>(c.bond[p])].bending_stiffness;
    }
  }
  Real least{0};
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.fixed[i] != 0) continue;
    const Real inertia = s.parts.rotation ? detail::least_inertia(b, i) : Real(0);
    const Real k = 2 * springs[i].rate(b.mass[i], inertia);
    const Real c2 = 2 * dashpots[i].rate(b.mass[i], inertia);
    if (!(k > 0) && !(c2 > 0)) continue;
    const Real step = 16 / (c2 + sqrt(c2 * c2 + 4 * k)) / 5;
    if (least == 0 || step < least) least = step;
  }
  return least;
}

enum class Wave { pressure, rayleigh };

// Why waves say nothing of the contacts of `s`, whose materials have these names; empty where they do: the
// springs of contacts then follow from the Young's moduli that waves know.
template <RealType Real>
[[nodiscard]] std::string wave_refusal(const SimulationState<Real>& s,
                                       const std::vector<std::string>& materials) {
  if (s.law == scenes::ContactLaw::viscoelastic)
    return "waves know elastic materials alone, and the law 'viscoelastic' makes its springs from "
           "collision_time";
  // Hertz's law has no use for a stiffness that is given.
  if (s.law == scenes::ContactLaw::hertz_mindlin) return "";
  for (const std::int32_t m : s.bodies.material) {
    const auto k = static_cast<std::size_t>(m);
    if (s.materials[k].elastic.stiffness != 0)
      return "waves know elastic materials alone, and the stiffness of the material '" + materials[k] +
             "' is given";
  }
  return "";
}

// The shortest time (s) of a wave over the spheres, each of the density that its mass makes; 0 where there is
// none.
template <RealType Real>
[[nodiscard]] Real wave_limit(const SimulationState<Real>& s, Wave wave) {
  const Bodies<Real>& b = s.bodies;
  Real least{0};
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.shape[i] != Shape::sphere) continue;
    const Elastic<Real>& m = s.materials[static_cast<std::size_t>(b.material[i])].elastic;
    const Real density = sphere_density(b.mass[i], b.radius[i]);
    const Real step = wave == Wave::pressure ? p_wave_step(b.radius[i], density, m.young)
                                             : rayleigh_step(b.radius[i], density, m.young, m.poisson);
    if (least == 0 || step < least) least = step;
  }
  return least;
}

}  // namespace ulpgate::dem
