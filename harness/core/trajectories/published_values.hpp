// End values of initial value problems in print, and how far they hold against the true solutions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/core/trajectories/truth.hpp"

namespace ulpgate {

struct PublishedValue {
  std::string problem;
  std::string end;
  std::size_t component;  // from 0
  std::string value;      // as printed, up to the place of the point
  std::string source;
};
[[nodiscard]] const std::vector<PublishedValue>& published_values();

enum class PublishedStanding {
  to_the_last,  // off by one unit of the last digit that is compared, at most
  in_part,      // more than half of the compared digits hold
  wrong,
};

struct PublishedAgreement {
  PublishedStanding standing = PublishedStanding::wrong;
  int printed = 0;    // significant digits in print; 0 of a printed zero
  int compared = 0;   // as many of them as the truth has
  double digits = 0;  // that hold, -log10 of the relative difference, from 0 to `compared`
};

// A printed zero holds to the last where the component is below 1e-20 of the solution's largest one, which is
// what the digits of an orbit's constants leave of it, and what underflows beside the others.  Throws
// std::out_of_range for a component that the truth does not have.
[[nodiscard]] PublishedAgreement agreement_with_truth(const PublishedValue& published,
                                                      std::span<const TrueValue> truth);

}  // namespace ulpgate
