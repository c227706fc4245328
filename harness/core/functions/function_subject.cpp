// A math function as a subject: what the tables say of it.
#include "harness/core/functions/function_subject.hpp"

namespace ulpgate {

SubjectInfo subject_info(const FunctionInfo& f, RealFamily family) {
  SubjectInfo info{SubjectKind::function,
                   std::string(f.name),
                   std::string(name_of(f.function_class)),
                   implementation_of(f, family),
                   {},
                   {},
                   claimed_ulp(f, family)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i)
    info.inputs.push_back({"", 1, std::string(name_of(f.domain[i]))});
  for (int part = 0; part < f.parts; ++part) info.parts.push_back({std::string(part_name(f, part)), 1});
  return info;
}

}  // namespace ulpgate
