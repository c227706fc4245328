// The literals of kernels.
#include "harness/core/kernels/kernel_audit.hpp"

#include "harness/core/kernels/kernel_states.hpp"
#include "kernels/dem/table/kernel_table_impl.hpp"
#include "kernels/scenes/reader/assemble.hpp"

namespace ulpgate {

const dem::KernelTable<AuditedReal>& audited_kernel_table() {
  return dem::kernel_table<AuditedReal>();
}

std::vector<HiddenDouble> audit_kernels(const dem::KernelTable<AuditedReal>& table,
                                        std::uint64_t states_per_stratum) {
  using Value = AuditedReal::Value;
  std::vector<HiddenDouble> found;
  for (const auto& kernel : dem::all_kernels()) {
    std::vector<Value> values(kernel.input_components());
    std::vector<AuditedReal> inputs;
    std::vector<AuditedReal> outputs(kernel.output_components());
    (void)AuditedReal::take_found();
    // A literal may stand on a branch: states of every kind are tried.
    for (const auto& stratum : kernel_strata) {
      const States<Value> states(kernel, {stratum.id, 1, states_per_stratum, nullptr});
      for (std::uint64_t k = 0; k < states_per_stratum; ++k) {
        states.make(k, values.data());
        inputs.clear();
        for (const auto& x : values) inputs.emplace_back(x);
        std::uint8_t threw = 0;
        table[static_cast<std::size_t>(kernel.id)](inputs.data(), outputs.data(), &threw, 1);
      }
    }
    for (const double literal : AuditedReal::take_found())
      found.push_back({std::string(kernel.name), literal});
  }
  return found;
}

std::vector<double> audit_scene(const scenes::Scene& scene) {
  (void)AuditedReal::take_found();
  (void)scenes::assemble<AuditedReal>(scene);
  const auto found = AuditedReal::take_found();
  return {found.begin(), found.end()};
}

}  // namespace ulpgate
