// The lines of a checkpoint's files.
#include "harness/app/store/checkpoint_text.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>

#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/records/summary_text.hpp"

namespace ulpgate::app {

namespace {

std::string hex_bits(double x) {
  return fmt::format("{:x}", std::bit_cast<std::uint64_t>(x));
}

template <class Integer>
bool parse(std::string_view word, Integer& n, int base = 10) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n, base);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

std::string joined(const std::vector<Summary>& summaries) {
  std::string text;
  for (const auto& s : summaries) text += ";" + summary_to_text(s);
  return text;
}

// "a-b,c-d" as positions; nothing where one is not of the row or is out of order.
std::optional<std::vector<std::size_t>> positions_of(const std::string& text, std::size_t row,
                                                     const ShardUnits& units) {
  std::vector<std::size_t> positions;
  for (const auto& range : split(text, ',')) {
    const auto ends = split(range, '-');
    std::size_t first = 0;
    std::size_t last = 0;
    if (ends.size() != 2 || !parse(ends[0], first) || !parse(ends[1], last) || last >= units.size() ||
        first > last || (!positions.empty() && first <= positions.back())) {
      return std::nullopt;
    }
    for (std::size_t p = first; p <= last; ++p) {
      if (units[p].row != row) return std::nullopt;
      positions.push_back(p);
    }
  }
  return positions;
}

}  // namespace

std::string with_checksum(const std::string& payload) {
  return fmt::format("{:016x} {}\n", fnv1a(payload), payload);
}

std::vector<CheckedLine> checked_lines(std::string_view text) {
  std::vector<CheckedLine> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    std::uint64_t checksum = 0;
    const bool whole = end != std::string_view::npos && line.size() > 17 && line[16] == ' ' &&
                       parse(line.substr(0, 16), checksum, 16) && checksum == fnv1a(line.substr(17));
    lines.push_back({whole ? std::optional<std::string>(line.substr(17)) : std::nullopt});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string unit_payload(std::size_t position, double seconds, const std::vector<Summary>& summaries) {
  return fmt::format("u {} {}{}", position, hex_bits(seconds), joined(summaries));
}

std::optional<FinishedUnit> unit_from_payload(std::string_view payload) {
  const auto fields = split(std::string(payload), ';');
  const auto words = split(fields.empty() ? "" : fields[0], ' ');
  FinishedUnit unit;
  std::uint64_t bits = 0;
  if (fields.size() < 2 || words.size() != 3 || words[0] != "u" || !parse(words[1], unit.position) ||
      !parse(words[2], bits, 16)) {
    return std::nullopt;
  }
  unit.seconds = std::bit_cast<double>(bits);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    auto s = summary_from_text(fields[i]);
    if (!s) return std::nullopt;
    unit.summaries.push_back(std::move(*s));
  }
  return unit;
}

std::string row_payload(std::size_t row, const UnitProgress::Row& progress,
                        const std::vector<std::size_t>& done) {
  std::string ranges;
  for (std::size_t i = 0; i < done.size();) {
    std::size_t j = i;
    while (j + 1 < done.size() && done[j + 1] == done[j] + 1) ++j;
    ranges += fmt::format("{}{}-{}", ranges.empty() ? "" : ",", done[i], done[j]);
    i = j + 1;
  }
  return fmt::format("r {} {} {}{}", row, hex_bits(progress.seconds), ranges, joined(progress.parts));
}

bool take_line(std::string_view payload, const ShardUnits& units, UnitProgress& progress) {
  const auto fields = split(std::string(payload), ';');
  if (fields.size() < 2) return false;
  const auto words = split(fields[0], ' ');
  std::uint64_t bits = 0;
  std::size_t number = 0;
  if (words.size() < 3 || !parse(words[1], number) || !parse(words[2], bits, 16)) return false;

  std::size_t row = number;
  std::vector<std::size_t> positions;
  if (words[0] == "u" && words.size() == 3 && number < units.size()) {
    positions.push_back(number);
    row = units[number].row;
  } else if (words[0] == "r" && words.size() == 4 && row < progress.rows.size()) {
    const auto found = positions_of(words[3], row, units);
    if (!found) return false;
    positions = *found;
  }
  std::uint64_t points = 0;
  std::size_t known = 0;
  for (const auto p : positions) {
    points += units.points(p);
    known += progress.done[p] ? 1U : 0U;
  }
  if (points == 0) return false;
  // A process that was killed between done.txt and the new log leaves its last units in both.
  if (known > 0) return known == positions.size();

  std::vector<Summary> summaries;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    auto s = summary_from_text(fields[i]);
    if (!s || s->samples != points) return false;
    summaries.push_back(std::move(*s));
  }
  auto& parts = progress.rows[row].parts;
  if (!parts.empty() && parts.size() != summaries.size()) return false;
  progress.rows[row].add(summaries, std::bit_cast<double>(bits), points);
  for (const auto p : positions) progress.done[p] = true;
  return true;
}

}  // namespace ulpgate::app
