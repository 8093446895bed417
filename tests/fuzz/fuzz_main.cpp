// fuzz-files KIND: reads damaged files of one kind and says what became of them, as JSON.
// scripts/fuzz runs it for all kinds, and notices where it dies.
#include "tests/fuzz/Readers.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace patina;
using namespace patina::test;

Outcome readGuarded(const FuzzKind& kind, const fs::path& file, Random& random) {
    try {
        return kind.read(file, random);
    } catch (const std::exception& exception) { // none crosses a module
        fmt::print(stderr, "exception: {}\n", exception.what());
        return Outcome::Broken;
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Reads damaged files of a kind and reports what became of them.");
    std::string name, seeds, keep = ".";
    std::uint64_t seed = 1;
    std::uint64_t first = 0, count = 100;
    double seconds = 10.0;
    bool list = false;
    app.add_option("kind", name, "what is read; --list names all");
    app.add_flag("--list", list, "the kinds that have seeds");
    app.add_option("--seeds", seeds, "folder with a folder of sound files for each kind");
    app.add_option("--keep", keep, "folder for files that something came of");
    app.add_option("--seed", seed, "of all mutants");
    app.add_option("--first", first, "number of the first mutant");
    app.add_option("--count", count, "mutants");
    app.add_option("--seconds", seconds, "that a file may take");
    CLI11_PARSE(app, argc, argv);

    WorkerClient worker;
    worker.setLimits({std::size_t{2} << 30, seconds, seconds});
    const std::map<std::string, FuzzKind> kinds = fuzzKinds(worker, seeds);
    if (list) {
        for (const auto& [known, kind] : kinds)
            if (!kind.seeds.empty())
                fmt::print("{}\n", known);
        return 0;
    }
    const auto found = kinds.find(name);
    if (found == kinds.end() || found->second.seeds.empty()) {
        fmt::print(stderr, "there are no seeds of the kind \"{}\"\n", name);
        return 2;
    }
    const FuzzKind& kind = found->second;
    const fs::path file = fs::path(keep) / fmt::format("{}-{}", name, ::getpid()) / kind.file;
    fs::create_directories(file.parent_path());
    constexpr std::array kWords{"loaded", "rejected", "died", "timedOut", "broken"};
    nlohmann::ordered_json tally{{"loaded", 0}, {"rejected", 0}, {"died", 0},     {"timedOut", 0},
                                 {"broken", 0}, {"slow", 0},     {"slowest", 0.0}};
    for (std::uint64_t i = first; i < first + count; ++i) {
        std::seed_seq sequence{seed, i};
        Random random(sequence);
        const std::string bytes = kind.mutate(kind.seeds, random);
        std::ofstream(file, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        ::alarm(static_cast<unsigned>(12.0 * seconds)); // what hangs here dies
        const auto begin = std::chrono::steady_clock::now();
        const Outcome outcome = readGuarded(kind, file, random);
        const double took =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        ::alarm(0);
        const char* word = kWords[static_cast<std::size_t>(outcome)];
        tally[word] = tally[word].get<int>() + 1;
        tally["slowest"] = std::max(tally["slowest"].get<double>(), took);
        const bool slow = took > seconds;
        if (slow)
            tally["slow"] = tally["slow"].get<int>() + 1;
        if (!slow && outcome != Outcome::Broken && outcome != Outcome::Died)
            continue;
        std::error_code error;
        const fs::path kept =
            fs::path(keep) / fmt::format("{}-{}-{}-{}", name, seed, i, slow ? "slow" : word);
        fs::create_directories(kept, error);
        fs::copy_file(file, kept / kind.file, fs::copy_options::overwrite_existing, error);
    }
    std::error_code error;
    fs::remove_all(file.parent_path(), error); // whoever dies leaves what it read
    fmt::print("{}\n", tally.dump());
    return 0;
}
