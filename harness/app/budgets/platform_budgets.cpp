// Budgets of platforms.
#include "harness/app/budgets/platform_budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* platform_file = "platform";
constexpr const char* platforms_directory = "platforms";
constexpr const char* no_fma = "no-fma";

// "1.81.0" is of the series "1.81": patch releases change no bits.
std::string series(const std::string& version) {
  const std::size_t first = version.find('.');
  const std::size_t second = first == std::string::npos ? first : version.find('.', first + 1);
  return version.substr(0, second);
}

// "1.81": digits, a point, digits.
bool is_version(const std::string& text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto point = std::find_if_not(text.begin(), text.end(), digit);
  return point != text.begin() && point != text.end() && *point == '.' && point + 1 != text.end() &&
         std::all_of(point + 1, text.end(), digit);
}

// 1.9 before 1.10.
std::array<int, 2> version_number(const std::string& version) {
  std::array<int, 2> parts{};
  const std::size_t dot = std::min(version.find('.'), version.size());
  std::from_chars(version.data(), version.data() + dot, parts[0]);
  if (dot < version.size())
    std::from_chars(version.data() + dot + 1, version.data() + version.size(), parts[1]);
  return parts;
}

std::string file_text(const Platform& p) {
  return fmt::format("glibc {}\nBoost {}\n{}", p.glibc, p.boost,
                     p.instructions.empty() ? "" : "instructions " + p.instructions + "\n");
}

Platform read_platform(const std::filesystem::path& file) {
  Platform p;
  const auto lines = read_lines(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t space = std::min(lines[i].find(' '), lines[i].size());
    const std::string name = lines[i].substr(0, space);
    const std::string value = lines[i].substr(std::min(space + 1, lines[i].size()));
    std::string* field = name == "glibc"          ? &p.glibc
                         : name == "Boost"        ? &p.boost
                         : name == "instructions" ? &p.instructions
                                                  : nullptr;
    const bool good = field == &p.instructions ? value == no_fma : is_version(value);
    if (field == nullptr || !field->empty() || !good) {
      throw Failure(
          Standing::bad_input,
          fmt::format("{}:{}: '{}' is none of \"glibc 2.36\", \"Boost 1.81\", \"instructions no-fma\"",
                      file.string(), i + 1, lines[i]));
    }
    *field = value;
  }
  if (p.glibc.empty() || p.boost.empty())
    throw Failure(Standing::bad_input, fmt::format("{}: names no glibc and Boost", file.string()));
  return p;
}

// Those that have a directory, each named as its key says.
std::vector<Platform> platforms_below(const std::filesystem::path& root) {
  std::vector<Platform> found;
  const auto directory = root / platforms_directory;
  if (!std::filesystem::is_directory(directory)) return found;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (!entry.is_directory()) continue;
    const Platform p = read_platform(entry.path() / platform_file);
    if (p.key() != entry.path().filename()) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: its file '{}' says {}", entry.path().string(), platform_file, p.key()));
    }
    found.push_back(p);
  }
  std::ranges::sort(found, {}, [](const Platform& p) { return version_number(p.boost); });
  return found;
}

}  // namespace

std::string Platform::key() const {
  return fmt::format("glibc-{}_boost-{}{}", glibc, boost, instructions.empty() ? "" : "_" + instructions);
}

std::string Platform::words() const {
  return fmt::format("glibc {}, Boost {}{}", glibc, boost, instructions.empty() ? "" : ", " + instructions);
}

Platform platform_of(const std::map<std::string, std::string>& facts, const std::string& place) {
  const auto version = [&](const char* library) {
    const auto it = facts.find(library);
    if (it == facts.end())
      throw Failure(Standing::bad_input, fmt::format("{}: names no version of {}", place, library));
    return series(it->second);
  };
  Platform p{version("glibc"), version("Boost"), ""};
  // Where the C library does not tell, nothing is known to differ.
  const auto sets = facts.find("instruction_sets");
  if (sets != facts.end() && !sets->second.empty() &&
      (" " + sets->second + " ").find(" FMA ") == std::string::npos)
    p.instructions = no_fma;
  return p;
}

std::filesystem::path PlatformBudgets::directory_of(const Platform& platform) const {
  const auto top = root / platforms_directory / platform.key();
  return below.empty() || below == "." ? top : top / below;
}

std::filesystem::path PlatformBudgets::overlay_directory() const {
  return overlay ? directory_of(*overlay) : std::filesystem::path();
}

std::string PlatformBudgets::words() const {
  switch (match) {
    case Match::base:
      return fmt::format("budgets of {}", base.words());
    case Match::exact:
      return fmt::format("budgets of {}, over those of {}", here.words(), base.words());
    default:
      return fmt::format(
          "no budgets of {}: those of {} are used, which a few rows may exceed without anything being wrong; "
          "--update --platform auto writes its own",
          here.words(), overlay ? overlay->words() : base.words());
  }
}

std::optional<PlatformBudgets> find_platform_budgets(const std::filesystem::path& budgets,
                                                     const Platform& here) {
  std::error_code code;
  auto start = std::filesystem::weakly_canonical(budgets, code);
  if (code) start = budgets;
  if (!start.has_filename()) start = start.parent_path();
  PlatformBudgets found;
  found.here = here;
  auto at = start;
  int levels = 4;
  while (!std::filesystem::is_regular_file(at / platform_file)) {
    if (--levels == 0 || at == at.parent_path()) return std::nullopt;
    at = at.parent_path();
  }
  // As it was given, where that is possible: shorter to read, and relative where it was.
  found.below = std::filesystem::relative(start, at);
  found.root = budgets;
  if (!found.root.has_filename()) found.root = found.root.parent_path();
  for (auto rest = start; rest != at; rest = rest.parent_path()) {
    if (found.root.filename() != rest.filename()) {
      found.root = at;
      break;
    }
    found.root = found.root.parent_path();
  }
  if (found.root.empty()) found.root = ".";
  found.base = read_platform(at / platform_file);
  if (here == found.base) return found;
  std::vector<Platform> same_libm;
  for (const Platform& p : platforms_below(at)) {
    if (p == here) {
      found.match = PlatformBudgets::Match::exact;
      found.overlay = p;
      return found;
    }
    if (p.glibc == here.glibc && p.instructions == here.instructions) same_libm.push_back(p);
  }
  found.match = PlatformBudgets::Match::other;
  if (found.base.glibc == here.glibc && found.base.instructions == here.instructions) {
    same_libm.push_back(found.base);
    std::ranges::sort(same_libm, {}, [](const Platform& p) { return version_number(p.boost); });
  }
  if (same_libm.empty()) return found;
  found.match = PlatformBudgets::Match::same_libm;
  const auto newer = std::ranges::upper_bound(same_libm, version_number(here.boost), {},
                                              [](const Platform& p) { return version_number(p.boost); });
  const Platform& nearest = newer == same_libm.begin() ? *newer : *(newer - 1);
  if (!(nearest == found.base)) found.overlay = nearest;
  return found;
}

void make_platform(const PlatformBudgets& budgets) {
  const auto directory = budgets.root / platforms_directory / budgets.here.key();
  make_directory(directory);
  write_file(directory / platform_file, file_text(budgets.here));
}

}  // namespace ulpgate::app
