// ForeignCode.
#include "harness/foreign/foreign_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "harness/foreign/foreign_batch.hpp"

namespace ulpgate {

namespace {

std::string environment_words(const ulpgate_environment& from, const ulpgate_environment& to) {
  std::string text;
  const auto add = [&](std::string_view words) { text += (text.empty() ? "" : ", ") + std::string(words); };
#if defined(__x86_64__)
  constexpr std::uint32_t flush = 0x8000;
  constexpr std::uint32_t zeros = 0x0040;
  constexpr std::uint32_t rounding = 0x6000;
  constexpr std::uint32_t traps = 0x1f80;
  const std::uint32_t sse = from.sse ^ to.sse;
  if ((sse & flush) != 0) add((to.sse & flush) != 0 ? "flushes subnormal results to zero (FTZ)" : "ends FTZ");
  if ((sse & zeros) != 0)
    add((to.sse & zeros) != 0 ? "takes subnormal arguments for zero (DAZ)" : "ends DAZ");
  if ((sse & rounding) != 0) add("changes the rounding mode");
  if ((sse & traps) != 0) add("changes which exceptions trap");
  if (from.x87 != to.x87) add(fmt::format("x87 control word {:04x} -> {:04x}", from.x87, to.x87));
  if (sse != 0) text += fmt::format(" (MXCSR {:04x} -> {:04x})", from.sse, to.sse);
#else
  add(fmt::format("control bits {:08x} -> {:08x}", from.sse, to.sse));
#endif
  return text;
}

// The arguments of a point, as `ulpgate at` takes them where printf knows the type, else their bytes.
std::string shown(const ForeignCall& call, const unsigned char* args) {
  std::string text;
  const auto add = [&]<class T>(const char* format, T x, const unsigned char* from) {
    std::array<char, 64> digits{};
    std::memcpy(&x, from, value_bytes(call.shape().element));
    std::snprintf(digits.data(), digits.size(), format, x);
    text += (text.empty() ? "" : " ") + std::string(digits.data());
  };
  for (std::size_t i = 0; i < call.arity(); ++i) {
    const unsigned char* from = args + i * call.size();
    if (call.shape().element == 'f') {
      float x = 0;
      std::memcpy(&x, from, sizeof x);
      text += (text.empty() ? "" : " ") + fmt::format("{:a}", x);
    } else if (call.shape().element == 'd') {
      add("%a", 0.0, from);
    } else if (call.shape().element == 'l') {
      add("%La", 0.0L, from);
    } else {
      text += text.empty() ? "bytes " : " ";
      for (std::size_t b = 0; b < call.size(); ++b) text += fmt::format("{:02x}", from[b]);
    }
  }
  return text;
}

std::string text_of(const char* words) {
  return {words, ::strnlen(words, 1024)};
}

}  // namespace

ForeignCode::ForeignCode(ForeignSpec spec, const ForeignShape& shape) : call_(std::move(spec), shape) {
  const ulpgate_channel& c = call_.worker().channel();
  facts_ = {text_of(c.path), text_of(c.soname), text_of(c.build_id), call_.spec().signature, {}};
  if (const std::string words = environment_words(c.at_start, c.loaded); !words.empty())
    facts_.findings.push_back("on loading it " + words);
  for (int s = 1; s <= 64; ++s) {
    if ((c.handlers >> (s - 1) & 1U) != 0)
      facts_.findings.push_back(fmt::format("on loading it replaces the handler of signal {}", s));
  }
}

std::size_t ForeignCode::batch() const {
  return ulpgate_channel_points;
}

std::vector<std::string> ForeignCode::findings() const {
  const std::lock_guard lock(mutex_);
  return findings_;
}

void ForeignCode::note(const std::string& finding) const {
  constexpr std::size_t most = 20;
  const std::lock_guard lock(mutex_);
  if (findings_.size() < most && std::ranges::find(findings_, finding) == findings_.end())
    findings_.push_back(finding);
}

void ForeignCode::evaluate(const void* args, void* results, std::uint8_t* threw, std::size_t count) const {
  const auto* bytes = static_cast<const unsigned char*>(args);
  auto* values = static_cast<unsigned char*>(results);
  ForeignBatch batch(call_, bytes, values, count);
  if (batch.run()) return;
  // As a fresh process does it, which the next batch is not to see.
  call_.drop_worker();
  ForeignBatch again(call_, bytes, values, count);
  const bool clean = again.run();
  call_.drop_worker();
  if (clean) {
    const auto first = std::ranges::find_if(batch.troubles(), [](std::uint8_t t) { return t != 0; });
    const auto i = static_cast<std::size_t>(first - batch.troubles().begin());
    note(fmt::format("{} at {}, and not again in a fresh process: it depends on earlier calls",
                     name_of(static_cast<Outcome>(static_cast<int>(Outcome::exception) + *first - 1)),
                     shown(call_, bytes + i * call_.arity() * call_.size())));
  }
  std::ranges::copy(again.troubles(), threw);
}

double ForeignCode::call(const void* args, void* results, std::size_t count, int rounds) const {
  using Clock = std::chrono::steady_clock;
  double seconds = 0;
  const std::size_t size = call_.size();
  for (std::size_t first = 0; first < count; first += ulpgate_channel_points) {
    const std::size_t n = std::min<std::size_t>(ulpgate_channel_points, count - first);
    WorkerProcess& w = call_.worker();
    std::memcpy(w.channel().arguments, static_cast<const unsigned char*>(args) + first * call_.arity() * size,
                n * call_.arity() * size);
    const auto start = Clock::now();
    if (w.request(static_cast<std::uint32_t>(n), ulpgate_worker_whole, static_cast<std::uint32_t>(rounds)) !=
        WorkerEnd::answered) {
      call_.drop_worker();
      seconds += std::chrono::duration<double>(Clock::now() - start).count();
      continue;
    }
    seconds += 1e-9 * static_cast<double>(w.channel().elapsed_ns);
    auto* to = static_cast<unsigned char*>(results) + first * size;
    if (call_.stride() == size) {
      std::memcpy(to, call_.result(w.channel(), 0), n * size);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) std::memcpy(to + i * size, call_.result(w.channel(), i), size);
  }
  return seconds;
}

}  // namespace ulpgate
