// FunctionTable<Real>: a batch evaluator for every function, instantiated in one translation unit per type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/functions/function_info.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

// Evaluates `count` points: args holds count * arity values, results count * parts.  threw[i] is set to 1
// where point i threw, its results are then unspecified; entries are never cleared.
template <RealType Real>
using BatchFunction = void (*)(const Real* args, Real* results, std::uint8_t* threw, std::size_t count);

// Indexed by FunctionId; a copy may have entries replaced, which is how the mutation tests plant defects.
template <RealType Real>
using FunctionTable = std::vector<BatchFunction<Real>>;

// The table of the functions as they are.
template <RealType Real>
[[nodiscard]] const FunctionTable<Real>& function_table();

}  // namespace ulpgate
