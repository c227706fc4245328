// Crash report: a fatal signal in a function under test names the row that it happened in and ends with exit
// code 4; so does a library that ends the program on its own.
#pragma once

namespace ulpgate::app {

// The row is that of the crashing thread's WorkPlace.
void install_crash_report();

// main is about to return: whoever ends the program before that is a library that could not go on, such as
// one that gets no thread, and the exit code is 4 rather than the library's.
void ends_by_itself();

}  // namespace ulpgate::app
