// Revision: which commit of the sources a run belongs to.
#pragma once

#include <string>

namespace ulpgate::app {

// `named` where it is not empty: any word of letters, digits and ._/+- up to 100 characters.  Otherwise the
// commit that is checked out in the current directory, with "-dirty" behind it where tracked files differ
// from it. Throws a Failure, bad_input, where neither is to be had.
[[nodiscard]] std::string revision_of(const std::string& named);

}  // namespace ulpgate::app
