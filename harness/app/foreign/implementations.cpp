// Lists of implementations.
#include "harness/app/foreign/implementations.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

namespace {

[[noreturn]] void bad(const std::string& message) {
  throw Failure(Standing::bad_input, message);
}

// "Sleef_{function}_u10" for sin: Sleef_sin_u10.
std::string expanded(std::string text, const std::string& function) {
  constexpr std::string_view hole = "{function}";
  for (auto at = text.find(hole); at != std::string::npos; at = text.find(hole, at + function.size()))
    text.replace(at, hole.size(), function);
  return text;
}

class Reader {
 public:
  Reader(const std::string& file, const ForeignSpec& common) : file_(file) { pattern_.spec = common; }

  std::vector<ListedFunction> read(const std::string& text) {
    const toml::table table = toml::parse(text, file_);
    for (const auto& [key, node] : table)
      if (key != "implementation") take(pattern_, node, key.str());
    const auto* rows = table["implementation"].as_array();
    if (rows == nullptr || !rows->is_array_of_tables()) bad(fmt::format("{}: no [[implementation]]", file_));
    for (const auto& node : *rows) add_rows(*node.as_table());
    return std::move(list_);
  }

 private:
  [[nodiscard]] std::string at(const toml::node& node) const {
    return fmt::format("{}:{}: ", file_, node.source().begin.line);
  }
  [[nodiscard]] std::string text_of(const toml::node& node, std::string_view key) const {
    if (!node.is_string()) bad(fmt::format("{}{} must be a text", at(node), key));
    return *node.value<std::string>();
  }
  [[nodiscard]] double positive(const toml::node& node, std::string_view key) const {
    const auto x = node.value<double>();
    if (!x || !(*x > 0) || !std::isfinite(*x))
      bad(fmt::format("{}{} must be a positive number", at(node), key));
    return *x;
  }

  // What `find` throws says where as well.
  template <class Find>
  static auto placed(const ListedFunction& row, Find find) {
    try {
      return find();
    } catch (const Failure& e) {
      throw Failure(e.standing(), row.place + e.what());
    }
  }

  void add_rows(const toml::table& table) {
    ListedFunction row = pattern_;
    row.place = at(table);
    names_.clear();
    for (const auto& [key, value] : table) take(row, value, key.str());
    if (names_.empty() && !row.function.empty()) names_ = {row.function};
    if (row.spec.symbol.empty() || names_.empty() || row.type.empty())
      bad(fmt::format("{}symbol, function (or functions) and type are wanted", row.place));
    if (row.spec.library.empty() && row.spec.worker.empty())
      bad(fmt::format("{}of which library?", row.place));
    if (row.spec.library.empty()) row.spec.library = "-";
    // A type of libraries that this program was built without.
    constexpr std::array<std::string_view, 4> known = {"float", "double", "long_double", "float128"};
    if (find_type(row.type) == nullptr && std::ranges::find(known, row.type) != known.end()) {
      fmt::print(stderr, "ulpgate: note: {}{} is not built in: {} left out\n", row.place, row.type,
                 row.spec.symbol);
      return;
    }
    placed(row, [&] { return &type_or_fail(row.type); });
    for (const auto& name : names_) {
      ListedFunction one = row;
      one.function = name;
      const auto arity = static_cast<std::size_t>(placed(row, [&] { return function_or_fail(name).arity; }));
      if (!one.claim.domain.empty() && one.claim.domain.size() != arity)
        bad(fmt::format("{}the domain of {} has {} intervals, the function {} arguments", row.place, name,
                        one.claim.domain.size(), arity));
      one.spec.symbol = expanded(row.spec.symbol, name);
      list_.push_back(std::move(one));
    }
  }

  void take(ListedFunction& row, const toml::node& node, std::string_view key) {
    if (key == "library") {
      row.spec.library = text_of(node, key);
    } else if (key == "worker") {
      row.spec.worker = text_of(node, key);
    } else if (key == "name") {
      row.name = text_of(node, key);
    } else if (key == "symbol") {
      row.spec.symbol = text_of(node, key);
    } else if (key == "signature") {
      row.spec.signature = text_of(node, key);
    } else if (key == "function") {
      row.function = text_of(node, key);
    } else if (key == "functions" && node.is_array()) {
      for (const auto& name : *node.as_array()) names_.push_back(text_of(name, key));
    } else if (key == "type") {
      row.type = text_of(node, key);
    } else if (key == "claim_ulp") {
      row.spec.claimed_ulp = positive(node, key);
    } else if (key == "claim_floor") {
      row.claim.floor = positive(node, key);
    } else if (key == "domain" && node.is_array()) {
      row.claim.domain = domain_of(*node.as_array());
    } else {
      bad(
          fmt::format("{}unknown key '{}' (library, worker, name, symbol, signature, function, functions, "
                      "type, claim_ulp, "
                      "claim_floor, domain)",
                      at(node), key));
    }
  }

  // [low, high], or one such pair for each argument.
  [[nodiscard]] std::vector<std::pair<double, double>> domain_of(const toml::array& array) const {
    const auto pair_of = [&](const toml::array& ends) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      const double low = ends.size() == 2 ? ends[0].value_or(none) : none;
      const double high = ends.size() == 2 ? ends[1].value_or(none) : none;
      if (!(low <= high)) bad(fmt::format("{}a domain is [low, high]", at(ends)));
      return std::pair(low, high);
    };
    if (array.empty() || !array[0].is_array()) return {pair_of(array)};
    std::vector<std::pair<double, double>> domain;
    for (const auto& ends : array) {
      if (!ends.is_array()) bad(fmt::format("{}a domain is [low, high], or one for each argument", at(ends)));
      domain.push_back(pair_of(*ends.as_array()));
    }
    return domain;
  }

  std::string file_;
  ListedFunction pattern_;
  std::vector<std::string> names_;
  std::vector<ListedFunction> list_;
};

}  // namespace

std::vector<ListedFunction> read_implementations(const std::string& file, const std::string& text,
                                                 const ForeignSpec& common) {
  try {
    return Reader(file, common).read(text);
  } catch (const toml::parse_error& e) {
    bad(fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

}  // namespace ulpgate::app
