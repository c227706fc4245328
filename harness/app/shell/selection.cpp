// Names on the command line.
#include "harness/app/shell/selection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/nearest_name.hpp"

namespace ulpgate::app {

namespace {

std::vector<std::string> names_of(SubjectKind kind) {
  std::vector<std::string> names;
  for (const auto* subject : subjects_of(kind)) names.push_back(subject->name);
  return names;
}

std::vector<std::string> type_tokens() {
  std::vector<std::string> tokens;
  for (const auto& type : all_types()) tokens.push_back(type.token);
  return tokens;
}

// What the option and the list of a kind are called.
std::string_view word_of(SubjectKind kind) {
  return kind == SubjectKind::function ? "function" : "kernel";
}

// Keeps the items of `all` that `chosen` names, in the order of `all`.
std::vector<std::string> in_order(std::vector<std::string> all, const std::vector<std::string>& chosen) {
  std::erase_if(all,
                [&](const std::string& item) { return std::ranges::find(chosen, item) == chosen.end(); });
  return all;
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    if (end > start) parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

void unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  const std::string listed = what == "stratum" ? "strata" : what + "s";
  constexpr std::array<std::string_view, 6> lists{"functions", "types",  "strata",
                                                  "kernels",   "scenes", "integrators"};
  std::string all = fmt::format("one of {}", fmt::join(known, ", "));
  if (std::ranges::find(lists, listed) != lists.end())
    all = fmt::format("`ulpgate list {}` shows all", listed);
  if (what == "case") all = "`ulpgate stress --list` shows all";
  throw Failure(Standing::bad_input,
                fmt::format("unknown {} '{}'{} ({})", what, name, nearest_hint(name, known), all));
}

const FunctionInfo& function_or_fail(const std::string& name) {
  const auto f = find_function(name);
  if (!f) unknown_name("function", name, names_of(SubjectKind::function));
  return info_of(f->id);
}

const RealDescriptor& type_or_fail(const std::string& token) {
  const RealDescriptor* type = find_type(token);
  if (type == nullptr) unknown_name("type", token, type_tokens());
  return *type;
}

const Subject& subject_or_fail(const std::string& name, const std::string& token) {
  const RealDescriptor& type = type_or_fail(token);
  const Subject* subject = find_subject(name, type.token);
  if (subject != nullptr) return *subject;
  auto known = names_of(SubjectKind::function);
  for (auto& kernel : names_of(SubjectKind::kernel)) known.push_back(std::move(kernel));
  unknown_name("function", name, known);
}

std::vector<std::string> select_subjects(SubjectKind kind, const std::string& text) {
  const auto known = subjects_of(kind);
  std::vector<std::string> chosen;
  for (const auto& name : split(text, ',')) {
    const std::size_t before = chosen.size();
    for (const auto* subject : known) {
      if (name == "all" || name == subject->subject_class || name == subject->name)
        chosen.push_back(subject->name);
    }
    if (chosen.size() == before) unknown_name(std::string(word_of(kind)), name, names_of(kind));
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, fmt::format("--{0}s names no {0}", word_of(kind)));
  return in_order(names_of(kind), chosen);
}

std::vector<std::string> select_types(const std::string& text) {
  std::vector<std::string> chosen = text == "all" ? type_tokens() : split(text, ',');
  for (const auto& token : chosen) static_cast<void>(type_or_fail(token));
  if (chosen.empty()) throw Failure(Standing::bad_input, "--types names no type");
  return in_order(type_tokens(), chosen);
}

std::vector<Stratum> select_strata(SubjectKind kind, const std::string& text) {
  std::vector<std::string> known;
  for (const auto& s : strata_of(kind)) known.emplace_back(s.name);
  std::vector<std::string> chosen = known;
  std::erase_if(chosen, [](const std::string& name) { return is_asked_for_by_name(*find_stratum(name)); });
  if (text != "all") chosen = split(text, ',');
  for (const auto& name : chosen) {
    if (!find_stratum(name, strata_of(kind))) unknown_name("stratum", name, known);
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, "--strata names no stratum");
  std::vector<Stratum> strata;
  for (const auto& name : in_order(known, chosen)) strata.push_back(*find_stratum(name));
  return strata;
}

namespace {

// Likewise for the stratum `narrow`, whose rows only functions with a cheap reference have.
void keep_narrow(const std::string& functions, const std::string& types, PlanRequest& request) {
  if (std::ranges::find(request.strata, Stratum::narrow) == request.strata.end()) return;
  const auto has_rows = [](const std::string& name, const std::string& token) {
    const Subject* subject = find_subject(name, token);
    return subject != nullptr && subject->narrow_arguments() > 0;
  };
  const auto type_has = [&](const std::string& token) {
    return std::ranges::any_of(request.subjects, [&](const auto& name) { return has_rows(name, token); });
  };
  const auto function_has = [&](const std::string& name) {
    return std::ranges::any_of(request.types, [&](const auto& token) { return has_rows(name, token); });
  };
  for (const auto& token : request.types) {
    if (types == "all" || type_has(token)) continue;
    throw Failure(Standing::bad_input,
                  fmt::format("--strata narrow takes float and double: {} has no cheap reference", token));
  }
  for (const auto& name : split(functions, ',')) {
    if (!find_function(name) || function_has(name)) continue;
    throw Failure(Standing::bad_input,
                  fmt::format("--strata narrow takes real functions: {} has no cheap reference", name));
  }
  if (request.strata.size() > 1) return;
  std::erase_if(request.types, [&](const std::string& token) { return !type_has(token); });
  std::erase_if(request.subjects, [&](const std::string& name) { return !function_has(name); });
}

}  // namespace

void keep_rows_of_named_strata(const std::string& functions, const std::string& types, PlanRequest& request) {
  keep_narrow(functions, types, request);
  if (std::ranges::find(request.strata, Stratum::exhaustive) == request.strata.end()) return;
  if (types != "all") {
    for (const auto& token : request.types) {
      if (token == "float") continue;
      throw Failure(Standing::bad_input,
                    fmt::format("--strata exhaustive takes float alone: {} has too many values", token));
    }
  }
  for (const auto& name : split(functions, ',')) {
    const auto f = find_function(name);
    const Subject* subject = find_subject(name, "float");
    if (!f || (subject != nullptr && subject->can_exhaust())) continue;
    throw Failure(Standing::bad_input,
                  fmt::format("--strata exhaustive takes real functions of one argument: {} is {}", name,
                              f->function_class == FunctionClass::real
                                  ? fmt::format("one of {} arguments", f->arity)
                                  : fmt::format("a {} function", name_of(f->function_class))));
  }
  if (request.strata.size() > 1) return;
  std::erase_if(request.types, [](const std::string& token) { return token != "float"; });
  std::erase_if(request.subjects, [](const std::string& name) {
    const Subject* subject = find_subject(name, "float");
    return subject == nullptr || !subject->can_exhaust();
  });
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const auto slash = text.find('/');
  const char* end = text.data() + text.size();
  const char* middle = text.data() + std::min(slash, text.size());
  const auto a = std::from_chars(text.data(), middle, shard.index);
  const auto b = slash == std::string::npos ? std::from_chars_result{end, std::errc::invalid_argument}
                                            : std::from_chars(middle + 1, end, shard.count);
  if (a.ec != std::errc() || a.ptr != middle || b.ec != std::errc() || b.ptr != end ||
      shard.index >= shard.count || shard.count > most_shards) {
    throw Failure(
        Standing::bad_input,
        fmt::format("--shard '{}': want i/n with 0 <= i < n <= {}, such as 0/3", text, most_shards));
  }
  return shard;
}

}  // namespace ulpgate::app
