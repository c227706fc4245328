// Expressions of a scene: decimal numbers, + - * / ( ), named constants, pi, sqrt sin cos tan exp log; in any
// Real.
//
// Every literal is rounded once to Real and every operation runs in Real, left to right, so a scene means the
// same sequence of operations in every precision and no constant passes through double.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "reference/text/literal.hpp"

namespace ulpgate::scenes {

// A text that is no expression; what() says where.
struct ExpressionError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Why a constant cannot have this name; empty where it can.  A name that the language has itself would never
// be looked up, or would stand for something else than it says.
[[nodiscard]] inline std::string constant_name_fault(std::string_view name) {
  for (const std::string_view taken :
       {"pi", "sqrt", "sin", "cos", "tan", "exp", "log", "nan", "inf", "infinity"}) {
    if (name == taken)
      return "a constant cannot be called '" + std::string(name) + "', which means something else";
  }
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_')
      return "a constant's name is of letters, digits and '_'";
  }
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0)
    return "a constant's name begins with a letter or '_'";
  return "";
}

template <RealType Real>
class Evaluator {
 public:
  void define(const std::string& name, const Real& value) { constants_.insert_or_assign(name, value); }

  // Throws ExpressionError on malformed text.
  [[nodiscard]] Real operator()(std::string_view text) const {
    Cursor c{text, 0, *this};
    Real value = c.sum();  // not const: it is moved out
    c.skip_space();
    if (c.at != text.size()) c.fail("unexpected '" + std::string(1, text[c.at]) + "'");
    return value;
  }

 private:
  struct Cursor {
    std::string_view text;
    std::size_t at;
    const Evaluator& evaluator;
    int depth = 0;

    [[noreturn]] void fail(const std::string& what) const {
      throw ExpressionError("'" + std::string(text) + "': " + what + " at character " +
                            std::to_string(at + 1));
    }
    void skip_space() {
      while (at < text.size() && text[at] == ' ') ++at;
    }
    [[nodiscard]] char peek() {
      skip_space();
      return at < text.size() ? text[at] : '\0';
    }
    Real sum() {
      Real value = product();
      for (char op = peek(); op == '+' || op == '-'; op = peek()) {
        ++at;
        const Real right = product();
        value = op == '+' ? Real(value + right) : Real(value - right);
      }
      return value;
    }
    Real product() {
      Real value = factor();
      for (char op = peek(); op == '*' || op == '/'; op = peek()) {
        ++at;
        const Real right = factor();
        value = op == '*' ? Real(value * right) : Real(value / right);
      }
      return value;
    }
    Real factor() {
      if (++depth > 64) fail("nested too deep");
      const char c = peek();
      Real value{0};
      if (c == '-' || c == '+') {
        ++at;
        value = factor();
        if (c == '-') value = -value;
      } else if (c == '(') {
        ++at;
        value = sum();
        close();
      } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
        value = number();
      } else if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') {
        value = name();
      } else {
        fail(c == '\0' ? "a number is missing" : "unexpected '" + std::string(1, c) + "'");
      }
      --depth;
      return value;
    }
    void close() {
      if (peek() != ')') fail("')' is missing");
      ++at;
    }
    Real number() {
      const std::size_t begin = at;
      const bool hex = text.substr(at, 2) == "0x" || text.substr(at, 2) == "0X";
      const char exponent = hex ? 'p' : 'e';
      if (hex) at += 2;
      while (at < text.size()) {
        const char c = text[at];
        const auto low = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        const bool digit = hex ? std::isxdigit(static_cast<unsigned char>(c)) != 0
                               : std::isdigit(static_cast<unsigned char>(c)) != 0;
        const bool sign = (c == '+' || c == '-') &&
                          std::tolower(static_cast<unsigned char>(text[at - 1])) == exponent && at > begin;
        if (!digit && c != '.' && low != exponent && !sign) break;
        ++at;
      }
      try {
        return real<Real>(text.substr(begin, at - begin));
      } catch (const std::invalid_argument&) {
        at = begin;
        fail("malformed number");
      }
    }
    Real name() {
      using std::cos;
      using std::exp;
      using std::log;
      using std::sin;
      using std::sqrt;
      using std::tan;
      const std::size_t begin = at;
      while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_'))
        ++at;
      const std::string word(text.substr(begin, at - begin));
      if (peek() == '(') {
        ++at;
        const Real x = sum();
        close();
        if (word == "sqrt") return sqrt(x);
        if (word == "sin") return sin(x);
        if (word == "cos") return cos(x);
        if (word == "tan") return tan(x);
        if (word == "exp") return exp(x);
        if (word == "log") return log(x);
        fail("unknown function '" + word + "'");
      }
      const auto found = evaluator.constants_.find(word);
      if (found != evaluator.constants_.end()) return found->second;
      if (word == "pi") return boost::math::constants::pi<Real>();
      at = begin;
      fail("unknown name '" + word + "'");
    }
  };

  std::map<std::string, Real> constants_;
};

}  // namespace ulpgate::scenes
