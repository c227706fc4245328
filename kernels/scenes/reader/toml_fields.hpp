// Fields: reads one TOML table, key by key, collecting errors with their lines; a key nobody asked for is an
// error.
#pragma once

#include <toml++/toml.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"

namespace ulpgate::scenes {

// The document being read: its text for the digits of floats, its constants for validation, the errors found.
struct Document {
  std::vector<std::string> lines;
  std::string file;
  Evaluator<double> constants;
  std::vector<SceneError> errors;

  void error(const toml::node* node, std::string key, std::string message) {
    errors.push_back({file, node == nullptr ? 0 : static_cast<int>(node->source().begin.line), std::move(key),
                      std::move(message)});
  }
};

// The text of the float at `node`; empty where it cannot be found (a float on a line with wide characters).
[[nodiscard]] std::string float_text(const Document& document, const toml::node& node);

// Why `text`, in double, is not a number in `range`; empty when it is.  The type of a run asks again.
[[nodiscard]] std::string number_fault(const Evaluator<double>& constants, std::string_view text,
                                       Range range);

class Fields {
 public:
  Fields(Document& document, const toml::table& table, std::string path)
      : document_(document), table_(table), path_(std::move(path)) {}
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;

  // Looks a key up and marks it known; null where it is absent.
  const toml::node* find(std::string_view key);
  // The same, an error where it is absent.
  const toml::node* require(std::string_view key);

  void number(std::string_view key, Expression& out, Range range = Range::any);
  void number(std::string_view key, std::optional<Expression>& out, Range range = Range::any);
  void required_number(std::string_view key, Expression& out, Range range = Range::any);
  void triple(std::string_view key, Triple& out, Range range = Range::any);
  void required_triple(std::string_view key, Triple& out, Range range = Range::any);
  void integer(std::string_view key, int& out, int least, int most);
  void boolean(std::string_view key, bool& out);
  void string(std::string_view key, std::string& out);
  void required_string(std::string_view key, std::string& out);
  void strings(std::string_view key, std::vector<std::string>& out);
  // One of `names`; `out` becomes the value at the same place.
  template <class Enum>
  void choice(std::string_view key, Enum& out, const std::vector<std::pair<std::string, Enum>>& names) {
    std::string text;
    string(key, text);
    if (text.empty()) return;
    std::string known;
    for (const auto& [name, value] : names) {
      if (name == text) {
        out = value;
        return;
      }
      known += (known.empty() ? "" : ", ") + name;
    }
    fail(table_.get(key), key, "'" + text + "' is none of " + known);
  }
  void expression_at(const toml::node& node, const std::string& key, Expression& out, Range range);
  void triple_at(const toml::node& node, const std::string& key, Triple& out, Range range);
  void fail(const toml::node* node, std::string_view key, std::string message) {
    document_.error(node == nullptr ? &table_ : node, name_of(key), std::move(message));
  }
  // Reports the keys that nobody asked for.
  void finish();
  [[nodiscard]] const toml::table& table() const { return table_; }
  [[nodiscard]] std::string name_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }

 private:
  Document& document_;
  const toml::table& table_;
  std::string path_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace ulpgate::scenes
