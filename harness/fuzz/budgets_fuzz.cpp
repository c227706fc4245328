// Fuzz target: a budget file; what is accepted is the same when it is written and read again.
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/app/budgets/budget_files.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/fuzz/scratch_directory.hpp"

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ulpgate::fuzz::ScratchDirectory scratch;
  scratch.write("double.toml", {reinterpret_cast<const char*>(data), size});
  ulpgate::Budgets budgets;
  try {
    budgets = ulpgate::app::read_budgets(scratch.path());
  } catch (const ulpgate::app::Failure& e) {
    if (std::string_view(e.what()).find("double.toml") == std::string_view::npos)
      throw std::logic_error("an error that does not name the file: " + std::string(e.what()));
    return 0;
  }
  ulpgate::app::write_budgets(scratch.path(), budgets);
  const std::string once = text_of(scratch.path() / "double.toml");
  ulpgate::app::write_budgets(scratch.path(), ulpgate::app::read_budgets(scratch.path()));
  if (text_of(scratch.path() / "double.toml") != once)
    throw std::logic_error("budgets change when they are written and read again");
  return 0;
}
