// Watchdog: ends a program in which a function under test does not come back.
#pragma once

namespace CLI {
class App;
}

namespace ulpgate::app {

// Adds --timeout to the program and to the verbs that evaluate; 60 s where nobody asks.
void add_timeout_option(CLI::App& app, double& timeout_s);

// Starts a thread that looks at the heartbeats of all threads.  Where one has stood still for `timeout_s` in
// one batch of calls, or in the reference of one point, it finds the point by calling once more, says what
// stands still and where, and ends the program with exit code 4.  Units that were finished are in the
// checkpoint by then.
void start_watchdog(double timeout_s);

}  // namespace ulpgate::app
