// KernelTable<Real>: a batch evaluator for every DEM kernel, instantiated in one translation unit per type.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/dem/table/kernel_info.hpp"

namespace ulpgate::dem {

// Evaluates `count` states: in holds count * input_components values (the fields of the row in order), out
// count * output_components.  threw[i] is set to 1 where state i threw; entries are never cleared.
template <RealType Real>
using BatchKernel = void (*)(const Real* in, Real* out, std::uint8_t* threw, std::size_t count);

// Indexed by KernelId; a copy may have entries replaced by kernels with planted defects.
template <RealType Real>
using KernelTable = std::vector<BatchKernel<Real>>;

template <RealType Real>
[[nodiscard]] const KernelTable<Real>& kernel_table();

}  // namespace ulpgate::dem
