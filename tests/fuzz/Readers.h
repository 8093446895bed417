// What the fuzzer reads: a kind of file, sound ones to begin with, and the readers that whoever
// opens such a file would run.
#pragma once

#include "core/worker/WorkerClient.h"
#include "tests/fuzz/Mutation.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace patina::test {

enum class Outcome {
    Loaded,
    Rejected, // with a message
    Died,     // the decoder did, and the client said so
    TimedOut, // the decoder's limit
    Broken, // loaded, but a promise of the values does not hold; or an error without words: a fault
};

struct FuzzKind {
    std::string file; // name of a mutant
    std::function<std::string(const std::vector<std::string>&, Random&)> mutate;
    std::function<Outcome(const std::filesystem::path&, Random&)> read;
    std::vector<std::string> seeds;
};

// By name. `seeds`: a folder with files in a folder for each kind, for those whose seeds are made
// by the command line (scripts/fuzz), and for files of one's own.
[[nodiscard]] std::map<std::string, FuzzKind> fuzzKinds(WorkerClient& worker,
                                                        const std::filesystem::path& seeds);

} // namespace patina::test
