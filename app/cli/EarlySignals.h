// SIGINT and SIGTERM from the first moment of the program on: one that comes before the Watcher is
// there is kept for it, so that a run with a checkpoint ends with its own status whenever the
// signal comes. A second one ends the program.
#pragma once

namespace patina::cli {

class EarlySignals {
  public:
    EarlySignals(); // one for the process, the first thing that main() does
    // The signal that came, once; 0: none.
    [[nodiscard]] static int take();
};

} // namespace patina::cli
