// Cells of the wall traced in place of drawn: by real keys with the pointer over a cell, a caption,
// or elsewhere. PATINA_SCREENSHOTS keeps pictures.
#include "app/editor/wall/TracedCells.h"
#include "app/editor/wall/WallComparison.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"
#include "tests/app/wall/WallFixture.h"

#include <QCursor>
#include <QHelpEvent>
#include <QToolTip>
#include <algorithm>

namespace patina::editor {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TracedCellsTest : public WallWindow {
  protected:
    void SetUp() override {
        session->paths.setOn(false);
        WallWindow::SetUp();
        pointElsewhere();
        key(Qt::Key_F3);
        ASSERT_EQ(wall().cells().size(), 3u);
        ASSERT_TRUE(isSettled());
        m_drawn = viewport().grabFramebuffer();
    }
    void TearDown() override {
        for (const TracedBy tracer : {TracedBy::Paths, TracedBy::Whitted}) {
            wall().setOn(true);
            if (!cells().areTraced(cells().allCells(), tracer))
                cells().toggleAll(tracer);
            cells().toggleAll(tracer);
        }
        WallWindow::TearDown();
    }

    static TracedCells& cells() { return session->tracedCells; }
    static void keyWith(Qt::Key code, Qt::KeyboardModifiers modifiers) {
        QTest::keyClick(&viewport(), code, modifiers);
    }
    static void pointAt(const QPoint& place) {
        QCursor::setPos(viewport().mapToGlobal(place));
        ASSERT_TRUE(eventually([&] { return viewport().mapFromGlobal(QCursor::pos()) == place; }));
    }
    static void pointElsewhere() { pointAt(QPoint(-20, -20)); }
    static bool hasSamples(std::size_t cell, std::uint32_t count) {
        return eventually([=] { return cells().progress(cell).samples >= count; });
    }
    // Whether it comes to show something else; pictures that are taken all the time would hold that
    // up.
    static bool differsFrom(const QImage& before, std::size_t cell) {
        return eventually([&] {
            QTest::qWait(100);
            return pictureOf(cell) != before;
        });
    }
    static std::string badge(std::size_t cell) {
        return overlay().badgeOf(cell).text.toStdString();
    }
    [[nodiscard]] QImage drawn(std::size_t cell) const { return m_drawn.copy(placeOf(cell)); }
    [[nodiscard]] const QImage& drawnWall() const { return m_drawn; }
    // By how much the whole is more red than green.
    static double redness(const QImage& picture) {
        double sum = 0.0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                sum += qRed(picture.pixel(x, y)) - qGreen(picture.pixel(x, y));
        return sum / (picture.width() * picture.height());
    }
    static double mean(const QImage& picture) {
        double sum = 0.0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                sum += qGray(picture.pixel(x, y));
        return sum / (picture.width() * picture.height());
    }
    static void edit(std::size_t material, const glm::vec3& color) {
        controller().setParameter(parameter("material.baseColor"),
                                  {Scope::Material, document().materials[material].id}, color);
    }

  private:
    QImage m_drawn; // of the wall before
};

TEST_F(TracedCellsTest, TheKeyTracesTheCellBelowThePointer) {
    const quint64 revision = controller().revision();
    pointAt(centreOf(1));
    key(Qt::Key_F12);
    EXPECT_TRUE(wall().isOn());
    EXPECT_EQ(cells().tracer(1), TracedBy::Paths);
    EXPECT_FALSE(cells().tracer(0));
    EXPECT_FALSE(cells().tracer(2));
    EXPECT_THAT(badge(1), HasSubstr("Path"));
    ASSERT_TRUE(eventually([] { return cells().picture(1) != nullptr; }));
    EXPECT_LT(cells().picture(1)->width(), placeOf(1).width()) << "coarse at first";
    ASSERT_TRUE(hasSamples(1, 4));
    EXPECT_EQ(cells().picture(1)->width(), placeOf(1).width());
    EXPECT_EQ(cells().picture(1)->height(), placeOf(1).height());
    ASSERT_TRUE(eventually([&] { return QString::fromStdString(badge(1)).contains(u'±'); }));
    ASSERT_TRUE(differsFrom(drawn(1), 1));
    EXPECT_NEAR(mean(pictureOf(1)), mean(drawn(1)), 25.0) << "of the same scene, exposed alike";
    EXPECT_EQ(pictureOf(0), drawn(0)) << "as the viewport draws it";
    EXPECT_EQ(pictureOf(2), drawn(2));
    EXPECT_THAT(badge(0), IsEmpty());
    keepPicture("traced-cell.png");

    // By the other tracer, and back.
    keyWith(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_EQ(cells().tracer(1), TracedBy::Whitted);
    EXPECT_THAT(badge(1), HasSubstr("Whitted"));
    ASSERT_TRUE(eventually([] { return cells().progress(1).refined; }));
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(1), drawn(1));
    keyWith(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_FALSE(cells().tracer(1));
    EXPECT_EQ(cells().picture(1), nullptr) << "let go";
    EXPECT_THAT(badge(1), IsEmpty());
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(viewport().grabFramebuffer(), drawnWall());
    EXPECT_EQ(controller().revision(), revision) << "looking changes nothing";
}

TEST_F(TracedCellsTest, AnEditBeginsItAnewAndHoldsUpNoDrawnOne) {
    pointAt(centreOf(1));
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1, 2));
    const ImagePtr before = cells().picture(1);
    const QImage shown = pictureOf(0);
    controller().setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 1.0f);
    EXPECT_NE(pictureOf(0), shown) << "in the next frame, whatever the tracer does meanwhile";
    EXPECT_GE(cells().progress(1).samples, 2u) << "exposure changes no ray";
    const QImage gold = pictureOf(1);
    for (const std::size_t material : {0u, 1u})
        edit(material, {0.9f, 0.1f, 0.1f});
    const QImage red = pictureOf(1);
    EXPECT_NE(pictureOf(0), shown);
    EXPECT_EQ(cells().picture(1), nullptr) << "it is drawn until there is a pass";
    EXPECT_EQ(cells().progress(1).samples, 0u);
    EXPECT_GT(redness(red), redness(gold) + 2.0) << "and so follows input, too";
    ASSERT_TRUE(hasSamples(1, 1));
    EXPECT_NE(cells().picture(1), before);

    // The one that an edit leaves alone goes on.
    pointAt(centreOf(2));
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(2, 2));
    edit(0, {0.1f, 0.1f, 0.9f});
    (void)viewport().grabFramebuffer();
    EXPECT_GE(cells().progress(2).samples, 2u);

    // So does the camera.
    Camera camera = document().view.camera;
    camera.yawDeg += 40.0f;
    controller().setCamera(camera);
    (void)viewport().grabFramebuffer();
    EXPECT_EQ(cells().progress(1).samples, 0u);
    EXPECT_EQ(cells().progress(2).samples, 0u);
    ASSERT_TRUE(hasSamples(1, 1));
    ASSERT_TRUE(hasSamples(2, 1));
}

TEST_F(TracedCellsTest, AllCellsHaveAFirstPictureBeforeAnyIsFine) {
    QAction* all = window->actions().traceCells;
    EXPECT_TRUE(all->isEnabled());
    bool unfair = false;
    std::size_t most = 0;
    all->trigger();
    EXPECT_TRUE(all->isChecked());
    ASSERT_TRUE(eventually([&] {
        std::size_t pictures = 0, fine = 0;
        for (const std::size_t cell : cells().allCells()) {
            pictures += cells().picture(cell) != nullptr ? 1 : 0;
            fine += cells().progress(cell).samples > 0 ? 1 : 0;
        }
        unfair = unfair || (fine > 0 && pictures < 3);
        most = std::max(most, pictures);
        return fine == 3;
    }));
    EXPECT_FALSE(unfair);
    ASSERT_TRUE(hasSamples(0, 4) && hasSamples(1, 4) && hasSamples(2, 4));
    keepPicture("traced-cells.png");

    // What comes to the wall later is one of them.
    controller().editStructure(QStringLiteral("Material"), [](Document& document) {
        Material material;
        material.name = "Chalk";
        addMaterial(document, material);
    });
    ASSERT_EQ(wall().cells().size(), 4u);
    EXPECT_EQ(cells().tracer(3), TracedBy::Paths);
    ASSERT_TRUE(hasSamples(3, 1));
    // One of them by itself.
    pointAt(centreOf(3));
    key(Qt::Key_F12);
    EXPECT_FALSE(cells().tracer(3));
    EXPECT_FALSE(all->isChecked());
    controller().undoStack().undo();
    ASSERT_EQ(wall().cells().size(), 3u);
    EXPECT_TRUE(all->isChecked());
    all->trigger();
    EXPECT_FALSE(all->isChecked());
    for (const std::size_t cell : cells().allCells())
        EXPECT_FALSE(cells().tracer(cell));
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(viewport().grabFramebuffer(), drawnWall());
    key(Qt::Key_F3);
    EXPECT_FALSE(all->isEnabled());
}

TEST_F(TracedCellsTest, AwayFromTheCellsTheCurrentOneIsMeant) {
    QAction* traced = window->actions().pathTraced;
    key(Qt::Key_F12); // none is current
    EXPECT_TRUE(cells().areTraced(cells().allCells(), TracedBy::Paths));
    EXPECT_TRUE(traced->isChecked());
    key(Qt::Key_F12);
    EXPECT_FALSE(traced->isChecked());
    key(Qt::Key_Right);
    ASSERT_EQ(wall().current(), 0u);
    key(Qt::Key_Right);
    key(Qt::Key_F12);
    EXPECT_EQ(cells().tracer(1), TracedBy::Paths);
    EXPECT_FALSE(cells().tracer(0));
    EXPECT_TRUE(traced->isChecked());
    key(Qt::Key_Left);
    EXPECT_FALSE(traced->isChecked()) << "the current one is drawn";
}

TEST_F(TracedCellsTest, ACaptionMeansItsColumn) {
    controller().editStructure(QStringLiteral("Environment"), [](Document& document) {
        Environment second = document.environment();
        second.rotationDeg = 90.0f;
        second.id = document.takeId();
        document.environments.push_back(second);
    });
    key(Qt::Key_F3);
    wall().setPlan(defaultWallPlan(document()));
    key(Qt::Key_F3);
    ASSERT_EQ(wall().cells().size(), 6u) << "environments × materials";
    const auto& captions = overlay().layoutOfWall().captions;
    const auto second = std::ranges::find_if(captions, [](const WallLayout::Caption& caption) {
        return caption.of == std::vector<std::size_t>{1, 3, 5};
    });
    ASSERT_NE(second, captions.end());
    pointAt(second->place.center());
    key(Qt::Key_F12);
    for (const std::size_t cell : cells().allCells())
        EXPECT_EQ(cells().tracer(cell).has_value(), cell % 2 == 1) << cell;
    pointAt(QPoint(placeOf(0).right() + 1, placeOf(0).center().y())); // a gap
    key(Qt::Key_F12);
    EXPECT_EQ(cells().tracer(0), TracedBy::Paths) << "the closest one";
    key(Qt::Key_F12);
    // In the light of its own environment, which is rotated.
    ASSERT_TRUE(hasSamples(1, 1) && hasSamples(3, 1) && hasSamples(5, 1));
    controller().undoStack().undo();
}

TEST_F(TracedCellsTest, AnEnlargedOneIsTracedInItsSize) {
    click(1);
    pointAt(centreOf(1));
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1, 1));
    key(Qt::Key_Return);
    ASSERT_EQ(wall().enlarged(), 1u);
    ASSERT_TRUE(eventually([] {
        const ImagePtr picture = cells().picture(1);
        return picture != nullptr && picture->width() == placeOf(1).width() &&
               cells().progress(1).samples > 0;
    }));
    key(Qt::Key_Return);
    ASSERT_FALSE(wall().enlarged());
    ASSERT_TRUE(eventually([] {
        const ImagePtr picture = cells().picture(1);
        return picture != nullptr && picture->width() == placeOf(1).width();
    }));
}

TEST_F(TracedCellsTest, ViewsOfTermsAreDrawn) {
    session->views.show(shading::kViewBaseColor);
    ASSERT_TRUE(isSettled());
    const QImage color = pictureOf(1);
    session->views.show(shading::kViewFinal);
    pointAt(centreOf(1));
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1, 1));
    ASSERT_TRUE(differsFrom(drawn(1), 1));
    session->views.show(shading::kViewBaseColor);
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(pictureOf(1), color);
    session->views.show(shading::kViewFinal);
    const std::uint32_t before = cells().progress(1).samples;
    ASSERT_TRUE(hasSamples(1, before + 1)) << "it goes on";
}

TEST_F(TracedCellsTest, ComparedOnesAreMeasuredAsTheyBecomeFiner) {
    pointAt(centreOf(1));
    key(Qt::Key_F12);
    click(1);
    wall().compareWith(2);
    ASSERT_TRUE(session->comparison.isOn());
    ASSERT_TRUE(hasSamples(1, 1));
    ASSERT_TRUE(eventually([] { return session->comparison.measured().has_value(); }));
    EXPECT_GT(session->comparison.measured()->metrics.rmse, 0.0);
    EXPECT_TRUE(overlay().badgeOf(1).place.left() < viewport().width() / 2);
    pointElsewhere();
    key(Qt::Key_F12); // the enlarged one is drawn again
    EXPECT_FALSE(cells().tracer(1));
}

TEST_F(TracedCellsTest, BadgesFitIntoTheirCellsAndExplainThemselves) {
    cells().toggleAll(TracedBy::Paths);
    ASSERT_TRUE(hasSamples(0, 2) && hasSamples(1, 2) && hasSamples(2, 2));
    for (const std::size_t cell : cells().allCells()) {
        const WallOverlay::Badge shown = overlay().badgeOf(cell);
        EXPECT_TRUE(placeOf(cell).contains(shown.place)) << cell;
        EXPECT_THAT(shown.text.toStdString(), HasSubstr("±"));
        EXPECT_THAT(shown.help.toStdString(), HasSubstr("Path traced"));
    }
    const QPoint on = overlay().badgeOf(1).place.center();
    QHelpEvent help(QEvent::ToolTip, on, viewport().mapToGlobal(on));
    QCoreApplication::sendEvent(&viewport(), &help);
    EXPECT_THAT(QToolTip::text().toStdString(), HasSubstr("standard error"));
    const QPoint off = centreOf(1);
    QHelpEvent none(QEvent::ToolTip, off, viewport().mapToGlobal(off));
    QCoreApplication::sendEvent(&viewport(), &none);
    EXPECT_TRUE(eventually([] { return QToolTip::text().isEmpty(); }));
}

TEST_F(TracedCellsTest, WhatIsTooLargeIsRefused) {
    cells().toggleAll(TracedBy::Paths);
    std::vector<TracedCells::Wanted> wanted(3);
    for (TracedCells::Wanted& cell : wanted) {
        cell.document = &document();
        cell.camera = document().view.camera;
        cell.size = QSize(4096, 1500); // of which two are fewer than 2^24 pixels
    }
    cells().want(wanted);
    EXPECT_FALSE(cells().isRefused(0));
    EXPECT_FALSE(cells().isRefused(1));
    EXPECT_TRUE(cells().isRefused(2));
    EXPECT_THAT(badge(2), HasSubstr("Not traced"));
    EXPECT_THAT(overlay().badgeOf(2).help.toStdString(), HasSubstr("16 million"));
    wanted[0].size = QSize(); // not seen any more
    cells().want(wanted);
    EXPECT_FALSE(cells().isRefused(2));
}

TEST_F(TracedCellsTest, AnotherSceneIsDrawn) {
    cells().toggleAll(TracedBy::Whitted);
    key(Qt::Key_F3);
    EXPECT_FALSE(cells().isBusy());
    key(Qt::Key_F3);
    EXPECT_TRUE(cells().areTraced(cells().allCells(), TracedBy::Whitted)) << "the same wall";
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    key(Qt::Key_F3);
    ASSERT_FALSE(cells().allCells().empty());
    for (const std::size_t cell : cells().allCells())
        EXPECT_FALSE(cells().tracer(cell));
}

} // namespace
} // namespace patina::editor
