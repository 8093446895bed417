// The export dialog shows the plan, and the plan follows its settings.

#include "tests/app/editor/EditorFixture.h"

#include "app/editor/Actions.h"

#include <QCheckBox>
#include <QDialog>
#include <QDir>
#include <QLineEdit>
#include <QTableWidget>

namespace patina::editor {
namespace {

struct ExportDialogTest : EditorTest {};

TEST_F(ExportDialogTest, TheEnvironmentComesAlongWhenTicked) {
    window->actions().exportScene->trigger();
    auto* dialog = window->findChild<QDialog*>(QStringLiteral("exportDialog"));
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QLineEdit*>(QStringLiteral("exportPath"))
        ->setText(folder.filePath(QStringLiteral("scene.glb")));
    auto* files = dialog->findChild<QTableWidget*>(QStringLiteral("exportFiles"));
    auto* box = dialog->findChild<QCheckBox*>(QStringLiteral("exportEnvironment"));
    ASSERT_NE(files, nullptr);
    ASSERT_NE(box, nullptr);
    EXPECT_FALSE(box->isChecked()); // few programs read it
    const int before = files->rowCount();

    QTest::mouseClick(box, Qt::LeftButton, Qt::NoModifier, {8, box->height() / 2});
    ASSERT_TRUE(box->isChecked());
    ASSERT_EQ(files->rowCount(), before + 1);
    EXPECT_EQ(files->item(before, 0)->text(), QStringLiteral("environment"));
    EXPECT_EQ(files->item(before, 4)->text(), QStringLiteral("Inside scene.glb"));
    const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS", folder.path());
    ASSERT_TRUE(QDir().mkpath(target));
    EXPECT_TRUE(dialog->grab().save(QDir(target).filePath(QStringLiteral("export.png"))));

    QTest::mouseClick(box, Qt::LeftButton, Qt::NoModifier, {8, box->height() / 2});
    EXPECT_EQ(files->rowCount(), before);
    dialog->reject();
}

} // namespace
} // namespace patina::editor
