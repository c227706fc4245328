// ulpgate at: one point, everything known about it.
#include <fmt/format.h>

#include <cmath>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/store/worst_cases.hpp"

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

Json part_json(const PointPart& p) {
  const bool finite = p.judgement.outcome == Outcome::finite;
  return {{"value", p.got_hex},
          {"value_decimal", p.got_decimal},
          {"reference", p.exact_decimal},
          {"ulp_error", finite ? number_or_text(p.judgement.error.value) : Json(nullptr)},
          {"float_distance", finite ? number_or_text(p.judgement.distance) : Json(nullptr)},
          {"condition", signed_number(p.condition)},
          {"outcome", name_of(p.judgement.outcome)}};
}

void print_json(const FunctionInfo& f, const std::string& type, const Point& point) {
  Json j = {{"function", f.name}, {"type", type}, {"args", point.args_hex}};
  if (point.parts.size() == 1) {
    j.update(part_json(point.parts[0]));
  } else {
    // A complex result: every key of a part holds the list [real part, imaginary part].
    const Json re = part_json(point.parts[0]);
    const Json im = part_json(point.parts[1]);
    for (const auto& [key, value] : re.items()) j[key] = {value, im.at(key)};
  }
  fmt::print("{}\n", j.dump());
}

void print_text(const FunctionInfo& f, const TypeEngine& engine, const Point& point) {
  fmt::print("{} {}\n", f.name, engine.descriptor().token);
  for (std::size_t i = 0; i < point.args_hex.size(); ++i) {
    fmt::print("  argument {:<10} {}  ({})\n", i + 1, point.args_hex[i], point.args_decimal[i]);
  }
  for (std::size_t i = 0; i < point.parts.size(); ++i) {
    const PointPart& p = point.parts[i];
    const bool finite = p.judgement.outcome == Outcome::finite;
    if (point.parts.size() > 1) fmt::print(" {} part\n", i == 0 ? "real" : "imaginary");
    fmt::print("  {:<19} {}  ({})\n", "value", p.got_hex, p.got_decimal);
    fmt::print("  {:<19} {}\n", "exact value", p.exact_decimal);
    fmt::print("  {:<19} {}\n", "ULP error", finite ? shown(p.judgement.error.value, 6) : "-");
    fmt::print("  {:<19} {}\n", "float_distance", finite ? shown(p.judgement.distance, 0) : "-");
    fmt::print("  {:<19} {}\n", "condition number",
               std::isfinite(p.condition) ? fmt::format("{:.6g}", p.condition) : shown(p.condition, 0));
    fmt::print("  {:<19} {}\n", "outcome", name_of(p.judgement.outcome));
  }
}

Json quantity_json(const dem::Quantity& q, const QuantityPoint& p) {
  const bool finite = p.judgement.outcome == Outcome::finite;
  return {{"quantity", q.name},
          {"value", p.got_hex},
          {"reference", p.exact_decimal},
          {"ulp_error", finite ? number_or_text(p.judgement.error.value) : Json(nullptr)},
          {"float_distance", finite ? number_or_text(p.judgement.distance) : Json(nullptr)},
          {"normwise_error", number_or_text(p.normwise_error)},
          {"condition", signed_number(p.condition)},
          {"outcome", name_of(p.judgement.outcome)}};
}

// A DEM kernel takes the components of its inputs one after the other.
ExitCode run_at_kernel(const dem::KernelInfo& kernel, const std::vector<std::string>& plain, bool json) {
  const KernelEngine& engine = *find_kernel_engine(type_or_fail(plain[1]).descriptor().token);
  if (plain.size() != kernel.input_components() + 2) {
    std::string inputs;
    for (const auto f : kernel.inputs) inputs += fmt::format(" {}[{}]", name_of(f), dem::components_of(f));
    throw Failure(ExitCode::bad_input, fmt::format("{} takes {} numbers ({} ), found {}", kernel.name,
                                                   kernel.input_components(), inputs, plain.size() - 2));
  }
  std::vector<MpfrValue> inputs;
  for (std::size_t i = 2; i < plain.size(); ++i)
    inputs.push_back(parse_number(engine.descriptor(), plain[i], fmt::format("input {}", i - 1)));
  const KernelPoint point = engine.point(kernel, inputs);
  Json rows = Json::array();
  if (!json) fmt::print("{} {}\n", kernel.name, engine.descriptor().token);
  for (std::size_t q = 0; q < kernel.outputs.size(); ++q) {
    const QuantityPoint& p = point.quantities[q];
    rows.push_back(quantity_json(kernel.outputs[q], p));
    if (json) continue;
    const bool finite = p.judgement.outcome == Outcome::finite;
    fmt::print(" {}\n", kernel.outputs[q].name);
    for (std::size_t i = 0; i < p.got_hex.size(); ++i)
      fmt::print("  {:<19} {}  (exact {})\n", "value", p.got_hex[i], p.exact_decimal[i]);
    fmt::print("  {:<19} {}\n", "ULP error", finite ? shown(p.judgement.error.value, 6) : "-");
    fmt::print("  {:<19} {} roundings\n", "normwise error", shown(p.normwise_error, 6));
    fmt::print("  {:<19} {}\n", "condition number", shown(p.condition, 6));
    fmt::print("  {:<19} {}\n", "outcome", name_of(p.judgement.outcome));
  }
  if (json) {
    const Json j = {{"kernel", kernel.name},
                    {"type", engine.descriptor().token},
                    {"inputs", point.inputs_hex},
                    {"quantities", rows}};
    fmt::print("{}\n", j.dump());
  }
  return ExitCode::pass;
}

ExitCode run_at(const std::vector<std::string>& words) {
  std::vector<std::string> plain;
  bool json = false;
  for (const auto& word : words) {
    if (word == "--json") {
      json = true;
    } else if (word.starts_with("--")) {
      throw Failure(ExitCode::bad_input, fmt::format("unknown option '{}' (ulpgate at --help)", word));
    } else {
      plain.push_back(word);
    }
  }
  if (plain.size() < 2) throw Failure(ExitCode::bad_input, "usage: ulpgate at FUNCTION TYPE X... [--json]");
  if (const auto* kernel = dem::find_kernel(plain[0])) return run_at_kernel(*kernel, plain, json);
  const FunctionInfo& f = function_or_fail(plain[0]);
  const TypeEngine& engine = type_or_fail(plain[1]);
  if (plain.size() != static_cast<std::size_t>(f.arity) + 2) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} takes {} argument{}{}, found {}", f.name, f.arity, f.arity == 1 ? "" : "s",
                              f.function_class == FunctionClass::complex
                                  ? " (real and imaginary parts one after the other)"
                                  : "",
                              plain.size() - 2));
  }
  std::vector<MpfrValue> args;
  for (std::size_t i = 2; i < plain.size(); ++i) {
    args.push_back(
        parse_argument(f, i - 2, engine.descriptor(), plain[i], fmt::format("argument {}", i - 1)));
  }
  const Point point = engine.point(f, args);
  if (json) {
    print_json(f, engine.descriptor().token, point);
  } else {
    print_text(f, engine, point);
  }
  return ExitCode::pass;
}

}  // namespace

void add_at_command(CLI::App& app, Action& action) {
  auto* at =
      app.add_subcommand("at", "Everything known about one point: value, exact value, ULP error, condition");
  at->footer(
      "ulpgate at FUNCTION|KERNEL TYPE X... [--json]\n"
      "X is decimal, hexfloat (-0x1.5p+2), inf or nan, rounded once to TYPE; a complex argument is two "
      "numbers.\n"
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
