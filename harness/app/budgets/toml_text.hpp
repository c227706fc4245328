// Text for TOML files that are written here.
#pragma once

#include <filesystem>
#include <string>

namespace ulpgate::app {

// A basic string with its quotes.  Throws a Failure (bad input) where the text is no UTF-8, of which no TOML
// file can be made.
[[nodiscard]] std::string toml_quoted(const std::string& text);

// Whether a text is that many hexadecimal digits, as digests are written.
[[nodiscard]] bool is_digest(const std::string& text, std::size_t digits);

// DIR/NAME.toml.  Throws a Failure unless the name is made of letters, digits and ._+- and does not begin
// with a dot: names come from records and must not lead out of the directory.
[[nodiscard]] std::filesystem::path toml_file(const std::filesystem::path& directory,
                                              const std::string& name);

}  // namespace ulpgate::app
