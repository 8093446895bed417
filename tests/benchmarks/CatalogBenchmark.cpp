// How long a folder of environments takes: measured for the first time, and read from the cache.
// 100 files, copies of those in $PATINA_CATALOG_FOLDER, or of the built-in ones as 1024 × 512 .hdr.
#include "core/catalog/CatalogCache.h"
#include "core/catalog/CatalogEntry.h"
#include "core/io/ImageIO.h"
#include "core/library/Library.h"
#include "core/scene/FolderEnvironments.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

using namespace patina;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFiles = 100;
constexpr int kLanes = 2; // as the editor measures them

struct Folder {
    test::TemporaryFolder folder;
    WorkerClient worker;
    std::vector<std::string> files;
    CatalogCache cache{folder / "cache"};

    Folder() {
        std::vector<fs::path> originals;
        const char* given = std::getenv("PATINA_CATALOG_FOLDER"); // NOLINT(concurrency-mt-unsafe)
        if (given != nullptr) {
            originals = environmentFilesOf(given)->files;
        } else {
            for (const library::Entry& entry : library::environments()) {
                originals.push_back(folder / (entry.name + "-original.hdr"));
                (void)saveImage(worker, **library::environment(entry.name), originals.back());
            }
        }
        for (std::size_t i = 0; i < kFiles; ++i) {
            const fs::path& original = originals[i % originals.size()];
            const fs::path copy = folder / (std::to_string(i) + original.extension().string());
            fs::copy_file(original, copy);
            files.push_back(copy.string());
        }
        worker.warmUp(WorkerKind::Image);
    }

    // The lanes measure one file after another each.
    bool measure() {
        std::vector<char> good(kLanes, 1);
        std::vector<std::thread> lanes;
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            lanes.emplace_back([&, lane] {
                for (std::size_t i = lane; i < files.size(); i += kLanes) {
                    const Result<CatalogEntry> entry = makeCatalogEntry(worker, files[i]);
                    if (!entry || !cache.store(*catalogKey(files[i]), *entry))
                        good[lane] = 0;
                }
            });
        for (std::thread& lane : lanes)
            lane.join();
        return std::ranges::find(good, 0) == good.end();
    }
};

Folder& folderOf100() {
    static const auto folder = std::make_unique<Folder>();
    return *folder;
}

void measure100(benchmark::State& state) {
    Folder& folder = folderOf100();
    for (auto _ : state)
        if (!folder.measure())
            state.SkipWithError("an environment could not be measured or kept");
}

void readCached100(benchmark::State& state) {
    Folder& folder = folderOf100();
    if (!folder.measure())
        state.SkipWithError("an environment could not be measured or kept");
    for (auto _ : state)
        for (const std::string& file : folder.files)
            if (!folder.cache.find(*catalogKey(file)))
                state.SkipWithError("an entry is missing");
}

void compare100(benchmark::State& state) {
    Folder& folder = folderOf100();
    if (!folder.measure())
        state.SkipWithError("an environment could not be measured or kept");
    std::vector<CatalogEntryPtr> entries;
    for (const std::string& file : folder.files)
        entries.push_back(
            std::make_shared<const CatalogEntry>(*folder.cache.find(*catalogKey(file))));
    for (auto _ : state)
        benchmark::DoNotOptimize(findSameEntries(entries));
}

} // namespace

BENCHMARK(measure100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(readCached100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(compare100)->Unit(benchmark::kMillisecond)->UseRealTime();
