// Photos become an HDR picture: by a drop or the menu, with what was found in sight, and as the
// environment in one step.

#include "app/editor/bracket/BracketDialog.h"
#include "app/editor/bracket/BracketPicture.h"
#include "app/editor/bracket/BracketTable.h"
#include "app/editor/bracket/ResponsePlot.h"
#include "app/editor/document/DropPlan.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/io/ImageIO.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/TextFit.h"
#include "tests/support/Events.h"
#include "tests/support/ExifTiff.h"

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QUrl>
#include <cmath>

namespace patina::editor {
namespace {

using testing::HasSubstr;

class BracketDialogTest : public EditorTest {
  protected:
    // Clouds of light over ten stops under the sRGB curve, at a number of stops.
    QString photo(const QString& name, double ev, int width = 256, int height = 128,
                  bool exif = true) {
        Image image(width, height, 3, PixelType::U8, ColorEncoding::Data);
        std::size_t i = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double stops = -5.0 + 10.0 * x / width + std::sin(0.11 * x + 0.07 * y) +
                                         std::sin(0.17 * y) + 0.2 * (c - 1);
                    const double light = std::min(std::exp2(stops + ev), 1.0);
                    const double code = light <= 0.0031308
                                            ? 12.92 * light
                                            : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
                    image.u8()[i++] = static_cast<std::uint8_t>(std::lround(255.0 * code));
                }
        QFile file(folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        const std::string bytes = test::tiffWithExposure(image, exif ? 0.01 * std::exp2(ev) : 0.0);
        file.write(bytes.data(), static_cast<qsizetype>(bytes.size()));
        return file.fileName();
    }
    QStringList threePhotos(int width = 256, int height = 128) {
        return {photo(QStringLiteral("IMG_0001.tif"), -3.0, width, height),
                photo(QStringLiteral("IMG_0002.tif"), 0.0, width, height),
                photo(QStringLiteral("IMG_0003.tif"), 3.0, width, height)};
    }
    static void dropOnWindow(const QStringList& files) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& file : files)
            urls << QUrl::fromLocalFile(file);
        data.setUrls(urls);
        QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
    }
    static BracketDialog* shownDialog() {
        for (auto* dialog : window->findChildren<BracketDialog*>())
            if (dialog->isVisible())
                return dialog;
        return nullptr;
    }
    // Of a drop; merged.
    static BracketDialog* mergedDialog(const QStringList& photos) {
        dropOnWindow(photos);
        BracketDialog* dialog = nullptr;
        EXPECT_TRUE(eventually([&] {
            dialog = shownDialog();
            return dialog && !dialog->isBusy();
        }));
        return dialog;
    }
    template <class Widget>
    static Widget* part(const BracketDialog& dialog, const char* name) {
        auto* widget = dialog.findChild<Widget*>(QLatin1String(name));
        EXPECT_NE(widget, nullptr) << name;
        return widget;
    }
    static void keep(QWidget& widget, const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (!target.isEmpty() && QDir().mkpath(target)) {
            EXPECT_TRUE(widget.grab().save(QDir(target).filePath(name)));
        }
    }
};

TEST_F(BracketDialogTest, ADropOfPhotosSaysAndDoesWhatTheyBecome) {
    const QStringList photos = threePhotos();
    EXPECT_THAT(planDrop(photos).lines(document(), 0).join(QLatin1Char('\n')).toStdString(),
                HasSubstr("Make an HDR from 3 photos"));
    BracketDialog* dialog = mergedDialog(photos);
    ASSERT_NE(dialog, nullptr);
    ASSERT_NE(dialog->result(), nullptr) << dialog->message().toStdString();
    EXPECT_EQ(dialog->windowTitle(), QStringLiteral("Make HDR from 3 Photos"));
    EXPECT_EQ(dialog->result()->report.response, ResponseKind::Srgb);

    auto* table = part<BracketTable>(*dialog, "bracketPhotos");
    ASSERT_EQ(table->rowCount(), 3);
    EXPECT_EQ(table->item(0, 0)->text(), QStringLiteral("IMG_0001.tif"));
    EXPECT_EQ(table->item(0, 1)->text(), QStringLiteral("1/800 s, f/8"));
    EXPECT_NEAR(table->exposuresEv()[0], -3.0, 1e-3);
    EXPECT_EQ(table->item(2, 3)->text(), QStringLiteral("0, 0 px"));
    auto* plot = part<ResponsePlot>(*dialog, "bracketResponse");
    ASSERT_EQ(plot->curves().size(), 1u); // all channels are sRGB's
    EXPECT_NEAR(plot->valuesAt({0.0, 0.0})[0].numbers[0], 128.0, 0.5);
    EXPECT_THAT(part<QLabel>(*dialog, "bracketLegend")->text().toStdString(),
                HasSubstr("photos disagree 0.00 %"));
    for (const QSize& size : {QSize(1280, 660), dialog->size()}) {
        dialog->resize(size);
        test::handleEvents();
        EXPECT_EQ(dialog->size(), size);
        EXPECT_EQ(cutTexts(*dialog), QStringList());
    }
    keep(*dialog, QStringLiteral("bracket.png"));
    dialog->reject();
}

// What cameras write is longer than what this test's photos have.
TEST_F(BracketDialogTest, LongExposuresLeaveRoomForNames) {
    BracketTable table({QStringLiteral("/photos/IMG_4100.jpg"), QStringLiteral("/photos/b.jpg")});
    table.setExposures({{1.0 / 8000, 5.6, 25600}, {30.0, 22.0, 100}}, {-12.0, 12.0});
    BracketReport report;
    report.photos.resize(2);
    report.photos[0].file = "/photos/IMG_4100.jpg";
    report.photos[0].shift = {64, -64};
    report.photos[0].black = 0.0001;
    report.photos[0].white = 0.995;
    table.setFound(report);
    table.resize(table.minimumWidth(), 200);
    table.show();
    test::handleEvents();
    EXPECT_EQ(table.item(0, 3)->text(), QStringLiteral("-64, 64 px"));
    EXPECT_EQ(cutTexts(table), QStringList());
    EXPECT_GE(table.columnWidth(0), table.fontMetrics().horizontalAdvance("IMG_4100.jpg"));
    EXPECT_LE(table.horizontalHeader()->length(), table.viewport()->width());
    auto* ev = find<QDoubleSpinBox>(table, QStringLiteral("Exposure of b.jpg"));
    ASSERT_NE(ev, nullptr);
    const auto* text = ev->findChild<QLineEdit*>();
    ASSERT_NE(text, nullptr);
    EXPECT_GE(text->width(), text->fontMetrics().horizontalAdvance(QStringLiteral("-12.00")) + 4);
}

TEST_F(BracketDialogTest, MarksAndExposureChangeThePictureAlone) {
    BracketDialog* dialog = mergedDialog(threePhotos());
    ASSERT_TRUE(dialog && dialog->result());
    const auto merged = dialog->result();
    auto* picture = part<BracketPicture>(*dialog, "bracketPicture");
    auto* marks = part<QCheckBox>(*dialog, "bracketMarks");
    ASSERT_GT(merged->report.clippedAbove, 0.01); // the light is brighter than the darkest photo
    const QImage marked = picture->image();
    const QColor pink(kMarkColors.above[0], kMarkColors.above[1], kMarkColors.above[2]);
    const QPoint clipped(marked.width() - 3, [&] {
        for (int y = 0; y < marked.height(); ++y)
            if (marked.pixelColor(marked.width() - 3, y) == pink)
                return y;
        return 0;
    }());
    EXPECT_EQ(marked.pixelColor(clipped), pink);
    QTest::mouseClick(marks, Qt::LeftButton, Qt::NoModifier, {8, marks->height() / 2});
    ASSERT_FALSE(marks->isChecked());
    EXPECT_EQ(picture->image().pixelColor(clipped), QColor(Qt::white));
    part<QDoubleSpinBox>(*dialog, "bracketViewEv")->setValue(-6.0);
    EXPECT_LT(picture->image().pixelColor(clipped).lightness(), 200);
    EXPECT_EQ(dialog->result(), merged);
    dialog->reject();
}

TEST_F(BracketDialogTest, APanoramaLightsTheSceneInOneStep) {
    BracketDialog* dialog = mergedDialog(threePhotos());
    ASSERT_TRUE(dialog && dialog->result());
    auto* use = part<QCheckBox>(*dialog, "bracketUse");
    auto* path = part<QLineEdit>(*dialog, "bracketPath");
    auto* run = part<QPushButton>(*dialog, "bracketRun");
    EXPECT_EQ(path->text(), folder.filePath(QStringLiteral("IMG_0001-hdr.exr")));
    ASSERT_TRUE(use->isEnabled());
    EXPECT_EQ(run->text(), QStringLiteral("Save"));
    QTest::mouseClick(use, Qt::LeftButton, Qt::NoModifier, {8, use->height() / 2});
    EXPECT_EQ(run->text(), QStringLiteral("Save and Use"));
    path->setText(folder.filePath(QStringLiteral("light.txt")));
    EXPECT_FALSE(run->isEnabled());
    const QString file = folder.filePath(QStringLiteral("light.hdr"));
    path->setText(file);
    ASSERT_TRUE(run->isEnabled());
    const int steps = undoCount();
    QTest::mouseClick(run, Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    ASSERT_TRUE(eventually([&] { return document().environment().source == file.toStdString(); }));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(undoCount(), steps + 1);
    ASSERT_NE(document().environment().image, nullptr);
    EXPECT_EQ(document().environment().image->width(), 256);
}

TEST_F(BracketDialogTest, WhatIsNoPanoramaIsWrittenOnly) {
    BracketDialog* dialog = mergedDialog(threePhotos(192, 128));
    ASSERT_TRUE(dialog && dialog->result());
    EXPECT_FALSE(part<QCheckBox>(*dialog, "bracketUse")->isEnabled());
    EXPECT_THAT(part<QLabel>(*dialog, "bracketSummary")->text().toStdString(),
                HasSubstr("192 × 128 pixels; no panorama (2:1)"));
    const QString file = part<QLineEdit>(*dialog, "bracketPath")->text();
    QTest::mouseClick(part<QPushButton>(*dialog, "bracketRun"), Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    const Result<LoadedImage> written = loadImage(session->worker, file.toStdString());
    ASSERT_TRUE(written.ok());
    EXPECT_EQ(written->image().width(), 192);
    EXPECT_EQ(written->image().type(), PixelType::F32);
}

// Photos without Exif: their exposures are typed, and then they are merged.
TEST_F(BracketDialogTest, ExposuresCanBeTyped) {
    auto* dialog = new BracketDialog(controller(), session->jobs,
                                     {photo(QStringLiteral("a.tif"), -2.0, 256, 128, false),
                                      photo(QStringLiteral("b.tif"), 2.0, 256, 128, false)},
                                     window.get());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
    ASSERT_TRUE(eventually([&] { return !dialog->isBusy(); }));
    EXPECT_EQ(dialog->result(), nullptr);
    EXPECT_THAT(dialog->message().toStdString(), HasSubstr("does not say its exposure time"));
    EXPECT_THAT(dialog->message().toStdString(), HasSubstr("Type the exposures"));
    EXPECT_FALSE(part<QPushButton>(*dialog, "bracketRun")->isEnabled());
    keep(*dialog, QStringLiteral("bracket-no-exif.png"));
    auto* ev = find<QDoubleSpinBox>(*dialog, QStringLiteral("Exposure of b.tif"));
    ASSERT_NE(ev, nullptr);
    ev->selectAll();
    QTest::keyClicks(ev, QStringLiteral("4"));
    QTest::keyClick(ev, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return !dialog->isBusy(); }));
    ASSERT_NE(dialog->result(), nullptr) << dialog->message().toStdString();
    EXPECT_DOUBLE_EQ(dialog->result()->report.photos[1].ev, 2.0);
    // The same exposure again is none.
    ev->setValue(0.0);
    ASSERT_TRUE(eventually([&] { return !dialog->isBusy(); }));
    EXPECT_EQ(dialog->result(), nullptr);
    EXPECT_THAT(dialog->message().toStdString(), HasSubstr("the same exposure"));
    dialog->reject();
}

TEST_F(BracketDialogTest, ClosingEndsTheWork) {
    dropOnWindow(threePhotos(2048, 1024));
    BracketDialog* dialog = nullptr;
    ASSERT_TRUE(eventually([&] { return (dialog = shownDialog()) != nullptr; }));
    const QPointer<BracketDialog> closed = dialog;
    dialog->reject();
    ASSERT_TRUE(eventually([&] { return closed.isNull(); }));
    EXPECT_TRUE(session->worker.childProcesses().empty());
}

TEST_F(BracketDialogTest, OtherImagesAreLeftOutAsBefore) {
    dropOnWindow({photo(QStringLiteral("x1.tif"), 0.0), photo(QStringLiteral("x2.tif"), 0.0)});
    const auto texts = [] {
        QStringList all;
        for (const NoticeBar* bar : window->notices().bars())
            all << bar->notice().text;
        return all.join(QLatin1Char('\n'));
    };
    ASSERT_TRUE(eventually([&] { return texts().contains(QStringLiteral("x1.tif, x2.tif")); }));
    EXPECT_TRUE(texts().contains(QStringLiteral("different exposures")));
    EXPECT_EQ(shownDialog(), nullptr);
    // Names that say maps are maps, whatever their exposures are.
    EXPECT_TRUE(planDrop({QStringLiteral("/a/wood_normal.png"), QStringLiteral("/a/x.png"),
                          QStringLiteral("/a/y.png")})
                    .photos()
                    .isEmpty());
    EXPECT_TRUE(planDrop({QStringLiteral("/a/x.png")}).photos().isEmpty());
}

} // namespace
} // namespace patina::editor
