// SIGINT, SIGTERM and SIGUSR1 ask for a stop at the next safe point; a second SIGINT or SIGTERM
// ends the process at once. SIGUSR2 asks for a checkpoint. CLI: public headers only.
#pragma once

#include "hrad/hrad.h"

namespace hrad::cli::signals {

void install();

// The first signal that asked for a stop, 0 if none did.
int pending();
// Throws Interrupted when a signal asked any process for a stop: called by all, wherever a command
// may end.
void check();

// Whether SIGUSR2 came since the last time; it is not kept.
bool take_checkpoint_request();

// While it lives, a signal also stops the solver's solve.
class Watch {
 public:
  explicit Watch(hrad_solver* solver);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
};

}  // namespace hrad::cli::signals
