// Worst cases.
#include "harness/app/store/worst_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::app {

namespace {
// Degrees and orders beyond this make the series of the special functions a matter of hours.
constexpr long greatest_index = 1000;
// Arguments of the wide-range types beyond 2^this need an argument reduction with gigabytes of pi.
constexpr long greatest_exponent = 1L << 20;
}  // namespace

MpfrValue parse_number(const RealDescriptor& type, const std::string& text, const std::string& place) {
  MpfrValue value(type.format.precision + 64);
  if (!parse_into(value, text, type.format)) {
    throw Failure(
        Standing::bad_input,
        fmt::format("{}: '{}' is not a number (want decimal, hexfloat such as -0x1.8p+1, inf or nan)", place,
                    text));
  }
  if (mpfr_regular_p(value.get()) && std::labs(binade(value)) > greatest_exponent) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: '{}' lies beyond 2^+-{}, the largest arguments that are evaluated", place,
                              text, greatest_exponent));
  }
  return value;
}

MpfrValue parse_argument(const FunctionInfo& f, std::size_t slot, const RealDescriptor& type,
                         const std::string& text, const std::string& place) {
  MpfrValue value = parse_number(type, text, place);
  const DomainMap map = f.domain[slot];
  if (map == DomainMap::UINT || map == DomainMap::INT) {
    const long least = map == DomainMap::UINT ? 0 : -greatest_index;
    if (!mpfr_integer_p(value) || mpfr_cmp_si(value, greatest_index) > 0 || mpfr_cmp_si(value, least) < 0) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: argument {} of {} must be an integer from {} to {}, not '{}'", place,
                                slot + 1, f.name, least, greatest_index, text));
    }
  }
  return value;
}

WorstCaseFile read_worst_cases(const std::filesystem::path& directory, const PlanRequest& request) {
  if (!std::filesystem::is_directory(directory)) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: no such directory of worst cases", directory.string()));
  }
  WorstCaseFile out;
  for (const auto& token : request.types) {
    const auto file = directory / (token + ".txt");
    if (!std::filesystem::exists(file)) continue;
    std::size_t number = 0;
    for (std::string line : read_lines(file)) {
      const std::string place = fmt::format("{}:{}", file.string(), ++number);
      line = line.substr(0, line.find('#'));
      std::ranges::replace(line, '\t', ' ');
      const auto words = split(line, ' ');
      if (words.empty()) continue;
      const auto f = find_function(words[0]);
      if (!f) throw Failure(Standing::bad_input, fmt::format("{}: unknown function '{}'", place, words[0]));
      if (words.size() != static_cast<std::size_t>(f->arity) + 1) {
        throw Failure(Standing::bad_input, fmt::format("{}: {} takes {} arguments, found {}", place, f->name,
                                                       f->arity, words.size() - 1));
      }
      std::vector<MpfrValue> point;
      for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        point.push_back(parse_argument(*f, i, type_or_fail(token), words[i + 1], place));
      }
      if (std::ranges::find(request.subjects, words[0]) == request.subjects.end()) continue;
      out.text += token + " " + words[0];
      for (const auto& x : point) out.text += " " + to_hexfloat(x.get());
      out.text += "\n";
      out.cases[{words[0], token}].push_back(std::move(point));
    }
  }
  return out;
}

ArgumentList worst_cases_of(const std::filesystem::path& directory, const FunctionInfo& f,
                            const std::string& token) {
  PlanRequest request;
  request.subjects = {std::string(f.name)};
  request.types = {token};
  return std::move(read_worst_cases(directory, request).cases[{std::string(f.name), token}]);
}

std::string offer_worst_case(const std::filesystem::path& directory, const FunctionInfo& f,
                             const std::string& token, const std::vector<MpfrValue>& args, double error_ulp) {
  const auto file = directory / (token + ".txt");
  const std::string name(f.name);
  const Subject& subject = subject_or_fail(name, token);
  for (const auto& point : worst_cases_of(directory, f, token)) {
    const Point there = subject.point(point);
    double error = -1;
    for (const auto& part : there.parts) {
      if (part.judgement.outcome == Outcome::finite) error = std::max(error, part.judgement.error.value);
    }
    if (error < error_ulp) continue;
    return fmt::format("{} holds {} {} already, {:.6g} ULP: nothing added", file.string(), f.name,
                       fmt::join(there.args_hex, " "), error);
  }
  std::string text;
  if (std::filesystem::exists(file)) text = read_file(file);
  if (text.empty()) text = fmt::format("# Arguments with large errors in {}.\n", token);
  if (!text.ends_with('\n')) text += '\n';
  std::string line(f.name);
  for (const auto& x : args) line += " " + to_hexfloat(x.get());
  text += fmt::format("{:<32} # {:.6g} ULP, found by search\n", line, error_ulp);
  write_file(file, text);
  return fmt::format("added to {}: {}; the budgets of stratum `worst` follow with `ulpgate gate --update`",
                     file.string(), line);
}

}  // namespace ulpgate::app
