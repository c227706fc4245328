// What finished records come to by themselves.
#include "harness/app/run/record_verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/core/functions/oracle_defects.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

Verdict oracle_verdict(const std::vector<RowRecord>& records) {
  std::uint64_t compared = 0;
  std::uint64_t explained = 0;
  Verdict verdict;
  for (const auto& r : records) {
    compared += r.summary.oracle.compared;
    if (r.summary.oracle.disagreed == 0) continue;
    const auto function = find_function(r.subject);
    if (function && known_oracle_defect(*function, r.type)) {
      explained += r.summary.oracle.disagreed;
      continue;
    }
    verdict |= Standing::regression;
    std::string args;
    for (const auto& a : r.points.oracle_argmax) args += " " + a;
    fmt::print(stderr,
               "ulpgate: the oracles disagree: {} {} {} {}: RealHP<4> and MPFR differ by up to {:.3g} ULP of "
               "the type in {} "
               "of {} samples, most at{}\n",
               r.subject, r.part, r.type, r.stratum, r.summary.oracle.difference.value,
               r.summary.oracle.disagreed, r.summary.oracle.compared, args);
  }
  if (compared == 0) return verdict;
  fmt::print(stderr, "ulpgate: oracles compared on {} results; {} differ by known defects of a RealHP<4>\n",
             compared, explained);
  return verdict;
}

Verdict claim_verdict(const std::vector<RowRecord>& records) {
  Verdict verdict;
  for (const auto& r : records) {
    // The records may be of a program with more types than this one.
    const Subject* subject = find_subject(r.subject, r.type);
    if (subject == nullptr) continue;
    const auto claim = subject->info().claimed_ulp;
    if (!claim || r.summary.judged() == 0 || r.summary.max_error.value <= *claim) continue;
    verdict |= Standing::regression;
    fmt::print(
        stderr,
        "ulpgate: {} {} of {} is claimed to be off by at most {} ULP and is off by {}: ulpgate at {} {} "
        "{}{}\n",
        r.subject, r.type, r.implementation, *claim, r.summary.max_error.value, r.subject, r.type,
        fmt::join(r.points.argmax, " "), subject->info().selection);
  }
  return verdict;
}

}  // namespace ulpgate::app
