// program_text(): a violation as a C program.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/claims/claim.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/worker/worker_signature.h"
#include "reference/oracle/oracle.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate::app {

namespace {

struct Parts {
  std::string nearest;  // the number of the type nearest to the exact value, as C writes it
  std::string rest;     // exact value minus that
  std::string ulp;
  std::string decimal;
};

// The exact value as the sum of two numbers of the type.
Parts parts_of(const FunctionInfo& f, const RealDescriptor& type, const std::vector<std::string>& args) {
  const WideExponentRange wide;
  std::vector<MpfrValue> x;
  for (const auto& a : args) {
    x.emplace_back(type.format.precision);
    mpfr_set_str(x.back().get(), a.c_str(), 0, MPFR_RNDN);
  }
  std::vector<MpfrValue> y;
  y.emplace_back(type.reference_bits);
  exact_value(f, x, y);
  MpfrValue nearest(type.reference_bits);
  mpfr_set(nearest.get(), y.front(), MPFR_RNDN);
  round_to_format(nearest, type.format);
  MpfrValue rest(type.reference_bits);
  mpfr_sub(rest.get(), y.front(), nearest, MPFR_RNDN);
  MpfrValue ulp(53);
  const long exponent = mpfr_regular_p(y.front().get()) != 0
                            ? std::max<long>(mpfr_get_exp(y.front().get()) - 1, type.format.exponent_min)
                            : 0;
  mpfr_set_si_2exp(ulp.get(), 1, exponent - type.format.precision + 1, MPFR_RNDN);
  const auto text = [](const char* format, mpfr_srcptr v) {
    char* words = nullptr;
    mpfr_asprintf(&words, format, v);
    std::string s(words);
    mpfr_free_str(words);
    return s;
  };
  const auto literal = [&](mpfr_srcptr v) -> std::string {
    if (mpfr_nan_p(v) != 0) return "NAN";
    if (mpfr_inf_p(v) != 0) return mpfr_sgn(v) < 0 ? "-INFINITY" : "INFINITY";
    return text("%Ra", v);
  };
  MpfrValue short_rest(53);
  mpfr_set(short_rest.get(), rest, MPFR_RNDN);
  const bool number = mpfr_number_p(y.front().get()) != 0;
  // Beyond the largest number nothing is left to say of the rest.
  const bool has_rest = number && mpfr_number_p(short_rest.get()) != 0;
  return {literal(nearest), has_rest ? literal(short_rest) + "L" : "0", literal(ulp) + "L",
          text("%.40Rg", y.front())};
}

std::string c_type(char element) {
  return element == 'f' ? "float" : element == 'd' ? "double" : element == 'l' ? "long double" : "";
}

std::string literal_of(const std::string& hex, char element) {
  if (hex.find("nan") != std::string::npos) return "NAN";
  if (hex.find("inf") != std::string::npos) return hex[0] == '-' ? "-INFINITY" : "INFINITY";
  return hex + (element == 'f' ? "f" : element == 'l' ? "L" : "");
}

}  // namespace

std::string program_text(const ListedFunction& row, const BoundFunction& bound,
                         const std::vector<std::string>& args) {
  const std::string type = c_type(bound.element);
  ulpgate_signature s;
  if (type.empty() || ulpgate_parse_signature(bound.facts.signature.c_str(), &s) == 0) return "";
  if (ulpgate_results_of(&s) == 2 || s.shape == ulpgate_shape_arrays || s.integer != 0) return "";
  const FunctionInfo& f = function_or_fail(row.function);
  const Parts exact = parts_of(f, bound.subject->type(), args);
  const std::string& library = row.spec.library;
  const std::string link = library.find('/') != std::string::npos ? library
                           : library == "-"                       ? ""
                                                                  : "-l:" + library;
  std::vector<std::string> literals;
  literals.reserve(args.size());
  for (const auto& a : args) literals.push_back(literal_of(a, bound.element));
  std::string declaration;
  std::string call;
  const std::string& name = row.spec.symbol;
  if (s.lanes == 1) {
    std::vector<std::string> kinds(args.size(), type);
    if (s.shape == ulpgate_shape_sign) kinds.emplace_back("int*");
    declaration = fmt::format("{} {}({});\n", type, name, fmt::join(kinds, ", "));
    call = fmt::format("  {0}const {1} got = {2}({3}{4});\n",
                       s.shape == ulpgate_shape_sign ? "int sign;\n  " : "", type, name,
                       fmt::join(literals, ", "), s.shape == ulpgate_shape_sign ? ", &sign" : "");
  } else {
    const std::string vector = fmt::format("v{}{}", s.lanes, bound.element);
    std::vector<std::string> kinds(args.size(), vector);
    declaration = fmt::format("typedef {} {} __attribute__((vector_size({})));\n{} {}({});\n", type, vector,
                              s.lanes * (bound.element == 'f' ? 4 : 8), vector, name, fmt::join(kinds, ", "));
    std::vector<std::string> vectors;
    vectors.reserve(literals.size());
    // The same argument in every lane.
    for (const auto& a : literals)
      vectors.push_back(
          fmt::format("({}){{{}}}", vector,
                      fmt::join(std::vector<std::string>(static_cast<std::size_t>(s.lanes), a), ", ")));
    call = fmt::format("  const {} got = {}({})[0];\n", type, name, fmt::join(vectors, ", "));
  }
  const int bits = s.lanes * (bound.element == 'f' ? 32 : 64);
  const std::string flags = s.lanes == 1 ? "" : bits == 256 ? " -mavx2" : bits == 512 ? " -mavx512f" : "";
  // With a point, so that a suffix may follow.
  const std::string claim = fmt::format("{:#.6g}", row.spec.claimed_ulp.value_or(0));
  const std::string floor = row.claim.floor > 0 ? fmt::format("{}", row.claim.floor) : "0.0";
  return fmt::format(
      "/* {name} of {path}{id}: {function} is claimed to err by at most {claim} ULP{floor_words}.\n"
      " *   cc -O0 -fno-builtin{flags} FILE.c {link} -lm && ./a.out\n"
      " * exits with 1 where it errs by more.  The exact value is {decimal}. */\n"
      "#include <math.h>\n"
      "#include <stdio.h>\n\n"
      "{declaration}\n"
      "int main(void) {{\n"
      "{call}"
      "  const {type} nearest = {nearest}; /* the number nearest to the exact value */\n"
      "  const long double rest = {rest}; /* the exact value minus that */\n"
      "  const long double ulp = {ulp};\n"
      "  const long double steps = (long double)got - nearest;\n"
      "  const int numbers = isfinite(got) && isfinite(nearest);\n"
      "  const int other_zero = got == 0 && nearest == 0 && signbit(got) != signbit(nearest);\n"
      "  const long double error = other_zero ? INFINITY\n"
      "                            : numbers ? fabsl(steps - rest)\n"
      "                            : got == nearest || (isnan(got) && isnan(nearest)) ? 0 : INFINITY;\n"
      "  /* The first difference is exact: what the rest adds is not lost in it. */\n"
      "  const long double above = numbers && steps != 0 ? (fabsl(steps) - {claim}L * ulp) - (steps > 0 ? "
      "rest : -rest)\n"
      "                                                  : error - {claim}L * ulp;\n"
      "  printf(\"{name}({shown}) = %La, nearest %La: %.6Lg ULP, %.1Lg above {claim}\\n\", (long "
      "double)got,\n"
      "         (long double)nearest, error / ulp, above / ulp);\n"
      "  return above > 0 && error > {floor}L;\n"
      "}}\n",
      fmt::arg("name", name), fmt::arg("path", bound.facts.path),
      fmt::arg("id", bound.facts.build_id.empty() ? "" : " (build-id " + bound.facts.build_id + ")"),
      fmt::arg("function", row.function), fmt::arg("claim", claim),
      fmt::arg("floor_words", row.claim.floor > 0 ? fmt::format(" or {}", floor) : ""),
      fmt::arg("flags", flags), fmt::arg("link", link), fmt::arg("decimal", exact.decimal),
      fmt::arg("declaration", declaration), fmt::arg("call", call), fmt::arg("type", type),
      fmt::arg("nearest", exact.nearest), fmt::arg("rest", exact.rest), fmt::arg("ulp", exact.ulp),
      fmt::arg("shown", fmt::format("{}", fmt::join(args, ", "))), fmt::arg("floor", floor));
}

}  // namespace ulpgate::app
