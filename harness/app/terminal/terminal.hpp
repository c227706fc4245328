// What people read: lines that fit a terminal, columns, colour where there is some.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ulpgate::app {

enum class Paint { good, bad, note };

// The text in colour, or as it is: where the stream is no terminal, TERM is "dumb" or not set, or NO_COLOR is
// set to anything but nothing.  The escapes take no column: pad before painting.
std::string painted(Paint paint, const std::string& text, std::FILE* stream = stdout);

// How many columns a text takes: escapes none, any other character of UTF-8 one.
std::size_t columns_of(std::string_view text);

// Every line that is wider than `width` columns is broken between words and goes on below its last column
// (text after two spaces or more) of the left half.  Text from "ulpgate " on is a command and stays
// whole, as does a word that is wider than the line.
std::string fitted(std::string_view text, std::size_t width);

// Rows as columns, two spaces between them, each as wide as its widest cell.  `sides`: 'l' or 'r' for each
// column, and for those beyond it 'l'.  A row may have fewer cells than others.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::string_view sides);

// Text to standard output: fitted to the terminal if it is one, else byte for byte.
void show_text(std::string_view text);

template <class... Args>
void show(fmt::format_string<Args...> format, Args&&... args) {
  show_text(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace ulpgate::app
