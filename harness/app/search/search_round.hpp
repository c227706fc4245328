// A round of a search on several threads.
#pragma once

#include "harness/core/search/function_search.hpp"

namespace ulpgate::app {

// Of at most `most` evaluations; false where there was nothing to do.  The result does not depend on
// `threads`.  Throws a Failure where foreign code cannot go on.
bool run_round(FunctionSearch& search, std::uint64_t most, unsigned threads, const Subject& subject);

}  // namespace ulpgate::app
