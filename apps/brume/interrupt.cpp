#include "interrupt.h"

#include <csignal>

namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t signalled = 0;

void on_signal(int) {
  signalled = 1;
  // Whichever comes next does what it does by default: end the program.
  for (const int number : signals) std::signal(number, SIG_DFL);
}

}  // namespace

void watch_for_interrupt() {
  for (const int number : signals) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;  // as under nohup
    action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
  }
}

bool interrupted() { return signalled != 0; }
