// ForeignOptions: --library, --symbol and their like, and the functions that they put in place of this
// program's.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/core/records/row_record.hpp"
#include "harness/core/verdict/verdict.hpp"
#include "harness/foreign/foreign_spec.hpp"

namespace ulpgate::app {

struct ForeignOptions {
  std::string library;
  std::string symbol;
  std::string signature;
  std::string worker;
  std::vector<std::string> environment;
  double call_timeout_s = 1;
  std::string list;  // file of implementations

  [[nodiscard]] bool one() const { return !symbol.empty() || !library.empty(); }
  [[nodiscard]] bool any() const { return one() || !list.empty(); }
};

void add_foreign_options(CLI::App& verb, ForeignOptions& o, bool with_list);
// Takes the options out of the words of a verb that reads its own.
[[nodiscard]] ForeignOptions take_foreign_options(std::vector<std::string>& words);

// From now on `function` in `type` is the function of the library.  Throws Failure.
void bind_foreign(const ForeignOptions& o, const std::string& function, const std::string& type);
// Those of the list, of the functions and types that are chosen ("all": all of the list); returns the names
// and tokens that are left of both.  What this processor cannot run is left out, and said.
void bind_list(const ForeignOptions& o, std::string& functions, std::string& types);

// What was found in foreign code beside its errors: on loading, and at arguments of the records.
[[nodiscard]] Verdict foreign_verdict(const std::vector<RowRecord>& records);
// On loading and while running alone.
[[nodiscard]] Verdict foreign_verdict();

}  // namespace ulpgate::app
