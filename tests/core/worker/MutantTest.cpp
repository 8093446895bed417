// A small sample of what the program `mutants` does at length.
#include "tests/core/worker/ModelFiles.h"
#include "tests/core/worker/MutantRun.h"

namespace patina {
namespace {

TEST(Mutants, OfEveryFormatEndInAValueOrAMessage) {
    WorkerClient worker;
    const WorkerLimits limits{std::size_t{2} << 30, 2.0, 5.0};
    const auto seeds = test::seedFiles(worker);
    EXPECT_EQ(seeds.size(), 11u);
    constexpr int kPerFormat = 25;
    constexpr std::uint64_t kSeed = 20240;
    for (const auto& [format, files] : seeds) {
        const test::MutantTally tally =
            test::runMutants(worker, limits, format, files, kPerFormat, kSeed);
        EXPECT_TRUE(tally.faultless())
            << format << ": " << tally.overdue << " overdue, " << tally.broken
            << " broken; replay with mutants --format " << format << " --per-format " << kPerFormat
            << " --seed " << kSeed;
        EXPECT_EQ(tally.loaded + tally.rejected + tally.died + tally.timedOut, kPerFormat);
        EXPECT_GT(tally.rejected, 0) << format;
    }
}

} // namespace
} // namespace patina
