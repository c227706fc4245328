// The code behind a subject that is a function, for those who call it themselves.
#pragma once

#include "harness/core/subject/subject.hpp"
#include "kernels/math/function_table.hpp"

namespace ulpgate {

// `subject` is a function in Real; instantiated in one translation unit per type.
template <RealType Real>
[[nodiscard]] BatchFunction<Real> call_of(const Subject& subject);

}  // namespace ulpgate
