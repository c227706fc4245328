// The lines of a checkpoint's files, and their names: checksums, units and rows as text.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/app/store/checkpoint.hpp"

namespace ulpgate::app {

// Both kinds of checkpoint keep what is done, and a log of what was done since.
inline constexpr const char* done_file = "done.txt";
inline constexpr const char* log_file = "log.txt";
// What a power failure may lose, beyond what a killed process may.
inline constexpr auto sync_interval = std::chrono::seconds(5);

// "<16 hexadecimal digits of FNV-1a> payload\n".
[[nodiscard]] std::string with_checksum(const std::string& payload);

struct CheckedLine {
  std::optional<std::string> payload;  // none where the checksum is wrong or the line ends without its break
};
[[nodiscard]] std::vector<CheckedLine> checked_lines(std::string_view text);

// "u position seconds parts;summary;..."
[[nodiscard]] std::string unit_payload(std::size_t position, double seconds,
                                       const std::vector<Summary>& summaries);
// And back; nothing where the text is no such line.
struct FinishedUnit {
  std::size_t position = 0;
  double seconds = 0;
  std::vector<Summary> summaries;
};
[[nodiscard]] std::optional<FinishedUnit> unit_from_payload(std::string_view payload);
// "r row seconds a-b,c-d;summary;...": the positions of its units that are done, as ranges.
[[nodiscard]] std::string row_payload(std::size_t row, const UnitProgress::Row& progress,
                                      const std::vector<std::size_t>& done);

// Takes one line over into `progress`; units that are there already are left as they are.  False where the
// line is no unit or row of this shard.
[[nodiscard]] bool take_line(std::string_view payload, const ShardUnits& units, UnitProgress& progress);

}  // namespace ulpgate::app
