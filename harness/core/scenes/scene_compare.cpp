// Divergence of two simulations, and constants that stop at double's digits.
#include "harness/core/scenes/scene_compare.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reference/text/text.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

namespace {

struct Largest {
  double distance = 0;
  double ulp = 0;
};

Largest largest_difference(const dem::DemEngine& tested, const dem::DemEngine& reference, dem::BodyQuantity q,
                           const FloatFormat& format) {
  Largest largest;
  MpfrValue a;
  MpfrValue b;
  MpfrValue d(64);
  MpfrValue sum(64);
  for (std::size_t body = 0; body < tested.bodies(); ++body) {
    mpfr_set_zero(sum, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      tested.exact(q, body, c, a);
      reference.exact(q, body, c, b);
      // A simulation that has left the numbers is infinitely far from any, and from another that has.
      if (mpfr_number_p(a.get()) == 0 || mpfr_number_p(b.get()) == 0) return {HUGE_VAL, HUGE_VAL};
      largest.ulp = std::max(largest.ulp, ulp_error(a, b, format).value);
      mpfr_sub(d, a, b, MPFR_RNDN);
      mpfr_sqr(d, d, MPFR_RNDN);
      mpfr_add(sum, sum, d, MPFR_RNDN);
    }
    mpfr_sqrt(sum, sum, MPFR_RNDN);
    largest.distance = std::max(largest.distance, mpfr_get_d(sum, MPFR_RNDN));
  }
  return largest;
}

double energy_difference(const dem::DemEngine& tested, const dem::DemEngine& reference) {
  const auto names = tested.energy_names();
  if (std::ranges::find(names, "sum") == names.end()) return 0;
  MpfrValue a;
  MpfrValue b;
  tested.energy_exact("sum", a);
  reference.energy_exact("sum", b);
  MpfrValue d(64);
  mpfr_sub(d, a, b, MPFR_RNDN);
  return mpfr_number_p(d.get()) != 0 ? std::fabs(mpfr_get_d(d, MPFR_RNDN)) : HUGE_VAL;
}

// Bits of the significand from the first 1 to the last.
long significant_bits(mpfr_srcptr x) {
  return mpfr_regular_p(x) ? static_cast<long>(mpfr_min_prec(x)) : 0;
}

}  // namespace

Divergence compare_engines(const dem::DemEngine& tested, const dem::DemEngine& reference,
                           const FloatFormat& format) {
  Divergence d;
  d.step = tested.iteration();
  d.time_s = tested.time_s();
  const Largest position = largest_difference(tested, reference, dem::BodyQuantity::position, format);
  const Largest velocity = largest_difference(tested, reference, dem::BodyQuantity::velocity, format);
  d.position_error_m = position.distance;
  d.position_error_ulp = position.ulp;
  d.velocity_error_m_per_s = velocity.distance;
  d.velocity_error_ulp = velocity.ulp;
  d.energy_error_j = energy_difference(tested, reference);
  const auto mine = tested.contacts();
  const auto theirs = reference.contacts();
  std::ranges::set_difference(mine, theirs, std::back_inserter(d.only_tested));
  std::ranges::set_difference(theirs, mine, std::back_inserter(d.only_reference));
  return d;
}

std::vector<std::uint64_t> comparison_steps(std::uint64_t last) {
  std::vector<std::uint64_t> steps;
  for (std::uint64_t decade = 1; decade <= last; decade *= 10) {
    for (const std::uint64_t m : {1U, 2U, 5U}) {
      if (m * decade <= last) steps.push_back(m * decade);
    }
    if (decade > last / 10) break;
  }
  if (last > 0 && (steps.empty() || steps.back() != last)) steps.push_back(last);
  return steps;
}

std::vector<ShortConstant> short_constants(const dem::DemEngine& wide) {
  constexpr long float_bits = 24;
  constexpr long double_bits = 53;
  std::vector<ShortConstant> found;
  MpfrValue x;
  const auto check = [&](mpfr_srcptr value, const std::string& what) {
    const long bits = significant_bits(value);
    // Up to float's digits a number may well be exact: an integer, a half.
    if (bits > float_bits && bits <= double_bits) found.push_back({what, to_hexfloat(value)});
  };
  const auto check_text = [&](const std::string& hexfloat, const std::string& what) {
    // Every bit of a hexfloat is 4 bits a character at most.
    mpfr_set_prec(x, static_cast<mpfr_prec_t>(4 * hexfloat.size() + 8));
    if (mpfr_set_str(x, hexfloat.c_str(), 0, MPFR_RNDN) == 0) check(x, what);
  };
  for (const auto& pair : wide.contacts()) {
    for (const auto& constant : wide.contact_constants(pair)) {
      check_text(constant, "stiffness or viscosity of contact " + std::to_string(pair.first) + "-" +
                               std::to_string(pair.second));
    }
  }
  for (std::size_t body = 0; body < wide.bodies(); ++body) {
    check_text(wide.mass_text(body), "mass of body " + std::to_string(body));
    for (std::size_t c = 0; c < 3; ++c) {
      wide.exact(dem::BodyQuantity::position, body, c, x);
      check(x, std::string("position ") + "xyz"[c] + " of body " + std::to_string(body));
      wide.exact(dem::BodyQuantity::velocity, body, c, x);
      check(x, std::string("velocity ") + "xyz"[c] + " of body " + std::to_string(body));
    }
  }
  return found;
}

}  // namespace ulpgate
