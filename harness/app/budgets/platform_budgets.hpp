// Budgets of platforms: which directories of budgets hold for the libraries that records were measured with.
//
// ROOT/platform names the platform of the budgets below ROOT, the base: "glibc 2.36" and "Boost 1.81", a line
// each.  ROOT/platforms/<key>/ holds the rows of another platform that differ, at the same path below it:
// those of ROOT/kernels/double.toml stand in ROOT/platforms/<key>/kernels/double.toml.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace ulpgate::app {

struct Platform {
  std::string glibc;  // "2.36"
  std::string boost;  // "1.81"
  // "", or "no-fma" where the C library has no fused multiply-add to choose variants by: other bits.
  std::string instructions;
  friend bool operator==(const Platform&, const Platform&) = default;

  // "glibc-2.36_boost-1.81", "glibc-2.36_boost-1.81_no-fma"
  [[nodiscard]] std::string key() const;
  // "glibc 2.36, Boost 1.81"
  [[nodiscard]] std::string words() const;
};

// From the facts of a context that decide bits (deciding_facts).  Throws a Failure of bad_input, which begins
// with `place`, where they do not name both libraries.
[[nodiscard]] Platform platform_of(const std::map<std::string, std::string>& facts, const std::string& place);

struct PlatformBudgets {
  std::filesystem::path root;
  Platform base;
  Platform here;
  enum class Match { base, exact, same_libm, other } match = Match::base;
  // The platform whose rows are laid over the base; nothing: none is.
  std::optional<Platform> overlay;
  std::filesystem::path below;  // of the budgets, below the root

  // Where rows of a platform stand; that directory need not exist.
  [[nodiscard]] std::filesystem::path directory_of(const Platform& platform) const;
  // What is laid over the base; empty where nothing is.
  [[nodiscard]] std::filesystem::path overlay_directory() const;
  // Which budgets are used, in words.
  [[nodiscard]] std::string words() const;
};

// Looks for ROOT from `budgets` upwards, four levels at most; nothing where no file "platform" is found: such
// budgets know no platform.  The order in which platforms are looked for: the same key; the same C library
// with another Boost, the newest that is not newer, else the oldest; the base.  Throws a Failure of bad_input
// where a file "platform" or the name of a platform's directory is none.
[[nodiscard]] std::optional<PlatformBudgets> find_platform_budgets(const std::filesystem::path& budgets,
                                                                   const Platform& here);

// Makes the directory of the platform `here` and the file in it that names it.
void make_platform(const PlatformBudgets& budgets);

}  // namespace ulpgate::app
