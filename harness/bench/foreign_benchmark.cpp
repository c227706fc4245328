// Benchmarks of a function of a library, called here and called in a worker, at several sizes of batch:
// `bare` is a round trip with nothing looked at, `held` what a run does, with part of each batch evaluated
// twice.
//
//   foreign_benchmark --benchmark_filter=/32768
#include <benchmark/benchmark.h>
#include <dlfcn.h>

#include <stdexcept>
#include <vector>

#include "harness/foreign/foreign_code.hpp"

namespace {

constexpr const char* library = "libm.so.6";

using Function = double (*)(double);

Function function_of(const char* symbol) {
  void* handle = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* found = handle == nullptr ? nullptr : ::dlsym(handle, symbol);
  if (found == nullptr) throw std::runtime_error(::dlerror());
  return reinterpret_cast<Function>(
      found);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast): as POSIX has it
}

std::vector<double> arguments(std::size_t count) {
  std::vector<double> args(count);
  for (std::size_t i = 0; i < count; ++i)
    args[i] = 20.0 * static_cast<double>(i) / static_cast<double>(count) - 10.0;
  return args;
}

void in_process(benchmark::State& state, const char* symbol) {
  const Function function = function_of(symbol);
  const auto args = arguments(static_cast<std::size_t>(state.range(0)));
  std::vector<double> results(args.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < args.size(); ++i) results[i] = function(args[i]);
    benchmark::DoNotOptimize(results.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <class Call>
void in_worker(benchmark::State& state, const char* symbol, const Call& call) {
  ulpgate::ForeignSpec spec;
  spec.library = library;
  spec.symbol = symbol;
  spec.worker = ULPGATE_WORKER_FILE;
  const ulpgate::ForeignCode code(spec, {'d', 1, 0});
  const auto args = arguments(static_cast<std::size_t>(state.range(0)));
  std::vector<double> results(args.size());
  for (auto _ : state) call(code, args, results);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void bare(benchmark::State& state, const char* symbol) {
  in_worker(state, symbol, [](const auto& code, const auto& args, auto& results) {
    static_cast<void>(code.call(args.data(), results.data(), args.size(), 1));
  });
}

void held(benchmark::State& state, const char* symbol) {
  std::vector<std::uint8_t> threw(static_cast<std::size_t>(state.range(0)));
  in_worker(state, symbol, [&](const auto& code, const auto& args, auto& results) {
    code.evaluate(args.data(), results.data(), threw.data(), args.size());
  });
}

[[maybe_unused]] const bool registered = [] {
  for (const char* symbol : {"sin", "tgamma"}) {
    const auto add = [&](const char* how, void (*run)(benchmark::State&, const char*)) {
      const std::string name = std::string(how) + "/" + symbol;
      for (const std::int64_t batch : {256, 4096, 32768})
        benchmark::RegisterBenchmark(name.c_str(), run, symbol)->Arg(batch)->UseRealTime();
    };
    add("in_process", in_process);
    add("bare", bare);
    add("held", held);
  }
  return true;
}();

}  // namespace
