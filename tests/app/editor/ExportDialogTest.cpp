// The export dialog shows the plan, and the plan follows its settings.

#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/Actions.h"
#include "app/editor/widget/BusyIndicator.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/lightmap/LightMap.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/material/Material.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTableWidget>
#include <atomic>
#include <thread>

namespace patina::editor {
namespace {

struct ExportDialogTest : EditorTest {
    // The one that is shown: one that was closed may still be on its way out.
    static QDialog* openDialog() {
        window->actions().exportScene->trigger();
        for (auto* dialog : window->findChildren<QDialog*>(QStringLiteral("exportDialog")))
            if (dialog->isVisible())
                return dialog;
        return nullptr;
    }
};

TEST_F(ExportDialogTest, TheEnvironmentComesAlongWhenTicked) {
    QDialog* dialog = openDialog();
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

TEST_F(ExportDialogTest, NothingVisibleCannotBeExportedAndSaysWhy) {
    const std::vector<MeshInstance> meshes = document().meshes;
    for (const MeshInstance& mesh : meshes)
        controller().setParameter(*findParameter("mesh.visible"), {Scope::Mesh, mesh.id}, false);
    QDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    auto* run = dialog->findChild<QPushButton*>(QStringLiteral("exportRun"));
    auto* warnings = dialog->findChild<QLabel*>(QStringLiteral("exportWarnings"));
    ASSERT_TRUE(run && warnings);
    EXPECT_FALSE(run->isEnabled());
    EXPECT_TRUE(warnings->text().contains(QStringLiteral("make at least one mesh visible")));
    auto* all = dialog->findChild<QCheckBox*>(QStringLiteral("exportVisible"));
    ASSERT_NE(all, nullptr);
    QTest::mouseClick(all, Qt::LeftButton, Qt::NoModifier, {8, all->height() / 2});
    EXPECT_TRUE(run->isEnabled());
    EXPECT_FALSE(warnings->text().contains(QStringLiteral("visible")));
    dialog->reject();
}

TEST_F(ExportDialogTest, BandsOfATransferAreChosenWhereThereIsOne) {
    const auto bands = [](QDialog* dialog) {
        return dialog->findChild<QComboBox*>(QStringLiteral("exportBands"));
    };
    QDialog* without = openDialog();
    ASSERT_NE(without, nullptr);
    EXPECT_FALSE(bands(without)->isVisible());
    without->reject();

    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = 3;
    bake->inputs = hashBakeInputs(bakeInputs(document()));
    for (const MeshInstance& mesh : document().meshes)
        bake->vertices.push_back(
            {mesh.id, 9, std::vector<float>(9 * mesh.mesh->vertexCount(), 0.25f)});
    controller().attachBake(bake);
    QDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    ASSERT_TRUE(bands(dialog)->isVisible());
    const auto lists = [&](const QString& text) {
        const auto* files = dialog->findChild<QTableWidget*>(QStringLiteral("exportFiles"));
        return !files->findItems(text, Qt::MatchContains).isEmpty();
    };
    EXPECT_FALSE(lists(QStringLiteral("3 bands"))) << "few programs read it";
    auto* box = dialog->findChild<QCheckBox*>(QStringLiteral("exportTransfer"));
    ASSERT_NE(box, nullptr);
    QTest::mouseClick(box, Qt::LeftButton, Qt::NoModifier, {8, box->height() / 2});
    EXPECT_TRUE(lists(QStringLiteral("3 bands")));
    bands(dialog)->setFocus();
    QTest::keyClick(bands(dialog), Qt::Key_Down);
    EXPECT_EQ(bands(dialog)->currentText(), QStringLiteral("The first 2"));
    EXPECT_TRUE(lists(QStringLiteral("2 bands")));
    dialog->reject();
    controller().removeBake(BakeKind::PrtVertex);
}

TEST_F(ExportDialogTest, ALightMapIsAskedForWhereThereIsOne) {
    const auto box = [](QDialog* dialog) {
        return dialog->findChild<QCheckBox*>(QStringLiteral("exportLightMap"));
    };
    QDialog* without = openDialog();
    ASSERT_NE(without, nullptr);
    EXPECT_FALSE(box(without)->isVisible());
    without->reject();

    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::LightMap;
    bake->inputs = hashBakeInputs(bakeInputs(document()));
    bake->light = hashLightMapLight(traceInputs(document()));
    for (const Material& material : document().materials) {
        TexelBake& texels = bake->texels.emplace_back();
        texels.material = material.id;
        texels.side = 4;
        texels.stride = kLightMapStride;
        texels.values.assign(std::size_t{16} * kLightMapStride, 0.25f);
    }
    controller().attachBake(bake);
    QDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    ASSERT_TRUE(box(dialog)->isVisible());
    EXPECT_TRUE(box(dialog)->isChecked());
    const auto* files = dialog->findChild<QTableWidget*>(QStringLiteral("exportFiles"));
    const auto maps = [&] {
        return files->findItems(QStringLiteral("_irradiance.exr"), Qt::MatchEndsWith).size();
    };
    EXPECT_EQ(maps(), static_cast<qsizetype>(document().materials.size()));
    const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
    if (!target.isEmpty())
        dialog->grab().save(target + QStringLiteral("/export-light-map.png"));
    QTest::mouseClick(box(dialog), Qt::LeftButton, Qt::NoModifier, {8, box(dialog)->height() / 2});
    EXPECT_EQ(maps(), 0);
    dialog->reject();
    controller().removeBake(BakeKind::LightMap);
}

// A scene whose textures are damaged has a warning for each.
TEST_F(ExportDialogTest, ManyWarningsLeaveTheFilesInSight) {
    QDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    auto* files = dialog->findChild<QTableWidget*>(QStringLiteral("exportFiles"));
    auto* warnings = dialog->findChild<QLabel*>(QStringLiteral("exportWarnings"));
    auto* area = dialog->findChild<QScrollArea*>(QStringLiteral("exportWarningsArea"));
    ASSERT_TRUE(files && warnings && area);
    QStringList texts;
    for (int i = 0; i < 60; ++i)
        texts << QStringLiteral("Material %1: its base colour could not be read").arg(i);
    warnings->setText(texts.join(QLatin1Char('\n')));
    area->show();
    test::handleEvents();
    EXPECT_GE(files->viewport()->height(), 4 * files->verticalHeader()->defaultSectionSize());
    EXPECT_GE(area->height(), 3 * warnings->fontMetrics().height());
    EXPECT_LE(dialog->height(), 700); // on a screen of 768
    EXPECT_GT(area->verticalScrollBar()->maximum(), 0);
    const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS", folder.path());
    ASSERT_TRUE(QDir().mkpath(target));
    EXPECT_TRUE(dialog->grab().save(QDir(target).filePath(QStringLiteral("export-warnings.png"))));
    dialog->reject();
}

TEST_F(ExportDialogTest, TheStatusBarSaysHowFarAJobHasCome) {
    auto* indicator = window->findChild<BusyIndicator*>();
    ASSERT_NE(indicator, nullptr);
    ASSERT_TRUE(eventually([&] { return indicator->isHidden(); }));
    QAction* jobs = window->actions().jobsDock;
    ASSERT_FALSE(jobs->isChecked());
    std::atomic<bool> mayEnd = false;
    session->jobs.start(QStringLiteral("Export: 100%2.glb"), false, [&](const JobContext& job) {
        job.setProgress(0.42);
        while (!mayEnd)
            std::this_thread::yield();
        return JobOutcome{std::nullopt, QStringLiteral("100%2.glb"), {}};
    });
    EXPECT_TRUE(eventually([&] {
        return indicator->activity() == QStringLiteral("Export: 100%2.glb · 42 %");
    })) << indicator->activity().toStdString();
    EXPECT_TRUE(indicator->isVisible());
    QTest::mouseClick(indicator, Qt::LeftButton);
    EXPECT_TRUE(eventually([&] { return jobs->isChecked(); }));
    QTest::mouseClick(indicator, Qt::LeftButton); // they stay in sight
    EXPECT_TRUE(jobs->isChecked());
    mayEnd = true;
    EXPECT_TRUE(eventually([&] { return indicator->isHidden(); }));
    jobs->trigger();
    session->jobs.clearFinished();
}

} // namespace
} // namespace patina::editor
