// The literals of kernels: doubles that became numbers of a kernel's type, which no precision can mend.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/dem/table/kernel_table.hpp"
#include "kernels/scenes/reader/scene.hpp"
#include "reference/types/audited_real.hpp"

namespace ulpgate {

struct HiddenDouble {
  std::string kernel;
  double literal = 0;
};

// Evaluates every kernel of the table in states of every stratum, in a type that watches its constructors.
[[nodiscard]] std::vector<HiddenDouble> audit_kernels(const dem::KernelTable<AuditedReal>& table,
                                                      std::uint64_t states_per_stratum);
// The doubles that become constants of the scene's start state.
[[nodiscard]] std::vector<double> audit_scene(const scenes::Scene& scene);
// The table of the kernels as they are.
[[nodiscard]] const dem::KernelTable<AuditedReal>& audited_kernel_table();

}  // namespace ulpgate
