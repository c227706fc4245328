// Errors of single results and of arrays, and exact values.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "harness/interface/include/ulpgate/ulpgate.h"
#include "harness/interface/last_error.hpp"
#include "reference/condition/condition.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/text/text.hpp"
#include "reference/types/exchange.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

std::string& last_error() {
  thread_local std::string text;
  return text;
}

namespace {

const FunctionInfo& function_named(const char* name) {
  const auto f = find_function(name);
  if (!f || f->parts != 1)
    throw std::invalid_argument(fmt::format("'{}' is no function of one real result", name));
  return info_of(f->id);
}

template <class With>
void in_type(const char* type, With with) {
  const std::string_view name = type;
  if (name == "float") return with(0.0F);
  if (name == "double") return with(0.0);
  if (name == "long double") return with(0.0L);
  throw std::invalid_argument(fmt::format("'{}' is not float, double or long double", type));
}

template <class Real>
Real read(const void* from, std::size_t i) {
  Real x;
  std::memcpy(&x, static_cast<const unsigned char*>(from) + i * sizeof x, sizeof x);
  return x;
}

template <class Real>
std::vector<MpfrValue> arguments_of(const FunctionInfo& f, const void* args, std::size_t point) {
  std::vector<MpfrValue> values;
  const auto arity = static_cast<std::size_t>(f.arity);
  for (std::size_t j = 0; j < arity; ++j) {
    values.emplace_back(std::numeric_limits<Real>::digits);
    to_mpfr(values.back().get(), read<Real>(args, point * arity + j));
  }
  return values;
}

// At four times the bits of Real.
template <class Real>
MpfrValue exact_of(const FunctionInfo& f, std::span<const MpfrValue> args) {
  std::vector<MpfrValue> value;
  value.emplace_back(4 * std::numeric_limits<Real>::digits);
  exact_value(f, args, value);
  return std::move(value.front());
}

template <class Real>
Judgement judged(Real got, mpfr_srcptr exact) {
  MpfrValue g(std::numeric_limits<Real>::digits);
  to_mpfr(g.get(), got);
  return judge(g, exact, float_format<Real>());
}

double error_of(const Judgement& j) {
  return j.outcome == Outcome::finite ? j.error.value : std::numeric_limits<double>::infinity();
}

void put(const std::string& text, char* to, std::size_t size) {
  if (size == 0) return;
  const std::size_t n = std::min(text.size(), size - 1);
  std::memcpy(to, text.data(), n);
  to[n] = '\0';
}

template <class Real>
std::string words_of(Real got, mpfr_srcptr exact, const Judgement& j, double limit) {
  const Real nearest = from_mpfr<Real>(exact);
  std::string text = j.outcome == Outcome::finite
                         ? fmt::format("off by {:.6g} ULP (limit {:g})", j.error.value, limit)
                         : fmt::format("{} (limit {:g} ULP)", name_of(j.outcome), limit);
  text += fmt::format("\n  got      {}  ({})", to_hexfloat(got), to_decimal(got));
  text += fmt::format("\n  nearest  {}  ({})", to_hexfloat(nearest), to_decimal(nearest));
  text += fmt::format("\n  exact    {}", to_decimal(exact, 30));
  return text;
}

}  // namespace
}  // namespace ulpgate

extern "C" {

const char* ulpgate_version(void) {
  return ULPGATE_VERSION;
}

const char* ulpgate_last_error(void) {
  return ulpgate::last_error().c_str();
}

const char* ulpgate_outcome_name(int outcome) {
  if (outcome < 0 || static_cast<std::size_t>(outcome) >= ulpgate::outcome_count) return nullptr;
  return ulpgate::outcome_names[static_cast<std::size_t>(outcome)].data();
}

int ulpgate_arity(const char* function) {
  const auto f = ulpgate::find_function(function);
  return f && f->parts == 1 ? f->arity : 0;
}

int ulpgate_ulp_errors(const char* function, const char* type, const void* args, const void* got,
                       size_t count, double* ulp, unsigned char* outcome) {
  return ulpgate::guarded([&] {
    const auto& f = ulpgate::function_named(function);
    ulpgate::in_type(type, [&](auto zero) {
      using Real = decltype(zero);
      for (std::size_t i = 0; i < count; ++i) {
        const auto x = ulpgate::arguments_of<Real>(f, args, i);
        const auto j = ulpgate::judged(ulpgate::read<Real>(got, i), ulpgate::exact_of<Real>(f, x).get());
        if (ulp != nullptr) ulp[i] = ulpgate::error_of(j);
        if (outcome != nullptr) outcome[i] = static_cast<unsigned char>(j.outcome);
      }
    });
  });
}

int ulpgate_describe_value(const char* type, const void* got, const void* exact, double limit_ulp,
                           double* ulp, char* text, size_t size) {
  return ulpgate::guarded([&] {
    ulpgate::in_type(type, [&](auto zero) {
      using Real = decltype(zero);
      ulpgate::MpfrValue value(std::numeric_limits<Real>::digits);
      ulpgate::to_mpfr(value.get(), ulpgate::read<Real>(exact, 0));
      const Real g = ulpgate::read<Real>(got, 0);
      const auto j = ulpgate::judged(g, value.get());
      if (ulp != nullptr) *ulp = ulpgate::error_of(j);
      ulpgate::put(ulpgate::words_of(g, value.get(), j, limit_ulp), text, size);
    });
  });
}

int ulpgate_describe_call(const char* type, const void* got, const char* function, const void* args,
                          double limit_ulp, double* ulp, char* text, size_t size) {
  return ulpgate::guarded([&] {
    const auto& f = ulpgate::function_named(function);
    ulpgate::in_type(type, [&](auto zero) {
      using Real = decltype(zero);
      const auto x = ulpgate::arguments_of<Real>(f, args, 0);
      const auto exact = ulpgate::exact_of<Real>(f, x);
      const Real g = ulpgate::read<Real>(got, 0);
      const auto j = ulpgate::judged(g, exact.get());
      if (ulp != nullptr) *ulp = ulpgate::error_of(j);
      std::string words = ulpgate::words_of(g, exact.get(), j, limit_ulp);
      std::string call;
      for (int i = 0; i < f.arity; ++i)
        call += (i == 0 ? "" : ", ") +
                ulpgate::to_hexfloat(ulpgate::read<Real>(args, static_cast<std::size_t>(i)));
      words += fmt::format("\n  of       {}({})", function, call);
      const double condition = ulpgate::condition_number(f, x, 0, std::numeric_limits<Real>::digits);
      if (std::isfinite(condition)) {
        words += fmt::format(
            "\n  condition number {:.4g}: half an ULP in the argument{} costs up to {:.4g} ULP here",
            condition, f.arity == 1 ? "" : "s", condition);
      }
      ulpgate::put(words, text, size);
    });
  });
}

int ulpgate_exact(const char* function, const char* const* args, size_t arguments, int digits, char* text,
                  size_t size) {
  return ulpgate::guarded([&] {
    const auto& f = ulpgate::function_named(function);
    if (arguments != static_cast<std::size_t>(f.arity))
      throw std::invalid_argument(
          fmt::format("{} takes {} arguments, found {}", function, f.arity, arguments));
    if (digits < 1 || digits > 100000)
      throw std::invalid_argument(fmt::format("{} digits: want 1 to 100000", digits));
    const auto bits = static_cast<long>(std::ceil(digits * 3.3219280948873626)) + 32;
    std::vector<ulpgate::MpfrValue> x;
    for (std::size_t i = 0; i < arguments; ++i) {
      // As many bits as its digits have, and some: "0.1" is a tenth, not a double.
      x.emplace_back(std::max(bits, static_cast<long>(4 * std::strlen(args[i]) + 64)));
      char* end = nullptr;
      mpfr_strtofr(x.back().get(), args[i], &end, 0, MPFR_RNDN);
      if (args[i][0] == '\0' || *end != '\0')
        throw std::invalid_argument(fmt::format("'{}' is no number", args[i]));
    }
    std::vector<ulpgate::MpfrValue> value;
    value.emplace_back(bits);
    ulpgate::exact_value(f, x, value);
    const std::string words = ulpgate::to_decimal(value.front().get(), digits);
    if (words.size() + 1 > size)
      throw std::invalid_argument(fmt::format("{} digits do not fit into {} bytes", digits, size));
    ulpgate::put(words, text, size);
  });
}

}  // extern "C"
