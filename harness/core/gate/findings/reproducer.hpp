// Reproducers: commands that show a row of functions or kernels again.
#pragma once

#include <string>
#include <vector>

#include "harness/core/gate/findings/gate_finding.hpp"

namespace ulpgate {

// "ulpgate at sin double 0x1p+0"
[[nodiscard]] std::string point_reproducer(const std::string& subject, const std::string& type,
                                           const std::vector<std::string>& at);
// "ulpgate math --functions sin --types double --strata uniform,stratified --samples 20000 --seed 1 ...": the
// row with the others of its stratum's draw, at the points of a plan of that size and seed.
[[nodiscard]] std::string row_reproducer(RowKind of, const std::string& subject, const std::string& type,
                                         const std::string& stratum, std::uint64_t samples,
                                         std::uint64_t seed);

// A word as a shell takes it: in single quotes where it holds anything but letters, digits and _-+.,/:=@%.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace ulpgate
