// Words that `ulpgate scene` does not take, with the spelling of what was probably meant.
#pragma once

#include <string>
#include <vector>

namespace ulpgate::app {

// Of `ulpgate scene WORDS...` without a sub-verb, or with `verb` behind the words.  Throws the Failure that
// names the spelling with one: `ulpgate scene explain pendulum3` for `ulpgate scene pendulum3 --explain`.
[[noreturn]] void refuse_words_before_verb(const std::vector<std::string>& words, const std::string& verb);

// Of `ulpgate scene VERB SCENE WORDS...`: throws a Failure where there is one, which names the first option.
void refuse_unknown_words(const std::string& verb, const std::string& scene,
                          const std::vector<std::string>& words);

}  // namespace ulpgate::app
