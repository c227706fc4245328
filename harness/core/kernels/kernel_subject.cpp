// A DEM kernel as a subject: what its row says of it.
#include "harness/core/kernels/kernel_subject.hpp"

#include "harness/core/records/row_record.hpp"

namespace ulpgate {

SubjectInfo subject_info(const dem::KernelInfo& kernel) {
  // The code is this tree's own: the program's version in context.json tells which.
  SubjectInfo info{
      SubjectKind::kernel, std::string(kernel.name), std::string(kernel_class), "ulpgate", {}, {}, {}};
  for (const auto f : kernel.inputs)
    info.inputs.push_back({std::string(name_of(f)), dem::components_of(f), ""});
  for (const auto& q : kernel.outputs) info.parts.push_back({std::string(q.name), q.components});
  return info;
}

}  // namespace ulpgate
