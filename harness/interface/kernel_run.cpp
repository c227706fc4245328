// Kernels judged.
#include "harness/interface/kernel_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "harness/interface/wide_value.hpp"
#include "reference/text/text.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate::kernel_test {

namespace {

struct FreeWide {
  void operator()(ulpgate_wide* x) const { ulpgate_wide_free(x); }
};
using WideValue = std::unique_ptr<ulpgate_wide, FreeWide>;

// Calls `with` for a number of the kernel's type.
template <class With>
auto in_type(const ulpgate_kernel& kernel, With with) {
  const std::string type = kernel.type;
  if (type == "float") return with(0.0F);
  if (type == "double") return with(0.0);
  if (type == "long double") return with(0.0L);
  throw std::invalid_argument(
      fmt::format("kernel {}: '{}' is no type that kernels are tested in", kernel.name, type));
}

class WideKernel {
 public:
  explicit WideKernel(const ulpgate_kernel& kernel)
      : kernel_(kernel),
        before_(ulpgate_wide_precision()),
        bits_(in_type(kernel, [](auto x) { return long{4} * std::numeric_limits<decltype(x)>::digits; })) {
    ulpgate_wide_set_precision(bits_);
    for (int i = 0; i < kernel.arguments; ++i) args_.emplace_back(ulpgate_wide_new());
    for (int i = 0; i < kernel.results; ++i) results_.emplace_back(ulpgate_wide_new());
    for (const auto& a : args_) arg_pointers_.push_back(a.get());
    for (const auto& r : results_) result_pointers_.push_back(r.get());
  }
  WideKernel(const WideKernel&) = delete;
  WideKernel& operator=(const WideKernel&) = delete;
  ~WideKernel() { ulpgate_wide_set_precision(before_); }

  void evaluate(const long double* x) {
    for (std::size_t i = 0; i < args_.size(); ++i) mpfr_set_ld(args_[i]->value, x[i], MPFR_RNDN);
    kernel_.evaluate_wide(arg_pointers_.data(), result_pointers_.data());
  }
  [[nodiscard]] mpfr_srcptr result(std::size_t part) const { return results_[part]->value; }

  // Sum over the arguments of |x_j df/dx_j| / |f|, by central differences of a third of the bits.
  [[nodiscard]] double condition(const long double* x, std::size_t part) {
    evaluate(x);
    MpfrValue value(bits_);
    mpfr_set(value.get(), result(part), MPFR_RNDN);
    if (mpfr_regular_p(value.get()) == 0) return std::numeric_limits<double>::quiet_NaN();
    MpfrValue sum(bits_);
    mpfr_set_zero(sum.get(), 1);
    MpfrValue up(bits_);
    MpfrValue step(bits_);
    for (std::size_t j = 0; j < args_.size(); ++j) {
      if (x[j] == 0) continue;
      evaluate_beside(x, j, 1);
      mpfr_set(up.get(), result(part), MPFR_RNDN);
      evaluate_beside(x, j, -1);
      mpfr_sub(up.get(), up.get(), result(part), MPFR_RNDN);
      mpfr_div(up.get(), up.get(), value.get(), MPFR_RNDN);
      mpfr_abs(up.get(), up.get(), MPFR_RNDN);
      mpfr_add(sum.get(), sum.get(), up.get(), MPFR_RNDN);
    }
    mpfr_mul_2si(sum.get(), sum.get(), bits_ / 3 - 1, MPFR_RNDN);
    return mpfr_get_d(sum.get(), MPFR_RNDN);
  }

 private:
  // With argument j off by a relative 2^-(bits/3).
  void evaluate_beside(const long double* x, std::size_t j, int sign) {
    for (std::size_t i = 0; i < args_.size(); ++i) mpfr_set_ld(args_[i]->value, x[i], MPFR_RNDN);
    MpfrValue change(bits_);
    mpfr_mul_2si(change.get(), args_[j]->value, -(bits_ / 3), MPFR_RNDN);
    if (sign > 0) {
      mpfr_add(args_[j]->value, args_[j]->value, change.get(), MPFR_RNDN);
    } else {
      mpfr_sub(args_[j]->value, args_[j]->value, change.get(), MPFR_RNDN);
    }
    kernel_.evaluate_wide(arg_pointers_.data(), result_pointers_.data());
  }

  const ulpgate_kernel& kernel_;
  long before_;
  long bits_;
  std::vector<WideValue> args_;
  std::vector<WideValue> results_;
  std::vector<const ulpgate_wide*> arg_pointers_;
  std::vector<ulpgate_wide*> result_pointers_;
};

// The kernel's own results at points, in its own type and with its own options.
template <class Real>
std::vector<Real> results_of(const ulpgate_kernel& kernel, const std::vector<long double>& values) {
  const std::size_t count = values.size() / static_cast<std::size_t>(kernel.arguments);
  std::vector<Real> args(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) args[i] = static_cast<Real>(values[i]);
  std::vector<Real> results(count * static_cast<std::size_t>(kernel.results));
  kernel.evaluate(args.data(), results.data(), count);
  return results;
}

template <class Real>
Judgement judged(const Real& got, mpfr_srcptr exact) {
  MpfrValue g(std::numeric_limits<Real>::digits);
  to_mpfr(g.get(), got);
  return judge(g, exact, float_format<Real>());
}

template <class Real>
std::vector<PartRow> rows_of(const ulpgate_kernel& kernel, const Points& points) {
  const auto arguments = static_cast<std::size_t>(kernel.arguments);
  const auto parts = static_cast<std::size_t>(kernel.results);
  const std::vector<Real> results = results_of<Real>(kernel, points.values);
  WideKernel wide(kernel);
  std::vector<PartRow> rows;
  rows.reserve(parts);
  for (int part = 0; part < kernel.results; ++part)
    rows.push_back({points.stratum, part, 0, -1, 0, {}, {}, {}});
  for (std::size_t i = 0; i * arguments < points.values.size(); ++i) {
    const long double* x = &points.values[i * arguments];
    wide.evaluate(x);
    for (std::size_t part = 0; part < parts; ++part) {
      PartRow& row = rows[part];
      const Judgement j = judged(results[i * parts + part], wide.result(part));
      ++row.samples;
      if (j.outcome != Outcome::finite) {
        const std::string name(name_of(j.outcome));
        if (row.mismatches[name]++ == 0) row.mismatch_args[name].assign(x, x + arguments);
        continue;
      }
      row.mean_ulp += j.error.value;
      if (j.error.value <= row.largest_ulp) continue;
      row.largest_ulp = j.error.value;
      row.args.assign(x, x + arguments);
    }
  }
  for (auto& row : rows) {
    std::uint64_t judged_samples = row.samples;
    for (const auto& [name, n] : row.mismatches) judged_samples -= n;
    row.mean_ulp /= static_cast<double>(std::max<std::uint64_t>(1, judged_samples));
  }
  return rows;
}

}  // namespace

std::vector<PartRow> run_kernel(const ulpgate_kernel& kernel, std::uint64_t samples, std::uint64_t seed,
                                bool extremes) {
  std::vector<PartRow> all;
  for (const auto& points : points_of(kernel, samples, seed, extremes)) {
    const auto rows = in_type(kernel, [&](auto x) { return rows_of<decltype(x)>(kernel, points); });
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

std::vector<PartAt> look_at(const ulpgate_kernel& kernel, const std::vector<long double>& args) {
  return in_type(kernel, [&](auto zero) {
    using Real = decltype(zero);
    const std::vector<Real> results = results_of<Real>(kernel, args);
    WideKernel wide(kernel);
    std::vector<PartAt> parts;
    for (std::size_t part = 0; part < results.size(); ++part) {
      wide.evaluate(args.data());
      const Judgement j = judged(results[part], wide.result(part));
      PartAt at{to_hexfloat(results[part]), to_decimal(results[part]), to_decimal(wide.result(part), 25), j,
                0};
      at.condition = wide.condition(args.data(), part);
      parts.push_back(std::move(at));
    }
    return parts;
  });
}

std::string hexfloat(const ulpgate_kernel& kernel, long double x) {
  return in_type(kernel, [&](auto zero) { return to_hexfloat(static_cast<decltype(zero)>(x)); });
}

long double parse_number(const ulpgate_kernel& kernel, const std::string& text) {
  MpfrValue v(in_type(kernel, [](auto zero) { return long{std::numeric_limits<decltype(zero)>::digits}; }));
  char* end = nullptr;
  mpfr_strtofr(v.get(), text.c_str(), &end, 0, MPFR_RNDN);
  if (text.empty() || *end != '\0') throw std::invalid_argument(fmt::format("'{}' is no number", text));
  return in_type(kernel,
                 [&](auto zero) { return static_cast<long double>(from_mpfr<decltype(zero)>(v.get())); });
}

}  // namespace ulpgate::kernel_test
