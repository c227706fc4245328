// Names on the command line.
#include "harness/app/shell/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// Levenshtein distance, for suggestions only.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const auto& f : all_functions()) names.emplace_back(f.name);
  return names;
}

std::vector<std::string> type_tokens() {
  std::vector<std::string> tokens;
  for (const auto& engine : all_engines()) tokens.push_back(engine->descriptor().token);
  return tokens;
}

// Keeps the items of `all` that `chosen` names, in the order of `all`.
template <class Item, class NameOf>
std::vector<Item> in_order(const std::vector<Item>& all, const std::vector<std::string>& chosen,
                           NameOf&& name) {
  std::vector<Item> out;
  for (const auto& item : all) {
    if (std::ranges::find(chosen, name(item)) != chosen.end()) out.push_back(item);
  }
  return out;
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
  const auto best =
      std::ranges::min_element(known, {}, [&](const std::string& k) { return edit_distance(name, k); });
  std::string hint;
  if (best != known.end() && edit_distance(name, *best) <= std::max<std::size_t>(2, name.size() / 3)) {
    hint = fmt::format("; did you mean '{}'?", *best);
  }
  throw Failure(ExitCode::bad_input, fmt::format("unknown {} '{}'{} (`ulpgate list {}` shows all)", what,
                                                 name, hint, what == "stratum" ? "strata" : what + "s"));
}

std::vector<dem::KernelId> select_kernels(const std::string& text) {
  std::vector<dem::KernelId> all;
  std::vector<std::string> names;
  for (const auto& k : dem::all_kernels()) {
    all.push_back(k.id);
    names.emplace_back(k.name);
  }
  if (text == "all") return all;
  const auto chosen = split(text, ',');
  for (const auto& name : chosen) {
    if (dem::find_kernel(name) == nullptr) unknown_name("kernel", name, names);
  }
  return in_order(all, chosen, [](dem::KernelId id) { return std::string(dem::info_of(id).name); });
}

std::vector<StateStratum> select_state_strata(const std::string& text) {
  std::vector<StateStratum> all;
  std::vector<std::string> names;
  for (const auto& s : all_state_strata) {
    all.push_back(s.id);
    names.emplace_back(s.name);
  }
  if (text == "all") return all;
  const auto chosen = split(text, ',');
  for (const auto& name : chosen) {
    if (!find_state_stratum(name)) unknown_name("stratum", name, names);
  }
  return in_order(all, chosen, [](StateStratum s) { return std::string(name_of(s)); });
}

const FunctionInfo& function_or_fail(const std::string& name) {
  const auto f = find_function(name);
  if (!f) unknown_name("function", name, function_names());
  return info_of(f->id);
}

const TypeEngine& type_or_fail(const std::string& token) {
  const TypeEngine* engine = find_engine(token);
  if (engine == nullptr) unknown_name("type", token, type_tokens());
  return *engine;
}

std::vector<FunctionId> select_functions(const std::string& text) {
  std::vector<std::string> chosen;
  for (const auto& name : split(text, ',')) {
    bool is_class = false;
    for (const auto& f : all_functions()) {
      if (name == "all" || name == name_of(f.function_class)) {
        chosen.emplace_back(f.name);
        is_class = true;
      }
    }
    if (!is_class) chosen.emplace_back(function_or_fail(name).name);
  }
  if (chosen.empty()) throw Failure(ExitCode::bad_input, "--functions names no function");
  std::vector<FunctionId> ids;
  for (const auto& f : all_functions()) ids.push_back(f.id);
  return in_order(ids, chosen, [](FunctionId id) { return std::string(info_of(id).name); });
}

std::vector<std::string> select_types(const std::string& text) {
  std::vector<std::string> chosen = text == "all" ? type_tokens() : split(text, ',');
  for (const auto& token : chosen) static_cast<void>(type_or_fail(token));
  if (chosen.empty()) throw Failure(ExitCode::bad_input, "--types names no type");
  return in_order(type_tokens(), chosen, [](const std::string& t) { return t; });
}

std::vector<Stratum> select_strata(const std::string& text) {
  std::vector<std::string> known;
  std::vector<Stratum> all;
  for (const auto& s : all_strata) {
    known.emplace_back(s.name);
    all.push_back(s.id);
  }
  std::vector<std::string> chosen = known;
  // All 2^32 floats are a run of their own: asked for by name alone.
  std::erase(chosen, name_of(Stratum::exhaustive));
  if (text != "all") chosen = split(text, ',');
  for (const auto& name : chosen) {
    if (!find_stratum(name)) unknown_name("stratum", name, known);
  }
  if (chosen.empty()) throw Failure(ExitCode::bad_input, "--strata names no stratum");
  return in_order(all, chosen, [](Stratum s) { return std::string(name_of(s)); });
}

void narrow_to_exhaustible(const std::string& functions, const std::string& types, PlanRequest& request) {
  if (std::ranges::find(request.strata, Stratum::exhaustive) == request.strata.end()) return;
  if (types != "all") {
    for (const auto& token : request.types) {
      if (token == "float") continue;
      throw Failure(ExitCode::bad_input,
                    fmt::format("--strata exhaustive takes float alone: {} has too many values", token));
    }
  }
  for (const auto& name : split(functions, ',')) {
    const auto f = find_function(name);
    if (!f || Plan::can_exhaust(*f, "float")) continue;
    throw Failure(ExitCode::bad_input,
                  fmt::format("--strata exhaustive takes real functions of one argument: {} is {}", name,
                              f->function_class == FunctionClass::real
                                  ? fmt::format("one of {} arguments", f->arity)
                                  : fmt::format("a {} function", name_of(f->function_class))));
  }
  if (request.strata.size() > 1) return;
  std::erase_if(request.types, [](const std::string& token) { return token != "float"; });
  std::erase_if(request.functions, [](FunctionId id) { return !Plan::can_exhaust(info_of(id), "float"); });
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
      shard.index >= shard.count) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("--shard '{}': want i/n with 0 <= i < n, such as 0/3", text));
  }
  return shard;
}

}  // namespace ulpgate::app
