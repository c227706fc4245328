// KernelStateCase: one state of a kernel as text for every type, and what is known to be true of it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/core/stress/stress_case.hpp"
#include "harness/core/subject/subject.hpp"
#include "kernels/scenes/reader/expression.hpp"

namespace ulpgate {

// Digits for every expression of a state: all types' roundoffs and sizes beside each other.
using WideReal = MpfrReal<400>;

// A kernel evaluated in one state: what it gave and what RealHP<4> gives, by part and component.
struct KernelPoint {
  Point point;
  std::vector<std::vector<WideReal>> got;
  std::vector<std::vector<WideReal>> exact;  // from the decimals of the point
  std::vector<WideReal> inputs;              // rounded to the type
  double roundoff = 0;

  [[nodiscard]] double of(std::size_t part, std::size_t component) const {
    return static_cast<double>(got[part][component]);
  }
};

// Values of the components of one part that are true whatever the kernel says, as expressions.
struct KnownPart {
  std::size_t part;
  std::vector<std::string> components;
};

struct KernelStateCase {
  std::string name, form, title;
  std::string kernel;
  // One expression a component, separated by blanks: numbers, + - * / ( ), sqrt ..., and
  //   u     2^-p of the type,
  //   huge  its largest number, least its smallest positive one, normal its smallest of full precision,
  //   small 2^(e/2) with e the exponent of `normal`, even: its square is of full precision, that of a
  //   hundredth
  //         of it need not be; large: the same at the other end,
  //   s     the argument of a scan.
  std::string inputs;
  // Arguments s = 2^k for k = 0, step ... scan_end; 0: no scan.  The first that goes wrong is told, and
  // judged.
  int scan_step = 0;
  int scan_end = 0;
  // A closed form for some parts, in the same names, of the numbers before they are rounded to the type.
  std::vector<KnownPart> truth{};
  // What is wrong with the outcome (sign, contact, branch); empty: nothing.
  std::function<std::string(const KernelPoint&)> outcome{};
  std::vector<KnownVerdict> known{};
};

// The expressions' names for a type of a format, at the scan argument 2^scan.
[[nodiscard]] scenes::Evaluator<WideReal> state_names(const FloatFormat& format, int scan);

// Evaluates a kernel at blank-separated expressions.  Throws std::invalid_argument where they are not as many
// as its inputs have components.
[[nodiscard]] KernelPoint evaluate_state(std::string_view kernel, const RealDescriptor& type,
                                         std::string_view inputs, int scan);

// Worst first over the parts: not finite, another outcome, then error against condition.  E and kappa are
// those of the part that decides.
[[nodiscard]] StressRow judge_state(const KernelStateCase& c, const RealDescriptor& type, int scan);

[[nodiscard]] StressCase as_stress_case(KernelStateCase c);

}  // namespace ulpgate
