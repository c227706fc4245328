// The registry of what is built in: subjects by kind, name and type.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "harness/core/subject/subject.hpp"

namespace ulpgate {

using SubjectList = std::vector<std::unique_ptr<Subject>>;

// In the order of the types, and for each in that of functions.def, then kernels.def.
[[nodiscard]] const SubjectList& all_subjects();
// nullptr where there is none.
[[nodiscard]] const Subject* find_subject(std::string_view name, std::string_view type_token);
// From now on find_subject() gives this one for its name and type; what it gave before stays alive.  Before
// anything is measured, from one thread.
void replace_subject(std::unique_ptr<Subject> subject);
// What a kind holds, in the same order in every type: each name and what it is in the first of the types.
[[nodiscard]] std::vector<const SubjectInfo*> subjects_of(SubjectKind kind);

// The types built in, in the order of ULPGATE_TYPES.
[[nodiscard]] const std::vector<RealDescriptor>& all_types();
[[nodiscard]] const RealDescriptor* find_type(std::string_view token);  // nullptr where not built

}  // namespace ulpgate
