// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.hpp"

#include <csignal>

namespace occusg::apps {
namespace {

// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void rememberInterrupt(int /*signal*/) { interrupt_seen = 1; }

}  // namespace

void catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = rememberInterrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_seen != 0; }

}  // namespace occusg::apps
