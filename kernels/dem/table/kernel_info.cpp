// KernelInfo: the rows.
#include "kernels/dem/table/kernel_info.hpp"

#include <algorithm>

namespace ulpgate::dem {

std::size_t KernelInfo::input_components() const {
  std::size_t n = 0;
  for (const auto f : inputs) n += components_of(f);
  return n;
}

std::size_t KernelInfo::output_components() const {
  std::size_t n = 0;
  for (const auto& q : outputs) n += q.components;
  return n;
}

std::span<const KernelInfo> all_kernels() {
  static const std::vector<KernelInfo> rows = [] {
    using enum Field;
    return std::vector<KernelInfo>{
#define QUANTITY(name, components) \
  Quantity {                       \
#name, components              \
  }
#define INPUTS(...) \
  { __VA_ARGS__ }
#define OUTPUTS(...) \
  { __VA_ARGS__ }
#define KERNEL(name, inputs, outputs, ...) KernelInfo{KernelId::name, #name, inputs, outputs},
#include "kernels/dem/table/kernels.def"
    };
  }();
  return rows;
}

const KernelInfo& info_of(KernelId id) {
  return all_kernels()[static_cast<std::size_t>(id)];
}

const KernelInfo* find_kernel(std::string_view name) {
  const auto rows = all_kernels();
  const auto it = std::ranges::find(rows, name, &KernelInfo::name);
  return it == rows.end() ? nullptr : &*it;
}

}  // namespace ulpgate::dem
