// Reads every file of the directories that are named, with the code of a fuzz target: its corpus as a test of
// any compiler.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  int files = 0;
  for (int i = 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
      try {
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
      } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", entry.path().c_str(), e.what());
        return 1;
      }
      ++files;
    }
  }
  std::printf("%d inputs\n", files);
  // A corpus that is not there tests nothing.
  return files > 0 ? 0 : 3;
}
