// Fuzz target: scene files, their expressions and overrides; what is read is assembled in double.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "kernels/scenes/reader/assemble.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "reference/types/mpfr_value.hpp"

namespace {

// Whether it has so few bodies that an input takes no seconds.
bool is_small(const ulpgate::scenes::Scene& scene) {
  using ulpgate::scenes::GeneratorKind;
  std::int64_t bodies = 0;
  for (const auto& g : scene.generators) {
    if (g.kind == GeneratorKind::hexagonal_ball) return false;  // as many as its radii say
    for (const int n : g.counts) {
      if (n < 1 || n > 10) return false;
    }
    bodies += 1000;
  }
  return bodies <= 2000;
}

}  // namespace

// The first line is an override such as "dt=1e-6", the rest a scene.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ulpgate::MpfrThread mpfr;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find('\n');
  if (end == std::string_view::npos) return 0;
  auto [scene, errors] = ulpgate::scenes::read_scene(input.substr(end + 1), "input.toml");
  if (scene.has_value() != errors.empty()) throw std::logic_error("a scene with errors, or none without");
  for (const auto& error : errors) {
    if (error.text().empty() || error.message.empty()) throw std::logic_error("an error without a text");
  }
  if (!scene) return 0;
  static_cast<void>(ulpgate::scenes::apply_override(*scene, input.substr(0, end)));
  if (!is_small(*scene)) return 0;
  try {
    static_cast<void>(ulpgate::scenes::assemble<double>(*scene));
  } catch (const ulpgate::scenes::SceneFault& e) {
    // It names the key or the body.
    if (*e.what() == '\0') throw std::logic_error("a fault without a text");
  }
  return 0;
}
