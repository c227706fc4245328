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
  const MpfrValue y = exact_at(f, type, args);
  MpfrValue nearest(type.reference_bits);
  mpfr_set(nearest.get(), y, MPFR_RNDN);
  round_to_format(nearest, type.format);
  MpfrValue rest(type.reference_bits);
  mpfr_sub(rest.get(), y, nearest, MPFR_RNDN);
  MpfrValue ulp(53);
  const long exponent =
      mpfr_regular_p(y.get()) != 0 ? std::max<long>(mpfr_get_exp(y.get()) - 1, type.format.exponent_min) : 0;
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
  const bool number = mpfr_number_p(y.get()) != 0;
  // Beyond the largest number nothing is left to say of the rest.
  const bool has_rest = number && mpfr_number_p(short_rest.get()) != 0;
  return {literal(nearest), has_rest ? literal(short_rest) + "L" : "0", literal(ulp) + "L",
          text("%.40Rg", y)};
}

std::string c_type(char element) {
  return element == 'f' ? "float" : element == 'd' ? "double" : element == 'l' ? "long double" : "";
}

std::string literal_of(const std::string& hex, char element) {
  if (hex.find("nan") != std::string::npos) return "NAN";
  if (hex.find("inf") != std::string::npos) return hex[0] == '-' ? "-INFINITY" : "INFINITY";
  return hex + (element == 'f' ? "f" : element == 'l' ? "L" : "");
}

struct Call {
  std::string declaration;
  std::string text;  // lines that define `got`
};

// `which` of two results, where there are two.
Call call_of(const std::string& name, const ulpgate_signature& s, const std::string& type,
             const std::vector<std::string>& literals, int which) {
  const std::string vector = fmt::format("v{}{}", s.lanes, s.element);
  const int bytes = s.lanes * (s.element == 'f' ? 4 : 8);
  const std::string operand = s.lanes == 1 ? type : vector;
  Call c;
  if (s.lanes > 1)
    c.declaration = fmt::format("typedef {} {} __attribute__((vector_size({})));\n", type, vector, bytes);
  std::vector<std::string> kinds(literals.size(), operand);
  std::vector<std::string> operands = literals;
  // The same argument in every lane.
  for (auto& o : operands)
    if (s.lanes > 1)
      o = fmt::format("({}){{{}}}", vector,
                      fmt::join(std::vector<std::string>(static_cast<std::size_t>(s.lanes), o), ", "));
  std::string returned = operand;
  std::string before;
  std::string result;
  switch (s.shape) {
    case ulpgate_shape_sign:
      before = "  int sign;\n";
      kinds.emplace_back("int*");
      operands.emplace_back("&sign");
      break;
    case ulpgate_shape_pair:
      returned = "void";
      before = fmt::format("  {} results[2][{}];\n", type, s.lanes);
      result = fmt::format("results[{}][0]", which);
      for (const auto* of : {"results[0]", "results[1]"}) {
        kinds.push_back(type + "*");
        operands.emplace_back(of);
      }
      break;
    case ulpgate_shape_lane_pair: {
      // A pointer for each lane: vectors of 64-bit addresses, as wide as the argument, as many as that takes.
      returned = "void";
      const int per = bytes / 8;
      c.declaration +=
          fmt::format("typedef unsigned long addresses __attribute__((vector_size({})));\n", bytes);
      before = fmt::format("  {} results[2][{}];\n  addresses at[2][{}];\n", type, s.lanes, s.lanes / per);
      before += fmt::format(
          "  for (int i = 0; i < 2; ++i)\n"
          "    for (int k = 0; k < {}; ++k) at[i][k / {}][k % {}] = (unsigned long)&results[i][k];\n",
          s.lanes, per, per);
      result = fmt::format("results[{}][0]", which);
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < s.lanes / per; ++k) {
          kinds.emplace_back("addresses");
          operands.push_back(fmt::format("at[{}][{}]", i, k));
        }
      break;
    }
    default:
      break;
  }
  c.declaration += fmt::format("{} {}({});\n", returned, name, fmt::join(kinds, ", "));
  const std::string call = fmt::format("{}({})", name, fmt::join(operands, ", "));
  if (result.empty()) result = s.lanes > 1 ? call + "[0]" : call;
  c.text = before;
  if (returned == "void") c.text += fmt::format("  {};\n", call);
  c.text += fmt::format("  const {} got = {};\n", type, result);
  return c;
}

}  // namespace

std::string program_text(const ListedFunction& row, const BoundFunction& bound,
                         const std::vector<std::string>& args) {
  const std::string type = c_type(bound.element);
  ulpgate_signature s;
  if (type.empty() || ulpgate_parse_signature(bound.facts.signature.c_str(), &s) == 0) return "";
  if (s.shape == ulpgate_shape_arrays || s.integer != 0) return "";
  const FunctionInfo& f = function_or_fail(row.function);
  const Parts exact = parts_of(f, bound.subject->type(), args);
  const std::string& library = row.spec.library;
  const std::string link = library.find('/') != std::string::npos ? library
                           : library == "-"                       ? ""
                                                                  : "-l:" + library;
  std::vector<std::string> literals;
  literals.reserve(args.size());
  for (const auto& a : args) literals.push_back(literal_of(a, bound.element));
  const Call c = call_of(row.spec.symbol, s, type, literals, row.function == "cos" ? 1 : 0);
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
      fmt::arg("name", row.spec.symbol), fmt::arg("path", bound.facts.path),
      fmt::arg("id", bound.facts.build_id.empty() ? "" : " (build-id " + bound.facts.build_id + ")"),
      fmt::arg("function", row.function), fmt::arg("claim", claim),
      fmt::arg("floor_words", row.claim.floor > 0 ? fmt::format(" or {}", floor) : ""),
      fmt::arg("flags", flags), fmt::arg("link", link), fmt::arg("decimal", exact.decimal),
      fmt::arg("declaration", c.declaration), fmt::arg("call", c.text), fmt::arg("type", type),
      fmt::arg("nearest", exact.nearest), fmt::arg("rest", exact.rest), fmt::arg("ulp", exact.ulp),
      fmt::arg("shown", fmt::format("{}", fmt::join(args, ", "))), fmt::arg("floor", floor));
}

}  // namespace ulpgate::app
