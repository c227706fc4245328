// Plan: rows, units and hash.
#include "harness/core/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/core/arguments/random_words.hpp"

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
  std::string units = fmt::format("{}", unit_size);
  if (std::ranges::find(r.strata, Stratum::exhaustive) != r.strata.end())
    units += fmt::format(" exhaustive {}", exhaustive_unit_size);
  // Versions of the rules that make arguments and that record errors: raise them when they change.
  return fmt::format(
      "ulpgate math plan\narguments 1\nerrors 3\nunit {}\nseed {}\nsamples {}\ntypes {}\nstrata "
      "{}\nfunctions {}\n"
      "reference full\nworst_cases {:016x}\n",
      units, r.seed, r.samples, fmt::join(r.types, ","), fmt::join(strata, ","), fmt::join(functions, ","),
      fnv1a(r.worst_cases_text));
}

}  // namespace

bool Plan::can_exhaust(const FunctionInfo& f, std::string_view type) {
  return type == "float" && f.function_class == FunctionClass::real && f.arity == 1;
}

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
        if (s == Stratum::exhaustive) {
          source.count = can_exhaust(f, token) ? exhaustive_count : 0;
        } else if (is_drawn(s)) {
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
