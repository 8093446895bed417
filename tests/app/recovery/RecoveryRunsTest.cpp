// Editors that are killed, terminated or lose their X server while they are edited: their work is
// offered, at most two seconds of it are lost, and the user's file is as it was. How often:
// PATINA_RECOVERY_KILLS, _TERMS and _DISPLAYS (a few by default; the demand is 100, 20 and 20).

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/recovery/RecoverySession.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/app/recovery/ChildProcess.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <random>
#include <sstream>
#include <thread>

namespace patina {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::SizeIs;

int setting(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

std::int64_t nowMs() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

struct Edit {
    int number = 0;
    std::int64_t ms = 0;
};

std::vector<Edit> editsIn(const fs::path& log) {
    std::vector<Edit> edits;
    std::ifstream stream(log);
    std::string line, word;
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        Edit edit;
        if (words >> word >> edit.number >> edit.ms && word == "edit")
            edits.push_back(edit);
    }
    return edits;
}

// The number of the last edit that a document holds.
int lastEdit(const Document& document) {
    int number = static_cast<int>(document.lights.at(0).intensity);
    const std::string& name = document.materials.at(0).name;
    if (name.starts_with("edit "))
        number = std::max(number, std::atoi(name.c_str() + 5));
    return number;
}

class RecoveryRuns : public ::testing::Test {
  protected:
    void SetUp() override {
        WorkerClient worker;
        Document document = startDocument();
        document.lights.resize(1);
        document.lights.front().id = document.takeId();
        document.lights.front().intensity = 0.0f;
        ASSERT_TRUE(saveProject(worker, document, files / "scene.patina").ok());
    }

    // `end` ends the editor that edits, given its number of the run; returns its status.
    struct Totals {
        int runs = 0, offered = 0, pictures = 0;
        std::int64_t worstLossMs = 0;
        int worstLossEdits = 0;
    };
    void run(int count, const std::map<std::string, std::string>& environment,
             const std::function<void(test::ChildProcess&)>& end, Totals& totals) {
        for (int i = 0; i < count; ++i) {
            SCOPED_TRACE("run " + std::to_string(i));
            const test::TemporaryFolder data;
            std::map<std::string, std::string> variables = environment;
            variables["XDG_DATA_HOME"] = data.path().string();
            const Hash before = hashFile(files / "scene.patina");
            const fs::path log = data / "log";
            test::ChildProcess editor(
                {PATINA_RECOVERY_VICTIM, (files / "scene.patina").string(), std::to_string(i)},
                variables, log.string());
            const std::int64_t limit = nowMs() + 120'000;
            while (editsIn(log).empty() && editor.running() && nowMs() < limit)
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            ASSERT_TRUE(editor.running());
            // At a random moment of the editing; the first edits have the two seconds, too.
            std::this_thread::sleep_for(std::chrono::milliseconds(2000 + m_random() % 3000));
            const std::int64_t ended = nowMs();
            end(editor);
            ++totals.runs;

            const std::vector<Edit> edits = editsIn(log);
            const AbandonedWorks found =
                abandonedWorks(data.path() / "Patina" / "Patina" / "recovery");
            const std::vector<AbandonedWork>& works = found.works;
            ASSERT_THAT(works, SizeIs(1)) << edits.size() << " edits";
            ++totals.offered;
            totals.pictures += fs::exists(works[0].session->pictureFile()) ? 1 : 0;
            const auto document =
                documentFromJson(works[0].record.project, works[0].record.projectFile());
            ASSERT_TRUE(document.ok()) << document.error().text();
            const int kept = lastEdit(*document);
            const auto lost = std::ranges::find_if(
                edits, [kept](const Edit& edit) { return edit.number > kept; });
            if (lost != edits.end()) {
                totals.worstLossMs = std::max(totals.worstLossMs, ended - lost->ms);
                totals.worstLossEdits =
                    std::max(totals.worstLossEdits, static_cast<int>(edits.end() - lost));
            }
            EXPECT_EQ(hashFile(files / "scene.patina"), before);
            EXPECT_THAT(files.files(), ElementsAre("scene.patina"));
        }
        std::printf("%d runs: offered %d, with picture %d; lost at most %d edits, %lld ms\n",
                    totals.runs, totals.offered, totals.pictures, totals.worstLossEdits,
                    static_cast<long long>(totals.worstLossMs));
    }

    test::TemporaryFolder files;
    std::mt19937 m_random{20};
};

// Two seconds; a machine that many programs share may stand still for longer than that.
std::int64_t longestLossMs() {
    return setting("PATINA_RECOVERY_LOSS_MS", 10'000);
}

TEST_F(RecoveryRuns, AKilledEditorsWorkIsOffered) {
    Totals totals;
    run(
        setting("PATINA_RECOVERY_KILLS", 2), {},
        [](test::ChildProcess& editor) {
            editor.signal(SIGKILL);
            EXPECT_EQ(editor.wait(60.0), 128 + SIGKILL);
        },
        totals);
    EXPECT_LE(totals.worstLossMs, longestLossMs());
}

TEST_F(RecoveryRuns, ATerminatedEditorLosesNothing) {
    Totals totals;
    int turn = 0;
    run(
        setting("PATINA_RECOVERY_TERMS", 2), {},
        [&turn](test::ChildProcess& editor) {
            const int signal = ++turn % 2 == 0 ? SIGHUP : SIGTERM;
            editor.signal(signal);
            EXPECT_EQ(editor.wait(60.0), 128 + signal);
        },
        totals);
    EXPECT_EQ(totals.worstLossEdits, 0);
}

TEST_F(RecoveryRuns, AnEditorWhoseDisplayEndsLosesAtMostTwoSeconds) {
    Totals totals;
    const int count = setting("PATINA_RECOVERY_DISPLAYS", 1);
    for (int i = 0; i < count; ++i) {
        test::TemporaryFolder folder;
        test::XServer server(folder.path().string());
        run(
            1, {{"DISPLAY", server.display()}},
            [&server](test::ChildProcess& editor) {
                server.kill();
                EXPECT_NE(editor.wait(60.0), -1) << "it goes on without a display";
            },
            totals);
    }
    EXPECT_LE(totals.worstLossMs, longestLossMs());
}

} // namespace
} // namespace patina
