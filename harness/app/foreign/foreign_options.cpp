// ForeignOptions.
#include "harness/app/foreign/foreign_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <filesystem>
#include <set>

#include "harness/app/foreign/implementations.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/foreign/foreign_code.hpp"
#include "harness/foreign/foreign_failure.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate::app {

namespace {

struct Bound {
  const Subject* subject;
  std::unique_ptr<ForeignCode> code;
  std::unique_ptr<BatchCode> claimed;  // around it; null where nothing limits its claim
};
std::vector<Bound>& bound() {
  static std::vector<Bound> all;
  return all;
}

ForeignSpec common_spec(const ForeignOptions& o) {
  ForeignSpec spec;
  spec.worker = o.worker;
  spec.environment = o.environment;
  spec.timeout_s = o.call_timeout_s;
  return spec;
}

void refuse_incomplete(const ForeignOptions& o) {
  if (o.symbol.empty())
    throw Failure(Standing::bad_input, "--library without --symbol: which function of it?");
  if (o.library.empty() && o.worker.empty())
    throw Failure(Standing::bad_input, "--symbol without --library: of which library?");
}

// The letter of a type in signatures; 0: it has none.
char element_of(const std::string& token) {
  return token == "float"         ? 'f'
         : token == "double"      ? 'd'
         : token == "long_double" ? 'l'
         : token == "float128"    ? 'q'
                                  : '\0';
}

std::string domain_text(const ClaimBounds& bounds) {
  std::vector<std::string> ends;
  for (const auto& [low, high] : bounds.domain) ends.push_back(fmt::format("[{}, {}]", low, high));
  return fmt::format("{}", fmt::join(ends, " x "));
}

std::unique_ptr<ForeignCode> make_code(const ListedFunction& row, const ForeignShape& shape) {
  try {
    return std::make_unique<ForeignCode>(row.spec, shape);
  } catch (const ForeignUnsupported& e) {
    if (row.place.empty()) throw Failure(Standing::nothing_measured, e.what());
    fmt::print(stderr, "ulpgate: note: {}{}: left out\n", row.place, e.what());
    return nullptr;
  } catch (const ForeignFailure& e) {
    throw Failure(Standing::bad_input, row.place + e.what());
  }
}

}  // namespace

BoundFunction bind_listed(const ListedFunction& row) {
  const FunctionInfo& f = function_or_fail(row.function);
  const Subject& original = subject_or_fail(row.function, row.type);
  const char element = element_of(row.type);
  if (element == '\0' || f.parts != 1) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}{} {}: libraries are called with float, double, long_double and float128 "
                              "numbers and give one",
                              row.place, row.function, row.type));
  }
  auto code = make_code(row, {element, f.arity, row.function == "cos" || row.function == "cosh" ? 1 : 0});
  if (code == nullptr) return {};
  const ForeignFacts& facts = code->facts();
  CodeNames names{
      row.name.empty() ? facts.name_with(row.spec.symbol) : fmt::format("{} {}", row.name, row.spec.symbol),
      row.spec.claimed_ulp,
      row.spec.selection(),
      {}};
  names.facts = {{"path", facts.path},
                 {"soname", facts.soname},
                 {"build_id", facts.build_id},
                 {"signature", facts.signature}};
  // What has no build-id is told from another by its bytes.
  if (facts.build_id.empty() && std::filesystem::is_regular_file(facts.path))
    names.facts.emplace_back("content", fmt::format("{:016x}", fnv1a(read_file(facts.path))));
  if (!row.claim.domain.empty()) names.facts.emplace_back("claim_domain", domain_text(row.claim));
  if (row.claim.floor > 0) names.facts.emplace_back("claim_floor", fmt::format("{}", row.claim.floor));
  Bound b{nullptr, std::move(code), nullptr};
  if (row.claim.limit()) b.claimed = make_claimed_code(*b.code, f, element, row.claim);
  const BatchCode& used = b.claimed != nullptr ? *b.claimed : static_cast<const BatchCode&>(*b.code);
  auto subject = original.with_code(used, names);
  b.subject = subject.get();
  BoundFunction result{subject.get(), &used, element, facts};
  bound().push_back(std::move(b));
  replace_subject(std::move(subject));
  return result;
}

void add_foreign_options(CLI::App& verb, ForeignOptions& o, bool with_list) {
  const std::string group = "Functions of a library";
  verb.add_option("--library", o.library, "shared library whose function is tested, as the loader takes it")
      ->group(group);
  verb.add_option("--symbol", o.symbol,
                  "the function's symbol in it: the function named is what it claims to be")
      ->group(group);
  verb.add_option(
          "--signature", o.signature,
          "how it is called: d(d), d(d,d), v4d(v4d), void(n,d*,d*), void(d,d*,d*), d(d,i*), d(i,d); f, d, l, "
          "q "
          "are float, double, long double, binary128 (default: what the symbol's name tells, else values of "
          "the type)")
      ->group(group);
  verb.add_option("--worker", o.worker, "program that calls it (default: ulpgate-worker)")->group(group);
  verb.add_option("--worker-environment", o.environment,
                  "NAME=VALUE for that program, such as GLIBC_TUNABLES=...")
      ->group(group);
  verb.add_option("--call-timeout", o.call_timeout_s, "seconds of processor time after which a call hangs")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 1e6))
      ->group(group);
  if (with_list)
    verb.add_option("--implementations", o.list,
                    "TOML file of functions of libraries (harness/app/foreign/README.md)")
        ->group(group);
}

ForeignOptions take_foreign_options(std::vector<std::string>& words) {
  ForeignOptions o;
  std::vector<std::string> left;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string name = words[i];
    std::string value;
    const auto equals = name.find('=');
    const bool joined = name.starts_with("--") && equals != std::string::npos;
    if (joined) {
      value = name.substr(equals + 1);
      name.resize(equals);
    }
    const auto is = [&](std::string_view wanted) { return name == wanted; };
    if (!is("--library") && !is("--symbol") && !is("--signature") && !is("--worker") &&
        !is("--worker-environment") && !is("--call-timeout")) {
      left.push_back(words[i]);
      continue;
    }
    if (!joined) {
      if (i + 1 == words.size()) throw Failure(Standing::bad_input, fmt::format("{} needs a value", name));
      value = words[++i];
    }
    if (is("--library")) o.library = value;
    if (is("--symbol")) o.symbol = value;
    if (is("--signature")) o.signature = value;
    if (is("--worker")) o.worker = value;
    if (is("--worker-environment")) o.environment.push_back(value);
    if (is("--call-timeout")) {
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), o.call_timeout_s);
      if (error != std::errc() || end != value.data() + value.size() || !(o.call_timeout_s > 0))
        throw Failure(Standing::bad_input,
                      fmt::format("--call-timeout: '{}' is no number of seconds", value));
    }
  }
  words = std::move(left);
  return o;
}

void bind_foreign(const ForeignOptions& o, const std::string& function, const std::string& type) {
  if (!o.one()) return;
  refuse_incomplete(o);
  ListedFunction row{function, type, {}, {}, "", ""};
  row.spec = common_spec(o);
  row.spec.library = o.library.empty() ? "-" : o.library;
  row.spec.symbol = o.symbol;
  row.spec.signature = o.signature;
  static_cast<void>(bind_listed(row));
}

void bind_list(const ForeignOptions& o, std::string& functions, std::string& types) {
  if (o.list.empty()) return;
  const auto chosen_functions = select_subjects(SubjectKind::function, functions);
  const auto chosen_types = select_types(types);
  const auto holds = [](const std::vector<std::string>& all, const std::string& name) {
    return std::ranges::find(all, name) != all.end();
  };
  std::set<std::string> names;
  std::set<std::string> tokens;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& row : read_implementations(o.list, read_file(o.list), common_spec(o))) {
    if (!holds(chosen_functions, row.function) || !holds(chosen_types, row.type)) continue;
    if (pairs.contains({row.function, row.type})) {
      throw Failure(Standing::bad_input, fmt::format("{}{} {} stands there twice: a run measures one of each",
                                                     row.place, row.function, row.type));
    }
    if (bind_listed(row).subject == nullptr) continue;
    names.insert(row.function);
    tokens.insert(row.type);
    pairs.emplace(row.function, row.type);
  }
  if (pairs.empty())
    throw Failure(Standing::nothing_measured,
                  fmt::format("{}: none of the functions and types chosen", o.list));
  // What the list lacks of their product would be measured with this program's own functions.
  for (const auto& name : names) {
    for (const auto& token : tokens) {
      if (!pairs.contains({name, token}))
        fmt::print(stderr, "ulpgate: note: {}: {} {} is not in it: this program's own is measured\n", o.list,
                   name, token);
    }
  }
  functions = fmt::format("{}", fmt::join(names, ","));
  types = fmt::format("{}", fmt::join(tokens, ","));
}

Verdict foreign_verdict() {
  Verdict verdict;
  for (const auto& b : bound()) {
    auto findings = b.code->facts().findings;
    for (const auto& f : b.code->findings()) findings.push_back(f);
    for (const auto& f : findings) {
      verdict |= Standing::regression;
      fmt::print(stderr, "ulpgate: {}: {}\n", b.subject->info().implementation, f);
    }
  }
  return verdict;
}

Verdict foreign_verdict(const std::vector<RowRecord>& records) {
  Verdict verdict = foreign_verdict();
  for (const auto& r : records) {
    for (auto o = static_cast<std::size_t>(Outcome::crash); o < outcome_count; ++o) {
      if (r.summary.outcomes[o] == 0) continue;
      const Subject* subject = find_subject(r.subject, r.type);
      verdict |= Standing::regression;
      const auto at = r.points.first_mismatch.find(static_cast<Outcome>(o));
      fmt::print(stderr, "ulpgate: {} {}: {} at {} of {} arguments of {}, first: ulpgate at {} {} {}{}\n",
                 r.implementation, r.type, outcome_names[o], r.summary.outcomes[o], r.summary.samples,
                 r.stratum, r.subject, r.type,
                 at == r.points.first_mismatch.end() ? "" : fmt::format("{}", fmt::join(at->second, " ")),
                 subject == nullptr ? "" : subject->info().selection);
    }
  }
  return verdict;
}

}  // namespace ulpgate::app
