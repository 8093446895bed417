// A save is one step: whenever it ends, the project and its bakes are of one version, nothing that
// the project names is lost, and nothing of others is overwritten unasked.
#include "SceneFixture.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/scene/DocumentIO.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gmock/gmock.h>
#include <map>
#include <random>
#include <set>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace patina;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

// Versions are numbers that exposure and every value of every bake hold: 1/256 steps, which halves
// and decimals keep.
float numberOf(int version) {
    return static_cast<float>(version % 256) / 256.0f;
}

BakeArtifactPtr bakeOf(const Document& document, BakeKind kind, int version) {
    BakeArtifact bake;
    bake.kind = kind;
    bake.samplesDone = 64;
    bake.settings["samples"] = "64";
    bake.inputs = hashBytes({});
    bake.order = holdsTransfer(kind) ? 2 : 0;
    const std::size_t stride = holdsTransfer(kind) ? 4 : 1;
    for (const MeshInstance& mesh : document.meshes) {
        VertexBake& vertices = bake.vertices.emplace_back();
        vertices.mesh = mesh.id;
        vertices.stride = static_cast<int>(stride);
        vertices.values.assign(mesh.mesh->vertexCount() * stride, numberOf(version));
    }
    return std::make_shared<const BakeArtifact>(std::move(bake));
}

void setVersion(Document& document, int version) {
    document.view.exposureEv = numberOf(version);
    attachBake(document, bakeOf(document, BakeKind::AoVertex, version));
    attachBake(document, bakeOf(document, BakeKind::PrtVertex, version));
}

class ProjectSave : public SceneFixture {
  protected:
    void saveTo(const Document& document, const fs::path& file) {
        const Result<void> saved = saveProject(m_worker, document, file);
        ASSERT_TRUE(saved.ok()) << saved.error().text();
    }
    [[nodiscard]] std::set<std::string> bakeFiles(const std::string& folder = "p.bakes") const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(m_folder / folder))
            names.insert(entry.path().filename().string());
        return names;
    }
    // Opens the project and checks that all of it is of one version, which is returned.
    float versionOf(const fs::path& file) {
        const OpenedScene opened = open(file.string());
        EXPECT_EQ(opened.document.bakes.size(), 2u);
        EXPECT_TRUE(opened.notices.empty())
            << (opened.notices.empty() ? "" : opened.notices.front().message);
        const float version = opened.document.view.exposureEv;
        for (const BakeArtifactPtr& bake : opened.document.bakes) {
            EXPECT_FALSE(bake->vertices.empty());
            for (const VertexBake& vertices : bake->vertices)
                for (const float value : vertices.values)
                    if (value != version) {
                        ADD_FAILURE()
                            << "the project is of version " << version << ", its bake of " << value;
                        return version;
                    }
        }
        return version;
    }

    const fs::path m_file = m_folder / "p.patina";
};

// The disk is full after the bakes are written: the old project must still have its own.
TEST_F(ProjectSave, AFailureAfterTheBakesLeavesTheOldVersionWhole) {
    constexpr rlim_t kLimit = 1 << 18; // bytes of a file
    Document document = open("builtin:plane").document;
    setVersion(document, 1);
    saveTo(document, m_file);
    setVersion(document, 2);
    Light light;
    for (int i = 0; i < 800; ++i) { // the project's text becomes larger than its bakes
        light.name = "Light no. " + std::to_string(i);
        addLight(document, light);
    }
    ASSERT_GT(documentToJson(document, m_file).size(), kLimit);
    for (const auto& entry : fs::directory_iterator(m_folder / "p.bakes"))
        ASSERT_LT(entry.file_size(), kLimit);
    const pid_t child = ::fork();
    if (child == 0) {
        WorkerClient worker;
        static_cast<void>(encodeImage(worker, Image(1, 1, 1, PixelType::F32, ColorEncoding::Data),
                                      ImageFileFormat::Exr)); // starts it without the limit
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{kLimit, kLimit};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const Result<void> saved = saveProject(worker, document, m_file);
        std::fprintf(stderr, "%s\n", saved.ok() ? "saved" : saved.error().text().c_str());
        ::_exit(!saved.ok() && saved.error().kind == ErrorKind::Io ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(versionOf(m_file), numberOf(1));
    EXPECT_GT(bakeFiles().size(), 2u); // those of the second version came too early
    // They stay, or go with the next save.
    setVersion(document, 3);
    saveTo(document, m_file);
    EXPECT_EQ(versionOf(m_file), numberOf(3));
    EXPECT_EQ(bakeFiles().size(), 2u);
}

// kill -9 while a process saves again and again. PATINA_SAVE_KILLS sets how often.
TEST_F(ProjectSave, KilledAtAnyMomentProjectAndBakesAreOfOneVersion) {
    const char* wanted = std::getenv("PATINA_SAVE_KILLS");
    const int kills = wanted != nullptr ? std::atoi(wanted) : 5;
    const char* seedText = std::getenv("PATINA_SEED");
    const unsigned seed =
        seedText != nullptr ? static_cast<unsigned>(std::atoi(seedText)) : std::random_device()();
    SCOPED_TRACE("replay with PATINA_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    Document document = open("builtin:sphere").document;
    setVersion(document, 0);
    saveTo(document, m_file);
    std::set<float> seen;
    std::size_t most = 0;
    int version = 0;
    for (int kill = 0; kill < kills; ++kill) {
        std::array<int, 2> pipe{};
        ASSERT_EQ(::pipe(pipe.data()), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            WorkerClient worker;
            for (int next = version + 1;; ++next) {
                setVersion(document, next);
                const auto start = std::chrono::steady_clock::now();
                if (!saveProject(worker, document, m_file).ok())
                    ::_exit(1);
                const auto time = std::chrono::steady_clock::now() - start;
                const auto us = static_cast<std::uint32_t>(time / std::chrono::microseconds(1));
                static_cast<void>(::write(pipe[1], &us, sizeof us) == sizeof us);
            }
        }
        ::close(pipe[1]);
        // The first save starts the decoder; the second says how long one takes.
        std::uint32_t us = 0;
        for (int save = 0; save < 2; ++save, ++version)
            ASSERT_EQ(::read(pipe[0], &us, sizeof us), sizeof us) << "a save failed";
        // Decides nothing: any moment will do.
        ::usleep(static_cast<useconds_t>(random() % (us + us / 4)));
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "a save failed";
        while (::read(pipe[0], &us, sizeof us) == sizeof us)
            ++version;
        ::close(pipe[0]);
        const float there = versionOf(m_file);
        // What reported success is there, or what came after it.
        EXPECT_TRUE(there == numberOf(version) || there == numberOf(version + 1))
            << there * 256 << " where " << version % 256 << " was reported";
        version += there == numberOf(version + 1) ? 1 : 0;
        most = std::max(most, bakeFiles().size());
        seen.insert(there);
        if (HasFailure())
            return;
    }
    saveTo(document, m_file);
    EXPECT_EQ(bakeFiles().size(), 2u) << "what killed processes left is gone after a save";
    std::printf("%d kills, %d saves, %zu versions found, at most %zu bakes beside the project\n",
                kills, version, seen.size(), most);
}

TEST_F(ProjectSave, BakesThatAreThereAreNotWrittenAgain) {
    Document document = open("builtin:plane").document;
    setVersion(document, 1);
    saveTo(document, m_file);
    const std::set<std::string> before = bakeFiles();
    ASSERT_EQ(before.size(), 2u);
    const auto inodeOf = [&](const std::string& name) {
        struct stat info {};
        EXPECT_EQ(::stat((m_folder / ("p.bakes/" + name)).c_str(), &info), 0);
        return info.st_ino;
    };
    std::map<std::string, ino_t> inodes;
    for (const std::string& name : before)
        inodes[name] = inodeOf(name);
    document.view.exposureEv = 0.75f;
    saveTo(document, m_file);
    EXPECT_EQ(bakeFiles(), before);
    for (const auto& [name, inode] : inodes)
        EXPECT_EQ(inodeOf(name), inode) << name;

    // One that was damaged meanwhile is.
    const std::string damaged = *before.begin();
    m_folder.write("p.bakes/" + damaged, "damaged");
    saveTo(document, m_file);
    EXPECT_EQ(open(m_file.string()).document.bakes[0]->vertices, document.bakes[0]->vertices);

    // A new one replaces the old one of its kind; what is no bake of ours stays.
    m_folder.write("p.bakes/notes.txt", "mine");
    m_folder.write("p.bakes/prtVertex-mine.exr", "mine");
    attachBake(document, bakeOf(document, BakeKind::PrtVertex, 2));
    saveTo(document, m_file);
    EXPECT_EQ(bakeFiles().size(), 4u);
    removeBake(document, BakeKind::PrtVertex);
    removeBake(document, BakeKind::AoVertex);
    saveTo(document, m_file);
    EXPECT_EQ(bakeFiles(), (std::set<std::string>{"notes.txt", "prtVertex-mine.exr"}));
}

TEST_F(ProjectSave, ABakeThatIsAwayKeepsItsPlace) {
    Document document = open("builtin:plane").document;
    setVersion(document, 1);
    saveTo(document, m_file);
    const std::string before = *readTextFile(m_file, 1 << 20);
    fs::rename(m_folder / "p.bakes", m_folder / "away");

    OpenedScene without = open(m_file.string());
    EXPECT_EQ(without.notices.size(), 2u);
    EXPECT_TRUE(mentions(without.notices, "put the file back"));
    EXPECT_EQ(findBake(without.document, BakeKind::PrtVertex), nullptr);
    EXPECT_FALSE(hasTransfer(without.document));
    saveTo(without.document, m_file);
    EXPECT_EQ(*readTextFile(m_file, 1 << 20), before);
    // Also when one is replaced, and in another place.
    attachBake(without.document, bakeOf(without.document, BakeKind::AoVertex, 9));
    saveTo(without.document, m_file);
    EXPECT_EQ(bakeFiles().size(), 1u);
    fs::create_directory(m_folder / "elsewhere");
    saveTo(without.document, m_folder / "elsewhere/q.patina");

    for (const auto& entry : fs::directory_iterator(m_folder / "away"))
        fs::rename(entry.path(), m_folder / "p.bakes" / entry.path().filename());
    for (const char* file : {"p.patina", "elsewhere/q.patina"}) {
        const OpenedScene back = open((m_folder / file).string());
        EXPECT_TRUE(back.notices.empty()) << file;
        const BakeArtifactPtr transfer = findBake(back.document, BakeKind::PrtVertex);
        const BakeArtifactPtr ao = findBake(back.document, BakeKind::AoVertex);
        ASSERT_TRUE(transfer && ao) << file;
        EXPECT_EQ(transfer->vertices.at(0).values.at(0), numberOf(1)) << file;
        EXPECT_EQ(ao->vertices.at(0).values.at(0), numberOf(9)) << file;
    }
}

TEST_F(ProjectSave, ABakeOfAModelThatIsAwayKeepsItsPlace) {
    Document document = open(writeModel()).document;
    setVersion(document, 1);
    saveTo(document, m_file);
    const std::string before = *readTextFile(m_file, 1 << 20);
    fs::rename(m_folder / "models", m_folder / "away");
    const OpenedScene without = open(m_file.string());
    EXPECT_EQ(findBake(without.document, BakeKind::AoVertex), nullptr);
    saveTo(without.document, m_file);
    EXPECT_EQ(*readTextFile(m_file, 1 << 20), before);
    fs::rename(m_folder / "away", m_folder / "models");
    const OpenedScene back = open(m_file.string());
    EXPECT_NE(findBake(back.document, BakeKind::AoVertex), nullptr);
    EXPECT_EQ(bakeFiles().size(), 2u);
}

// Projects of before bakes were named by their content.
TEST_F(ProjectSave, OldProjectsOpenAndAreRenewed) {
    Document document = open("builtin:plane").document;
    setVersion(document, 5);
    saveTo(document, m_file);
    for (const std::string& name : bakeFiles())
        fs::rename(m_folder / ("p.bakes/" + name),
                   m_folder / ("p.bakes/" + name.substr(0, name.find('-')) + ".exr"));
    m_folder.write("p.patina", documentToJson(document, m_file)); // which names them the old way
    EXPECT_EQ(bakeFiles(), (std::set<std::string>{"aoVertex.exr", "prtVertex.exr"}));
    EXPECT_EQ(versionOf(m_file), numberOf(5));
    saveTo(open(m_file.string()).document, m_file);
    EXPECT_EQ(versionOf(m_file), numberOf(5));
    EXPECT_EQ(bakeFiles().size(), 2u);
    EXPECT_FALSE(bakeFiles().contains("aoVertex.exr"));
}

TEST_F(ProjectSave, AFolderThatIsGoneIsNotMadeAnew) {
    fs::create_directory(m_folder / "work");
    const fs::path file = m_folder / "work/p.patina";
    Document document = open("builtin:plane").document;
    setVersion(document, 1);
    saveTo(document, file);
    fs::rename(m_folder / "work", m_folder / "moved");
    const SaveOutcome outcome = saveProject(m_worker, document, file, SaveTerms{});
    ASSERT_TRUE(outcome.error.has_value());
    EXPECT_EQ(outcome.obstacle, SaveObstacle::FolderGone);
    EXPECT_EQ(outcome.error->kind, ErrorKind::CannotCreate);
    EXPECT_THAT(outcome.error->message, HasSubstr("folder"));
    EXPECT_FALSE(fs::exists(m_folder / "work"));
}

TEST_F(ProjectSave, WhatOthersWroteIsNotOverwrittenUnasked) {
    Document document = open("builtin:plane").document;
    const SaveOutcome first = saveProject(m_worker, document, m_file, SaveTerms{});
    ASSERT_FALSE(first.error.has_value());
    document.view.exposureEv = 1.0f;
    SaveTerms terms{first.version, false};
    const SaveOutcome second = saveProject(m_worker, document, m_file, terms);
    ASSERT_FALSE(second.error.has_value());
    EXPECT_EQ(projectVersion(m_file), second.version);

    // Somebody else: the same size, within the same second.
    document.view.exposureEv = 2.0f;
    saveTo(document, m_file);
    const std::string theirs = *readTextFile(m_file, 1 << 20);
    terms.expected = second.version;
    document.view.exposureEv = 3.0f;
    const SaveOutcome refused = saveProject(m_worker, document, m_file, terms);
    ASSERT_TRUE(refused.error.has_value());
    EXPECT_EQ(refused.obstacle, SaveObstacle::Changed);
    EXPECT_EQ(*readTextFile(m_file, 1 << 20), theirs);
    // What was removed is no one's work.
    fs::remove(m_file);
    EXPECT_FALSE(saveProject(m_worker, document, m_file, terms).error.has_value());
}

TEST_F(ProjectSave, AWriteProtectedFileIsReplacedOnlyWithConsent) {
    Document document = open("builtin:plane").document;
    saveTo(document, m_file);
    fs::permissions(m_file, fs::perms::owner_read);
    const std::string before = *readTextFile(m_file, 1 << 20);
    document.view.exposureEv = 2.0f;
    SaveTerms terms;
    terms.mayReplaceReadOnly = false;
    const SaveOutcome refused = saveProject(m_worker, document, m_file, terms);
    ASSERT_TRUE(refused.error.has_value());
    EXPECT_EQ(refused.obstacle, SaveObstacle::ReadOnly);
    EXPECT_EQ(*readTextFile(m_file, 1 << 20), before);
    terms.mayReplaceReadOnly = true;
    EXPECT_FALSE(saveProject(m_worker, document, m_file, terms).error.has_value());
    EXPECT_NE(*readTextFile(m_file, 1 << 20), before);
    EXPECT_EQ(fs::status(m_file).permissions(), fs::perms::owner_read) << "it stays protected";
}

// Several at once, as from two editors: one after the other, each of them whole.
TEST_F(ProjectSave, SavesOfOneProjectFollowEachOther) {
    const Document document = open("builtin:plane").document;
    std::atomic<int> failed = 0;
    std::vector<std::thread> savers;
    for (int saver = 0; saver < 3; ++saver)
        savers.emplace_back([&, saver] {
            Document mine = document;
            for (int round = 0; round < 5; ++round) {
                setVersion(mine, 1 + saver * 50 + round);
                failed += saveProject(m_worker, mine, m_file).ok() ? 0 : 1;
            }
        });
    for (std::thread& saver : savers)
        saver.join();
    EXPECT_EQ(failed, 0);
    versionOf(m_file);
    EXPECT_EQ(m_folder.files(), (std::vector<std::string>{"p.bakes", "p.patina"}));
    EXPECT_EQ(bakeFiles().size(), 2u);
}

// An archive brought X.bakes as a link, or a link inside of it.
TEST_F(ProjectSave, LinksAmongTheBakesAreNotFollowed) {
    Document document = open("builtin:plane").document;
    setVersion(document, 1);
    saveTo(document, m_file);
    const fs::path victim = m_folder.write("victim", "precious");
    for (const std::string& name : bakeFiles()) {
        fs::remove(m_folder / ("p.bakes/" + name));
        fs::create_symlink(victim, m_folder / ("p.bakes/" + name));
    }
    saveTo(document, m_file);
    EXPECT_EQ(*readTextFile(victim, 100), "precious");
    EXPECT_EQ(versionOf(m_file), numberOf(1));

    fs::create_directory(m_folder / "private");
    m_folder.write("private/aoVertex.exr", "precious");
    fs::remove_all(m_folder / "p.bakes");
    fs::create_directory_symlink(m_folder / "private", m_folder / "p.bakes");
    const std::string before = *readTextFile(m_file, 1 << 20);
    const Result<void> saved = saveProject(m_worker, document, m_file);
    ASSERT_FALSE(saved.ok());
    EXPECT_EQ(saved.error().kind, ErrorKind::CannotCreate);
    EXPECT_THAT(saved.error().message, HasSubstr("link"));
    EXPECT_EQ(*readTextFile(m_file, 1 << 20), before);
    document.bakes.clear();
    saveTo(document, m_file);
    EXPECT_EQ(bakeFiles("private"), (std::set<std::string>{"aoVertex.exr"}));
}

} // namespace
