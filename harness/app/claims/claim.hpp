// Claim: one function of a library, what is claimed of it, and what was found.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/foreign/implementations.hpp"
#include "harness/app/reading/json_fields.hpp"
#include "harness/core/verdict/verdict.hpp"
#include "harness/foreign/properties.hpp"

namespace ulpgate::app {

struct ClaimOptions {
  std::string out;
  std::uint64_t samples = 20000;
  std::uint64_t evaluations = 100000;  // of the search
  std::uint64_t seed = 1;
  unsigned threads = 0;
  bool exhaustive = false;
  bool overwrite = false;
};

struct ClaimFound {
  std::string implementation;
  std::uint64_t arguments = 0;
  double largest_ulp = -1;
  std::string where;              // "uniform", "search", "exhaustive", "domain"
  std::vector<std::string> args;  // of the largest, hexadecimal
  // Outcomes that are no number of ULP: name, how many, the arguments of the first, and the ULP that it comes
  // to all the same: a zero for one of the smallest numbers may be within a claim, and results that depend on
  // the neighbours of a lane are no error of this size or that.
  struct Mismatch {
    std::string outcome;
    std::uint64_t count;
    std::vector<std::string> args;
    double error_ulp = std::numeric_limits<double>::infinity();
  };
  std::vector<Mismatch> mismatches;
  std::vector<PropertyFinding> properties;
  std::optional<SampledResults> sample;
  double seconds = 0;
  std::string program;  // file that shows the violation; empty: none

  // Claims are stated in a few digits: what exceeds one by less than this share is no violation of it.
  static constexpr double negligible = 0x1p-20;
  // The first of the mismatches that is a violation; null where none is.
  [[nodiscard]] const Mismatch* first_beyond(double claimed_ulp) const {
    for (const auto& m : mismatches)
      if (m.error_ulp > claimed_ulp * (1 + negligible)) return &m;
    return nullptr;
  }
  [[nodiscard]] bool violates(double claimed_ulp) const {
    return first_beyond(claimed_ulp) != nullptr || largest_ulp > claimed_ulp * (1 + negligible);
  }
};

// Strata, search and, where asked for, all floats; what a directory of an earlier run holds is not done
// again.
[[nodiscard]] ClaimFound hold_to_claim(const ListedFunction& row, const BoundFunction& bound,
                                       const ClaimOptions& o);

// Where the records of a row lie, below the directory of all.
[[nodiscard]] std::string directory_of(const ListedFunction& row);

// A C program that calls the function at these arguments, prints what it gives beside the exact value, and
// exits with 1 where the error is above the claim; empty where its signature is none that such a program can
// call.
[[nodiscard]] std::string program_text(const ListedFunction& row, const BoundFunction& bound,
                                       const std::vector<std::string>& args);

// Arguments in hexadecimal as values of the type.
[[nodiscard]] std::vector<MpfrValue> values_of(const RealDescriptor& type,
                                               const std::vector<std::string>& args);

// The exact value of a real function at arguments in hexadecimal, to the bits of the type's reference.
// Whoever does arithmetic with it stays in a WideExponentRange: it may lie beyond the range of the type.
[[nodiscard]] MpfrValue exact_at(const FunctionInfo& f, const RealDescriptor& type,
                                 const std::vector<std::string>& args);

// The lists that are built in.
struct BuiltinClaims {
  std::string name;
  std::string text;
};
[[nodiscard]] const std::vector<BuiltinClaims>& builtin_claims();

}  // namespace ulpgate::app
