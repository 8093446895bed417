// Solved light studied in the window: stepped through, looked into by clicks, plotted, searched for
// leaks.
#include "core/document/ViewChoices.h"
#include "tests/app/editor/RadiosityDockFixture.h"
#include "tests/support/Events.h"

#include "app/editor/radiosity/ElementOverlay.h"
#include "app/editor/radiosity/FactorMap.h"
#include "app/editor/radiosity/HemicubeView.h"
#include "app/editor/radiosity/LeakList.h"
#include "app/editor/radiosity/RadiosityPlots.h"
#include "app/editor/widget/CurvePlot.h"
#include "app/editor/widget/PlotLegend.h"

#include <QComboBox>
#include <QMouseEvent>
#include <QSlider>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

TEST_F(RadiosityDock, GoesStepByStepForthAndBack) {
    light();
    EXPECT_FALSE(part<QPushButton>("radiosityBack")->isEnabled());
    const auto stepped = [](std::uint64_t shots) {
        return eventually([=] { return radiosity().step() && radiosity().step()->done == shots; });
    };
    press("radiosityFirst");
    ASSERT_TRUE(stepped(0));
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("next:")))
        << words("radiosityStep").toStdString();
    const auto next = radiosity().step()->next;
    press("radiosityNext");
    ASSERT_TRUE(stepped(1));
    EXPECT_EQ(radiosity().step()->last, next);
    press("radiosityNext");
    ASSERT_TRUE(stepped(2));
    press("radiosityBack");
    ASSERT_TRUE(stepped(1));
    const std::size_t elements = radiosity().live()->elements().size();
    press("radiosityRound");
    ASSERT_TRUE(stepped(1 + elements) || (radiosity().step() && radiosity().step()->atEnd));
    EXPECT_LT(radiosity().step()->residuals.back(), radiosity().step()->residuals.front());
    EXPECT_TRUE(eventually([] { return !part<CurvePlot>("radiosityPlot")->curves().empty(); }));
    auto* overlay = part<ElementOverlay>("elementOverlay");
    EXPECT_TRUE(overlay->isVisible()) << "the element that shoots next";

    // Unshot light is a view of its own, chosen in the dock.
    auto* view = part<QComboBox>("radiosityView");
    const int row = view->findData(shading::kViewUnshot);
    view->setCurrentIndex(row);
    Q_EMIT view->activated(row);
    EXPECT_EQ(session->views.shown(), shading::kViewUnshot);
    keep("radiosity-unshot.png");

    // The slider walks through all of it.
    auto* slider = part<QSlider>("radiosityShots");
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_Home);
    ASSERT_TRUE(stepped(0));

    press("radiositySolved");
    ASSERT_TRUE(eventually([] { return !radiosity().step(); }));
    ASSERT_TRUE(solved());

    // It plays, until somebody stops it or the scene is edited.
    press("radiosityPlay");
    ASSERT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done >= 3; }));
    const Id material = document().meshes.front().material;
    set("material.baseColor", {Scope::Material, material}, glm::vec3(0.1f, 0.6f, 0.2f));
    EXPECT_FALSE(radiosity().step());
}

TEST_F(RadiosityDock, GoesSweepBySweepAndComparesSolvers) {
    light();
    auto* unit = part<QComboBox>("radiosityStepUnit");
    const auto stepBy = [&](int row) {
        unit->setCurrentIndex(row);
        Q_EMIT unit->activated(row);
    };
    stepBy(1);
    EXPECT_FALSE(part<QPushButton>("radiosityRound")->isVisible()) << "a sweep is a round";
    press("radiosityFirst");
    ASSERT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done == 0; }));
    EXPECT_FALSE(radiosity().step()->next);
    press("radiosityNext");
    press("radiosityNext");
    ASSERT_TRUE(eventually([] { return radiosity().step()->done == 2; }));
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("2 sweeps")))
        << words("radiosityStep").toStdString();
    auto* plot = part<CurvePlot>("radiosityPlot");
    ASSERT_TRUE(eventually([&] { return plot->curves().size() == 4; }));
    EXPECT_EQ(plot->curves()[0].name, QStringLiteral("Jacobi"));
    keep("radiosity-sweeps.png");
    press("radiosityBack");
    ASSERT_TRUE(eventually([] { return radiosity().step()->done == 1; }));
    stepBy(0);
    EXPECT_FALSE(radiosity().step()) << "steps of another kind begin anew";
    ASSERT_TRUE(solved());
    const auto before = radiosity().convergence();
    set("view.radiosityArea", {Scope::View, 0}, 0.01f);
    ASSERT_TRUE(solved());
    EXPECT_NE(radiosity().convergence(), before) << "it goes with the solution";
}

TEST_F(RadiosityDock, AClickTellsWhoLightsAnElement) {
    light();
    ASSERT_TRUE(atRest());
    EXPECT_TRUE(words("radiosityElement").contains(QStringLiteral("Click")));
    const QPoint middle = viewport().rect().center();
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, middle + QPoint(-45, -50)); // the wall
    ASSERT_TRUE(radiosity().chosen());
    EXPECT_TRUE(words("radiosityElement").contains(QStringLiteral("element")));
    auto* flow = part<QTreeWidget>("radiosityFlow");
    ASSERT_EQ(flow->topLevelItemCount(), 3);
    EXPECT_GT(flow->topLevelItem(0)->childCount(), 2);
    EXPECT_EQ(flow->topLevelItem(1)->childCount(), 10) << "element by element";
    EXPECT_GT(flow->topLevelItem(2)->childCount(), 2);
    auto* overlay = part<ElementOverlay>("elementOverlay");
    ASSERT_TRUE(eventually([&] { return overlay->isVisible() && overlay->drawnArrows() > 1; }));
    keep("radiosity-element.png");
    // Its form factors are a view.
    session->views.show(shading::kViewFormFactor);
    ASSERT_TRUE(atRest());
    double share = 0.0;
    for (const ShownRadiosity::Element& element : radiosity().shown()->elements)
        share += static_cast<double>(element.share);
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 1.0001);
    // A drag is none: it moves the camera.
    const auto chosen = radiosity().chosen();
    QTest::mousePress(&viewport(), Qt::LeftButton, {}, middle);
    QTest::mouseMove(&viewport(), middle + QPoint(30, 5));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, middle + QPoint(60, 10));
    EXPECT_EQ(radiosity().chosen(), chosen);
    // One of those that light it is chosen in the list.
    QTreeWidgetItem* sender = flow->topLevelItem(1)->child(9);
    ASSERT_TRUE(sender->text(0).contains(QStringLiteral("element"))) << "the lamp is not the last";
    flow->scrollToItem(sender);
    const QPoint onIt = flow->visualItemRect(sender).center();
    QTest::mouseClick(flow->viewport(), Qt::LeftButton, {}, onIt);
    QTest::mouseDClick(flow->viewport(), Qt::LeftButton, {}, onIt);
    EXPECT_NE(radiosity().chosen(), chosen);
}

// Without a chosen element the view was black.
TEST_F(RadiosityDock, FormFactorsAreThoseOfTheBrightestElementUntilOneIsChosen) {
    light();
    ASSERT_TRUE(atRest());
    ASSERT_FALSE(radiosity().chosen());
    session->views.show(shading::kViewFormFactor);
    ASSERT_TRUE(eventually([] { return radiosity().chosen().has_value(); }));
    ASSERT_TRUE(atRest());
    EXPECT_GT(brightness(), 0.0);
    const std::uint32_t chosen = *radiosity().chosen();
    const LiveRadiosity& live = *radiosity().live();
    const double most = live.elements().area(chosen) *
                        glm::dot(live.lit.radiosity(live.solution, chosen), glm::dvec3(1.0));
    for (std::uint32_t e = 0; e < live.elements().size(); ++e)
        EXPECT_LE(live.elements().area(e) *
                      glm::dot(live.lit.radiosity(live.solution, e), glm::dvec3(1.0)),
                  most);
    double share = 0.0;
    for (const ShownRadiosity::Element& element : radiosity().shown()->elements)
        share += static_cast<double>(element.share);
    EXPECT_GT(share, 0.5);
    keep("radiosity-factors.png");
}

TEST_F(RadiosityDock, PlotsRadiosityAlongTheSurfaceAndTheMatrices) {
    light();
    ASSERT_TRUE(atRest());
    auto* plotted = part<QComboBox>("radiosityPlotted");
    const auto choose = [&](int row) {
        plotted->setFocus();
        plotted->setCurrentIndex(row);
        test::handleEvents();
    };
    choose(RadiosityPlots::kSurface);
    auto* surface = part<CurvePlot>("radiositySurfacePlot");
    EXPECT_TRUE(surface->isVisible());
    EXPECT_TRUE(surface->message().contains(QStringLiteral("Click")))
        << surface->message().toStdString();
    const QPoint middle = viewport().rect().center();
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, middle + QPoint(-45, -50)); // the wall
    ASSERT_TRUE(radiosity().chosen());
    ASSERT_EQ(surface->curves().size(), 2u);
    const auto height = [&] {
        double most = 0.0;
        for (const QPointF& point : surface->curves()[0].points)
            most = std::max(most, point.y());
        return most;
    };
    const auto* names = surface->parentWidget()->findChild<PlotLegend*>();
    ASSERT_NE(names, nullptr) << "which line is which";
    EXPECT_TRUE(names->accessibleName().contains(surface->curves()[0].name));
    EXPECT_EQ(surface->axes()[1].title(), QStringLiteral("radiosity [W/m²]"));
    const double inTheEnd = height();
    EXPECT_GT(inTheEnd, 0.0);
    keep("radiosity-surface.png");
    // It follows the steps.
    press("radiosityFirst");
    ASSERT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done == 0; }));
    EXPECT_LT(height(), inTheEnd);
    press("radiositySolved");
    ASSERT_TRUE(eventually([] { return !radiosity().step(); }));

    auto* matrix = part<FactorMap>("radiosityMatrix");
    const std::size_t size = radiosity().live()->elements().size();
    ASSERT_LE(size, RadiosityPlots::kMostInMatrix);
    choose(RadiosityPlots::kFactors);
    ASSERT_EQ(matrix->size(), static_cast<int>(size));
    double row = 0.0;
    for (int column = 0; column < matrix->size(); ++column)
        row += static_cast<double>(matrix->valueAt(10, column));
    EXPECT_GT(row, 0.5);
    EXPECT_LT(row, 1.0001);
    keep("radiosity-matrix.png");
    QTest::mouseClick(matrix, Qt::LeftButton, {}, matrix->position(3, 17).toPoint());
    ASSERT_TRUE(radiosity().chosen());
    EXPECT_NEAR(*radiosity().chosen(), 17, 4) << "a pixel is some rows";
    // What is solved: its product with the radiosity is what is emitted.
    choose(RadiosityPlots::kMatrix);
    EXPECT_EQ(matrix->valueAt(5, 5), 1.0f);
    EXPECT_LE(matrix->valueAt(5, 6), 0.0f);
    // Of more elements than there are cells a cell stands for several.
    set("view.radiosityArea", {Scope::View, 0}, 0.003f);
    ASSERT_TRUE(solved());
    const std::size_t many = radiosity().live()->elements().size();
    ASSERT_GT(many, RadiosityPlots::kMostInMatrix);
    EXPECT_EQ(matrix->size(), static_cast<int>(many));
    const int group = matrix->group();
    EXPECT_EQ(group, static_cast<int>((many + RadiosityPlots::kMostInMatrix - 1) /
                                      RadiosityPlots::kMostInMatrix));
    EXPECT_EQ(matrix->title(), QStringLiteral("I − ρF, in groups of %1 elements").arg(group));
    choose(RadiosityPlots::kFactors);
    // Rays of form factors that leave elements of equal size: a cell is the mean of its rows.
    const LiveRadiosity& live = *radiosity().live();
    const std::vector<float> fine = factorTable(live);
    double wanted = 0.0, area = 0.0;
    const int first = 10 * group, to = 20 * group;
    for (int i = first; i < first + group; ++i) {
        const double weight = radiosity::senderAreas(live.lit.problem)[static_cast<std::size_t>(i)];
        area += weight;
        for (int k = to; k < to + group; ++k)
            wanted +=
                weight *
                double{fine[static_cast<std::size_t>(i) * many + static_cast<std::size_t>(k)]};
    }
    EXPECT_NEAR(double{matrix->valueAt(first, to)}, wanted / area, 1e-6);
    EXPECT_EQ(matrix->readoutAt({double(to), double(first)}).place,
              QStringLiteral("from %1–%2 to %3–%4")
                  .arg(to)
                  .arg(to + group - 1)
                  .arg(first)
                  .arg(first + group - 1));
    keep("radiosity-matrix-groups.png");
    choose(RadiosityPlots::kConvergence);
}

TEST_F(RadiosityDock, LinksAreDrawnFromTheChosenElement) {
    set("view.radiositySolver", {Scope::View, 0}, 6);
    light();
    ASSERT_TRUE(atRest());
    auto* overlay = part<ElementOverlay>("elementOverlay");
    QTest::mouseClick(&viewport(), Qt::LeftButton, {},
                      viewport().rect().center() + QPoint(-45, -50)); // the wall
    ASSERT_TRUE(radiosity().chosen());
    ASSERT_TRUE(eventually([&] { return overlay->drawnLinks() > 0; }));
    const ElementLinks& links = overlay->links();
    EXPECT_EQ(overlay->drawnArrows(), 0);
    EXPECT_LE(overlay->drawnLinks(),
              static_cast<int>(std::min(links.links.size(), ElementOverlay::kMostLinks)));
    double sum = 0.0, row = 0.0;
    for (const ElementLink& link : links.links)
        sum += link.factor;
    for (const double factor : factorsOverLinks(*radiosity().live(), *radiosity().chosen()))
        row += factor;
    EXPECT_NEAR(sum, row, 1e-6);
    const auto* flow = part<QTreeWidget>("radiosityFlow");
    bool listed = false;
    for (int i = 0; i < flow->topLevelItemCount(); ++i)
        listed = listed || flow->topLevelItem(i)->text(0).startsWith(
                               QStringLiteral("%1 links").arg(links.links.size()));
    EXPECT_TRUE(listed);
    keep("radiosity-links.png");
    radiosity().choose(std::nullopt);
    EXPECT_TRUE(overlay->links().links.empty());
}

TEST_F(RadiosityDock, TheHemicubeShowsWhatAnElementSees) {
    light();
    ASSERT_TRUE(atRest());
    auto* plotted = part<QComboBox>("radiosityPlotted");
    plotted->setCurrentIndex(RadiosityPlots::kHemicube);
    test::handleEvents();
    auto* cross = part<QWidget>("radiosityHemicube");
    auto* view = qobject_cast<HemicubeView*>(cross->parentWidget());
    ASSERT_NE(view, nullptr);
    EXPECT_TRUE(view->picture().isNull()) << "nothing is chosen";
    QTest::mouseClick(&viewport(), Qt::LeftButton, {},
                      viewport().rect().center() + QPoint(-45, -50)); // the wall
    ASSERT_TRUE(radiosity().chosen());
    ASSERT_FALSE(view->picture().isNull());
    const int side = view->picture().width();
    EXPECT_EQ(side, 2 * HemicubeView::kCells);
    EXPECT_TRUE(view->wordsAt({1, 1}).isEmpty()) << "a corner of the cross";
    EXPECT_EQ(view->picture().pixelColor(1, 1).alpha(), 0);
    const QString middle = view->wordsAt({side / 2, side / 2});
    EXPECT_TRUE(middle.contains(QStringLiteral("this cell"))) << middle.toStdString();
    EXPECT_TRUE(middle.contains(QStringLiteral("%")));
    auto* colors = part<QComboBox>("radiosityHemicubeColors");
    const QImage elements = view->picture();
    colors->setCurrentIndex(HemicubeView::kRadiosity);
    const QImage light = view->picture();
    EXPECT_NE(light, elements);
    colors->setCurrentIndex(HemicubeView::kFactors);
    // Cells in the middle count most.
    const QImage factors = view->picture();
    EXPECT_GT(factors.pixelColor(side / 2, side / 2).lightness(),
              factors.pixelColor(side / 2, 1).lightness());
    colors->setCurrentIndex(HemicubeView::kElements);
    keep("radiosity-hemicube.png");
    const auto before = radiosity().chosen();
    // On a cell through which an element is seen.
    QPoint seen(-1, -1);
    for (int y = 0; y < side && seen.x() < 0; ++y)
        for (int x = 0; x < side && seen.x() < 0; ++x)
            if (view->wordsAt({x, y}).contains(QStringLiteral("element")))
                seen = {x, y};
    ASSERT_GE(seen.x(), 0);
    const double edge = std::min(cross->width(), cross->height()) - 8.0;
    const QPoint at = (0.5 * (QPointF(cross->width(), cross->height()) - QPointF(edge, edge)) +
                       (QPointF(seen) + QPointF(0.5, 0.5)) * (edge / side))
                          .toPoint();
    // Sent to it: the dock is scrolled, and the pointer may be over something else.
    QMouseEvent move(QEvent::MouseMove, at, cross->mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(cross, &move);
    EXPECT_EQ(words("radiosityHemicubeHover"), view->wordsAt(seen));
    QTest::mouseClick(cross, Qt::LeftButton, {}, at);
    EXPECT_TRUE(radiosity().chosen());
    EXPECT_NE(radiosity().chosen(), before) << "the element that is seen is chosen";
    plotted->setCurrentIndex(RadiosityPlots::kConvergence);
}

TEST_F(RadiosityDock, TheParaboloidIsShownWhereItIsTheMethod) {
    light();
    set("view.radiosityTexels", {Scope::View, 0}, 32.0f);
    set("view.radiosityMethod", {Scope::View, 0}, 3);
    ASSERT_TRUE(atRest());
    auto* plotted = part<QComboBox>("radiosityPlotted");
    plotted->setCurrentIndex(RadiosityPlots::kHemicube);
    QTest::mouseClick(&viewport(), Qt::LeftButton, {},
                      viewport().rect().center() + QPoint(-45, -50)); // the wall
    ASSERT_TRUE(radiosity().chosen());
    auto* view = qobject_cast<HemicubeView*>(part<QWidget>("radiosityHemicube")->parentWidget());
    ASSERT_NE(view, nullptr);
    EXPECT_TRUE(view->isParaboloid());
    ASSERT_FALSE(view->picture().isNull());
    const int side = view->picture().width();
    int shown = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool is = view->picture().pixelColor(x, y).alpha() > 0;
            EXPECT_EQ(is, std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) < 0.5 * side);
            EXPECT_EQ(is, !view->wordsAt({x, y}).isEmpty());
            shown += is ? 1 : 0;
        }
    EXPECT_GT(shown, side * side / 2);
    auto* colors = part<QComboBox>("radiosityHemicubeColors");
    colors->setCurrentIndex(HemicubeView::kFactors);
    const QImage factors = view->picture();
    EXPECT_GT(factors.pixelColor(side / 2, side / 2).lightness(),
              factors.pixelColor(side / 2, 1).lightness());
    colors->setCurrentIndex(HemicubeView::kElements);
    EXPECT_EQ(part<QComboBox>("radiosityPlotted")->currentText(), QStringLiteral("Paraboloid map"));
    keep("radiosity-paraboloid.png");
    // The picture follows the method.
    controller().undoStack().undo();
    ASSERT_TRUE(atRest());
    EXPECT_FALSE(view->isParaboloid());
    EXPECT_EQ(view->picture().pixelColor(side / 2, 0).alpha(), 255) << "a side of the hemicube";
    plotted->setCurrentIndex(RadiosityPlots::kConvergence);
}

TEST_F(RadiosityDock, LeaksAndSeamsAreListedAndShown) {
    light();
    ASSERT_TRUE(atRest());
    auto* plotted = part<QComboBox>("radiosityPlotted");
    plotted->setCurrentIndex(RadiosityPlots::kLeaks);
    test::handleEvents();
    EXPECT_FALSE(radiosity().leaks());
    const auto find = [] {
        press("radiosityFindLeaks");
        return eventually([] { return !radiosity().findingLeaks() && radiosity().leaks(); });
    };
    ASSERT_TRUE(find());
    // The short block is lifted by a centimetre: light comes out below it.
    const Document& opened = document();
    const auto block = std::ranges::find_if(opened.meshes, [](const MeshInstance& mesh) {
        return mesh.name.find("hort") != std::string::npos;
    });
    ASSERT_NE(block, opened.meshes.end());
    const std::size_t before = radiosity().leaks()->leaks.size();
    controller().editStructure(QStringLiteral("Lift"), [id = block->id](Document& edited) {
        Placement& placement = edited.mesh(id)->placement;
        placement.setPosition(placement.position() + glm::vec3(0.0f, 0.01f, 0.0f));
    });
    ASSERT_TRUE(solved());
    EXPECT_FALSE(radiosity().leaks()) << "they went with the solution";
    ASSERT_TRUE(find());
    EXPECT_GT(radiosity().leaks()->leaks.size(), before);
    EXPECT_TRUE(std::ranges::any_of(radiosity().leaks()->leaks, [](const LightLeak& leak) {
        return leak.kind == LightLeak::Kind::Gap && std::abs(leak.width - 0.01) < 1e-3;
    }));
    auto* list = part<QTreeWidget>("radiosityLeaks");
    ASSERT_EQ(list->topLevelItemCount(), 2);
    EXPECT_EQ(static_cast<std::size_t>(list->topLevelItem(0)->childCount()),
              std::min(radiosity().leaks()->leaks.size(), LeakList::kMostListed));
    keep("radiosity-leaks.png");
    ASSERT_GT(list->topLevelItem(0)->childCount(), 0);
    list->setCurrentItem(list->topLevelItem(0)->child(0));
    EXPECT_EQ(radiosity().chosen(), radiosity().leaks()->leaks[0].element);
    controller().undoStack().undo();
    plotted->setCurrentIndex(RadiosityPlots::kConvergence);
}

} // namespace
} // namespace patina::editor
