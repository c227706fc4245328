// ulpgate at: one point, everything known about it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/foreign/foreign_options.hpp"
#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/machine/environment.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

namespace {

Json signed_number(double x) {
  if (std::isnan(x)) return nullptr;
  return number_or_text(x);
}

std::string shown(double x, int decimals) {
  if (std::isnan(x)) return "undefined";
  if (std::isinf(x)) return "inf";
  return x < 1e15 ? fmt::format("{:.{}f}", x, decimals) : fmt::format("{:.6e}", x);
}

// One component stands for itself, several as a list.
Json one_or_list(const std::vector<std::string>& texts) {
  return texts.size() == 1 ? Json(texts.front()) : Json(texts);
}

Json part_json(const PointPart& p) {
  const bool finite = p.judgement.outcome == Outcome::finite;
  Json j = {{"value", one_or_list(p.got_hex)},
            {"value_decimal", one_or_list(p.got_decimal)},
            {"reference", one_or_list(p.exact_decimal)},
            {"ulp_error", finite ? number_or_text(p.judgement.error.value) : Json(nullptr)},
            {"float_distance", finite ? number_or_text(p.judgement.distance) : Json(nullptr)}};
  if (p.normwise_error) j["normwise_error"] = number_or_text(*p.normwise_error);
  j["condition"] = signed_number(p.condition);
  j["outcome"] = name_of(p.judgement.outcome);
  return j;
}

Json function_json(const Subject& subject, const Point& point) {
  Json j = {{"function", subject.name()}, {"type", subject.type().token}, {"args", point.args_hex}};
  if (point.parts.size() == 1) {
    j.update(part_json(point.parts[0]));
  } else {
    // A complex result: every key of a part holds the list [real part, imaginary part].
    const Json re = part_json(point.parts[0]);
    const Json im = part_json(point.parts[1]);
    for (const auto& [key, value] : re.items()) j[key] = {value, im.at(key)};
  }
  j["implementation"] = subject.info().implementation;
  return j;
}

Json kernel_json(const Subject& subject, const Point& point) {
  Json rows = Json::array();
  for (std::size_t q = 0; q < point.parts.size(); ++q) {
    Json row = {{"quantity", subject.info().parts[q].name}};
    row.update(part_json(point.parts[q]));
    // Lists whatever the number of components.
    for (const auto* key : {"value", "value_decimal", "reference"})
      if (!row[key].is_array()) row[key] = Json::array({row[key]});
    rows.push_back(row);
  }
  return {{"kernel", subject.name()},
          {"type", subject.type().token},
          {"inputs", point.args_hex},
          {"quantities", rows}};
}

// The outcome "finite" is that of every result that is what it should be: of the same kind as the exact one.
std::string outcome_words(const PointPart& p) {
  const auto any = [&](const char* word) {
    return std::ranges::any_of(p.exact_decimal,
                               [&](const std::string& x) { return x.find(word) != std::string::npos; });
  };
  if (p.judgement.outcome != Outcome::finite) return std::string(name_of(p.judgement.outcome));
  return any("nan") ? "NaN, as it should be" : any("inf") ? "infinite, as it should be" : "finite";
}

void print_part(const PointPart& p) {
  const bool finite = p.judgement.outcome == Outcome::finite;
  for (std::size_t i = 0; i < p.got_hex.size(); ++i) {
    show("  {:<19} {}  ({})\n", "value", p.got_hex[i], p.got_decimal[i]);
    show("  {:<19} {}\n", "exact value", p.exact_decimal[i]);
  }
  show("  {:<19} {}\n", "ULP error", finite ? shown(p.judgement.error.value, 6) : "-");
  show("  {:<19} {}\n", "float_distance", finite ? shown(p.judgement.distance, 0) : "-");
  if (p.normwise_error) show("  {:<19} {} roundings\n", "normwise error", shown(*p.normwise_error, 6));
  show("  {:<19} {}\n", "condition number",
       std::isfinite(p.condition) ? fmt::format("{:.6g}", p.condition) : shown(p.condition, 0));
  show("  {:<19} {}\n", "outcome", outcome_words(p));
}

void print_text(const Subject& subject, const Point& point) {
  const bool function = subject.info().kind == SubjectKind::function;
  show("{} {} ({})\n", subject.name(), subject.type().token, subject.info().implementation);
  for (std::size_t i = 0; function && i < point.args_hex.size(); ++i)
    show("  argument {:<10} {}  ({})\n", i + 1, point.args_hex[i], point.args_decimal[i]);
  for (std::size_t i = 0; i < point.parts.size(); ++i) {
    if (!function) show(" {}\n", subject.info().parts[i].name);
    if (function && point.parts.size() > 1) show(" {} part\n", i == 0 ? "real" : "imaginary");
    print_part(point.parts[i]);
  }
}

// "a[3] b[1]": the inputs of a kernel, whose components stand one after the other on the command line.
std::string shown_inputs(const SubjectInfo& info) {
  if (info.kind == SubjectKind::function)
    return info.subject_class == "complex" ? " (real and imaginary parts one after the other)" : "";
  std::string text;
  for (const auto& input : info.inputs) text += fmt::format(" {}[{}]", input.name, input.components);
  return " (" + text.substr(1) + ")";
}

Verdict run_at(std::vector<std::string> words) {
  const ForeignOptions foreign = take_foreign_options(words);
  std::vector<std::string> plain;
  bool json = false;
  for (const auto& word : words) {
    if (word == "--json") {
      json = true;
    } else if (word.starts_with("--")) {
      throw Failure(Standing::bad_input, fmt::format("unknown option '{}' (ulpgate at --help)", word));
    } else {
      plain.push_back(word);
    }
  }
  if (plain.size() < 2) throw Failure(Standing::bad_input, "usage: ulpgate at FUNCTION TYPE X... [--json]");
  bind_foreign(foreign, plain[0], plain[1]);
  const Subject& subject = subject_or_fail(plain[0], plain[1]);
  const SubjectInfo& info = subject.info();
  const std::size_t wanted = info.input_components();
  if (plain.size() != wanted + 2) {
    throw Failure(Standing::bad_input,
                  fmt::format("{} takes {} {}{}{}, found {}", info.name, wanted,
                              info.kind == SubjectKind::function ? "argument" : "number",
                              wanted == 1 ? "" : "s", shown_inputs(info), plain.size() - 2));
  }
  const auto function = find_function(info.name);
  std::vector<MpfrValue> args;
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::string place = fmt::format("argument {}", i + 1);
    args.push_back(function ? parse_argument(*function, i, subject.type(), plain[i + 2], place)
                            : parse_number(subject.type(), plain[i + 2], place));
  }
  const WorkPlace place(info.name, subject.type().token, "");
  const Point point = in_checked_environment([&] { return subject.point(args); });
  if (json) {
    fmt::print("{}\n", (function ? function_json(subject, point) : kernel_json(subject, point)).dump());
  } else {
    print_text(subject, point);
  }
  return foreign_verdict();
}

}  // namespace

void add_at_command(CLI::App& app, Action& action) {
  auto* at =
      app.add_subcommand("at", "Everything known about one point: value, exact value, ULP error, condition");
  set_foot(
      *at,
      {"ulpgate at sin double 1e22", "ulpgate at pow long_double 1.5 -0x1.8p-3 --json",
       "ulpgate at exp double 1 --library libm.so.6 --symbol exp"},
      "ulpgate at FUNCTION|KERNEL TYPE X... [--json] [--library L --symbol S]\n"
      "X is decimal, hexfloat (-0x1.5p+2), inf or nan, rounded once to TYPE; a complex argument is two "
      "numbers.\n"
      "--library and --symbol [--signature --worker --worker-environment --call-timeout] call the function "
      "of a shared library instead (`ulpgate math --help`).\n"
      "`ulpgate --timeout S at ...` waits longer than 60 s, or not as long.\n"
      "--json prints the keys function type args value reference ulp_error float_distance condition "
      "outcome.");
  // Arguments may begin with a minus: the words are taken as they stand rather than as options.
  at->prefix_command();
  at->callback([at, &action] {
    const auto words = at->remaining();
    action = [words] { return run_at(words); };
  });
}

}  // namespace ulpgate::app
