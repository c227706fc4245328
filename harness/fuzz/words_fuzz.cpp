// Fuzz target: numbers, expressions and the command line; what a number is written as reads back as itself.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/failure.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "reference/text/text.hpp"
#include "reference/types/mpfr_value.hpp"

namespace {

template <class Real>
void read_number(std::string_view text) {
  Real x;
  try {
    x = ulpgate::parse_real<Real>(text);
  } catch (const std::invalid_argument&) {
    return;
  }
  const std::string exact = ulpgate::to_hexfloat(x);
  if (ulpgate::to_hexfloat(ulpgate::parse_real<Real>(exact)) != exact ||
      ulpgate::to_hexfloat(ulpgate::parse_real<Real>(ulpgate::to_decimal(x))) != exact)
    throw std::logic_error("a number changes when it is written and read again: " + exact);
}

void read_expression(std::string_view text) {
  try {
    static_cast<void>(ulpgate::scenes::Evaluator<double>()(text));
  } catch (const ulpgate::scenes::ExpressionError&) {
  }
}

// Parsed alone: no verb runs.
void read_words(std::string_view text) {
  std::vector<std::string> words{"ulpgate"};
  words.emplace_back();
  for (const char c : text) {
    if (c == '\n') {
      words.emplace_back();
    } else if (c != '\0') {
      words.back() += c;
    }
  }
  std::vector<char*> argv;
  argv.reserve(words.size());
  for (auto& word : words) argv.push_back(word.data());
  CLI::App app("", "ulpgate");
  ulpgate::app::Action action;
  double timeout_s = 0;
  ulpgate::app::add_all_commands(app, action, timeout_s);
  try {
    app.parse(static_cast<int>(argv.size()), argv.data());
  } catch (const CLI::ParseError&) {
  } catch (const ulpgate::app::Failure&) {
  }
}

}  // namespace

// The first character says what the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ulpgate::MpfrThread mpfr;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'n':
      read_number<double>(text);
      read_number<float>(text);
      read_number<long double>(text);
      break;
    case 'e':
      read_expression(text);
      break;
    case 'w':
      read_words(text);
      break;
    default:
      break;
  }
  return 0;
}
