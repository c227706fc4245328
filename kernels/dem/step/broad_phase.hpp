// Broad phase of the collider: sort and sweep over boxes in double, whatever the Real of the simulation.
//
// Candidates decide nothing: a pair becomes a contact by its geometry in Real alone, and contacts are worked
// through in the order of their bodies' numbers.  So the boxes may be in double as long as they are rounded
// outwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ulpgate::dem {

struct CoarseBody {
  std::array<double, 3> low{}, high{};  // box, m, sweep included; infinite where a body has no end
  bool movable = false;                 // pairs of two immovable bodies are no candidates
  bool sphere = false;  // then two spheres are candidates only within the sum of their reaches
  std::array<double, 3> centre{};
  double reach = 0;
};

struct BodyPair {
  std::int32_t first, second;  // first < second
  friend bool operator==(const BodyPair&, const BodyPair&) = default;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

// Keeps its sorted order between calls, so that a re-sort of bodies that hardly moved is cheap.
class BroadPhase {
 public:
  // All candidate pairs, sorted.  Sweep and prune along x (D. Baraff, PhD thesis, Cornell 1992), its active
  // list split into cells of y and z.  False where there are more than `most`: `pairs` is then unspecified.
  [[nodiscard]] bool find(const std::vector<CoarseBody>& bodies, std::vector<BodyPair>& pairs,
                          std::size_t most);

 private:
  void sort_along_x(const std::vector<CoarseBody>& bodies);
  void sort_pairs(std::size_t bodies, std::vector<BodyPair>& pairs);

  std::vector<std::int32_t> order_;
  std::vector<std::int32_t> large_;
  std::vector<std::vector<std::int32_t>> cells_;
  std::vector<std::int32_t> start_;
  std::vector<BodyPair> sorted_;
};

}  // namespace ulpgate::dem
