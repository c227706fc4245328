// Reading one TOML table with validation.
#include "kernels/scenes/reader/toml_fields.hpp"

#include <algorithm>
#include <cmath>

namespace ulpgate::scenes {

std::string float_text(const Document& document, const toml::node& node) {
  const auto begin = node.source().begin;
  if (begin.line == 0 || begin.line > document.lines.size()) return {};
  const std::string& line = document.lines[begin.line - 1];
  // Columns count code points: only lines of plain ASCII up to here can be indexed.
  if (std::any_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }))
    return {};
  std::string text;
  for (std::size_t i = begin.column - 1; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '_') continue;
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '+' && c != '-') break;
    text += c;
  }
  return text;
}

std::string number_fault(const Evaluator<double>& constants, std::string_view text, Range range) {
  double value = 0;
  try {
    value = constants(text);
  } catch (const ExpressionError& e) {
    return e.what();
  }
  if (!std::isfinite(value)) return "'" + std::string(text) + "' is not finite";
  const std::string fault = range_fault(value, range);
  return fault.empty() ? fault : fault + ", is " + std::string(text);
}

const toml::node* Fields::find(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

const toml::node* Fields::require(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) fail(nullptr, key, "is missing");
  return node;
}

void Fields::expression_at(const toml::node& node, const std::string& key, Expression& out, Range range) {
  Expression text;
  if (const auto* s = node.as_string()) {
    text = s->get();
  } else if (const auto* i = node.as_integer()) {
    text = std::to_string(i->get());
  } else if (node.is_floating_point()) {
    text = float_text(document_, node);
    if (text.empty()) {
      document_.error(&node, key, "write this number as a string, so that all its digits are kept");
      return;
    }
  } else {
    document_.error(&node, key, "must be a number or a string that holds one");
    return;
  }
  const std::string fault = number_fault(document_.constants, text, range);
  if (!fault.empty()) {
    document_.error(&node, key, fault);
    return;
  }
  out = text;
}

void Fields::triple_at(const toml::node& node, const std::string& key, Triple& out, Range range) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) {
    document_.error(&node, key, "must be an array of three numbers");
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    expression_at((*array)[i], key + "[" + std::to_string(i) + "]", out[i], range);
  }
}

void Fields::number(std::string_view key, Expression& out, Range range) {
  if (const toml::node* node = find(key)) expression_at(*node, name_of(key), out, range);
}

void Fields::number(std::string_view key, std::optional<Expression>& out, Range range) {
  if (const toml::node* node = find(key)) {
    Expression text = "0";
    expression_at(*node, name_of(key), text, range);
    out = text;
  }
}

void Fields::required_number(std::string_view key, Expression& out, Range range) {
  if (const toml::node* node = require(key)) expression_at(*node, name_of(key), out, range);
}

void Fields::triple(std::string_view key, Triple& out, Range range) {
  if (const toml::node* node = find(key)) triple_at(*node, name_of(key), out, range);
}

void Fields::required_triple(std::string_view key, Triple& out, Range range) {
  if (const toml::node* node = require(key)) triple_at(*node, name_of(key), out, range);
}

void Fields::integer(std::string_view key, int& out, int least, int most) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const auto* value = node->as_integer();
  if (value == nullptr) return fail(node, key, "must be an integer");
  if (value->get() < least || value->get() > most) {
    return fail(node, key, "must be from " + std::to_string(least) + " to " + std::to_string(most));
  }
  out = static_cast<int>(value->get());
}

void Fields::boolean(std::string_view key, bool& out) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const auto* value = node->as_boolean();
  if (value == nullptr) return fail(node, key, "must be true or false");
  out = value->get();
}

void Fields::string(std::string_view key, std::string& out) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const auto* value = node->as_string();
  if (value == nullptr || value->get().empty()) return fail(node, key, "must be a string that is not empty");
  out = value->get();
}

void Fields::required_string(std::string_view key, std::string& out) {
  if (require(key) != nullptr) string(key, out);
}

void Fields::strings(std::string_view key, std::vector<std::string>& out) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr) return fail(node, key, "must be an array of strings");
  for (const toml::node& item : *array) {
    const auto* value = item.as_string();
    if (value == nullptr) return fail(&item, key, "must be an array of strings");
    out.push_back(value->get());
  }
}

void Fields::finish() {
  for (const auto& [key, node] : table_) {
    if (!known_.contains(key.str())) fail(&node, key.str(), "unknown key");
  }
}

}  // namespace ulpgate::scenes
