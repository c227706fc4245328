// Lines that fit a terminal, columns, colour.
#include "harness/app/terminal/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace ulpgate::app {

namespace {

constexpr char escape = '\033';

// Nothing where there is no terminal, or one that does not tell.
std::optional<std::size_t> terminal_width() {
  winsize size{};
  if (::isatty(STDOUT_FILENO) != 1 || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return std::nullopt;
  return size.ws_col;
}

bool has_colour(std::FILE* stream) {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return ::isatty(::fileno(stream)) == 1 && !set("NO_COLOR") && set("TERM") &&
         std::string_view(std::getenv("TERM")) != "dumb";
}

const char* code_of(Paint paint) {
  switch (paint) {
    case Paint::good:
      return "32";
    case Paint::bad:
      return "1;31";
    case Paint::note:
      return "33";
  }
  return "0";
}

// The bytes of the escape at the head of the text, 0 where there is none: ESC [ digits and semicolons, a
// letter.
std::size_t escape_at(std::string_view text) {
  if (text.size() < 2 || text[0] != escape || text[1] != '[') return 0;
  const auto end = std::ranges::find_if(text.substr(2), [](char c) { return c >= '@' && c <= '~'; });
  return static_cast<std::size_t>(end - text.begin()) + (end == text.end() ? 0 : 1);
}

bool begins_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

// Where a line that is too wide may be broken, and where it goes on.
struct Places {
  std::size_t last = 0;    // the byte of the last space that leaves a line of at most the width; 0: none
  std::size_t indent = 0;  // columns
};

Places places_of(std::string_view line, std::size_t width, std::size_t command) {
  Places found;
  std::size_t column = 0;
  std::size_t spaces = 0;
  bool text = false;
  for (std::size_t i = 0; i < line.size();) {
    if (const std::size_t bytes = escape_at(line.substr(i)); bytes > 0) {
      i += bytes;
      continue;
    }
    if (line[i] == ' ') {
      if (text && column <= width && i < command) found.last = i;
      ++spaces;
    } else {
      // The first text is no column that the rest could go below of: it goes in by two.
      if (!text) found.indent = column + 2;
      if (text && spaces >= 2 && column <= width / 2) found.indent = column;
      text = true;
      spaces = 0;
    }
    if (begins_character(line[i])) ++column;
    ++i;
  }
  return found;
}

std::string fitted_line(std::string_view line, std::size_t width) {
  std::string text;
  std::size_t indent = 0;
  std::string rest(line);
  while (columns_of(rest) > width) {
    // Spaces before a command may be broken at, none in it.
    const std::size_t command = std::min(rest.find("ulpgate "), rest.size());
    const Places places = places_of(rest, width, command);
    if (text.empty()) indent = std::min(places.indent, width / 2);
    if (places.last == 0) break;
    const std::size_t end = rest.find_last_not_of(' ', places.last);
    text += rest.substr(0, end + 1) + "\n";
    rest.erase(0, rest.find_first_not_of(' ', places.last));
    // A long word stands further to the left rather than beyond the edge.
    const std::size_t word = columns_of(std::string_view(rest).substr(0, rest.find(' ')));
    rest.insert(0, std::min(indent, width > word ? width - word : 0), ' ');
  }
  return text + rest;
}

}  // namespace

std::string painted(Paint paint, const std::string& text, std::FILE* stream) {
  if (!has_colour(stream)) return text;
  return fmt::format("{0}[{1}m{2}{0}[0m", escape, code_of(paint), text);
}

std::size_t columns_of(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) {
    const std::size_t bytes = escape_at(text);
    if (bytes == 0 && begins_character(text.front())) ++columns;
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return columns;
}

std::string fitted(std::string_view text, std::size_t width) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines += fitted_line(text.substr(0, end), width);
    if (end == std::string_view::npos) break;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows, std::string_view sides) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths[i] - columns_of(row[i]), ' ');
      const bool right = i < sides.size() && sides[i] == 'r';
      text += (i == 0 ? "" : "  ") + (right ? fill + row[i] : row[i]);
      // No line ends in spaces.
      if (!right && i + 1 < row.size()) text += fill;
    }
    text += '\n';
  }
  return text;
}

void show_text(std::string_view text) {
  const auto width = terminal_width();
  const std::string shown = width ? fitted(text, *width) : std::string(text);
  fmt::print("{}", shown);
}

}  // namespace ulpgate::app
