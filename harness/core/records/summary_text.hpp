// Summary as one line of text and back, exact to the last bit: what a checkpoint keeps of finished units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "harness/core/records/summary.hpp"

namespace ulpgate {

// Words separated by single blanks, without line breaks; doubles as hexfloats.
[[nodiscard]] std::string summary_to_text(const Summary& s);
// Nothing unless the text is one that summary_to_text gives.
[[nodiscard]] std::optional<Summary> summary_from_text(std::string_view text);

}  // namespace ulpgate
