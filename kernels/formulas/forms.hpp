// The formulas of forms.def by name, in any Real; included by few translation units, because it instantiates
// them all.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/formulas/cancellation.hpp"
#include "kernels/formulas/complex_division.hpp"
#include "kernels/formulas/geometry.hpp"
#include "kernels/formulas/polynomials.hpp"
#include "kernels/formulas/recurrences.hpp"
#include "kernels/formulas/sums.hpp"

namespace ulpgate::formulas {

template <RealType Real>
using Evaluate = std::vector<Real> (*)(std::span<const Real> x, long n);

template <RealType Real>
struct NamedForm {
  std::string_view problem;
  std::string_view form;
  Evaluate<Real> evaluate;
};

namespace detail {

template <RealType Real>
std::vector<Real> as_values(const Real& v) {
  return {v};
}
template <RealType Real>
std::vector<Real> as_values(std::vector<Real> v) {
  return v;
}

template <RealType Real, class Function>
std::vector<Real> each(std::span<const Real> x, Function f) {
  std::vector<Real> values;
  for (const Real& v : x) values.push_back(f(v));
  return values;
}

}  // namespace detail

// Every row of forms.def, in its order.
template <RealType Real>
[[nodiscard]] std::span<const NamedForm<Real>> named_forms() {
  using detail::each;
  using std::exp;
  using std::expm1;
  using std::log;
  using std::log1p;
  using std::sqrt;
  static const NamedForm<Real> forms[] = {
#define FORM(problem, form, ...)                                           \
  {#problem, #form, [](std::span<const Real> x, [[maybe_unused]] long n) { \
     static_cast<void>(x);                                                 \
     return detail::as_values<Real>(__VA_ARGS__);                          \
   }},
#include "kernels/formulas/forms.def"
#undef FORM
  };
  return forms;
}

// Throws std::invalid_argument, naming both, for a form that forms.def does not have.
template <RealType Real>
[[nodiscard]] Evaluate<Real> find_form(std::string_view problem, std::string_view form) {
  for (const auto& f : named_forms<Real>()) {
    if (f.problem == problem && f.form == form) return f.evaluate;
  }
  throw std::invalid_argument("no formula is called '" + std::string(problem) + "' in the form '" +
                              std::string(form) + "'");
}

}  // namespace ulpgate::formulas
