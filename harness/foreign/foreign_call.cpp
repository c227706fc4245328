// ForeignCall.
#include "harness/foreign/foreign_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <list>
#include <memory>

#include "harness/foreign/foreign_failure.hpp"

namespace ulpgate {

namespace {

// Workers that a thread keeps.
constexpr std::size_t most_workers = 4;

struct Kept {
  std::uint64_t id;
  std::unique_ptr<WorkerProcess> worker;
};
// Of this thread, the latest first.
std::list<Kept>& kept() {
  thread_local std::list<Kept> list;
  return list;
}

}  // namespace

std::size_t size_of(char element) {
  return element == 'f'   ? sizeof(float)
         : element == 'd' ? sizeof(double)
         : element == 'l' ? sizeof(long double)
                          : 16;
}
// Of those that hold the value: an x87 number is followed by bytes that say nothing.
std::size_t value_bytes(char element) {
  if (element == 'l' && std::numeric_limits<long double>::digits == 64) return 10;
  return size_of(element);
}

ForeignCall::ForeignCall(ForeignSpec spec, const ForeignShape& shape)
    : spec_(std::move(spec)), shape_(shape) {
  static std::atomic<std::uint64_t> next{0};
  id_ = next++;
  if (spec_.signature.empty())
    spec_.signature = default_signature(spec_.symbol, shape_.element, shape_.arity);
  const auto refuse = [&](const std::string& why) {
    throw ForeignFailure(fmt::format("{}: signature '{}' {}", spec_.symbol, spec_.signature, why));
  };
  if (ulpgate_parse_signature(spec_.signature.c_str(), &signature_) == 0)
    refuse("is none (such as d(d), d(d,d), v4d(v4d), void(n,d*,d*), void(d,d*,d*), d(d,i*))");
  if (signature_.element != shape_.element)
    refuse(fmt::format("is of another type than the function's: '{}' is wanted", shape_.element));
  if (signature_.arguments != shape_.arity)
    refuse(fmt::format("has {} argument(s), the function {}", signature_.arguments, shape_.arity));
  program_ = spec_.worker.empty() ? worker_program() : spec_.worker;
}

WorkerProcess& ForeignCall::worker() const {
  auto& all = kept();
  const auto it = std::ranges::find(all, id_, &Kept::id);
  if (it != all.end()) {
    all.splice(all.begin(), all, it);
  } else {
    all.push_front({id_, std::make_unique<WorkerProcess>(spec_, program_)});
    if (all.size() > most_workers) all.pop_back();
  }
  return *all.front().worker;
}

void ForeignCall::drop_worker() const {
  kept().remove_if([&](const Kept& k) { return k.id == id_; });
}

}  // namespace ulpgate
