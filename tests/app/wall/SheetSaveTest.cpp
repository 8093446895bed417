// The wall as a file: what it holds is what the wall shows, and what the command line draws.
#include "app/editor/wall/SheetSave.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/wall/SheetSaveDialog.h"
#include "core/document/ViewChoices.h"
#include "core/io/ImageIO.h"
#include "core/sheet/WallSheet.h"
#include "tests/app/wall/WallFixture.h"

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <cmath>

namespace patina::editor {
namespace {

class SheetSaveTest : public WallWindow {
  protected:
    void SetUp() override {
        WallWindow::SetUp();
        WallPlan plan; // two materials × two lighting modes
        plan.columns.compared = Compared::Materials;
        plan.columns.hidden = {controller().document().materials[0].id};
        plan.rows.compared = Compared::LightingModes;
        for (const AxisChoice& choice : choicesOf(controller().document(), plan.rows, 8))
            if (choice.id != static_cast<Id>(LightingMode::Ibl) &&
                choice.id != static_cast<Id>(LightingMode::Unshadowed))
                plan.rows.hidden.push_back(choice.id);
        wall().setOn(true);
        wall().setPlan(plan);
        ASSERT_EQ(wall().cells().size(), 4u) << wall().problem().toStdString();
        ASSERT_TRUE(isSettled());
    }
    void TearDown() override {
        session->jobs.cancelAll();
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        session->jobs.clearFinished();
        WallWindow::TearDown();
    }

    [[nodiscard]] QString path(const char* name) const {
        return folder.filePath(QLatin1String(name));
    }
    SheetSave* save(const char* name, SheetFormat format, int width, bool captions = false) {
        SheetOrder order;
        order.file = path(name);
        order.format = format;
        order.cellWidth = width;
        order.captions = captions;
        order.title = QStringLiteral("A title");
        return new SheetSave(order, wall(), viewport(), controller(), session->jobs);
    }
    static JobState ended() {
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        const std::vector<JobRecord> jobs = session->jobs.jobs();
        return jobs.empty() ? JobState::Failed : jobs.back().state;
    }
    static double rmse(const QImage& a, const QImage& b) {
        EXPECT_EQ(a.size(), b.size());
        double sum = 0.0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) {
                const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
                sum += std::pow(p.redF() - q.redF(), 2) + std::pow(p.greenF() - q.greenF(), 2) +
                       std::pow(p.blueF() - q.blueF(), 2);
            }
        return std::sqrt(sum / (3.0 * a.width() * a.height()));
    }
    // Where a cell lies on a sheet without captions.
    static QRect placeOnSheet(std::size_t cell, const QSize& size) {
        const auto sheet =
            sheet::WallSheet::create(wall().wall(), size.width(), size.height(), std::nullopt);
        const glm::ivec2 place = sheet->place(wall().cells()[cell]);
        return {QPoint(place.x, place.y), size};
    }
};

TEST_F(SheetSaveTest, ASheetIsWhatTheWallShowsAndWhatTheCommandLineDraws) {
    const QSize size = placeOf(0).size();
    save("sheet.png", SheetFormat::Png, size.width());
    ASSERT_EQ(ended(), JobState::Done);
    const QImage sheet(path("sheet.png"));
    ASSERT_FALSE(sheet.isNull());
    for (std::size_t cell = 0; cell < 4; ++cell)
        EXPECT_LT(rmse(sheet.copy(placeOnSheet(cell, size)), pictureOf(cell)), 0.002)
            << "but for the dither of what is on screen";
    EXPECT_GT(rmse(sheet.copy(placeOnSheet(0, size)), pictureOf(1)), 0.02) << "another cell";

    bool saved = false;
    controller().saveAs(path("scene.patina"), [&](bool done) { saved = done; });
    ASSERT_TRUE(eventually([&] { return saved; }));
    QProcess patina;
    patina.start(qEnvironmentVariable("PATINA_BIN_DIR") + QStringLiteral("/patina"),
                 {QStringLiteral("sheet"), path("scene.patina"), QStringLiteral("--materials"),
                  QStringLiteral("Gold"), QStringLiteral("Clay"), QStringLiteral("--lightings"),
                  QStringLiteral("ibl"), QStringLiteral("unshadowed"), QStringLiteral("--size"),
                  QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                  QStringLiteral("--samples"), QStringLiteral("8"), QStringLiteral("--no-captions"),
                  QStringLiteral("-o"), path("line.png")});
    ASSERT_TRUE(patina.waitForFinished(120'000)) << patina.errorString().toStdString();
    ASSERT_EQ(patina.exitCode(), 0) << patina.readAllStandardError().toStdString();
    EXPECT_LT(rmse(sheet, QImage(path("line.png"))), 0.0005);
}

TEST_F(SheetSaveTest, TracedCellsAreThoseOfTheCommandLine) {
    const QSize size = placeOf(0).size();
    save("drawn.png", SheetFormat::Png, size.width());
    ASSERT_EQ(ended(), JobState::Done);
    const QImage drawn(path("drawn.png"));
    session->tracedCells.toggle({0}, TracedBy::Paths);
    session->tracedCells.toggle({1}, TracedBy::Whitted);
    save("traced.png", SheetFormat::Png, size.width());
    ASSERT_EQ(ended(), JobState::Done);
    session->tracedCells.toggle({0}, TracedBy::Paths);
    session->tracedCells.toggle({1}, TracedBy::Whitted);
    const QImage sheet(path("traced.png"));

    bool saved = false;
    controller().saveAs(path("scene.patina"), [&](bool done) { saved = done; });
    ASSERT_TRUE(eventually([&] { return saved; }));
    const char* renderers[] = {"path", "whitted"};
    for (std::size_t cell = 0; cell < 4; ++cell) {
        const QRect place = placeOnSheet(cell, size);
        if (cell > 1) {
            EXPECT_EQ(sheet.copy(place), drawn.copy(place)) << cell;
            continue;
        }
        EXPECT_GT(rmse(sheet.copy(place), drawn.copy(place)), 0.01) << cell;
        QProcess patina;
        patina.start(qEnvironmentVariable("PATINA_BIN_DIR") + QStringLiteral("/patina"),
                     {QStringLiteral("sheet"), path("scene.patina"), QStringLiteral("--materials"),
                      QStringLiteral("Gold"), QStringLiteral("Clay"), QStringLiteral("--size"),
                      QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                      QStringLiteral("--renderer"), QLatin1String(renderers[cell]),
                      QStringLiteral("--no-captions"), QStringLiteral("-o"), path("line.png")});
        ASSERT_TRUE(patina.waitForFinished(120'000)) << patina.errorString().toStdString();
        ASSERT_EQ(patina.exitCode(), 0) << patina.readAllStandardError().toStdString();
        EXPECT_LT(rmse(sheet.copy(place), QImage(path("line.png")).copy(place)), 0.0005) << cell;
    }
}

TEST_F(SheetSaveTest, AnExrHasALinearPartForEachCellAndAPdfItsCaptions) {
    save("sheet.exr", SheetFormat::Exr, 48);
    ASSERT_EQ(ended(), JobState::Done);
    ImageLoadOptions all;
    all.allParts = true;
    const auto exr = loadImage(controller().worker(), path("sheet.exr").toStdString(), all);
    ASSERT_TRUE(exr.ok()) << exr.error().message;
    ASSERT_EQ(exr->parts.size(), 4u);
    EXPECT_EQ(exr->parts[0].name.rfind("Gold, ", 0), 0u) << exr->parts[0].name;
    EXPECT_EQ(exr->parts[0].image.width(), 48);

    save("sheet.pdf", SheetFormat::Pdf, 48, true);
    ASSERT_EQ(ended(), JobState::Done);
    QFile pdf(path("sheet.pdf"));
    ASSERT_TRUE(pdf.open(QIODevice::ReadOnly));
    const QByteArray bytes = pdf.readAll();
    EXPECT_TRUE(bytes.startsWith("%PDF-"));
    EXPECT_EQ(bytes.count("/Subtype /Image"), 4);
    EXPECT_TRUE(bytes.contains("/FontFile")) << "captions are text";
}

TEST_F(SheetSaveTest, ACancelOrAClosedWallLeavesNoFile) {
    save("cancelled.png", SheetFormat::Png, 400);
    QStringList said;
    QObject context;
    QObject::connect(&controller(), &DocumentController::noticed, &context,
                     [&said](const UserNotice& notice) { said << notice.text; });
    session->jobs.cancelAll();
    EXPECT_EQ(ended(), JobState::Cancelled);
    EXPECT_TRUE(said.isEmpty()) << "who cancels knows";
    save("closed.png", SheetFormat::Png, 400);
    wall().setOn(false);
    EXPECT_EQ(ended(), JobState::Cancelled);
    EXPECT_TRUE(QDir(folder.path()).isEmpty());
    ASSERT_EQ(said.size(), 1);
    EXPECT_TRUE(said[0].startsWith(QStringLiteral("closed.png was not saved")))
        << said[0].toStdString();
    save("none.png", SheetFormat::Png, 400);
    EXPECT_EQ(ended(), JobState::Cancelled) << "there is no wall";
}

TEST_F(SheetSaveTest, TheDialogSaysWhatItWillWrite) {
    QTest::mouseClick(find<QToolButton>(*window, QStringLiteral("Save Sheet")), Qt::LeftButton);
    auto* dialog = window->findChild<SheetSaveDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_TRUE(eventually([&] { return dialog->isVisible(); }));
    auto* summary = dialog->findChild<QLabel*>(QStringLiteral("sheetSaveSummary"));
    auto* width = dialog->findChild<QSpinBox*>(QStringLiteral("sheetSaveWidth"));
    auto* file = dialog->findChild<QLineEdit*>(QStringLiteral("sheetSavePath"));
    auto* run = dialog->findChild<QPushButton*>(QStringLiteral("sheetSaveRun"));
    ASSERT_TRUE(summary && width && file && run);
    EXPECT_TRUE(summary->text().startsWith(QStringLiteral("4 cells of 640 × ")))
        << summary->text().toStdString();
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        EXPECT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(
            dialog->grab().save(QDir(pictures).filePath(QStringLiteral("sheet-dialog.png"))));
    }
    file->setText(QString());
    EXPECT_FALSE(run->isEnabled());
    file->setText(path("by-dialog.png"));
    width->setValue(64);
    EXPECT_TRUE(run->isEnabled());
    QTest::mouseClick(run, Qt::LeftButton);
    EXPECT_EQ(ended(), JobState::Done);
    EXPECT_TRUE(QFile::exists(path("by-dialog.png")));
    EXPECT_EQ(undoCount(), steps) << "saving a sheet is no edit";
}

} // namespace
} // namespace patina::editor
