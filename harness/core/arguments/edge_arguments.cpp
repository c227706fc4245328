// Edges: the arguments at the ends and corners of every domain.
#include <utility>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/arguments/argument_values.hpp"

namespace ulpgate {

namespace {

bool is_index(DomainMap m) {
  return m == DomainMap::UINT || m == DomainMap::INT;
}

// Infinities, zeros and NaN in C99 annex G leave signs open, so complex functions and special functions get
// finite edges; for an index argument the small and the largest degrees.
std::vector<MpfrValue> edge_values(const FunctionInfo& f, std::size_t argument, const FloatFormat& format) {
  ArgumentValues out(format);
  const DomainMap map = f.domain[argument];
  if (is_index(map)) {
    for (const long i : {0L, 1L, 2L, 7L, 100L}) out.add_scaled(i, 0);
    if (map == DomainMap::INT) {
      for (const long i : {-1L, -2L, -100L}) out.add_scaled(i, 0);
    }
    return std::move(out.values);
  }
  const bool angle = map == DomainMap::MODPI || map == DomainMap::MOD2PI;
  const bool few = f.arity > 2 || f.function_class != FunctionClass::real;
  const ExponentRange range = sampled_exponents(f, format);
  MpfrValue v(format.precision);
  mpfr_set_zero(v, 1);
  out.add(v);
  if (!angle) {
    mpfr_set_zero(v, -1);
    out.add(v);
  }
  if (f.function_class == FunctionClass::real) {
    mpfr_set_inf(v, 1);
    out.add(v);
    mpfr_set_inf(v, -1);
    out.add(v);
    mpfr_set_nan(v);
    out.add(v);
  }
  if (angle) {
    for (const long exponent : {range.least, -60L, -1L, 0L, 1L}) out.add_scaled(1, exponent);
    mpfr_const_pi(v, MPFR_RNDN);
    if (map == DomainMap::MODPI) mpfr_div_2ui(v, v, 1, MPFR_RNDN);
    out.add(v);
    return std::move(out.values);
  }
  if (f.arity == 4) {
    // Fewer still: the product grows with the fourth power.
    for (const auto& [m, exponent] :
         {std::pair{1L, 0L}, {-1L, 0L}, {1L, 1L}, {-3L, -1L}, {1L, range.least}, {1L, range.greatest}}) {
      out.add_scaled(m, exponent);
    }
    return std::move(out.values);
  }
  if (few) {
    for (const long exponent : {range.least, -1L, 0L, 1L, range.greatest}) {
      if (f.function_class == FunctionClass::special && exponent == range.greatest) continue;
      out.add_scaled(1, exponent);
      out.add_scaled(-1, exponent);
    }
    out.add_scaled(3, -1);
    out.add_scaled(-3, -1);
    return std::move(out.values);
  }
  out.add_around_scaled(1, range.least, 0);
  if (format.subnormals) out.add_around_scaled(1, format.exponent_min, 1);
  mpfr_set_ui_2exp(v, 1, range.greatest, MPFR_RNDN);
  out.add_around(v, 1);
  mpfr_set_inf(v, 1);
  step_in_format(v, -1, format);
  if (format.exponent_max == range.greatest) out.add_around(v, 0);
  out.add_around_scaled(1, 0, 2);
  const long integers = f.arity == 1 ? 40 : 3;
  for (long i = 2; i <= integers; ++i) out.add_around_scaled(i, 0, f.arity == 1 ? 1 : 0);
  for (long i = 1; i <= 2 * integers; i += 2) out.add_around_scaled(i, -1, f.arity == 1 ? 1 : 0);
  if (f.arity == 1) {
    // The poles of tgamma go on to where it underflows; largest odd integers and halves end the exact
    // integers.
    for (const long i : {170L, 171L, 172L, 177L, 184L, 1755L, 1756L}) out.add_around_scaled(i, 0, 2);
    out.add_around_scaled(1, format.precision - 1, 2);
    out.add_around_scaled(1, format.precision, 2);
  }
  return std::move(out.values);
}

}  // namespace

ExponentRange sampled_exponents(const FunctionInfo& f, const FloatFormat& format) {
  const bool complex = f.function_class == FunctionClass::complex;
  return {std::max(format.exponent_least(), complex ? -1074L : -16494L),
          std::min(format.exponent_max, complex ? 1023L : 16383L)};
}

ArgumentList edge_arguments(const FunctionInfo& f, const FloatFormat& format) {
  std::vector<std::vector<MpfrValue>> axes;
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i)
    axes.push_back(edge_values(f, i, format));
  ArgumentList list;
  std::vector<std::size_t> index(axes.size(), 0);
  while (true) {
    std::vector<MpfrValue> point;
    for (std::size_t i = 0; i < axes.size(); ++i) point.push_back(copy(axes[i][index[i]]));
    list.push_back(std::move(point));
    std::size_t i = 0;
    while (i < axes.size() && ++index[i] == axes[i].size()) index[i++] = 0;
    if (i == axes.size()) return list;
  }
}

}  // namespace ulpgate
