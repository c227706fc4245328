// Plan: rows, units and hash.
#include "harness/core/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/core/arguments/random_words.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

ArgumentList copy(const ArgumentList& list) {
  ArgumentList out;
  for (const auto& point : list) {
    auto& to = out.emplace_back();
    for (const auto& x : point) {
      to.emplace_back(mpfr_get_prec(x.get()));
      mpfr_set(to.back(), x, MPFR_RNDN);
    }
  }
  return out;
}

bool holds(const std::vector<Stratum>& strata, Stratum s) {
  return std::ranges::find(strata, s) != strata.end();
}

// Raise it when the arguments of `narrow` change: the sequence, the blocks or the order of suspicion.
constexpr int narrow_version = 1;

std::string plan_text(const PlanRequest& r) {
  const bool functions = r.kind == SubjectKind::function;
  std::vector<std::string_view> strata;
  for (const auto s : r.strata) strata.push_back(name_of(s));
  std::string units = fmt::format("{}", unit_size);
  if (holds(r.strata, Stratum::exhaustive)) units += fmt::format(" exhaustive {}", exhaustive_unit_size);
  if (holds(r.strata, Stratum::narrow))
    units += fmt::format(" narrow {} {} {}", narrow_version, narrow_share, narrow_unit_size);
  const bool undivided =
      functions && holds(r.strata, Stratum::uniform) != holds(r.strata, Stratum::stratified);
  // Versions of the rules that make arguments and that record errors: raise them when they change.
  std::string text = fmt::format(
      "ulpgate {} plan\n{} 1\nerrors 3\nunit {}\nseed {}\nsamples {}{}\ntypes {}\nstrata {}\n{} {}\n"
      "reference full\n",
      functions ? "math" : "kernel", functions ? "arguments" : "states", units, r.seed, r.samples,
      undivided ? " undivided" : "", fmt::join(r.types, ","), fmt::join(strata, ","),
      functions ? "functions" : "kernels", fmt::join(r.subjects, ","));
  if (functions) text += fmt::format("worst_cases {:016x}\n", fnv1a(r.worst_cases_text));
  // Other code is another plan: whichever it is, and whichever build.
  for (const auto& token : r.types) {
    for (const auto& name : r.subjects) {
      const SubjectInfo& info = find_subject(name, token)->info();
      if (info.selection.empty()) continue;
      text += fmt::format("code {} {}{}", token, name, info.selection);
      for (const auto& [what, value] : info.code_facts) text += fmt::format(" {}={}", what, value);
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::uint64_t drawn_count(SubjectKind kind, Stratum s, std::uint64_t samples,
                          const std::vector<Stratum>& chosen) {
  if (kind == SubjectKind::kernel) return samples;
  if (s == Stratum::narrow) return (samples + narrow_share - 1) / narrow_share;
  const bool shared = holds(chosen, Stratum::uniform) && holds(chosen, Stratum::stratified);
  if (s != Stratum::binades && !shared) return samples;
  return s == Stratum::uniform ? samples - samples / 2 : samples / 2;
}

Plan::Plan(PlanRequest request, const WorstCases& worst) : request_(std::move(request)) {
  for (const auto& token : request_.types) {
    for (const auto& name : request_.subjects) {
      const Subject* subject = find_subject(name, token);
      for (const auto s : request_.strata) {
        StratumSource source{s, request_.seed, 0, nullptr};
        if (s == Stratum::exhaustive) {
          source.count = subject->can_exhaust() ? exhaustive_count : 0;
        } else if (s == Stratum::narrow && subject->narrow_arguments() == 0) {
          continue;
        } else if (is_drawn(s)) {
          source.count = drawn_count(request_.kind, s, request_.samples, request_.strata);
        } else {
          ArgumentList list = subject->listed(s);
          if (s == Stratum::worst) {
            const auto it = worst.find({name, token});
            if (it != worst.end()) list = copy(it->second);
          }
          source.count = list.size();
          source.list = &(lists_[{name, token, s}] = std::move(list));
        }
        if (source.count > 0) rows_.push_back({subject, source});
      }
    }
  }
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::uint64_t size = unit_size_of(rows_[row].source.stratum);
    for (std::uint64_t k = 0; k < rows_[row].source.count; k += size) {
      units_.push_back({row, k, std::min(k + size, rows_[row].source.count)});
    }
  }
  // Worst cases answer first: a merge gate that is going to fail should fail early.
  std::stable_partition(units_.begin(), units_.end(),
                        [&](const WorkUnit& u) { return rows_[u.row].source.stratum == Stratum::worst; });
  text_ = plan_text(request_);
  hash_ = fmt::format("{:016x}", fnv1a(text_));
}

}  // namespace ulpgate
