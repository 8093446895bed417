// mutants: decodes damaged files by the hundred and prints what became of them. Fails when a
// request was overdue or a value broke its promises.
#include "tests/core/worker/ModelFiles.h"
#include "tests/core/worker/MutantRun.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fstream>

namespace {

// The files of a folder, by extension.
std::map<std::string, std::vector<std::string>> filesIn(const std::filesystem::path& folder) {
    std::map<std::string, std::vector<std::string>> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || extension.size() < 2)
            continue;
        std::ifstream stream(entry.path(), std::ios::binary);
        files[extension.substr(1)].emplace_back(std::istreambuf_iterator<char>(stream),
                                                std::istreambuf_iterator<char>());
    }
    return files;
}

} // namespace

int main(int argc, char** argv) {
    using namespace patina;
    CLI::App app("Decodes damaged files and reports what became of them.");
    int perFormat = 500;
    std::uint64_t seed = 1;
    double seconds = 5.0;
    std::string format;
    std::string folder;
    app.add_option("--per-format", perFormat, "mutants of each format");
    app.add_option("--seed", seed, "seed of all mutants");
    app.add_option("--seconds", seconds, "wall limit of a request");
    app.add_option("--format", format, "only this one: glb, gltf, obj, fbx, dae, ply, stl, png …");
    app.add_option("--seeds", folder, "folder with files to damage instead of the built-in ones");
    CLI11_PARSE(app, argc, argv);

    WorkerClient worker;
    const auto seeds = folder.empty() ? test::seedFiles(worker) : filesIn(folder);
    const WorkerLimits limits{std::size_t{2} << 30, seconds, seconds};
    fmt::print("{:8}{:>8}{:>10}{:>8}{:>10}{:>9}{:>8}{:>10}\n", "format", "loaded", "rejected",
               "died", "timed out", "overdue", "broken", "slowest");
    bool faultless = true;
    for (const auto& [name, files] : seeds) {
        if (!format.empty() && name != format)
            continue;
        const test::MutantTally t = test::runMutants(worker, limits, name, files, perFormat, seed);
        fmt::print("{:8}{:>8}{:>10}{:>8}{:>10}{:>9}{:>8}{:>9.2f}s\n", name, t.loaded, t.rejected,
                   t.died, t.timedOut, t.overdue, t.broken, t.slowestSeconds);
        faultless = faultless && t.faultless();
    }
    return faultless ? 0 : 1;
}
