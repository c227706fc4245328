// The registry: what is looked up in the generated lists.
#include "harness/core/subject/registry.hpp"

#include <algorithm>
#include <map>

namespace ulpgate {

std::span<const StratumInfo> strata_of(SubjectKind kind) {
  if (kind == SubjectKind::function) return function_strata;
  return kernel_strata;
}

std::size_t SubjectInfo::input_components() const {
  std::size_t sum = 0;
  for (const auto& input : inputs) sum += input.components;
  return sum;
}

namespace {

SubjectList& replacements() {
  static SubjectList list;
  return list;
}

}  // namespace

void replace_subject(std::unique_ptr<Subject> subject) {
  replacements().push_back(std::move(subject));
}

const Subject* find_subject(std::string_view name, std::string_view type_token) {
  static const auto by_name = [] {
    std::map<std::pair<std::string_view, std::string_view>, const Subject*> map;
    for (const auto& s : all_subjects()) map[{s->name(), s->type().token}] = s.get();
    return map;
  }();
  // The last that was put in its place.
  const auto& replaced = replacements();
  const auto newest = std::find_if(replaced.rbegin(), replaced.rend(), [&](const auto& s) {
    return s->name() == name && s->type().token == type_token;
  });
  if (newest != replaced.rend()) return newest->get();
  const auto it = by_name.find({name, type_token});
  return it == by_name.end() ? nullptr : it->second;
}

std::vector<const SubjectInfo*> subjects_of(SubjectKind kind) {
  std::vector<const SubjectInfo*> found;
  for (const auto& s : all_subjects()) {
    if (&s->type() == &all_types().front() && s->info().kind == kind) found.push_back(&s->info());
  }
  return found;
}

const RealDescriptor* find_type(std::string_view token) {
  const auto it = std::ranges::find(all_types(), token, &RealDescriptor::token);
  return it == all_types().end() ? nullptr : &*it;
}

}  // namespace ulpgate
