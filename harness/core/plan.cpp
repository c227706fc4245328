// Plan: rows, units and hash.
#include "harness/core/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/core/random_words.hpp"

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

std::string plan_text(const PlanRequest& r) {
  std::vector<std::string_view> functions;
  std::vector<std::string_view> strata;
  for (const auto id : r.functions) functions.push_back(info_of(id).name);
  for (const auto s : r.strata) strata.push_back(name_of(s));
  // Versions of the rules that make arguments and that record errors: raise them when they change.
  return fmt::format(
      "ulpgate math plan\narguments 1\nerrors 3\nunit {}\nseed {}\nsamples {}\ntypes {}\nstrata "
      "{}\nfunctions {}\n"
      "reference full\nworst_cases {:016x}\n",
      unit_size, r.seed, r.samples, fmt::join(r.types, ","), fmt::join(strata, ","),
      fmt::join(functions, ","), fnv1a(r.worst_cases_text));
}

}  // namespace

std::uint64_t Plan::drawn_count(Stratum s, std::uint64_t samples) {
  return s == Stratum::uniform ? samples - samples / 2 : samples / 2;
}

Plan::Plan(PlanRequest request, const WorstCases& worst) : request_(std::move(request)) {
  for (const auto& token : request_.types) {
    const TypeEngine* engine = find_engine(token);
    const FloatFormat format = engine->descriptor().format;
    for (const auto id : request_.functions) {
      const FunctionInfo& f = info_of(id);
      for (const auto s : request_.strata) {
        StratumSource source{s, request_.seed, 0, nullptr};
        if (is_drawn(s)) {
          source.count = drawn_count(s, request_.samples);
        } else {
          ArgumentList list;
          if (s == Stratum::edges) list = edge_arguments(f, format);
          if (s == Stratum::hard) list = hard_arguments(f, format);
          if (s == Stratum::worst) {
            const auto it = worst.find({id, token});
            if (it != worst.end()) list = copy(it->second);
          }
          source.count = list.size();
          source.list = &(lists_[{id, token, s}] = std::move(list));
        }
        if (source.count > 0) rows_.push_back({engine, f, source});
      }
    }
  }
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (std::uint64_t k = 0; k < rows_[row].source.count; k += unit_size) {
      units_.push_back({row, k, std::min(k + unit_size, rows_[row].source.count)});
    }
  }
  // Worst cases answer first: a merge gate that is going to fail should fail early.
  std::stable_partition(units_.begin(), units_.end(),
                        [&](const WorkUnit& u) { return rows_[u.row].source.stratum == Stratum::worst; });
  text_ = plan_text(request_);
  hash_ = fmt::format("{:016x}", fnv1a(text_));
}

}  // namespace ulpgate
