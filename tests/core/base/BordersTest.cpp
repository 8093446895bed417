// The rooms' borders: who may include what (docs/architecture.md). Reads the sources.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <string>

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

TEST(Borders, RenderSeesNoQtAndNoApplication) {
    EXPECT_EQ(violations("render", "Q[A-Z]|Qt|app/|embree|assimp|OpenImageIO"), 0);
}

TEST(Borders, TheCommandLineAndTheWorkerSeeNoQt) {
    EXPECT_EQ(violations("app/cli", "Q[A-Z]|Qt"), 0);
    EXPECT_EQ(violations("app/worker", "Q[A-Z]|Qt|render/"), 0);
}

TEST(Borders, EachLibraryHasOneAdapter) {
    EXPECT_EQ(violations("core", "OpenImageIO/", "core/worker/ImageCodec.cpp"), 0);
    EXPECT_EQ(violations("core", "OpenEXR/", "core/worker/LuminanceChroma.cpp"), 0);
    EXPECT_EQ(violations("core", "assimp/", "core/worker/Assimp(Reader|Materials).cpp"), 0);
    EXPECT_EQ(violations("core", "draco/", "core/worker/DracoMesh.cpp"), 0);
    EXPECT_EQ(violations("core", "embree3/", "core/bake/RayScene.cpp"), 0);
    EXPECT_EQ(violations("core", "(oneapi/)?tbb/", "core/job/Parallel.cpp"), 0);
    EXPECT_EQ(violations("app", "embree3/|assimp/|OpenImageIO/|(oneapi/)?tbb/"), 0);
}

// Folders are opened to be synchronised, marks of open projects to be locked; what the kernel makes
// up, and the decoder's own process, need no care.
TEST(Borders, FilesAreOpenedForReadingInOnePlace) {
    const std::regex opens(
        "::open(at)?\\((?!.*O_(DIRECTORY|WRONLY|RDWR|TMPFILE)).*O_RDONLY|ifstream|"
        "fopen\\(");
    EXPECT_EQ(lines("core", opens,
                    "core/base/InputFile.cpp|core/bake/BakeMemory.cpp|core/worker/ModelFolder.cpp"),
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
