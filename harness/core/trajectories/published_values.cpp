// published_values() and agreement_with_truth().
#include "harness/core/trajectories/published_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <stdexcept>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

constexpr const char* test_set =
    "F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, release 2.4 (2008)";
constexpr const char* orbit_book =
    "E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.0";
constexpr mpfr_prec_t bits = 400;

void add(std::vector<PublishedValue>& list, const char* problem, const char* end, const char* source,
         std::initializer_list<const char*> values) {
  std::size_t component = 0;
  for (const char* value : values) list.push_back({problem, end, component++, value, source});
}

MpfrValue number_of(const std::string& text) {
  MpfrValue x(bits);
  mpfr_strtofr(x.get(), text.c_str(), nullptr, 10, MPFR_RNDN);
  return x;
}

// Significant digits and the decimal exponent of the last one.
struct Print {
  int digits = 0;
  long last_place = 0;
};
Print print_of(const std::string& text) {
  Print p;
  const std::size_t e = text.find_first_of("eE");
  bool point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') {
      point = true;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      if (p.digits > 0 || c != '0') ++p.digits;
      if (point) --p.last_place;
    }
  }
  if (e != std::string::npos) p.last_place += std::strtol(text.c_str() + e + 1, nullptr, 10);
  return p;
}

MpfrValue largest_of(std::span<const TrueValue> truth) {
  MpfrValue largest(bits);
  mpfr_set_zero(largest, 1);
  for (const TrueValue& t : truth) {
    const MpfrValue x = number_of(t.value);
    if (mpfr_cmpabs(x, largest) > 0) mpfr_abs(largest, x, MPFR_RNDN);
  }
  return largest;
}

}  // namespace

// Chemakzo's sixth component, 115.83 y1 y4, is none of its ordinary differential equations.
const std::vector<PublishedValue>& published_values() {
  static const std::vector<PublishedValue> list = [] {
    std::vector<PublishedValue> v;
    add(v, "robertson", "1e11", test_set,
        {"0.2083340149701255e-7", "0.8333360770334713e-13", "0.9999999791665050"});
    add(v, "van_der_pol", "2", test_set, {"1.706167732170483", "-0.8928097010247975"});
    add(v, "hires", "321.8122", test_set,
        {"0.7371312573325668e-3", "0.1442485726316185e-3", "0.5888729740967575e-4", "0.1175651343283149e-2",
         "0.2386356198831331e-2", "0.6238968252742796e-2", "0.2849998395185769e-2", "0.2850001604814231e-2"});
    add(v, "oregonator", "360", test_set, {"1.000814870318523", "1228.178521549917", "132.0554942846706"});
    add(v, "e5", "1e13", test_set,
        {"0.1152903278711829e-290", "8.867655517642120e-23", "8.854814626268838e-23", "0"});
    add(v, "chemakzo", "180", test_set,
        {"0.1150794920661702", "0.1203831471567715e-2", "0.1611562887407974", "0.3656156421249283e-3",
         "0.1708010885264404e-1"});
    add(v, "pleiades", "3", test_set,
        {"0.3706139143970502",    "0.3237284092057233e1",  "-0.3222559032418324e1", "0.6597091455775310",
         "0.3425581707156584",    "0.1562172101400631e1",  "-0.7003092922212495",   "-0.3943437585517392e1",
         "-0.3271380973972550e1", "0.5225081843456543e1",  "-0.2590612434977470e1", "0.1198213693392275e1",
         "-0.2429682344935824",   "0.1091449240428980e1",  "0.3417003806314313e1",  "0.1354584501625501e1",
         "-0.2590065597810775e1", "0.2025053734714242e1",  "-0.1155815100160448e1", "-0.8072988170223021",
         "0.5952396354208710",    "-0.3741244961234010e1", "0.3773459685750630",    "0.9386858869551073",
         "0.3667922227200571",    "-0.3474046353808490",   "0.2344915448180937e1",  "-0.1947020434263292e1"});
    add(v, "arenstorf", "17.0652165601579625588917206249", orbit_book,
        {"0.994", "0", "0", "-2.00158510637908252240537862224"});
    return v;
  }();
  return list;
}

PublishedAgreement agreement_with_truth(const PublishedValue& published, std::span<const TrueValue> truth) {
  if (published.component >= truth.size())
    throw std::out_of_range(published.problem + " has no component " +
                            std::to_string(published.component + 1));
  const TrueValue& is = truth[published.component];
  const MpfrValue exact = number_of(is.value);
  MpfrValue off = number_of(published.value);
  mpfr_sub(off, off, exact, MPFR_RNDN);
  mpfr_abs(off, off, MPFR_RNDN);
  const Print print = print_of(published.value);
  PublishedAgreement a;
  a.printed = print.digits;
  a.compared = std::min(print.digits, static_cast<int>(is.digits));
  MpfrValue allowed(bits);
  if (print.digits == 0) {
    allowed = largest_of(truth);
    mpfr_mul_d(allowed, allowed, 1e-20, MPFR_RNDN);
  } else {
    // A unit of the last place in print, and of the last one of the truth.
    MpfrValue place(bits);
    mpfr_set_si(allowed, 10, MPFR_RNDN);
    mpfr_pow_si(place, allowed, 1 - static_cast<long>(is.digits), MPFR_RNDN);
    mpfr_mul(place, place, exact, MPFR_RNDN);
    mpfr_abs(place, place, MPFR_RNDN);
    mpfr_pow_si(allowed, allowed, print.last_place, MPFR_RNDN);
    mpfr_max(allowed, allowed, place, MPFR_RNDN);
    mpfr_div(place, off, exact, MPFR_RNDN);
    mpfr_abs(place, place, MPFR_RNDN);
    mpfr_log10(place, place, MPFR_RNDN);
    a.digits = std::clamp(-mpfr_get_d(place, MPFR_RNDN), 0.0, static_cast<double>(a.compared));
  }
  if (mpfr_cmp(off, allowed) <= 0) {
    a.standing = PublishedStanding::to_the_last;
    a.digits = a.compared;
  } else if (2 * a.digits > a.compared) {
    a.standing = PublishedStanding::in_part;
  }
  return a;
}

}  // namespace ulpgate
