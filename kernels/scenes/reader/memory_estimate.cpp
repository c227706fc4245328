// What a scene takes in memory.
#include "kernels/scenes/reader/memory_estimate.hpp"

#include <array>
#include <cstdio>

namespace ulpgate::scenes {

namespace {

std::string gigabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g GB", bytes / 1e9);
  return text.data();
}

}  // namespace

void refuse_large(const std::string& what, std::uint64_t count, std::uint64_t most, std::uint64_t bytes_each,
                  bool allow_large) {
  if (count > most)
    throw SceneTooLarge(what + ": " + std::to_string(count) + " are more than the " + std::to_string(most) +
                        " that can be numbered");
  const double bytes = static_cast<double>(count) * static_cast<double>(bytes_each);
  if (!allow_large && bytes > static_cast<double>(most_bytes))
    throw SceneTooLarge(what + ": " + std::to_string(count) + " need about " + gigabytes(bytes) +
                        ", more than the " + gigabytes(static_cast<double>(most_bytes)) +
                        " that are taken without being asked for");
}

}  // namespace ulpgate::scenes
