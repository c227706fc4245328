// Strict options: how numbers and words on the command line are read, the same for every verb.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace ulpgate::app {

// What is wrong with `text` as a whole number, signed where `negative` may be: empty, a sign, other
// characters, a leading zero (which some read as octal) or more than 64 bits.  Empty where nothing is.
[[nodiscard]] std::string count_fault(const std::string& text, bool negative = false);
// The same for a finite decimal or hexadecimal floating-point number.
[[nodiscard]] std::string real_fault(const std::string& text);

// Makes every option of `app` and its subcommands that holds a number refuse a text with a fault, and every
// option that takes a value refuse an empty one.  Called once, when all verbs are there: none can be
// forgotten.
void make_options_strict(CLI::App& app);

}  // namespace ulpgate::app
