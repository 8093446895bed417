// The rooms' borders: who may include what (docs/architecture.md). Reads the sources.

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

// Counts the lines in `folder` that match `pattern`, except in files that match `allowedFile`.
int lines(const std::string& folder, const std::regex& pattern, const std::string& allowedFile) {
    const fs::path root = PATINA_SOURCE_DIR;
    const std::regex allowed(allowedFile);
    int found = 0, files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp")
            continue;
        ++files;
        const std::string relative = fs::relative(entry.path(), root).generic_string();
        std::ifstream stream(entry.path());
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number)
            if (!std::regex_match(relative, allowed) && std::regex_search(line, pattern)) {
                ADD_FAILURE() << relative << ":" << number << ": " << line;
                ++found;
            }
    }
    EXPECT_GT(files, 0) << folder << " holds no sources";
    return found;
}

// The same for includes of what `forbidden` matches.
int violations(const std::string& folder, const std::string& forbidden,
               const std::string& allowedFile = {}) {
    return lines(folder, std::regex("^\\s*#\\s*include\\s*[<\"](" + forbidden + ")"), allowedFile);
}

TEST(Borders, CoreSeesNeitherQtNorOpenGlNorTheRoomsAboveIt) {
    EXPECT_EQ(violations("core", "Q[A-Z]|Qt|GL/|epoxy|render/|app/"), 0);
}

// The modules of core with those they depend on, as their CMakeLists.txt have it (patina_module()).
std::map<std::string, std::set<std::string>> modules() {
    std::map<std::string, std::set<std::string>> result;
    const fs::path core = fs::path(PATINA_SOURCE_DIR) / "core";
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(core)) {
        if (entry.path().filename() != "CMakeLists.txt" || entry.path().parent_path() == core)
            continue;
        std::ifstream stream(entry.path());
        std::stringstream text;
        text << stream.rdbuf();
        const std::string lines = text.str();
        const std::string folder = fs::relative(entry.path().parent_path(), core).generic_string();
        EXPECT_THAT(lines, ::testing::HasSubstr("patina_module(" + folder + "\n"));
        std::set<std::string>& dependencies = result[folder];
        std::smatch list;
        if (!std::regex_search(lines, list, std::regex("DEPENDS ([^\n)]*)")))
            continue;
        std::istringstream words(list[1]);
        for (std::string word; words >> word;)
            dependencies.insert(word);
    }
    return result;
}

// A module with all that lies below it; empty where that leads back to the module.
std::set<std::string> withModulesBelow(const std::map<std::string, std::set<std::string>>& modules,
                                       const std::string& module) {
    std::set<std::string> seen;
    std::vector<std::string> open{module};
    while (!open.empty()) {
        const std::string current = open.back();
        open.pop_back();
        if (!modules.contains(current)) {
            ADD_FAILURE() << current << ": no such module";
            continue;
        }
        for (const std::string& below : modules.at(current)) {
            if (below == module)
                return {};
            if (seen.insert(below).second)
                open.push_back(below);
        }
    }
    seen.insert(module);
    return seen;
}

TEST(Borders, CoreModulesSeeOnlyThoseBelowThem) {
    const auto all = modules();
    EXPECT_GT(all.size(), 20u);
    for (const auto& [module, dependencies] : all) {
        SCOPED_TRACE(module);
        const std::set<std::string> visible = withModulesBelow(all, module);
        EXPECT_FALSE(visible.empty()) << "depends on itself";
        std::string allowed;
        for (const std::string& name : visible)
            allowed += (allowed.empty() ? "" : "|") + name;
        // Folders of a module's own folder are modules of their own.
        const std::string own = "core/" + module;
        const std::regex include(R"(^\s*#\s*include\s*"core/([a-z/]+)/)");
        for (const fs::directory_entry& entry :
             fs::directory_iterator(fs::path(PATINA_SOURCE_DIR) / own)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp")
                continue;
            std::ifstream stream(entry.path());
            std::string line;
            for (int number = 1; std::getline(stream, line); ++number) {
                std::smatch found;
                if (std::regex_search(line, found, include)) {
                    EXPECT_TRUE(visible.contains(found[1]))
                        << own << "/" << entry.path().filename().string() << ":" << number << ": "
                        << line << "\nvisible: " << allowed;
                }
            }
        }
    }
}

TEST(Borders, RenderSeesNoQtAndNoApplication) {
    EXPECT_EQ(violations("render", "Q[A-Z]|Qt|app/|embree|assimp|OpenImageIO"), 0);
}

TEST(Borders, TheCommandLineAndTheWorkerSeeNoQt) {
    EXPECT_EQ(violations("app/cli", "Q[A-Z]|Qt"), 0);
    EXPECT_EQ(violations("app/worker", "Q[A-Z]|Qt|render/"), 0);
}

TEST(Borders, EachLibraryHasOneAdapter) {
    EXPECT_EQ(violations("core", "OpenImageIO/", "core/codec/openimageio/OpenImageIoCodec.cpp"), 0);
    EXPECT_EQ(
        violations("core", "OpenEXR/", "core/codec/image/(Exr(Reader|Writer)|LuminanceChroma).cpp"),
        0);
    EXPECT_EQ(violations("core", "png.h", "core/codec/image/PngReader.cpp|core/io/PngEncoder.cpp"),
              0);
    // What is written, and, in the worker that reads what nobody has checked, what Assimp is given.
    EXPECT_EQ(violations("core", "jpeglib.h", "core/codec/image/JpegReader.cpp"), 0);
    EXPECT_EQ(violations("core", "pugixml.hpp",
                         "core/(export/collada/ColladaTree.h|"
                         "codec/model/Collada(Arrays|Nodes|Scenes).cpp)"),
              0);
    EXPECT_EQ(violations("core", "assimp/", "core/codec/model/Assimp(Reader|Materials).cpp"), 0);
    EXPECT_EQ(violations("core", "draco/", "core/codec/model/DracoMesh.cpp"), 0);
    EXPECT_EQ(violations("core", "embree[34]/", "core/trace/Embree.h"), 0);
    EXPECT_EQ(violations("core", "(oneapi/)?tbb/", "core/job/Parallel.cpp"), 0);
    EXPECT_EQ(violations("app", "embree[34]/|assimp/|OpenImageIO/|(oneapi/)?tbb/"), 0);
}

// All work of the editor goes through one runner, with one border for exceptions and one end. What
// reads, writes or computes there is a task (core/job/TaskRunner.h).
TEST(Borders, TheEditorHasNoThreadsBesideItsRunner) {
    const std::regex threads("QThreadPool|QRunnable|QtConcurrent|QFutureWatcher|new QThread\\b|"
                             "QThread::create|std::(j?thread\\b|async\\()");
    // One hears of signals whatever the window is busy with.
    EXPECT_EQ(lines("app/editor", threads, "app/editor/TerminationWatch.(h|cpp)"), 0);
    EXPECT_EQ(
        lines("core", std::regex("std::(j?thread\\b(?!::)|async\\()"),
              "core/job/TaskRunner.cpp|core/job/LowThreads.(h|cpp)|core/recovery/RecoveryWriter.h"),
        0);
}

// Folders are opened to be synchronised, marks of open projects to be locked; what the kernel makes
// up, and the decoder's own process, need no care.
TEST(Borders, FilesAreOpenedForReadingInOnePlace) {
    const std::regex opens(
        "::open(at)?\\((?!.*O_(DIRECTORY|WRONLY|RDWR|TMPFILE)).*O_RDONLY|ifstream|"
        "fopen\\(");
    EXPECT_EQ(
        lines(
            "core", opens,
            "core/base/InputFile.cpp|core/base/ProcessMemory.cpp|core/codec/model/ModelFolder.cpp|"
            "core/worker/GuestRequests.cpp"),
        0);
    EXPECT_EQ(lines("render", opens, ""), 0);
    EXPECT_EQ(lines("app/cli", opens, ""), 0);
    EXPECT_EQ(lines("app/editor", opens, "app/editor/document/OpenProjects.cpp"), 0);
}

// What reaches a terminal passes core/base/PrintableText.h there.
TEST(Borders, FewFilesWriteToTheTerminal) {
    const std::regex writes(
        "fmt::print\\(|\\bf?printf\\(|\\bf?puts\\(|std::c(out|err|log)\\b|std::clog");
    EXPECT_EQ(lines("core", writes,
                    "core/base/Check.cpp|core/worker/WorkerClient.cpp"), // a sanitizer's report
              0);
    EXPECT_EQ(lines("render", writes, ""), 0);
    EXPECT_EQ(lines("app/cli", writes, "app/cli/(BakeRun|Report|Watcher).cpp"), 0);
    // Before there is a window: what the driver and Qt say, and the option that failed.
    EXPECT_EQ(lines("app/editor", writes, "app/editor/(main|OpenGlProbe|StartupMessages).cpp"), 0);
}

TEST(Borders, NothingDependsOnTests) {
    for (const char* folder : {"core", "render", "app"})
        EXPECT_EQ(violations(folder, "tests/|gtest|gmock"), 0);
}

} // namespace
