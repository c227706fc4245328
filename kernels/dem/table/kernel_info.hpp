// KernelInfo: name, inputs and output quantities of every DEM kernel, from kernels.def.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/dem/table/kernel_state.hpp"

namespace ulpgate::dem {

enum class KernelId {
#define KERNEL(name, inputs, outputs, ...) name,
#include "kernels/dem/table/kernels.def"
};

struct Quantity {
  std::string_view name;
  std::size_t components;
};

struct KernelInfo {
  KernelId id;
  std::string_view name;
  std::vector<Field> inputs;
  std::vector<Quantity> outputs;

  // Numbers per state and per result.
  [[nodiscard]] std::size_t input_components() const;
  [[nodiscard]] std::size_t output_components() const;
};

[[nodiscard]] std::span<const KernelInfo> all_kernels();
[[nodiscard]] const KernelInfo& info_of(KernelId id);
[[nodiscard]] const KernelInfo* find_kernel(std::string_view name);  // nullptr where there is none

}  // namespace ulpgate::dem
