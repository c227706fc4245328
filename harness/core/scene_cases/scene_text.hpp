// The TOML text of small scenes, a section a function; a scene is the sum of its sections.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ulpgate::scene_text {

// Keys of a section besides those that it always has.  A value is one expression, "0.01+1e-7", or three with
// a comma and a blank between them, "0, 1e-3/2, 0"; what is no number stands as it is: "true", "[0, 1]".
using Keys = std::vector<std::pair<std::string_view, std::string>>;

// "[[facet]]" or "[run]" and its keys, a line each.
[[nodiscard]] std::string section(std::string_view header, const Keys& keys);

// The name of a scene and its only material.
[[nodiscard]] std::string begin(const std::string& scene, const std::string& material, const Keys& keys);
[[nodiscard]] std::string sphere(const std::string& position, const std::string& radius,
                                 const Keys& keys = {});
// A plane across y.
[[nodiscard]] std::string wall(const std::string& y);
[[nodiscard]] std::string contacts(const std::string& law, const Keys& keys = {});
[[nodiscard]] std::string run(const std::string& dt, const std::string& until = "1", const Keys& keys = {});

inline constexpr const char* energy = R"(["energy"])";   // run: record
inline constexpr const char* downwards = "0, -9.81, 0";  // run: gravity, m/s^2

// Two equal balls of 1 cm at these x, 1 m/s each, head on in a visco-elastic contact of 1e-3 s.
[[nodiscard]] std::string head_on_balls(const std::string& restitution, const std::string& x1,
                                        const std::string& x2);

// Two spinning balls of two sizes that meet off centre, by any law, in steps of 4e-7 s.
struct SpinningBalls {
  std::string law, young;      // Pa
  std::string friction_angle;  // degrees
  std::string x2;              // m, of the second one
};
[[nodiscard]] std::string text_of(const SpinningBalls& balls, const std::string& name);

}  // namespace ulpgate::scene_text
