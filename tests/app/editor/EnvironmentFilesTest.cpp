// Environment files in the editor: choosing the layout, and saving in another one.

#include "tests/app/editor/EditorFixture.h"

#include "core/edit/EditSession.h"
#include "core/scene/EnvironmentSave.h"
#include "core/scene/Scene.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QToolButton>

namespace patina::editor {
namespace {

struct EnvironmentFiles : EditorTest {
    // Nothing here is seen in the viewport, and drawing takes long.
    void SetUp() override {
        window->findChild<ViewportWidget*>()->hide();
        EditorTest::SetUp();
    }
    QString path(const char* name) { return folder.filePath(QString::fromLatin1(name)); }
    std::filesystem::path write(const char* name, EnvironmentLayout layout) {
        const EnvironmentSaveSettings settings{path(name).toStdString(), layout, 64, false};
        const auto written =
            saveEnvironment(controller().worker(), document().environment(), settings);
        EXPECT_TRUE(written.ok());
        return settings.output;
    }
};

TEST_F(EnvironmentFiles, ChangingTheLayoutReadsTheFileAnewAsOneStep) {
    write("ball.exr", EnvironmentLayout::MirrorBall);
    controller().setEnvironment(path("ball.exr"));
    ASSERT_TRUE(settled(*session));
    ASSERT_EQ(undoCount(), 1);
    const ImagePtr angular = document().environment().image;

    const ParameterInfo& layout = parameter("environment.layout");
    controller().setParameter(layout, {Scope::Environment, 0},
                              static_cast<int>(EnvironmentLayout::MirrorBall));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(undoCount(), 2);
    EXPECT_EQ(document().environment().layout, EnvironmentLayout::MirrorBall);
    EXPECT_NE(*document().environment().image, *angular);
    controller().undoStack().undo();
    EXPECT_EQ(document().environment().layout, EnvironmentLayout::Automatic);
    EXPECT_EQ(document().environment().image, angular);
    controller().undoStack().redo();
    EXPECT_EQ(document().environment().layout, EnvironmentLayout::MirrorBall);

    // A layout that does not fit changes nothing and is explained.
    controller().setParameter(layout, {Scope::Environment, 0},
                              static_cast<int>(EnvironmentLayout::HorizontalCross));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().layout, EnvironmentLayout::MirrorBall);
    EXPECT_EQ(undoCount(), 2);
    // The next file is guessed again.
    controller().setEnvironment(QStringLiteral("builtin:sunset"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().layout, EnvironmentLayout::Automatic);
}

TEST_F(EnvironmentFiles, TheDialogWritesWhatItSays) {
    window->findChild<QDockWidget*>(QStringLiteral("environment"))->raise();
    QApplication::processEvents();
    auto* saveAs = find<QToolButton>(*window, QStringLiteral("Save the environment"));
    ASSERT_NE(saveAs, nullptr);
    QTest::mouseClick(saveAs, Qt::LeftButton);
    auto* dialog = window->findChild<QDialog*>(QStringLiteral("environmentSaveDialog"));
    ASSERT_NE(dialog, nullptr);
    auto* layout = dialog->findChild<QComboBox*>(QStringLiteral("environmentSaveLayout"));
    auto* format = dialog->findChild<QComboBox*>(QStringLiteral("environmentSaveFormat"));
    auto* size = dialog->findChild<QSpinBox*>(QStringLiteral("environmentSaveSize"));
    auto* file = dialog->findChild<QLineEdit*>(QStringLiteral("environmentSavePath"));
    auto* envmap = dialog->findChild<QCheckBox*>(QStringLiteral("environmentSaveEnvmap"));
    auto* summary = dialog->findChild<QLabel*>(QStringLiteral("environmentSaveSummary"));
    auto* save = dialog->findChild<QPushButton*>(QStringLiteral("environmentSaveRun"));
    ASSERT_TRUE(layout && format && size && file && envmap && summary && save);
    file->setText(path("sky.exr"));
    EXPECT_TRUE(envmap->isEnabled());

    layout->setCurrentIndex(layout->findText(QStringLiteral("Six faces")));
    EXPECT_FALSE(envmap->isEnabled());
    format->setCurrentIndex(1);
    EXPECT_EQ(file->text(), path("sky.hdr"));
    size->setValue(32);
    EXPECT_THAT(summary->text().toStdString(), testing::HasSubstr("Six files of 32 × 32"));
    file->setText(QStringLiteral("/home/artist/sky.hdr"));
    const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS", folder.path());
    ASSERT_TRUE(QDir().mkpath(target));
    EXPECT_TRUE(dialog->grab().save(QDir(target).filePath(QStringLiteral("save-environment.png"))));
    // A name of no format cannot be saved, and the dialog says why.
    file->setText(path("sky.txt"));
    EXPECT_FALSE(save->isEnabled());
    EXPECT_THAT(summary->text().toStdString(), testing::HasSubstr(".exr or .hdr"));
    file->setText(path("sky.hdr"));
    ASSERT_TRUE(save->isEnabled());
    QTest::mouseClick(save, Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));

    controller().setEnvironment(path("sky_px.hdr"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().source, path("sky_px.hdr").toStdString());
    EXPECT_EQ(document().environment().image->width(), 128);
    EXPECT_TRUE(document().environment().problem.empty());
}

} // namespace
} // namespace patina::editor
