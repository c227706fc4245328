// Definition of function_table<Real>(); included only by the one translation unit of each type.
#pragma once

#include "kernels/math/function_table.hpp"
#include "kernels/math/functions.hpp"

namespace ulpgate {

namespace detail {

template <FunctionId Id, RealType Real>
void evaluate_batch(const Real* args, Real* results, std::uint8_t* threw, std::size_t count) {
  const auto arity = static_cast<std::size_t>(info_of(Id).arity);
  const auto parts = static_cast<std::size_t>(info_of(Id).parts);
  for (std::size_t i = 0; i < count; ++i) {
    try {
      math::Function<Id, Real>::evaluate(args + i * arity, results + i * parts);
    } catch (...) {
      // Whatever it threw, the point has no result; the harness counts it as a mismatch.
      threw[i] = 1;
    }
  }
}

}  // namespace detail

template <RealType Real>
const FunctionTable<Real>& function_table() {
  static const FunctionTable<Real> table = {
#define ULPGATE_ENTRY(name) &detail::evaluate_batch<FunctionId::name, Real>,
#define REAL1(name, d0, hard, oracle) ULPGATE_ENTRY(name)
#define REAL2(name, d0, d1, hard, oracle) ULPGATE_ENTRY(name)
#define REAL3(name, d0, d1, d2, hard, oracle) ULPGATE_ENTRY(name)
#define OPER2(name, op, d0, d1, hard, oracle) ULPGATE_ENTRY(name)
#define COMPLEX1(token, callee, oracle) ULPGATE_ENTRY(token)
#define COMPLEX2(token, callee, oracle) ULPGATE_ENTRY(token)
#define COMPLEX_REAL(token, callee, oracle) ULPGATE_ENTRY(token)
#define POLAR(token, callee) ULPGATE_ENTRY(token)
#define SPECIAL1(token, d0) ULPGATE_ENTRY(token)
#define SPECIAL2(token, d0, d1, hard) ULPGATE_ENTRY(token)
#define SPECIAL3(token, d0, d1, d2) ULPGATE_ENTRY(token)
#define SPECIAL4_COMPLEX(token, d0, d1, d2, d3) ULPGATE_ENTRY(token)
#include "reference/functions/functions.def"
#undef ULPGATE_ENTRY
  };
  return table;
}

}  // namespace ulpgate
