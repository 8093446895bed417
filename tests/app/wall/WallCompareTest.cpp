// Two cells against each other in the real window: line, turns, blend, differences, numbers.
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/wall/CompareControls.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/widget/NumberField.h"
#include "tests/app/wall/WallFixture.h"

#include <QCheckBox>
#include <QLabel>
#include <QLayout>
#include <cmath>
#include <vector>

namespace patina::editor {
namespace {

class WallCompareTest : public WallWindow {
  protected:
    static WallComparison& comparison() { return session->comparison; }
    void SetUp() override {
        WallWindow::SetUp();
        comparison().setMode(CompareMode::Wipe);
        comparison().moveLine({});
        comparison().setOnlyVisible(false);
        key(Qt::Key_F3);
        // Each alone, as large as when it is compared.
        for (const std::size_t cell : {1u, 2u}) {
            wall().enlarge(cell);
            ASSERT_TRUE(isSettled());
            (cell == 1 ? gold : clay) = pictureOf(cell);
        }
        wall().enlarge(std::nullopt);
        click(1);
        click(2, Qt::ControlModifier);
        ASSERT_EQ(wall().enlarged(), 1u);
        ASSERT_EQ(wall().compared(), 2u);
        ASSERT_TRUE(isSettled());
    }
    static QImage shown() { return pictureOf(1); }
    static bool measured() {
        return isSettled() && eventually([] { return comparison().measured().has_value(); });
    }
    // Largest difference of any channel, of 255.
    static int largest(const QImage& a, const QImage& b) {
        int most = a.size() == b.size() ? 0 : 256;
        for (int y = 0; y < std::min(a.height(), b.height()); ++y)
            for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
                const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
                for (const int d : {qRed(p) - qRed(q), qGreen(p) - qGreen(q), qBlue(p) - qBlue(q)})
                    most = std::max(most, std::abs(d));
            }
        return most;
    }
    // The share of pixels that differ by more than the dither.
    static double differing(const QImage& a, const QImage& b) {
        int count = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) {
                const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
                count += std::abs(qRed(p) - qRed(q)) > 2 || std::abs(qBlue(p) - qBlue(q)) > 2;
            }
        return static_cast<double>(count) / (a.width() * a.height());
    }
    static QRect left(const QImage& image) { return {0, 0, image.width() / 2 - 1, image.height()}; }
    static QRect right(const QImage& image) {
        return {image.width() / 2 + 1, 0, image.width() / 2 - 1, image.height()};
    }

    QImage gold, clay;
};

TEST_F(WallCompareTest, AWipeShowsOneCellOnEachSideOfItsLine) {
    ASSERT_NE(gold, clay);
    QImage both = shown();
    EXPECT_EQ(both.copy(left(both)), gold.copy(left(both)));
    EXPECT_EQ(both.copy(right(both)), clay.copy(right(both)));
    keepPicture("compare-wipe.png");
    // Dragged by its disc to a fourth of the width.
    const QRect area = placeOf(1);
    const QPoint from = area.center(), to = from - QPoint(area.width() / 4, 0);
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, from);
    QMouseEvent move(QEvent::MouseMove, to, viewport().mapToGlobal(to), Qt::NoButton,
                     Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&viewport(), &move);
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, to);
    EXPECT_NEAR(comparison().line()->position.x, 0.25f, 0.02f);
    both = shown();
    EXPECT_EQ(both.copy(both.width() * 3 / 10, 0, 40, both.height()),
              clay.copy(both.width() * 3 / 10, 0, 40, both.height()));
    // Turned flat, the other one lies below.
    render::ViewSplit flat;
    flat.angleDeg = 90.0f;
    comparison().moveLine(flat);
    both = shown();
    const int half = both.height() / 2;
    EXPECT_EQ(both.copy(0, 0, both.width(), half - 1), gold.copy(0, 0, both.width(), half - 1));
    EXPECT_EQ(both.copy(0, half + 1, both.width(), half - 1),
              clay.copy(0, half + 1, both.width(), half - 1));
}

TEST_F(WallCompareTest, FlickerShowsOneAfterTheOtherAndSpaceTheOtherOne) {
    choose("Compare by", "Flicker");
    EXPECT_FALSE(comparison().line());
    EXPECT_TRUE(eventually([&] { return shown() == clay; }));
    EXPECT_TRUE(eventually([&] { return shown() == gold; }));
    choose("Compare by", "Wipe");
    QTest::keyPress(&viewport(), Qt::Key_Space);
    EXPECT_EQ(shown(), clay);
    QTest::keyRelease(&viewport(), Qt::Key_Space);
    EXPECT_NE(shown(), clay);
}

TEST_F(WallCompareTest, ABlendIsAMixOfBoth) {
    choose("Compare by", "Blend");
    auto* share = find<NumberField>(*window, QStringLiteral("Share of B"));
    ASSERT_TRUE(share->isVisible());
    for (const auto& [percent, picture] : {std::pair("0", &gold), {"100", &clay}}) {
        share->setFocus();
        QTest::keyClicks(share, QLatin1String(percent));
        QTest::keyClick(share, Qt::Key_Return);
        EXPECT_LE(largest(shown(), *picture), 0) << percent;
    }
    comparison().setBlend(0.5f);
    const QImage half = shown();
    for (int y = 0; y < half.height(); y += 7)
        for (int x = 0; x < half.width(); x += 7)
            EXPECT_NEAR(qGreen(half.pixel(x, y)),
                        0.5 * (qGreen(gold.pixel(x, y)) + qGreen(clay.pixel(x, y))), 1.0);
}

TEST_F(WallCompareTest, NumbersAreThoseOfTheShownPictures) {
    ASSERT_TRUE(measured());
    double squares = 0.0;
    int most = 0;
    for (int y = 0; y < gold.height(); ++y)
        for (int x = 0; x < gold.width(); ++x) {
            const QRgb p = gold.pixel(x, y), q = clay.pixel(x, y);
            for (const int d : {qRed(p) - qRed(q), qGreen(p) - qGreen(q), qBlue(p) - qBlue(q)}) {
                squares += d * d / (255.0 * 255.0);
                most = std::max(most, std::abs(d));
            }
        }
    const ImageMetrics& metrics = comparison().measured()->metrics;
    const double samples = 3.0 * gold.width() * gold.height();
    EXPECT_NEAR(metrics.rmse, std::sqrt(squares / samples), 1e-6);
    EXPECT_NEAR(metrics.max, most / 255.0, 1e-6);
    EXPECT_GT(comparison().measured()->flip.mean, 0.0);
    const auto* numbers = window->findChild<QLabel*>(QStringLiteral("compareNumbers"));
    EXPECT_THAT(numbers->text().toStdString(), testing::HasSubstr("RMSE"));
    EXPECT_THAT(numbers->text().toStdString(), testing::HasSubstr("FLIP"));

    // An edit changes them.
    const double before = metrics.rmse;
    controller().setParameter(parameter("material.baseColor"),
                              {Scope::Material, document().materials[2].id}, glm::vec3(0.0f));
    ASSERT_TRUE(measured());
    EXPECT_NE(comparison().measured()->metrics.rmse, before);
}

// A bar that grew with the numbers would make the picture smaller, which is then measured anew:
// without end, at every width at which they need another row.
TEST_F(WallCompareTest, TheBarIsAsHighWithTheNumbersAsWithout) {
    const auto heights = [] {
        const auto* controls = window->findChild<CompareControls*>();
        std::vector<int> rows;
        for (int width = 300; width <= 1400; width += 20)
            rows.push_back(controls->layout()->heightForWidth(width));
        return rows;
    };
    ASSERT_TRUE(measured());
    const std::vector<int> with = heights();
    auto* numbers = window->findChild<QLabel*>(QStringLiteral("compareNumbers"));
    ASSERT_GT(numbers->text().size(), 40);
    numbers->setText(QStringLiteral("Comparing…")); // as while it measures anew
    EXPECT_EQ(heights(), with);
    EXPECT_GT(with.front(), with.back()) << "it wraps where it is narrow";
}

TEST_F(WallCompareTest, DifferencesAreShownInColours) {
    ASSERT_TRUE(measured());
    EXPECT_TRUE(comparison().measured()->map.isNull()) << "a wipe shows none";
    choose("Compare by", "Difference, signed");
    const auto hasMap = [] {
        return eventually([] {
            const auto& found = comparison().measured();
            return found && !found->map.isNull();
        });
    };
    ASSERT_TRUE(hasMap());
    EXPECT_FLOAT_EQ(comparison().measured()->from, -comparison().measured()->to);
    EXPECT_EQ(comparison().measured()->map.size(), gold.size());
    const QImage signedMap = comparison().measured()->map;
    keepPicture("compare-difference.png");
    // Swapped, each sign is the other one: the blue channel of one end is the red end's place.
    const double rmse = comparison().measured()->metrics.rmse;
    QTest::mouseClick(find<QToolButton>(*window, QStringLiteral("Swap A and B")), Qt::LeftButton);
    EXPECT_EQ(wall().enlarged(), 2u);
    EXPECT_EQ(wall().compared(), 1u);
    ASSERT_TRUE(measured());
    ASSERT_TRUE(hasMap());
    EXPECT_DOUBLE_EQ(comparison().measured()->metrics.rmse, rmse);
    EXPECT_NE(comparison().measured()->map, signedMap);
    choose("Compare by", "Visible difference (FLIP)");
    EXPECT_TRUE(eventually([] {
        return comparison().measured()->colors == ColorMap::Magma &&
               comparison().measured()->to == 1.0f;
    }));
    keepPicture("compare-flip.png");
}

TEST_F(WallCompareTest, EscLeavesStepByStep) {
    key(Qt::Key_Escape);
    EXPECT_FALSE(wall().compared()) << "the line first";
    EXPECT_TRUE(wall().enlarged());
    key(Qt::Key_Escape);
    EXPECT_FALSE(wall().enlarged());
    EXPECT_TRUE(wall().isOn());
    choose("Compare by", "Flicker"); // nothing is compared: nothing flickers
    EXPECT_FALSE(comparison().shown().any);
    click(0);
    click(0, Qt::ControlModifier);
    EXPECT_FALSE(wall().compared()) << "not with itself";
}

// B is a picture from a file: what the cell showed before, so that it is known.
TEST_F(WallCompareTest, AFileIsComparedWithACell) {
    const QString same = folder.filePath(QStringLiteral("clay.png")),
                  square = folder.filePath(QStringLiteral("square.png"));
    ASSERT_TRUE(clay.save(same));
    ASSERT_TRUE(clay.scaled(64, 64).save(square));
    comparison().setFile(same);
    EXPECT_FALSE(wall().compared().has_value()) << "the file takes the cell's place";
    ASSERT_TRUE(eventually([] { return comparison().measured().has_value(); }))
        << comparison().fileNote().toStdString();
    EXPECT_EQ(comparison().fileNote(), QString());
    EXPECT_GT(comparison().measured()->metrics.rmse, 0.02);
    const QImage both = viewport().grab().toImage().copy(placeOf(1));
    // But for the line with its handle and names, each side is its picture.
    const auto sideIs = [&](const QRect& side, const QImage& one, const QImage& other) {
        const double own = differing(both.copy(side), one.copy(side));
        EXPECT_LT(own, 0.5 * differing(both.copy(side), other.copy(side))) << own;
    };
    sideIs(right(both), clay, gold);
    sideIs(left(both), gold, clay);
    comparison().setMode(CompareMode::Visible);
    ASSERT_TRUE(eventually(
        [] { return comparison().measured() && !comparison().measured()->map.isNull(); }));
    comparison().setMode(CompareMode::Wipe);

    // The very cell: no difference but the dither's.
    wall().setCurrent(2);
    comparison().setFile(same);
    ASSERT_TRUE(eventually([] { return comparison().measured().has_value(); }));
    EXPECT_LT(comparison().measured()->metrics.rmse, 0.003);

    // Other proportions are stretched when the user says so.
    comparison().setFile(square);
    auto* numbers = window->findChild<QLabel*>(QStringLiteral("compareNumbers"));
    auto* stretch = find<QCheckBox>(*window, QStringLiteral("Stretch"));
    ASSERT_TRUE(eventually([&] {
        return numbers->text().contains(QStringLiteral("proportions are others"));
    })) << numbers->text().toStdString();
    EXPECT_TRUE(stretch->isVisible());
    EXPECT_FALSE(comparison().measured().has_value());
    QTest::mouseClick(stretch, Qt::LeftButton, {}, QPoint(8, stretch->height() / 2));
    ASSERT_TRUE(eventually([] { return comparison().measured().has_value(); }));
    EXPECT_TRUE(numbers->text().contains(QStringLiteral("64 × 64 stretched to")));
    keepPicture("compare-file.png");

    // One that is not there says so; Nothing ends it.
    comparison().setFile(folder.filePath(QStringLiteral("none.png")));
    ASSERT_TRUE(eventually([&] {
        return numbers->text().contains(QStringLiteral("none.png")) &&
               !numbers->text().startsWith(QStringLiteral("Reading"));
    })) << numbers->text().toStdString();
    choose("Compare with", "Nothing");
    EXPECT_FALSE(comparison().isOn());
    comparison().setFile(same);
    key(Qt::Key_Escape);
    EXPECT_FALSE(comparison().hasFile());
    EXPECT_EQ(undoCount(), steps);
}

} // namespace
} // namespace patina::editor
