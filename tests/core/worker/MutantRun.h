// Damaged files by the hundred: truncated, with flipped bits, spliced. Whatever the decoders make
// of them, this process lives on and no request takes longer than its limit.
#pragma once

#include "core/worker/WorkerClient.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace patina::test {

struct MutantTally {
    int loaded = 0;   // still good enough
    int rejected = 0; // the decoder said no
    int died = 0;     // the child crashed, and the client said so
    int timedOut = 0; // a limit ended it
    int overdue = 0;  // took longer than the wall limit allows: a fault of ours
    int broken = 0;   // loaded, but a promise of the values does not hold: a fault of ours
    double slowestSeconds = 0;
    [[nodiscard]] bool faultless() const { return overdue == 0 && broken == 0; }
};

// `count` mutants of the seeds, each derived from `seed` and its number alone.
MutantTally runMutants(WorkerClient& worker, const WorkerLimits& limits, const std::string& format,
                       const std::vector<std::string>& seeds, int count, std::uint64_t seed);

} // namespace patina::test
