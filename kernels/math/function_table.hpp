// FunctionTable<Real>: a batch evaluator for every function, instantiated in one translation unit per type.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/functions/function_info.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

// Code of which only the bytes of its arguments and results are known here: a function in another process.
class BatchCode {
 public:
  BatchCode() = default;
  BatchCode(const BatchCode&) = delete;
  BatchCode& operator=(const BatchCode&) = delete;
  virtual ~BatchCode() = default;
  // As BatchFunction, of a type that it was made for; called by several threads at once.
  virtual void evaluate(const void* args, void* results, std::uint8_t* threw, std::size_t count) const = 0;
  // So many times each, with no checks of any kind: for timing.  Returns the seconds that it took.
  virtual double call(const void* args, void* results, std::size_t count, int rounds) const = 0;
  // Points that are best evaluated together.
  [[nodiscard]] virtual std::size_t batch() const = 0;
};

// Evaluates `count` points: args holds count * arity values, results count * parts.  threw[i] is set to 1
// where point i threw, by other code to what its caller knows; its results are then unspecified, and entries
// are never cleared.  As cheap to copy as the function that it holds.
template <RealType Real>
class BatchFunction {
 public:
  using Plain = void (*)(const Real* args, Real* results, std::uint8_t* threw, std::size_t count);

  // NOLINTNEXTLINE(google-explicit-constructor): a function is one
  template <std::convertible_to<Plain> F>
  BatchFunction(F plain) : plain_(plain) {}
  explicit BatchFunction(const BatchCode& code) : code_(&code) {}

  void operator()(const Real* args, Real* results, std::uint8_t* threw, std::size_t count) const {
    if (code_ != nullptr) return code_->evaluate(args, results, threw, count);
    plain_(args, results, threw, count);
  }
  // Null for a function of this program.
  [[nodiscard]] const BatchCode* code() const { return code_; }

 private:
  Plain plain_ = nullptr;
  const BatchCode* code_ = nullptr;
};

// Indexed by FunctionId; a copy may have entries replaced, which is how the mutation tests plant defects.
template <RealType Real>
using FunctionTable = std::vector<BatchFunction<Real>>;

// The table of the functions as they are.
template <RealType Real>
[[nodiscard]] const FunctionTable<Real>& function_table();

}  // namespace ulpgate
