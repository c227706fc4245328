// Loaded code.
#include "harness/app/machine/loaded_code.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#if defined(__x86_64__) && __has_include(<sys/platform/x86.h>)
#include <sys/platform/x86.h>
#define ULPGATE_HAVE_ACTIVE_FEATURES 1
#endif

#include "reference/functions/function_info.hpp"

namespace ulpgate::app {

namespace {

constexpr std::array<std::string_view, 5> deciding = {"libm.so", "libquadmath.so", "libmpfr.so", "libmpc.so",
                                                      "libgmp.so"};

bool decides(const std::string& file) {
  for (const auto name : deciding)
    if (file.starts_with(name)) return true;
  return false;
}

std::string build_id_of(const dl_phdr_info& object) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const auto& segment = object.dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): dl_iterate_phdr gives addresses as numbers
    const auto* note = reinterpret_cast<const char*>(object.dlpi_addr + segment.p_vaddr);
    const char* end = note + segment.p_memsz;
    const auto padded = [](std::size_t n) { return (n + 3) & ~std::size_t{3}; };
    while (note + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) header;
      std::memcpy(&header, note, sizeof header);
      const char* name = note + sizeof header;
      const char* content = name + padded(header.n_namesz);
      if (header.n_type == NT_GNU_BUILD_ID && header.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0) {
        std::string id;
        for (std::size_t k = 0; k < header.n_descsz; ++k)
          id += fmt::format("{:02x}", static_cast<unsigned char>(content[k]));
        return id;
      }
      note = content + padded(header.n_descsz);
    }
  }
  return "";
}

struct Object {
  std::string file;
  LoadedLibrary library;
};

// By base address.
std::map<std::uintptr_t, Object> mapped_objects() {
  std::map<std::uintptr_t, Object> all;
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* to) {
        std::error_code code;
        const std::filesystem::path named = object->dlpi_name;
        const auto path = std::filesystem::canonical(named.empty() ? "/proc/self/exe" : named, code);
        static_cast<std::map<std::uintptr_t, Object>*>(to)->insert(
            {object->dlpi_addr,
             {named.empty() ? "" : named.filename().string(),
              {code ? named.string() : path.string(), build_id_of(*object)}}});
        return 0;
      },
      &all);
  return all;
}

// The names that functions.def and its complex functions may come to in the C library.
std::vector<std::string> function_names() {
  std::set<std::string> names = {"sincos", "sincosf", "sincosl", "fma", "fmaf", "fmal", "exp2", "exp2f"};
  for (const auto& f : all_functions())
    for (const auto* suffix : {"", "f", "l"}) names.insert(std::string(f.name) + suffix);
  return {names.begin(), names.end()};
}

// Where the public name is a wrapper, the variants show under the names that it once had for -ffast-math.
constexpr std::array<const char*, 12> variants_of_old = {
    "__acos_finite", "__asin_finite", "__atan2_finite", "__exp_finite",   "__exp2f_finite", "__expf_finite",
    "__log_finite",  "__logf_finite", "__log2_finite",  "__log2f_finite", "__pow_finite",   "__powf_finite"};

struct Variant {
  std::string name;
  std::uintptr_t base;
  std::uintptr_t offset;
};

// A look-up by name gives what the loader would call: it asks a function with variants which one it is.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  const auto add = [&](const std::string& name, void* address) {
    Dl_info place{};
    if (address == nullptr || dladdr(address, &place) == 0) return;
    const auto base = reinterpret_cast<std::uintptr_t>(place.dli_fbase);
    all.push_back({name, base, reinterpret_cast<std::uintptr_t>(address) - base});
  };
  for (const auto& name : function_names()) add(name, dlsym(RTLD_DEFAULT, name.c_str()));
#if defined(__x86_64__)
  for (const auto* name : variants_of_old) add(name, dlvsym(RTLD_DEFAULT, name, "GLIBC_2.15"));
#endif
  return all;
}

}  // namespace

std::map<std::string, LoadedLibrary> loaded_libraries() {
  const auto all = mapped_objects();
  std::map<std::string, LoadedLibrary> libraries;
  for (const auto& [base, object] : all)
    if (decides(object.file)) libraries[object.file] = object.library;
  for (const auto& v : variants()) {
    const auto owner = all.find(v.base);
    // The C library proper has some of the simplest; its version is known.
    if (owner == all.end() || owner->second.file.empty() || owner->second.file.starts_with("libc.so"))
      continue;
    libraries[owner->second.file] = owner->second.library;
  }
  return libraries;
}

std::string function_variants() {
  const auto all = mapped_objects();
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto mix = [&](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  };
  for (const auto& v : variants()) {
    const auto owner = all.find(v.base);
    // The program's own functions lie elsewhere in every build of it.
    const std::string file = owner == all.end() ? "?" : owner->second.file;
    mix(file.empty()
            ? fmt::format("{} program\n", v.name)
            : fmt::format("{} {} {} {:x}\n", v.name, file, owner->second.library.build_id, v.offset));
  }
  return fmt::format("{:016x}", hash);
}

std::string active_instruction_sets() {
  std::string text;
#ifdef ULPGATE_HAVE_ACTIVE_FEATURES
#define ULPGATE_FEATURE(name) \
  if (CPU_FEATURE_ACTIVE(name)) text += (text.empty() ? "" : " ") + std::string(#name);
  ULPGATE_FEATURE(SSE4_1)
  ULPGATE_FEATURE(SSE4_2)
  ULPGATE_FEATURE(AVX)
  ULPGATE_FEATURE(AVX2)
  ULPGATE_FEATURE(AVX512F)
  ULPGATE_FEATURE(AVX512DQ)
  ULPGATE_FEATURE(AVX512VL)
  ULPGATE_FEATURE(FMA)
  ULPGATE_FEATURE(FMA4)
#undef ULPGATE_FEATURE
#endif
  return text;
}

}  // namespace ulpgate::app
