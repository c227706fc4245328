// Interior angles of a chain of bodies.
#include "harness/core/scenes/chain_angles.hpp"

#include <array>
#include <cmath>

namespace ulpgate {

namespace {

constexpr mpfr_prec_t guard_bits = 64;
using Vector = std::array<MpfrValue, 3>;

Vector vector_of(mpfr_prec_t bits) {
  return {MpfrValue(bits), MpfrValue(bits), MpfrValue(bits)};
}

// From body `from` to body `to`.
Vector direction(const dem::DemEngine& engine, std::size_t from, std::size_t to, mpfr_prec_t bits) {
  Vector d = vector_of(bits);
  MpfrValue a;
  MpfrValue b;
  for (std::size_t c = 0; c < 3; ++c) {
    engine.exact(dem::BodyQuantity::position, from, c, a);
    engine.exact(dem::BodyQuantity::position, to, c, b);
    mpfr_sub(d[c], b, a, MPFR_RNDN);
  }
  return d;
}

// out := x u - y v.
void cross_component(mpfr_ptr out, mpfr_srcptr x, mpfr_srcptr u, mpfr_srcptr y, mpfr_srcptr v) {
  mpfr_fmms(out, x, u, y, v, MPFR_RNDN);
}

}  // namespace

std::vector<double> chain_angles(const dem::DemEngine& engine) {
  const auto at = [&](std::size_t body) {
    std::array<double, 3> x{};
    for (std::size_t c = 0; c < 3; ++c) x[c] = engine.approximate(dem::BodyQuantity::position, body, c);
    return x;
  };
  std::vector<double> angles;
  for (std::size_t i = 1; i + 1 < engine.bodies(); ++i) {
    const auto before = at(i - 1);
    const auto here = at(i);
    const auto after = at(i + 1);
    std::array<double, 3> a{};
    std::array<double, 3> b{};
    for (std::size_t c = 0; c < 3; ++c) {
      a[c] = before[c] - here[c];
      b[c] = after[c] - here[c];
    }
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double cross =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    // atan2 keeps its digits where the chain is straight, an arc cosine does not.
    angles.push_back(std::atan2(cross, dot));
  }
  return angles;
}

double product_of(const std::vector<double>& angles) {
  double product = 1;
  for (const double angle : angles) product *= angle;
  return product;
}

ExactChainAngles exact_chain_angles(const dem::DemEngine& engine, mpfr_prec_t bits) {
  const mpfr_prec_t wide = bits + guard_bits;
  ExactChainAngles out{{}, MpfrValue(wide)};
  mpfr_set_ui(out.product, 1, MPFR_RNDN);
  for (std::size_t i = 1; i + 1 < engine.bodies(); ++i) {
    const Vector a = direction(engine, i, i - 1, wide);
    const Vector b = direction(engine, i, i + 1, wide);
    MpfrValue dot(wide);
    MpfrValue part(wide);
    mpfr_mul(dot, a[0], b[0], MPFR_RNDN);
    for (std::size_t c = 1; c < 3; ++c) mpfr_fma(dot, a[c], b[c], dot, MPFR_RNDN);
    MpfrValue cross(wide);
    mpfr_set_zero(cross, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      const std::size_t e = (c + 2) % 3;
      cross_component(part, a[d], b[e], a[e], b[d]);
      mpfr_hypot(cross, cross, part, MPFR_RNDN);
    }
    out.angles.emplace_back(wide);
    mpfr_atan2(out.angles.back(), cross, dot, MPFR_RNDN);
    mpfr_mul(out.product, out.product, out.angles.back(), MPFR_RNDN);
  }
  return out;
}

}  // namespace ulpgate
