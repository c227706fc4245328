// MpiRanks.
#include "harness/app/run/mpi_ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

// The C++ bindings of old are not wanted.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/store/checkpoint_text.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/watch/stopwatch.hpp"

namespace ulpgate::app {

namespace {

constexpr int report_tag = 1;
constexpr int order_tag = 2;

// First letter of a report.
constexpr char hello = 'h';         // identity
constexpr char ready = 'r';         // nothing in hand
constexpr char unit = 'u';          // line of a finished unit, with its checksum
constexpr char disagreement = 'd';  // message of a ReferenceDisagreement
constexpr char failed = 'f';        // message of another failure in a unit
constexpr char bye = 'b';           // leaves; message of the failure that keeps it from working, or nothing

// MPI's own waiting keeps a core busy, which somebody else could use.
void rest(int& idle) {
  idle = std::min(idle + 1, 50);
  std::this_thread::sleep_for(std::chrono::microseconds(100) * idle);
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

}  // namespace

MpiRanks::MpiRanks(double patience_s) : patience_s_(patience_s) {
  int size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  left_.resize(static_cast<std::size_t>(size));
  busy_.resize(static_cast<std::size_t>(size));
  left_[0] = true;
}

std::optional<MpiRanks::Report> MpiRanks::next_report() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, report_tag, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Report report{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(report.text.data(), size, MPI_CHAR, report.rank, report_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return report;
}

void MpiRanks::send_order(int rank, std::int64_t order) {
  MPI_Send(&order, 1, MPI_INT64_T, rank, order_tag, MPI_COMM_WORLD);
}

void MpiRanks::send_report(char kind, const std::string& text) {
  const std::string report = kind + text;
  MPI_Send(report.data(), static_cast<int>(report.size()), MPI_CHAR, 0, report_tag, MPI_COMM_WORLD);
}

std::int64_t MpiRanks::next_order() {
  constexpr double silence_s = 600;
  const auto start = Clock::now();
  int there = 0;
  for (int idle = 0; there == 0; rest(idle)) {
    MPI_Iprobe(0, order_tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    if (there != 0) break;
    if (seconds_since(start) > silence_s)
      throw Failure(Standing::environment, "rank 0 does not answer; the units it has kept are in --out");
  }
  std::int64_t order = 0;
  MPI_Recv(&order, 1, MPI_INT64_T, 0, order_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return order;
}

bool MpiRanks::any_busy() const {
  return std::ranges::find(busy_, true) != busy_.end();
}

void MpiRanks::take_in(const Report& report, UnitExchange& exchange, const RunIdentity& identity) {
  const std::string text = report.text.substr(1);
  const auto fail = [&](Standing standing, const std::string& message) {
    exchange.fail(
        std::make_exception_ptr(Failure(standing, fmt::format("rank {}, {}", report.rank, message))));
  };
  switch (report.text[0]) {
    case hello: {
      const auto cut = text.find(' ');
      if (const auto other = identity_difference(text.substr(cut + 1), identity)) {
        fail(Standing::bad_input,
             fmt::format("on {}, would not give the bytes of rank 0: {}", text.substr(0, cut), *other));
      }
      break;
    }
    case unit: {
      const auto lines = checked_lines(text);
      const auto done = lines.size() == 1 && lines[0].payload ? unit_from_payload(*lines[0].payload)
                                                              : std::optional<FinishedUnit>();
      if (!done) {
        fail(Standing::environment, "sent a damaged unit");
        break;
      }
      exchange.finish(done->position, done->seconds, done->summaries);
      break;
    }
    case disagreement:
      exchange.fail(std::make_exception_ptr(ReferenceDisagreement(text)));
      break;
    case failed:
      fail(Standing::environment, text);
      break;
    case bye:
      left_[static_cast<std::size_t>(report.rank)] = true;
      if (!text.empty()) fail(Standing::bad_input, text);
      break;
    default:
      break;
  }
}

void MpiRanks::serve(UnitExchange& exchange, const RunIdentity& identity) {
  // Who ends a job sends SIGTERM, and SIGKILL a second or two later.
  constexpr double last_units_s = 0.5;
  std::optional<Clock::time_point> interrupt;
  int idle = 0;
  while (true) {
    if (interrupted() && !interrupt) interrupt = Clock::now();
    if (exchange.over() && !(interrupt && any_busy() && seconds_since(*interrupt) < last_units_s)) return;
    const auto report = next_report();
    if (!report) {
      rest(idle);
      continue;
    }
    idle = 0;
    const auto rank = static_cast<std::size_t>(report->rank);
    busy_[rank] = false;
    try {
      take_in(*report, exchange, identity);
    } catch (...) {
      exchange.fail(std::current_exception());
    }
    if (left_[rank]) continue;
    const auto taken = exchange.take(rank);
    busy_[rank] = taken.answer == UnitQueue::Answer::unit;
    send_order(report->rank, busy_[rank] ? static_cast<std::int64_t>(taken.position) : wait);
  }
}

void MpiRanks::help(const RunIdentity& identity, const ShardUnits& units,
                    const std::function<std::vector<Summary>(const WorkUnit&)>& evaluate) {
  send_report(hello, host_name() + " " + identity_text(identity));
  for (std::int64_t order = next_order(); order != leave_now; order = next_order()) {
    if (order == wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      send_report(ready, "");
      continue;
    }
    const auto position = static_cast<std::size_t>(order);
    try {
      const auto start = Clock::now();
      const auto summaries = evaluate(units[position]);
      send_report(unit, with_checksum(unit_payload(position, seconds_since(start), summaries)));
    } catch (const ReferenceDisagreement& e) {
      send_report(disagreement, e.what());
    } catch (const std::exception& e) {
      send_report(failed, e.what());
    }
  }
}

std::vector<int> MpiRanks::dismiss() {
  auto heard = Clock::now();
  const double patience_s = interrupted() ? std::min(patience_s_, 1.0) : patience_s_;
  int idle = 0;
  while (std::ranges::find(left_, false) != left_.end() && seconds_since(heard) < patience_s) {
    const auto report = next_report();
    if (!report) {
      rest(idle);
      continue;
    }
    heard = Clock::now();
    idle = 0;
    if (report->text[0] == bye) {
      left_[static_cast<std::size_t>(report->rank)] = true;
    } else {
      send_order(report->rank, leave_now);
    }
  }
  std::vector<int> silent;
  for (std::size_t r = 0; r < left_.size(); ++r) {
    if (!left_[r]) silent.push_back(static_cast<int>(r));
  }
  return silent;
}

void MpiRanks::leave(const std::string& failure) {
  send_report(bye, failure);
}

}  // namespace ulpgate::app
