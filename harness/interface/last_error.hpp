// What ulpgate_last_error() says, and how exceptions become return codes of the C interface.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace ulpgate {

[[nodiscard]] std::string& last_error();

// 0, or the exit code of what `work` threw: 2 for a wrong argument, 4 for the rest.
template <class Work>
int guarded(Work work) noexcept {
  try {
    last_error().clear();
    work();
    return 0;
  } catch (const std::invalid_argument& e) {
    last_error() = e.what();
    return 2;
  } catch (const std::exception& e) {
    last_error() = e.what();
    return 4;
  }
}

}  // namespace ulpgate
