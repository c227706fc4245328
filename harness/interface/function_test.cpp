// ulpgate_test_function(): a function of the caller's over the strata of functions.
#include <fmt/format.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "harness/core/arguments/sampling.hpp"
#include "harness/interface/include/ulpgate/ulpgate.h"
#include "harness/interface/last_error.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/text/text.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

namespace {

using Json = nlohmann::ordered_json;

// The code that the caller's evaluator returned.
struct Ended {
  int code;
};

template <class Real>
class FunctionTest {
 public:
  FunctionTest(const FunctionInfo& f, std::string type, ulpgate_batch evaluate, void* user)
      : function_(f),
        type_(std::move(type)),
        evaluate_(evaluate),
        user_(user),
        arity_(static_cast<std::size_t>(f.arity)) {}

  Json run(std::uint64_t samples, std::uint64_t seed) {
    Json rows = Json::array();
    const ArgumentList edges = edge_arguments(function_, float_format<Real>());
    const ArgumentList hard = hard_arguments(function_, float_format<Real>());
    for (const StratumSource& source : {StratumSource{Stratum::uniform, seed, samples - samples / 2, nullptr},
                                        {Stratum::stratified, seed, samples / 2, nullptr},
                                        {Stratum::binades, seed, samples / 2, nullptr},
                                        {Stratum::edges, seed, edges.size(), &edges},
                                        {Stratum::hard, seed, hard.size(), &hard}}) {
      if (source.count > 0) rows.push_back(row_of(source, seed));
    }
    return rows;
  }

 private:
  Json row_of(const StratumSource& source, std::uint64_t seed) {
    const auto count = static_cast<std::size_t>(source.count);
    std::vector<Real> args(count * arity_);
    std::vector<Real> results(count);
    Arguments<Real>(function_, source).make_all(0, count, args.data());
    if (const int code = evaluate_(user_, args.data(), results.data(), count); code != 0) throw Ended{code};
    double largest = -1;
    double sum = 0;
    std::size_t judged = 0;
    std::uint64_t correctly_rounded = 0;
    std::size_t at = 0;
    std::map<std::string, std::uint64_t> mismatch;
    Json first = Json::object();
    MpfrValue got(std::numeric_limits<Real>::digits);
    for (std::size_t i = 0; i < count; ++i) {
      const MpfrValue exact = exact_at(&args[i * arity_]);
      to_mpfr(got.get(), results[i]);
      const Judgement j = judge(got, exact, float_format<Real>());
      if (j.outcome != Outcome::finite) {
        const std::string name(name_of(j.outcome));
        if (mismatch[name]++ == 0) first[name] = words_of(&args[i * arity_]);
        continue;
      }
      ++judged;
      sum += j.error.value;
      correctly_rounded += j.correctly_rounded ? 1 : 0;
      if (j.error.value <= largest) continue;
      largest = j.error.value;
      at = i;
    }
    const bool any = judged > 0;
    return {{"function", std::string(function_.name)},
            {"type", type_},
            {"stratum", std::string(name_of(source.stratum))},
            {"samples", count},
            {"seed", seed},
            {"max_ulp", any ? Json(largest) : Json(nullptr)},
            {"mean_ulp", any ? Json(sum / static_cast<double>(judged)) : Json(nullptr)},
            {"argmax", any ? words_of(&args[at * arity_]) : Json::array()},
            {"got", any ? to_hexfloat(results[at]) : ""},
            {"exact", any ? to_decimal(exact_at(&args[at * arity_]).get(), 30) : ""},
            {"correctly_rounded", correctly_rounded},
            {"mismatch", mismatch},
            {"mismatch_first", first}};
  }

  [[nodiscard]] MpfrValue exact_at(const Real* args) const {
    std::vector<MpfrValue> x;
    for (std::size_t j = 0; j < arity_; ++j) {
      x.emplace_back(std::numeric_limits<Real>::digits);
      to_mpfr(x.back().get(), args[j]);
    }
    std::vector<MpfrValue> value;
    value.emplace_back(4 * std::numeric_limits<Real>::digits);
    exact_value(function_, x, value);
    return std::move(value.front());
  }
  [[nodiscard]] Json words_of(const Real* args) const {
    Json words = Json::array();
    for (std::size_t j = 0; j < arity_; ++j) words.push_back(to_hexfloat(args[j]));
    return words;
  }

  const FunctionInfo& function_;
  std::string type_;
  ulpgate_batch evaluate_;
  void* user_;
  std::size_t arity_;
};

Json test_function(const char* function, const std::string& type, ulpgate_batch evaluate, void* user,
                   std::uint64_t samples, std::uint64_t seed) {
  const auto found = find_function(function);
  if (!found || found->parts != 1)
    throw std::invalid_argument(fmt::format("'{}' is no function of one real result", function));
  if (samples < 2 || samples > 100000000)
    throw std::invalid_argument(fmt::format("{} samples: want 2 to 1e8", samples));
  const FunctionInfo& f = info_of(found->id);
  if (type == "float") return FunctionTest<float>(f, type, evaluate, user).run(samples, seed);
  if (type == "double") return FunctionTest<double>(f, type, evaluate, user).run(samples, seed);
  if (type == "long double") return FunctionTest<long double>(f, type, evaluate, user).run(samples, seed);
  throw std::invalid_argument(fmt::format("'{}' is not float, double or long double", type));
}

}  // namespace
}  // namespace ulpgate

extern "C" {

int ulpgate_test_function(const char* function, const char* type, ulpgate_batch evaluate, void* user,
                          uint64_t samples, uint64_t seed, char** json) {
  int ended = 0;
  const int code = ulpgate::guarded([&] {
    try {
      const std::string text = ulpgate::test_function(function, type, evaluate, user, samples, seed).dump();
      *json = new char[text.size() + 1];
      std::memcpy(*json, text.c_str(), text.size() + 1);
    } catch (const ulpgate::Ended& e) {
      ended = e.code;
      throw std::runtime_error("the evaluator ended the test");
    }
  });
  return ended != 0 ? ended : code;
}

void ulpgate_free(char* text) {
  delete[] text;
}

}  // extern "C"
