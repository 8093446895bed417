// The Bake and Jobs docks, driven by real clicks: queue, pause, staleness, cache, interruption.
#include "core/document/ViewChoices.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/UnderSky.h"
#include "tests/support/Events.h"

#include "app/editor/job/BakeRates.h"
#include "app/editor/job/InterruptedBakes.h"
#include "app/editor/job/LivePreview.h"
#include "app/editor/panel/BakePanel.h"
#include "app/editor/panel/JobRow.h"
#include "app/editor/panel/JobTexts.h"
#include "app/editor/viewport/IblUpdater.h"
#include "core/bake/Bake.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/domain/BakePresets.h"
#include "core/base/AtomicFile.h"
#include "core/base/FileLock.h"
#include "core/edit/EditSession.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>
#include <QToolButton>
#include <string>

namespace patina::editor {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class BakeManagerTest : public EditorTest {
  protected:
    void SetUp() override {
        // Kept bakes and checkpoints of other tests would answer instead.
        ASSERT_TRUE(QDir(cacheFolder()).removeRecursively());
        EditorTest::SetUp();
        window->viewport().setFixedSize(320, 200); // software OpenGL pays for each pixel
        session->jobs.clearFinished();
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        choose("bakeKind", QStringLiteral("Ambient occlusion (per vertex)"));
    }
    void TearDown() override {
        session->jobs.cancelAll();
        ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    }

    static QString cacheFolder() {
        return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
               QStringLiteral("/bakes");
    }
    static BakePanel& panel() { return *window->findChild<BakePanel*>(); }
    template <class Widget>
    static Widget* visible(const char* name) {
        for (Widget* widget : panel().findChildren<Widget*>(QLatin1String(name)))
            if (widget->isVisibleTo(&panel()))
                return widget;
        return nullptr;
    }
    static void click(const char* name) {
        ASSERT_TRUE(eventually([&] { return visible<QPushButton>(name) != nullptr; })) << name;
        visible<QPushButton>(name)->click();
    }
    static void choose(const char* name, const QString& text) {
        auto* box = panel().findChild<QComboBox*>(QLatin1String(name));
        ASSERT_NE(box, nullptr) << name;
        ASSERT_GE(box->findText(text), 0) << text.toStdString();
        box->setCurrentIndex(box->findText(text));
    }
    static void rays(int count) { choose("bakeSamples", QLocale().toString(count)); }
    static JobRecord job(std::size_t index) { return session->jobs.jobs().at(index); }
    static std::string status() {
        test::handleEvents(); // rows that were made anew
        const auto* label = visible<QLabel>("bakeStatus");
        return label ? label->text().toStdString() : "";
    }
    // What a job has done when the ranges that were under way have come to their end.
    static double workAtRest(std::size_t index) {
        double last = -1.0;
        int same = 0;
        EXPECT_TRUE(eventually([&] {
            const double now = job(index).progress.workDone;
            same = now == std::exchange(last, now) ? same + 1 : 0;
            return same >= 10;
        }));
        return last;
    }
    static bool traces(std::size_t index) {
        return eventually([&] { return job(index).progress.workDone > 0.0; });
    }
};

TEST_F(BakeManagerTest, BakesTakeTurnsByPriority) {
    rays(8192);
    click("bakeStart");
    ASSERT_EQ(job(0).state, JobState::Running);
    ASSERT_TRUE(traces(0));
    EXPECT_EQ(visible<QPushButton>("bakeStart")->text(), QStringLiteral("Add to the queue"));
    rays(16384); // not over before it has been looked at twice
    click("bakeStart");
    ASSERT_EQ(session->jobs.jobs().size(), 2u);
    EXPECT_EQ(job(1).state, JobState::Queued);
    EXPECT_FALSE(job(1).begun);

    // A higher priority lets the first one rest; it goes on afterwards from where it was.
    session->jobs.setPriority(job(1).id, JobPriority::High);
    EXPECT_EQ(job(0).state, JobState::Queued);
    EXPECT_TRUE(job(0).begun);
    EXPECT_EQ(job(1).state, JobState::Running);
    ASSERT_TRUE(traces(1));
    const double rested = workAtRest(0);
    const double second = job(1).progress.workDone;
    ASSERT_TRUE(eventually([&] { return job(1).progress.workDone > second; }));
    EXPECT_EQ(job(0).progress.workDone, rested);
    session->jobs.cancel(job(1).id);
    ASSERT_TRUE(eventually([&] { return job(1).state == JobState::Cancelled; }));
    EXPECT_EQ(job(0).state, JobState::Running);
    EXPECT_TRUE(eventually([&] { return job(0).progress.workDone > rested; }));
}

TEST_F(BakeManagerTest, APausedBakeRestsAndLetsTheNextGo) {
    rays(16384);
    click("bakeStart");
    ASSERT_TRUE(traces(0));
    click("bakePause");
    EXPECT_EQ(job(0).state, JobState::Paused);
    EXPECT_EQ(visible<QPushButton>("bakePause")->text(), QStringLiteral("Resume"));
    rays(32);
    click("bakeStart");
    EXPECT_EQ(job(1).state, JobState::Running);
    ASSERT_TRUE(eventually([&] { return job(1).ended(); }));
    EXPECT_EQ(job(1).state, JobState::Done) << job(1).summary.toStdString();
    const double rested = workAtRest(0); // the tiles that were begun when it was paused end first
    QTest::qWait(50);                    // nothing to wait for: it shows that nothing comes
    EXPECT_EQ(job(0).state, JobState::Paused);
    EXPECT_EQ(job(0).progress.workDone, rested);
    click("bakePause");
    EXPECT_TRUE(eventually([&] { return job(0).progress.workDone > rested; }));
    // Stopping ends a rest, and keeps what there is.
    session->jobs.pause(job(0).id);
    session->jobs.stop(job(0).id);
    ASSERT_TRUE(eventually([&] { return job(0).ended(); }));
    EXPECT_EQ(job(0).state, JobState::Stopped);
}

TEST_F(BakeManagerTest, WhatWaitsCanBeCancelled) {
    rays(16384);
    click("bakeStart");
    click("bakeStart");
    ASSERT_EQ(job(1).state, JobState::Queued);
    session->jobs.cancel(job(1).id);
    EXPECT_EQ(job(1).state, JobState::Cancelled);
    EXPECT_EQ(job(0).state, JobState::Running);
    click("bakeStart");
    session->jobs.cancelAll();
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    for (const JobRecord& record : session->jobs.jobs()) {
        EXPECT_EQ(record.state, JobState::Cancelled);
        EXPECT_THAT(record.summary.toStdString(), HasSubstr("nothing was kept"));
    }
    EXPECT_TRUE(document().bakes.empty());
}

TEST_F(BakeManagerTest, AStaleBakeSaysWhyAndIsBakedAgainByOneClick) {
    rays(32);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    EXPECT_THAT(status(), HasSubstr("Up to date, 32 rays"));

    rays(64); // the bake stays right, whatever else could be baked
    EXPECT_THAT(status(), HasSubstr("Up to date, 32 rays"));
    EXPECT_THAT(status(), HasSubstr("Form differs: Rays 64 (this bake: 32)"));
    EXPECT_EQ(visible<QPushButton>("rebake"), nullptr);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.front()->samplesDone == 64; }));
    EXPECT_TRUE(eventually([] { return status().find("Up to date") != std::string::npos; }));

    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    rays(32);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 2; }));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    controller().addModel(QStringLiteral("builtin:plane"));
    ASSERT_TRUE(settled(*session));
    EXPECT_THAT(status(), HasSubstr("Stale: geometry"));
    EXPECT_THAT(status(), HasSubstr("was added or shown"));
    click("rebakeStale");
    EXPECT_EQ(session->jobs.runningCount(), 2);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_TRUE(eventually([] {
        QList<QLabel*> labels = panel().findChildren<QLabel*>(QStringLiteral("bakeStatus"));
        return std::none_of(labels.begin(), labels.end(), [](const QLabel* label) {
            return label->isVisibleTo(&panel()) && label->text().contains(QLatin1String("Stale"));
        });
    }));
    ASSERT_EQ(document().bakes.size(), 2u);
    // Each with the settings it had.
    for (const BakeArtifactPtr& bake : document().bakes)
        EXPECT_EQ(bake->samplesDone, bake->kind == BakeKind::AoVertex ? 64 : 32);
}

TEST_F(BakeManagerTest, WhatWasBakedBeforeComesFromTheCache) {
    rays(64);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    const BakeArtifactPtr first = document().bakes.front();
    controller().removeBake(BakeKind::AoVertex);
    ASSERT_TRUE(document().bakes.empty());
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    EXPECT_EQ(*document().bakes.front(), *first);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_EQ(job(1).progress.workDone, 0.0) << "no ray was traced";
    EXPECT_THAT(job(1).summary.toStdString(), HasSubstr("kept from an earlier bake"));
}

// A bake of other geometry takes its place; back in the old one, by undo or by hand, it is there
// again, whole, without a job. Undo itself leaves bakes alone.
TEST_F(BakeManagerTest, TheBakeOfTheGeometryBeforeComesBack) {
    rays(64);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    const BakeArtifactPtr whole = document().bakes.front();
    const Id mesh = document().meshes.front().id;
    const QString undoText = controller().undoStack().undoText();
    controller().addModel(QStringLiteral("builtin:plane"));
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return document().meshes.size() == 2; }));
    EXPECT_EQ(document().bakes.front(), whole) << "stale, but there";
    click("bakeStart");
    ASSERT_TRUE(eventually([&] { return document().bakes.front() != whole; }));
    const BakeArtifactPtr ofBoth = document().bakes.front();
    controller().undoStack().undo();
    ASSERT_EQ(document().meshes.size(), 1u);
    EXPECT_EQ(controller().undoStack().undoText(), undoText);
    ASSERT_TRUE(eventually([&] { return document().bakes.front() == whole; }));
    controller().undoStack().redo();
    ASSERT_TRUE(eventually([&] { return document().bakes.front() == ofBoth; }));
    controller().removeMesh(document().meshes.back().id == mesh ? document().meshes.front().id
                                                                : document().meshes.back().id);
    ASSERT_TRUE(eventually([&] { return document().bakes.front() == whole; }));
    EXPECT_EQ(session->jobs.runningCount(), 0);
    EXPECT_FALSE(controller().undoStack().canRedo());
}

// Another document interrupts a bake; back in the scene it goes on from its checkpoint and comes to
// what it would have come to.
TEST_F(BakeManagerTest, AnInterruptedBakeIsOfferedAndGoesOn) {
    rays(4096); // not over before it is interrupted
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    const BakeArtifact whole = *document().bakes.front();
    ASSERT_TRUE(QDir(cacheFolder()).removeRecursively());
    controller().removeBake(BakeKind::AoVertex);
    session->jobs.clearFinished();

    click("bakeStart");
    ASSERT_TRUE(traces(0));
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    if (job(0).state == JobState::Done)
        GTEST_FAIL() << "the bake was over before it was interrupted";
    EXPECT_THAT(job(0).summary.toStdString(), HasSubstr("Interrupted; it can go on"));
    EXPECT_TRUE(document().bakes.empty()) << "of another document";
    EXPECT_EQ(visible<QPushButton>("bakeResume"), nullptr) << "not of this scene";
    controller().openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return visible<QPushButton>("bakeResume") != nullptr; }));
    EXPECT_THAT(visible<QLabel>("bakeUnfinished")->text().toStdString(),
                AllOf(HasSubstr("Unfinished, from"), HasSubstr("% of its 4,096 rays")));
    click("bakeResume");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    BakeArtifact resumed = *document().bakes.front();
    ASSERT_EQ(resumed.vertices.size(), whole.vertices.size());
    EXPECT_EQ(resumed.vertices[0].values, whole.vertices[0].values);
    EXPECT_EQ(visible<QPushButton>("bakeResume"), nullptr);
    EXPECT_TRUE(QDir(cacheFolder()).entryList({QStringLiteral("*.checkpoint")}).isEmpty());
}

// Another program computes the same bake: its checkpoint is not offered, not continued and not
// overwritten.
TEST_F(BakeManagerTest, ACheckpointThatAnotherProgramWritesIsLeftAlone) {
    rays(2048);
    click("bakeStart");
    ASSERT_TRUE(traces(0));
    controller().newDocument(); // interrupts it
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    const QStringList files = QDir(cacheFolder()).entryList({QStringLiteral("*.checkpoint")});
    ASSERT_EQ(files.size(), 1);
    const std::filesystem::path file = (cacheFolder() + u'/' + files.front()).toStdString();
    const Result<Bytes> before = readFile(file, 1 << 24);
    ASSERT_TRUE(before.ok());

    std::optional<FileLock> other; // of its bake
    other.emplace(FileLock::take(file).value());
    controller().openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(visible<QPushButton>("bakeResume"), nullptr);
    EXPECT_FALSE(removeCheckpoint(file).ok());
    std::vector<UserNotice> notices;
    QObject here;
    QObject::connect(&controller(), &DocumentController::noticed, &here,
                     [&](const UserNotice& notice) { notices.push_back(notice); });
    rays(2048);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_EQ(document().bakes.front()->samplesDone, 2048);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_THAT(notices.front().text.toStdString(),
                HasSubstr("another program computes this bake"));
    EXPECT_EQ(readFile(file, 1 << 24).value(), *before);

    other.reset(); // it crashed
    EXPECT_TRUE(removeCheckpoint(file).ok());
    EXPECT_FALSE(std::filesystem::exists(file));
}

// The bake that goes on may have been asked for with quite other settings than the form has.
TEST_F(BakeManagerTest, TheFormFollowsABakeThatIsResumed) {
    rays(4096); // not over before it is interrupted
    click("bakeStart");
    ASSERT_TRUE(traces(0));
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    ASSERT_EQ(job(0).state, JobState::Cancelled);
    rays(32);
    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    controller().openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(*session));
    click("bakeResume");
    EXPECT_EQ(visible<QComboBox>("bakeKind")->currentText(),
              QStringLiteral("Ambient occlusion (per vertex)"));
    EXPECT_EQ(visible<QComboBox>("bakeSamples")->currentText(), QLocale().toString(4096));
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_THAT(status(),
                AllOf(HasSubstr("Up to date, 4,096 rays"), Not(HasSubstr("Form differs"))));
    EXPECT_EQ(visible<QPushButton>("rebake"), nullptr);
}

// Attached from elsewhere, it takes the form along, unless that was edited.
TEST_F(BakeManagerTest, TheFormFollowsAnAttachedBakeUntilItIsEdited) {
    controller().openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(*session));
    const auto attach = [](int samples) {
        TileSink sink;
        AoSettings settings;
        settings.samples = samples;
        controller().attachBake(std::make_shared<const BakeArtifact>(
            *bakeAoVertex(bakeInputs(document()), settings, sink, {})));
    };
    const auto shown = [] { return visible<QComboBox>("bakeSamples")->currentText().toInt(); };
    rays(64);
    attach(64); // as the form has it: nothing is edited any more
    attach(32);
    EXPECT_EQ(shown(), 32);
    rays(128);
    attach(64);
    EXPECT_EQ(shown(), 128);
    EXPECT_THAT(status(), HasSubstr("Form differs: Rays 128 (this bake: 64)"));
}

TEST_F(BakeManagerTest, AStoppedBakeSaysAtHowManyRaysAndGoesOn) {
    rays(2048); // not over before it is stopped
    click("bakeStart");
    ASSERT_TRUE(eventually(
        [] { return session->bakes.preview() && session->bakes.preview()->samplesDone() >= 32; }));
    click("bakeStop");
    // Said at once: keeping takes a moment on large scenes.
    EXPECT_TRUE(job(0).ended() || job(0).stopping);
    if (!job(0).ended()) {
        EXPECT_EQ(visible<QPushButton>("bakeStop"), nullptr);
        EXPECT_THAT(stateText(job(0)).toStdString(), HasSubstr("Stopping"));
    }
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    ASSERT_EQ(job(0).state, JobState::Stopped);
    ASSERT_EQ(document().bakes.size(), 1u);
    const std::optional<StoppedBake> stopped = stoppedEarly(*document().bakes[0]);
    ASSERT_TRUE(stopped);
    EXPECT_EQ(stopped->asked, 2048);
    EXPECT_THAT(status(), HasSubstr("Stopped at " + std::to_string(stopped->done) + " of "));
    EXPECT_THAT(job(0).summary.toStdString(), HasSubstr(" of 2048 rays"));
    EXPECT_EQ(visible<QPushButton>("bakeResume"), nullptr) << "offered once";
    EXPECT_FALSE(QDir(cacheFolder()).entryList({QStringLiteral("*.checkpoint")}).isEmpty());

    click("bakeContinue");
    ASSERT_TRUE(traces(1));
    // Progress starts where it was: the rays that are known are not traced again.
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    ASSERT_EQ(job(1).state, JobState::Done) << job(1).summary.toStdString();
    EXPECT_THAT(status(), HasSubstr("Up to date, 2,048 rays"));
    EXPECT_LT(job(1).progress.workDone,
              2048.0 * static_cast<double>(document().meshes[0].mesh->vertexCount()));
    EXPECT_TRUE(QDir(cacheFolder()).entryList({QStringLiteral("*.checkpoint")}).isEmpty());
    TileSink sink;
    AoSettings settings;
    settings.samples = 2048;
    EXPECT_EQ(document().bakes[0]->vertices,
              bakeAoVertex(bakeInputs(document()), settings, sink, {})->vertices);
}

TEST_F(BakeManagerTest, AStoppedBakeDoesNotReplaceABetterOne) {
    rays(1024);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
    const BakeArtifactPtr better = document().bakes[0];
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    rays(16384);
    click("bakeStart");
    ASSERT_TRUE(eventually(
        [] { return session->bakes.preview() && session->bakes.preview()->samplesDone() >= 32; }));
    click("bakeStop");
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    // A machine that was faster than the click has more rays, and may replace it.
    if (const auto stopped = stoppedEarly(*document().bakes.at(0))) {
        EXPECT_GT(stopped->done, 1024) << "the better one was replaced";
    }
    if (document().bakes[0] == better) {
        EXPECT_TRUE(eventually([] { return visible<QPushButton>("bakeResume") != nullptr; }));
    }
}

// Re-baking shows the finished bake, bounces and all, until the better one is there.
TEST_F(BakeManagerTest, AFinishedBakeStaysInThePictureUntilTheNextIsDone) {
    controller().openScene(QStringLiteral("builtin:cornell-box"));
    ASSERT_TRUE(settled(*session));
    putUnderSky(*session);
    ASSERT_TRUE(eventually([] { return !controller().document().meshes.empty(); }));
    controller().setParameter(parameter("view.lighting"), {Scope::View, 0},
                              static_cast<int>(LightingMode::Prt));
    TileSink sink;
    PrtSettings settings;
    settings.samples = 64;
    settings.transfer = TransferKind::Interreflected;
    controller().attachBake(std::make_shared<const BakeArtifact>(
        *bakePrtVertex(bakeInputs(document()), settings, sink, {})));
    ASSERT_TRUE(eventually([] { return session->bounces.upToDate(); }));
    const auto difference = [](const QImage& a, const QImage& b) {
        double sum = 0.0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                sum += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y)));
        return sum / (a.width() * a.height());
    };
    const auto picture = [] { return window->viewport().grabFramebuffer(); };
    QImage before = picture();
    ASSERT_TRUE(eventually([&] { // light that has just been loaded comes in steps
        if (!window->viewport().isSettled())
            return false;
        const QImage last = std::exchange(before, picture());
        return session->ibl.finished() && !window->viewport().waitsForPrograms() &&
               difference(last, before) < 0.02;
    }));

    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    choose("bakeTransfer", QStringLiteral("Interreflected"));
    rays(16384);
    click("bakeStart");
    ASSERT_TRUE(eventually(
        [] { return session->bakes.preview() && session->bakes.preview()->samplesDone() >= 32; }));
    // Two passes later, and in a frame after them, it would be shown.
    ASSERT_TRUE(eventually([] { return session->bakes.preview()->samplesDone() >= 96; }));
    picture();
    EXPECT_FALSE(session->bakes.preview()->shown());
    EXPECT_LT(difference(before, picture()), 0.5);
    // Without a bake to keep, what is known so far is shown.
    controller().removeBake(BakeKind::PrtVertex);
    EXPECT_TRUE(session->bakes.preview()->shown());
    EXPECT_TRUE(eventually([&] { return difference(before, picture()) > 1.0; }))
        << "bounces are missing in it";
    session->jobs.cancelAll();
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
}

TEST_F(BakeManagerTest, CancellingALongBakeAsksAndStoppingIsTheDefault) {
    rays(16384);
    click("bakeStart");
    ASSERT_TRUE(eventually(
        [] { return session->bakes.preview() && session->bakes.preview()->samplesDone() >= 32; }));
    JobRow row(session->jobs, job(0), QStringLiteral("test"));
    auto* cancel = row.findChild<QPushButton*>(QStringLiteral("testCancel"));
    const auto question = [&] { return row.findChild<QMessageBox*>(); };
    JobRecord record = job(0);
    record.progress.secondsSoFar = 61.0;
    EXPECT_TRUE(cancelLosesMuch(record));
    row.show(record);
    cancel->click();
    ASSERT_NE(question(), nullptr);
    EXPECT_EQ(session->jobs.runningCount(), 1) << "nothing is lost before the answer";
    EXPECT_EQ(question()->defaultButton()->text(), QStringLiteral("&Stop and Keep"));
    question()->reject();
    EXPECT_TRUE(eventually([&] { return question() == nullptr; }));
    EXPECT_EQ(session->jobs.runningCount(), 1);

    cancel->click();
    ASSERT_NE(question(), nullptr);
    question()->defaultButton()->click();
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_EQ(job(0).state, JobState::Stopped);
    EXPECT_EQ(document().bakes.size(), 1u);

    // A short one is cancelled at once.
    record.progress.secondsSoFar = 59.0;
    EXPECT_FALSE(cancelLosesMuch(record));
    record.progress.secondsSoFar = 61.0;
    record.canStop = false; // an export has nothing to keep
    EXPECT_FALSE(cancelLosesMuch(record));
}

// Rays per second of the moment in which a bake is looked at are far off: bounces are followed
// without any.
TEST_F(BakeManagerTest, TheTimeOfABakeIsThatOfTheLastWholeOneOfItsKind) {
    BakeRequest bounces{BakeKind::PrtVertex, {}, {}};
    bounces.prt.transfer = TransferKind::Interreflected;
    const BakeRequest shadows{BakeKind::PrtVertex, {}, {}};
    const auto ended = [](double rays, double seconds) {
        JobProgress progress;
        progress.workDone = rays;
        progress.secondsSoFar = seconds;
        return progress;
    };
    BakeRates::learn(shadows, 1e6, ended(1e6, 2.0));
    BakeRates::learn(bounces, 1e6, ended(1e6, 10.0));
    EXPECT_NEAR(BakeRates::seconds(shadows, 3e6), 6.0, 1e-9);
    EXPECT_NEAR(BakeRates::seconds(bounces, 3e6), 30.0, 1e-9);
    BakeRates::learn(bounces, 1e6, ended(0.0, 1.0));  // found in the cache
    BakeRates::learn(bounces, 1e6, ended(1e4, 1.0));  // resumed at its end
    BakeRates::learn(bounces, 1e6, ended(1e6, 0.01)); // over at once
    EXPECT_NEAR(BakeRates::seconds(bounces, 3e6), 30.0, 1e-9);

    rays(16384);
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return job(0).ended(); }));
    const double took = job(0).progress.secondsSoFar;
    ASSERT_GT(took, 0.25) << "or it tells nothing";
    BakeRequest asked{BakeKind::AoVertex, {}, {}};
    asked.ao.samples = 16384;
    EXPECT_NEAR(session->bakes.expectedSeconds(asked, bakeInputs(document())), took, 1e-3 * took);
}

TEST_F(BakeManagerTest, ABakeInClosedFormIsNotSaidToHaveRays) {
    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    choose("bakeTransfer", QStringLiteral("Unshadowed"));
    click("bakeStart");
    ASSERT_TRUE(eventually([] { return job(0).ended(); }));
    EXPECT_EQ(job(0).summary, QStringLiteral("in closed form, without rays"));
    ASSERT_TRUE(eventually([] { return !document().bakes.empty(); }));
    EXPECT_THAT(status(), HasSubstr("Up to date, in closed form, without rays"));
    choose("bakeTransfer", QStringLiteral("Shadowed"));
}

TEST_F(BakeManagerTest, TimesAreToldAsCoarselyAsTheyMatter) {
    EXPECT_EQ(durationText(0.2), QStringLiteral("1 s"));
    EXPECT_EQ(durationText(59.5), QStringLiteral("1 min 00 s"));
    EXPECT_EQ(durationText(3599.0), QStringLiteral("59 min 59 s"));
    EXPECT_EQ(durationText(3600.0 + 7 * 60 + 59), QStringLiteral("1 h 07 min"));
    EXPECT_EQ(roughDurationText(0.2), QStringLiteral("about 1 s"));
    EXPECT_EQ(roughDurationText(42.0), QStringLiteral("about 40 s"));
    EXPECT_EQ(roughDurationText(62.0), QStringLiteral("about 1 min"));
    EXPECT_EQ(roughDurationText(3400.0), QStringLiteral("about 57 min"));
    EXPECT_EQ(roughDurationText(5400.0), QStringLiteral("about 1.5 h"));
    EXPECT_EQ(roughDurationText(36000.0), QStringLiteral("about 10 h"));
}

TEST_F(BakeManagerTest, PresetsSetRaysAndSayHowLongTheyTake) {
    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    choose("bakeTransfer", QStringLiteral("Shadowed"));
    choose("bakeOrder", QStringLiteral("5"));
    const auto button = [](const char* name) {
        return visible<QPushButton>((std::string("bakePreset-") + name).c_str());
    };
    double before = 0.0;
    for (const BakePreset& preset : bakePresets()) {
        ASSERT_NE(button(preset.name), nullptr) << preset.name;
        button(preset.name)->click();
        EXPECT_TRUE(button(preset.name)->isChecked());
        EXPECT_EQ(visible<QComboBox>("bakeSamples")->currentData().toInt(), preset.transferSamples);
        EXPECT_EQ(visible<QComboBox>("bakeOrder")->currentData().toInt(), 5) << "is left alone";
        EXPECT_THAT(button(preset.name)->text().toStdString(),
                    testing::StartsWith(std::string(preset.label) + "\nabout "));
        const BakeRequest request{BakeKind::PrtVertex, {}, {}};
        const double seconds =
            session->bakes.expectedSeconds(withPreset(request, preset), bakeInputs(document()));
        EXPECT_GT(seconds, before);
        before = seconds;
    }
    rays(128);
    for (const BakePreset& preset : bakePresets())
        EXPECT_FALSE(button(preset.name)->isChecked()) << "the rays are of none of them";
    choose("bakeTransfer", QStringLiteral("Unshadowed"));
    EXPECT_EQ(button("good"), nullptr) << "casts no ray";
    choose("bakeTransfer", QStringLiteral("Shadowed"));
    button("good")->click();
}

TEST_F(BakeManagerTest, TheFormShowsWhatApplies) {
    choose("bakeKind", QStringLiteral("Radiance transfer (PRT, per vertex)"));
    choose("bakeTransfer", QStringLiteral("Shadowed")); // the form follows the bakes of other tests
    EXPECT_NE(visible<QComboBox>("bakeOrder"), nullptr);
    auto* advanced = panel().findChild<QToolButton*>(QStringLiteral("bakeAdvanced"));
    ASSERT_NE(advanced, nullptr);
    if (visible<QCheckBox>("bakeFitted"))
        advanced->click();
    EXPECT_EQ(visible<QCheckBox>("bakeFitted"), nullptr);
    advanced->click();
    ASSERT_NE(visible<QCheckBox>("bakeFitted"), nullptr);
    EXPECT_EQ(advanced->text(), QStringLiteral("Advanced"));
    visible<QCheckBox>("bakeFitted")->click();
    EXPECT_EQ(advanced->text(), QStringLiteral("Advanced (1 changed)")) << "told when it is folded";
    visible<QCheckBox>("bakeFitted")->click();
    EXPECT_EQ(visible<QComboBox>("bakeBounces"), nullptr);
    EXPECT_EQ(visible<QComboBox>("bakeSize"), nullptr);
    choose("bakeTransfer", QStringLiteral("Interreflected"));
    EXPECT_NE(visible<QComboBox>("bakeBounces"), nullptr);
    EXPECT_NE(visible<QComboBox>("bakeBounceSamples"), nullptr);
    choose("bakeTransfer", QStringLiteral("Unshadowed"));
    EXPECT_EQ(visible<QComboBox>("bakeSamples"), nullptr);
    choose("bakeTransfer", QStringLiteral("Shadowed"));
    choose("bakeKind", QStringLiteral("Ambient occlusion (texture)"));
    EXPECT_NE(visible<QComboBox>("bakeSize"), nullptr);
    EXPECT_EQ(visible<QComboBox>("bakeOrder"), nullptr);
    for (const BakeOption& option : bakeOptions()) {
        QString name = QLatin1String(option.name);
        name[0] = name[0].toUpper();
        const auto* field = panel().findChild<QWidget*>(QStringLiteral("bake") + name);
        ASSERT_NE(field, nullptr) << option.name;
        EXPECT_FALSE(field->toolTip().isEmpty()) << option.name;
    }
    const auto* cost = find<QLabel>(panel(), QStringLiteral("Cost of the bake"));
    ASSERT_NE(cost, nullptr);
    EXPECT_THAT(cost->text().toStdString(), HasSubstr("of memory"));
}

} // namespace
} // namespace patina::editor
