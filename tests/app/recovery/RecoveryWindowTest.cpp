// Unsaved work in a running window: what is kept when, and the dialog that offers it.

#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/Recovery.h"
#include "app/editor/RecoveryDialog.h"
#include "app/editor/TerminationWatch.h"
#include "core/edit/EditSession.h"
#include "core/scene/DocumentIO.h"

#include <QDir>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSessionManager>
#include <QTableWidget>
#include <algorithm>
#include <array>
#include <cstddef>

namespace patina::editor {
namespace {

namespace fs = std::filesystem;

class RecoveryWindow : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        root = fs::path(QFile::encodeName(folder.path()).toStdString()) / "recovery";
        recovery = std::make_unique<Recovery>(*session, *window, root, watch);
    }
    void TearDown() override { recovery.reset(); }

    static void rotate(float degrees) {
        controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0},
                                  degrees);
    }
    // As if another editor had ended with this document.
    void abandonCurrent() {
        ASSERT_TRUE(recovery->keeper().keepNow());
        recovery.reset();
        session->controller.newDocument();
        ASSERT_TRUE(settled(*session));
        recovery = std::make_unique<Recovery>(*session, *window, root, watch);
    }
    [[nodiscard]] fs::path savedScene() {
        const QString file = folder.filePath(QStringLiteral("helmet.patina"));
        bool done = false;
        controller().saveAs(file, [&](bool ok) { done = ok; });
        EXPECT_TRUE(eventually([&] { return done; }));
        return QFile::encodeName(file).toStdString();
    }
    static RecoveryDialog* dialog() {
        for (auto* found : window->findChildren<RecoveryDialog*>())
            if (found->isVisible())
                return found;
        return nullptr;
    }
    static void press(QWidget& parent, const QString& name) {
        auto* button = find<QPushButton>(parent, name);
        ASSERT_NE(button, nullptr) << name.toStdString();
        ASSERT_TRUE(button->isEnabled()) << name.toStdString();
        QTest::mouseClick(button, Qt::LeftButton);
    }
    static void shoot(const QString& name) {
        test::handleEvents();
        const QString to = qEnvironmentVariable("PATINA_SCREENSHOTS", QStringLiteral("."));
        QDir().mkpath(to);
        dialog()->grab().save(QStringLiteral("%1/%2.png").arg(to, name));
    }
    // Of this editor's session; empty while nothing is kept.
    [[nodiscard]] fs::path recordFile() const {
        if (fs::exists(root))
            for (const auto& entry : fs::directory_iterator(root))
                if (fs::exists(entry.path() / "work.recovery"))
                    return entry.path() / "work.recovery";
        return {};
    }
    [[nodiscard]] std::size_t offered() const { return abandonedWorks(root).works.size(); }

    fs::path root;
    TerminationWatch watch;
    std::unique_ptr<Recovery> recovery;
};

TEST_F(RecoveryWindow, AnEditIsKeptWithinTwoSecondsAndASaveEndsIt) {
    rotate(30.0f);
    ASSERT_TRUE(eventually([&] { return !recordFile().empty(); }));
    EXPECT_EQ(offered(), 0u) << "its editor runs";
    controller().undoStack().undo();
    EXPECT_TRUE(eventually([&] { return recordFile().empty(); })) << "nothing is unsaved any more";
    controller().undoStack().redo();
    EXPECT_TRUE(eventually([&] { return !recordFile().empty(); }));
    static_cast<void>(savedScene());
    EXPECT_TRUE(eventually([&] { return recordFile().empty(); }));
}

TEST_F(RecoveryWindow, TheLastStateOfADragIsKept) {
    const DragSession drag = controller().newDragSession();
    for (int i = 1; i <= 40; ++i) {
        controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0},
                                  static_cast<float>(i), drag);
        QCoreApplication::processEvents();
    }
    ASSERT_TRUE(recovery->keeper().keepNow());
    recovery.reset();
    const AbandonedWorks found = abandonedWorks(root);
    ASSERT_EQ(found.works.size(), 1u);
    const auto kept =
        documentFromJson(found.works[0].record.project, found.works[0].record.projectFile());
    ASSERT_TRUE(kept.ok());
    EXPECT_EQ(kept->environment().rotationDeg, 40.0f);
    EXPECT_EQ(found.works[0].record.steps, 1);
}

TEST_F(RecoveryWindow, StepsAreCountedFromTheLastSave) {
    rotate(10.0f);
    rotate(20.0f);
    EXPECT_EQ(controller().unsavedSteps(), 2);
    static_cast<void>(savedScene());
    EXPECT_EQ(controller().unsavedSteps(), 0);
    rotate(30.0f);
    EXPECT_EQ(controller().unsavedSteps(), 1);
    controller().undoStack().undo();
    controller().undoStack().undo();
    EXPECT_EQ(controller().unsavedSteps(), 1) << "one step before what was saved";
    rotate(40.0f);
    EXPECT_EQ(controller().unsavedSteps(), 0) << "undo does not lead back to what was saved";
    ASSERT_TRUE(controller().isModified());
    static_cast<void>(savedScene());
    rotate(50.0f);
    ASSERT_TRUE(recovery->keeper().keepNow());
    recovery.reset();
    const AbandonedWorks found = abandonedWorks(root);
    ASSERT_EQ(found.works.size(), 1u);
    EXPECT_EQ(found.works[0].record.steps, 1);
}

TEST_F(RecoveryWindow, WorkThatTheUserGaveUpIsNotOffered) {
    rotate(40.0f);
    ASSERT_TRUE(recovery->keeper().keepNow());
    recovery->leave();
    recovery.reset();
    EXPECT_EQ(offered(), 0u);
}

TEST_F(RecoveryWindow, RecoversComparesAndLeavesTheSavedFileAlone) {
    const fs::path file = savedScene();
    const Hash before = hashFile(file);
    const QString name = controller().displayName();
    rotate(50.0f);
    controller().setParameter(parameter("material.metallic"),
                              {Scope::Material, document().materials.front().id}, 0.75f);
    // The picture of it, which is taken when frames pause.
    const auto picture = [&] {
        const fs::path record = recordFile();
        return record.empty() ? QImage()
                              : QImage(QFile::decodeName(
                                    (record.parent_path() / "work.png").string().c_str()));
    };
    ASSERT_TRUE(eventually([&] { return !picture().isNull(); }));
    const QColor middle = picture().pixelColor(picture().width() / 2, picture().height() / 2);
    EXPECT_GT(middle.lightness(), 10) << "the ball is not black";
    abandonCurrent();

    recovery->offer();
    ASSERT_NE(dialog(), nullptr);
    shoot(QStringLiteral("recovery-one"));
    press(*dialog(), QStringLiteral("Compare with Saved"));
    auto* table = dialog()->findChild<QTableWidget*>();
    ASSERT_NE(table, nullptr);
    QStringList lines;
    for (int row = 0; row < table->rowCount(); ++row)
        lines << table->item(row, 1)->text() + QLatin1Char(':') + table->item(row, 3)->text();
    EXPECT_TRUE(lines.contains(QStringLiteral("Metallic:0.75")))
        << lines.join(QLatin1Char(' ')).toStdString();
    EXPECT_TRUE(lines.filter(QStringLiteral(":50")).size() == 1)
        << lines.join(QLatin1Char(' ')).toStdString();
    shoot(QStringLiteral("recovery-compare"));

    press(*dialog(), QStringLiteral("Recover"));
    ASSERT_TRUE(eventually([&] { return document().environment().rotationDeg == 50.0f; }));
    EXPECT_TRUE(controller().isModified());
    EXPECT_EQ(controller().filePath().toStdString(), file.string());
    EXPECT_EQ(controller().displayName(), name);
    EXPECT_FALSE(document().meshes.empty());
    EXPECT_EQ(hashFile(file), before);
    controller().undoStack().undo();
    EXPECT_FALSE(controller().isModified()) << "what was saved lies below";
    EXPECT_EQ(document().environment().rotationDeg, 0.0f);
    controller().undoStack().redo();
    EXPECT_EQ(document().environment().rotationDeg, 50.0f);
    // And it is kept on, in the folder where it was.
    ASSERT_TRUE(recovery->keeper().keepNow());
    recovery.reset();
    const AbandonedWorks again = abandonedWorks(root);
    ASSERT_EQ(again.works.size(), 1u);
}

TEST_F(RecoveryWindow, AFileThatWasChangedMeanwhileIsNotTheOneThatCtrlSWrites) {
    const fs::path file = savedScene();
    rotate(60.0f);
    abandonCurrent();
    ASSERT_TRUE(writeFileAtomically(file, std::string_view("somebody else's")).ok());
    recovery->offer();
    ASSERT_NE(dialog(), nullptr);
    press(*dialog(), QStringLiteral("Recover"));
    ASSERT_TRUE(eventually([&] { return document().environment().rotationDeg == 60.0f; }));
    EXPECT_TRUE(controller().filePath().isEmpty());
    EXPECT_TRUE(controller().isModified());
}

// "gpj.patina" with an override before it (U+202E) would read as "anitap.jpg".
TEST_F(RecoveryWindow, NamesThatRunBackwardsAreShownForwards) {
    rotate(40.0f);
    const QString file =
        folder.filePath(QStringLiteral("holiday") + QChar(0x202e) + QStringLiteral("gpj.patina"));
    bool done = false;
    controller().saveAs(file, [&](bool ok) { done = ok; });
    ASSERT_TRUE(eventually([&] { return done; }));
    const auto runsBackwards = [](const QString& text) {
        return std::any_of(text.begin(), text.end(), [](QChar c) {
            return (c >= QChar(0x202a) && c <= QChar(0x202e)) ||
                   (c >= QChar(0x2066) && c <= QChar(0x2069));
        });
    };
    EXPECT_FALSE(runsBackwards(window->windowTitle())) << window->windowTitle().toStdString();
    EXPECT_TRUE(window->windowTitle().contains(QStringLiteral("gpj.patina")));
    rotate(50.0f);
    abandonCurrent();
    recovery->offer();
    ASSERT_NE(dialog(), nullptr);
    press(*dialog(), QStringLiteral("Compare with Saved"));
    bool named = false;
    for (const auto* label : dialog()->findChildren<QLabel*>()) {
        EXPECT_FALSE(runsBackwards(label->text())) << label->text().toStdString();
        named = named || label->text().contains(QStringLiteral("gpj.patina"));
    }
    EXPECT_TRUE(named);
    const auto* list = dialog()->findChild<QListWidget*>();
    for (int i = 0; i < list->count(); ++i)
        EXPECT_FALSE(runsBackwards(list->item(i)->text()));
    press(*dialog(), QStringLiteral("Later"));
    ASSERT_TRUE(eventually([] { return dialog() == nullptr; }));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
}

TEST_F(RecoveryWindow, DiscardAsksAndLaterKeeps) {
    rotate(70.0f);
    abandonCurrent();
    rotate(80.0f);
    abandonCurrent();
    recovery->offer();
    ASSERT_NE(dialog(), nullptr);
    auto* list = dialog()->findChild<QListWidget*>();
    ASSERT_EQ(list->count(), 2);
    EXPECT_FALSE(find<QPushButton>(*dialog(), QStringLiteral("Compare with Saved"))->isEnabled())
        << "it was never saved";
    shoot(QStringLiteral("recovery-two"));
    press(*dialog(), QStringLiteral("Discard…"));
    const auto question = [] {
        for (auto* box : window->findChildren<QMessageBox*>())
            if (box->isVisible())
                return box;
        return static_cast<QMessageBox*>(nullptr);
    };
    ASSERT_NE(question(), nullptr);
    QTest::mouseClick(question()->button(QMessageBox::Cancel), Qt::LeftButton);
    EXPECT_EQ(list->count(), 2);
    press(*dialog(), QStringLiteral("Discard…"));
    ASSERT_TRUE(eventually([&] { return question() != nullptr; }));
    QTest::mouseClick(question()->button(QMessageBox::Discard), Qt::LeftButton);
    EXPECT_EQ(list->count(), 1);
    press(*dialog(), QStringLiteral("Later"));
    ASSERT_TRUE(eventually([] { return dialog() == nullptr; }));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_EQ(offered(), 1u);
    EXPECT_TRUE(controller().isPristine()) << "the start scene is untouched";
}

TEST_F(RecoveryWindow, TheLogoutOfTheSessionKeepsTheNewestState) {
    rotate(85.0f);
    rotate(90.0f);
    // Only Qt makes session managers. Nobody who is told of the request looks at this one.
    alignas(QSessionManager) static std::array<std::byte, sizeof(QSessionManager)> storage{};
    Q_EMIT qApp->commitDataRequest(*reinterpret_cast<QSessionManager*>(storage.data()));
    // Nothing else is waited for: the file has it.
    const fs::path file = recordFile();
    ASSERT_FALSE(file.empty());
    const auto record = readRecoveryRecord(file);
    ASSERT_TRUE(record.ok()) << record.error().text();
    const auto kept = documentFromJson(record->project, record->projectFile());
    ASSERT_TRUE(kept.ok()) << kept.error().text();
    EXPECT_EQ(kept->environment().rotationDeg, 90.0f);
}

} // namespace
} // namespace patina::editor
