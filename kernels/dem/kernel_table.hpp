// KernelTable<Real>: a batch evaluator for every DEM kernel, instantiated in one translation unit per type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/dem/kernel_info.hpp"
#include "reference/real_types.hpp"

namespace ulpgate::dem {

// Evaluates `count` states: in holds count * input_size numbers, out count * output_size.  threw[i] is set to
// 1 where state i threw, its results are then unspecified; entries are never cleared.
template <RealType Real>
using KernelBatch = void (*)(const Real* in, Real* out, std::uint8_t* threw, std::size_t count);

// Indexed by KernelId; a copy may have entries replaced, which is how the mutation tests plant defects.
template <RealType Real>
using KernelTable = std::vector<KernelBatch<Real>>;

// The table of the kernels as they are.
template <RealType Real>
[[nodiscard]] const KernelTable<Real>& kernel_table();

}  // namespace ulpgate::dem
