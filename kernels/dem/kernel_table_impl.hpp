// Definition of kernel_table<Real>(); included only by the one translation unit of each type.
#pragma once

#include "kernels/dem/kernel_bodies.hpp"
#include "kernels/dem/kernel_table.hpp"

namespace ulpgate::dem {

namespace detail {

template <KernelId Id, RealType Real>
void evaluate_batch(const Real* in, Real* out, std::uint8_t* threw, std::size_t count) {
  const auto in_size = static_cast<std::size_t>(info_of(Id).input_size);
  const auto out_size = static_cast<std::size_t>(info_of(Id).output_size);
  for (std::size_t i = 0; i < count; ++i) {
    try {
      StateReader<Real> reader(in + i * in_size);
      ResultWriter<Real> writer(out + i * out_size);
      KernelBody<Id, Real>::evaluate(reader, writer);
    } catch (...) {
      // Whatever it threw, the state has no result; the harness counts it as a mismatch.
      threw[i] = 1;
    }
  }
}

}  // namespace detail

template <RealType Real>
const KernelTable<Real>& kernel_table() {
  static const KernelTable<Real> table = {
#define KERNEL(name, in, out) &detail::evaluate_batch<KernelId::name, Real>,
#include "kernels/dem/kernels.def"
#undef KERNEL
  };
  return table;
}

}  // namespace ulpgate::dem
