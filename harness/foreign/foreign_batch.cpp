// ForeignBatch.
#include "harness/foreign/foreign_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>

#include "harness/foreign/foreign_failure.hpp"

namespace ulpgate {

namespace {

constexpr std::uint8_t threw_of(Outcome o) {
  return static_cast<std::uint8_t>(static_cast<int>(o) - static_cast<int>(Outcome::exception) + 1);
}

// Larger batches are those of exhaustive runs, where the second evaluation is of one point in so many.
constexpr std::size_t whole_again = 2048;
constexpr std::size_t stride_again = 64;
// Lanes whose neighbours are replaced by numbers that vector code likes least, in a batch.
constexpr std::size_t lanes_again = 16;
// A call that hangs costs its timeout: more than this in a batch is no run.
constexpr int most_hangs = 8;
template <class T>
void put(unsigned char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}
// What neighbours are made of: NaN, infinities, the smallest and the largest numbers, zeros.
void put_poison(unsigned char* to, char element, std::size_t which) {
  const auto of = [&]<class T>(T) {
    using L = std::numeric_limits<T>;
    const std::array<T, 7> values = {L::quiet_NaN(), L::infinity(), -L::infinity(),  L::denorm_min(),
                                     L::max(),       T(0),          -L::denorm_min()};
    put(to, values[which % values.size()]);
  };
  if (element == 'f') of(0.0F);
  if (element == 'd') of(0.0);
}

bool is_nan(const unsigned char* value, char element) {
  const auto of = [&]<class T>(T x) {
    std::memcpy(&x, value, value_bytes(element));
    return x != x;
  };
  switch (element) {
    case 'f':
      return of(0.0F);
    case 'd':
      return of(0.0);
    case 'l':
      return of(0.0L);
    default:
      break;
  }
#ifdef ULPGATE_HAVE_FLOAT128
  return of(__float128(0));
#else
  return false;
#endif
}

// One behind the other, with none left out.
bool side_by_side(std::span<const std::uint32_t> points) {
  // Orders are those of the batch or turned round: two and the ends tell.
  if (points.size() < 2) return true;
  return points[1] == points[0] + 1 && points.back() - points.front() == points.size() - 1;
}

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

}  // namespace

bool ForeignBatch::run() {
  const std::size_t count = troubles_.size();
  const std::size_t size = call_.size();
  // Kept by the thread: pages of a fresh one would cost more than the calls.
  thread_local std::vector<std::uint32_t> in_order;
  thread_local std::vector<std::uint32_t> order;
  for (std::size_t i = in_order.size(); i < count; ++i) in_order.push_back(static_cast<std::uint32_t>(i));
  evaluate_all(Points(in_order).first(count),
               [&](Points points, const unsigned char* from, std::size_t stride) {
                 // The first pass is in order, and most functions have one result.
                 if (stride == size && side_by_side(points)) {
                   std::memcpy(&values_[points.front() * size], from, points.size() * size);
                   return;
                 }
                 for (std::size_t slot = 0; slot < points.size(); ++slot)
                   std::memcpy(&values_[points[slot] * size], from + slot * stride, size);
               });
  // What gave a value once more, in another order and in other lanes.
  const std::size_t stride = count <= whole_again ? 1 : stride_again;
  order.clear();
  for (std::size_t i = 0; i < count; i += stride)
    if (troubles_[i] == 0) order.push_back(static_cast<std::uint32_t>(i));
  std::ranges::reverse(order);
  if (call_.lanes() > 1 && order.size() > 1) std::rotate(order.begin(), order.begin() + 1, order.end());
  std::vector<std::uint32_t> differing;
  evaluate_all(order, [&](Points points, const unsigned char* from, std::size_t stride) {
    for (std::size_t slot = 0; slot < points.size(); ++slot)
      if (!same(&values_[points[slot] * size], from + slot * stride)) differing.push_back(points[slot]);
  });
  look_at_lanes(order, differing);
  if (!differing.empty()) explain(differing);
  return std::ranges::all_of(troubles_, [](std::uint8_t t) { return t == 0; });
}

bool ForeignBatch::same(const unsigned char* a, const unsigned char* b) const {
  const char e = call_.shape().element;
  return std::memcmp(a, b, value_bytes(e)) == 0 || (is_nan(a, e) && is_nan(b, e));
}

void ForeignBatch::put_arguments(ulpgate_channel& c, std::size_t slot, std::uint32_t i) const {
  const std::size_t bytes = call_.arity() * call_.size();
  std::memcpy(c.arguments + slot * bytes, args_ + i * bytes, bytes);
}

void ForeignBatch::put_all_arguments(ulpgate_channel& c, Points points) const {
  const std::size_t bytes = call_.arity() * call_.size();
  if (side_by_side(points)) {
    std::memcpy(c.arguments, args_ + points.front() * bytes, points.size() * bytes);
    return;
  }
  for (std::size_t slot = 0; slot < points.size(); ++slot) put_arguments(c, slot, points[slot]);
}

void ForeignBatch::give_trouble(std::uint32_t i, Outcome o) {
  if (troubles_[i] == 0) troubles_[i] = threw_of(o);
  if (o == Outcome::hang && ++hangs_ > most_hangs) {
    throw ForeignHangs(fmt::format(
        "{} {} hangs at more than {} of {} arguments, each for {:g} s of processor time",
        call_.spec().library, call_.spec().symbol, most_hangs, troubles_.size(), call_.spec().timeout_s));
  }
}

void ForeignBatch::evaluate_all(Points points, const Take& take) {
  for (std::size_t first = 0; first < points.size(); first += ulpgate_channel_points) {
    const std::size_t n = std::min<std::size_t>(ulpgate_channel_points, points.size() - first);
    evaluate(points.subspan(first, n), take, ulpgate_worker_whole);
  }
}

void ForeignBatch::take_answers(Points points, const WorkerProcess& worker, const Take& take) {
  const ulpgate_channel& c = worker.channel();
  if (c.changed == 0) return take(points, call_.result(c, 0), call_.stride());
  std::vector<std::uint32_t> suspects;
  for (std::size_t slot = 0; slot < points.size(); ++slot) {
    if (c.changed_points[slot] == 0) {
      take(points.subspan(slot, 1), call_.result(c, slot), call_.stride());
    } else {
      suspects.push_back(points[slot]);
    }
  }
  for (const auto i : suspects) settle_environment(i, take);
}

void ForeignBatch::evaluate(Points points, const Take& take, ulpgate_worker_mode mode) {
  const bool arrays = call_.signature().shape == ulpgate_shape_arrays;
  const std::size_t size = call_.size();
  while (!points.empty()) {
    WorkerProcess& worker = call_.worker();
    ulpgate_channel& c = worker.channel();
    put_all_arguments(c, points);
    const WorkerEnd end = worker.request(static_cast<std::uint32_t>(points.size()), mode);
    if (end == WorkerEnd::answered && (c.changed == 0 || mode == ulpgate_worker_singly))
      return take_answers(points, worker, take);
    if (end == WorkerEnd::answered) {
      mode = ulpgate_worker_singly;
      continue;
    }
    const Outcome outcome = end == WorkerEnd::hung ? Outcome::hang : Outcome::crash;
    const auto at = std::min<std::size_t>(c.progress, points.size() - 1);
    // What stands before the point that it is at is done; of arrays nothing is.
    std::vector<unsigned char> done(arrays ? 0 : at * size);
    for (std::size_t slot = 0; slot * size < done.size(); ++slot)
      std::memcpy(&done[slot * size], call_.result(c, slot), size);
    call_.drop_worker();
    if (points.size() == 1) return give_trouble(points.front(), outcome);
    if (arrays) {
      evaluate(points.first(points.size() / 2), take, mode);
      points = points.subspan(points.size() / 2);
      continue;
    }
    if (mode == ulpgate_worker_singly) {
      // Which of them left another environment went with the process.
      evaluate(points.first(at), take, mode);
    } else {
      if (at > 0) take(points.first(at), done.data(), size);
    }
    const std::size_t group = std::min(call_.lanes(), points.size() - at);
    settle_group(points.subspan(at, group), take, outcome);
    points = points.subspan(at + group);
  }
}

void ForeignBatch::settle_group(Points group, const Take& take, Outcome outcome) {
  if (group.size() == 1) return give_trouble(group.front(), outcome);
  for (std::size_t j = 0; j < group.size(); ++j) evaluate(group.subspan(j, 1), take, ulpgate_worker_whole);
  // None does so alone: it is the company.
  if (std::ranges::all_of(group, [&](std::uint32_t i) { return troubles_[i] == 0; })) {
    for (const auto i : group) give_trouble(i, Outcome::lane_dependent);
  }
}

void ForeignBatch::settle_environment(std::uint32_t i, const Take& take) {
  WorkerProcess& worker = call_.worker();
  put_arguments(worker.channel(), 0, i);
  const WorkerEnd end = worker.request(1, ulpgate_worker_singly);
  if (end != WorkerEnd::answered) {
    call_.drop_worker();
    return give_trouble(i, end == WorkerEnd::hung ? Outcome::hang : Outcome::crash);
  }
  if (worker.channel().changed != 0) return give_trouble(i, Outcome::environment);
  take(Points(&i, 1), call_.result(worker.channel(), 0), call_.stride());
}

void ForeignBatch::look_at_lanes(Points order, std::vector<std::uint32_t>& differing) {
  const std::size_t lanes = call_.lanes();
  const std::size_t size = call_.size();
  const std::size_t arity = call_.arity();
  std::vector<std::uint32_t> points;
  const std::size_t step = std::max<std::size_t>(1, order.size() / lanes_again);
  for (std::size_t j = 0; j < order.size(); j += step)
    if (troubles_[order[j]] == 0) points.push_back(order[j]);
  if (lanes == 1 || points.empty()) return;
  WorkerProcess& worker = call_.worker();
  ulpgate_channel& c = worker.channel();
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t value = 0; value < lanes * arity; ++value)
      put_poison(c.arguments + (p * lanes * arity + value) * size, call_.shape().element, p + value);
    put_arguments(c, p * lanes + p % lanes, points[p]);
  }
  if (worker.request(static_cast<std::uint32_t>(points.size() * lanes), ulpgate_worker_whole) !=
      WorkerEnd::answered) {
    // The neighbours are no arguments that were asked for; what they do is told by the strata that hold them.
    return call_.drop_worker();
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!same(&values_[points[p] * size], call_.result(c, p * lanes + p % lanes)))
      differing.push_back(points[p]);
  }
}

void ForeignBatch::explain(const std::vector<std::uint32_t>& differing) {
  std::vector<std::uint32_t> order = all_of(troubles_.size());
  std::erase_if(order, [&](std::uint32_t i) { return troubles_[i] != 0; });
  const bool same_company = order.size() == troubles_.size();
  std::vector<std::uint8_t> other(troubles_.size());
  evaluate_all(order, [&](Points points, const unsigned char* from, std::size_t stride) {
    for (std::size_t slot = 0; slot < points.size(); ++slot) {
      const auto i = points[slot];
      other[i] = same(&values_[i * call_.size()], from + slot * stride) ? 0 : 1;
    }
  });
  for (const auto i : differing) {
    const bool lanes = call_.lanes() > 1 && (other[i] == 0 || !same_company);
    give_trouble(i, lanes ? Outcome::lane_dependent : Outcome::not_a_function);
  }
  for (std::size_t i = 0; same_company && i < other.size(); ++i)
    if (other[i] != 0) give_trouble(static_cast<std::uint32_t>(i), Outcome::not_a_function);
}

}  // namespace ulpgate
