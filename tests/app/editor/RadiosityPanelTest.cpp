// Light solved by elements in the window: started, stopped, solved by each solver and method, and
// edited while it is shown.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/RadiosityDockFixture.h"

#include "app/editor/panel/ParameterRow.h"
#include "app/editor/radiosity/RadiosityPanel.h"
#include "app/editor/radiosity/RadiosityPlots.h"
#include "app/editor/radiosity/RadiosityTexts.h"
#include "app/editor/widget/NumberField.h"

#include <QComboBox>

namespace patina::editor {
namespace {

TEST_F(RadiosityDock, DisablesWhatHasNoEffect) {
    const auto row = [](std::string_view id) -> QWidget* {
        for (ParameterRow* found : part<QWidget>("radiosityPanel")->findChildren<ParameterRow*>())
            if (found->info().id == id)
                return found;
        ADD_FAILURE() << id;
        return window.get();
    };
    QWidget *divideBy = row("view.radiosityDivideBy"), *dynamic = row("view.radiosityDynamic"),
            *patches = row("view.radiosityPatches");
    EXPECT_TRUE(row("view.radiosityAdaptive")->isEnabled()) << "before the scene is lit so";
    EXPECT_FALSE(divideBy->isEnabled()) << "nothing is divided further";
    EXPECT_FALSE(patches->isEnabled()) << "gathering has none";
    set("view.radiosityAdaptive", {Scope::View, 0}, 0.3f);
    EXPECT_TRUE(divideBy->isEnabled());
    EXPECT_FALSE(dynamic->isEnabled()) << "gathering does not shoot";
    set("view.radiositySolver", {Scope::View, 0}, static_cast<int>(RadiositySolver::Progressive));
    EXPECT_TRUE(dynamic->isEnabled());
    EXPECT_TRUE(patches->isEnabled());
}

TEST_F(RadiosityDock, LightsTheSceneAndGoesBack) {
    EXPECT_FALSE(controller().displayName().contains(QLatin1Char(':')))
        << "dialogs propose file names from it";
    // The room was opened lit by it; the next frame no longer is.
    ASSERT_TRUE(eventually([] { return !radiosity().isWanted(); }))
        << "nothing is solved that nobody looks at";
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    const double before = brightness();
    light();
    EXPECT_TRUE(words("radiosityStatus").contains(QStringLiteral("elements")))
        << words("radiosityStatus").toStdString();
    EXPECT_TRUE(part<QLabel>("radiosityStatus")->toolTip().contains(QStringLiteral("reciprocity")));
    ASSERT_TRUE(atRest());
    EXPECT_GT(brightness(), 1.1 * before) << "the ceiling is lit by the floor";
    keep("radiosity.png");
    press("radiosityLight");
    EXPECT_EQ(document().view.lighting, LightingMode::Ibl);
    controller().undoStack().undo();
    EXPECT_EQ(document().view.lighting, LightingMode::Radiosity);
    ASSERT_TRUE(solved());
}

TEST_F(RadiosityDock, EditsAreSolvedFromWhatIsKnown) {
    controller().addLight(LightType::Sphere);
    const Target lamp{Scope::Light, document().lights.back().id};
    set("light.position", lamp, document().bounds().center());
    set("light.intensity", lamp, 50.0f);
    light();
    const LiveRadiosityPtr first = radiosity().live();
    // A wall gets another colour: the same elements and form factors.
    const Id material = document().meshes.front().material;
    set("material.baseColor", {Scope::Material, material}, glm::vec3(0.9f, 0.2f, 0.1f));
    ASSERT_TRUE(solved());
    const LiveRadiosityPtr recoloured = radiosity().live();
    EXPECT_EQ(recoloured->factors, first->factors);
    EXPECT_NE(recoloured->solution.radiosity, first->solution.radiosity);
    // Muted in the mixer: nothing is solved.
    set("light.enabled", lamp, false);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->switchedOff.size(), 1u);
    set("light.enabled", lamp, true);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->solution.radiosity, recoloured->solution.radiosity);
    // What the solution does not rest on is no reason to solve.
    const LiveRadiosityPtr before = radiosity().live();
    set("view.exposureEv", {Scope::View, 0}, 1.0f);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live(), before);
    // Another division begins anew.
    set("view.radiosityArea", {Scope::View, 0}, 0.01f);
    ASSERT_TRUE(solved());
    EXPECT_NE(radiosity().live()->shape, first->shape);
    EXPECT_GT(radiosity().live()->elements().size(), first->elements().size());
}

TEST_F(RadiosityDock, StopsAndGoesOn) {
    light();
    radiosity().stop();
    set("view.radiosityArea", {Scope::View, 0}, 0.03f);
    EXPECT_TRUE(words("radiosityStatus").contains(QStringLiteral("stopped")));
    const LiveRadiosityPtr before = radiosity().live();
    QTest::qWait(50);
    EXPECT_EQ(radiosity().live(), before) << "edits wait";
    press("radiositySolve");
    ASSERT_TRUE(solved());
    EXPECT_NE(radiosity().live(), before);
}

TEST_F(RadiosityDock, AViewOfElementsIsSolvedForWhateverLightsTheScene) {
    EXPECT_EQ(document().view.lighting, LightingMode::Ibl);
    session->views.show(shading::kViewElementLight);
    ASSERT_TRUE(solved());
    EXPECT_TRUE(radiosity().live());
    ASSERT_TRUE(atRest());
    keep("radiosity-elements.png");
    session->views.show(shading::kViewFinal);
    ASSERT_TRUE(eventually([] { return !radiosity().isWanted(); }));
}

TEST_F(RadiosityDock, TooManyElementsAreRefusedWithAReason) {
    std::vector<UserNotice> notices;
    QObject here;
    QObject::connect(&controller(), &DocumentController::noticed, &here,
                     [&](const UserNotice& notice) { notices.push_back(notice); });
    set("view.radiosityArea", {Scope::View, 0}, 1e-6f);
    press("radiosityLight");
    ASSERT_TRUE(eventually([] { return !radiosity().failure().isEmpty(); }));
    EXPECT_FALSE(notices.empty());
    EXPECT_EQ(words("radiosityStatus"), radiosity().failure());
    set("view.radiosityArea", {Scope::View, 0}, 0.02f);
    ASSERT_TRUE(solved());
    EXPECT_TRUE(radiosity().failure().isEmpty());
    EXPECT_TRUE(radiosity().shown());
}

TEST_F(RadiosityDock, SolversAndMethodsAreChosen) {
    light();
    ASSERT_TRUE(atRest());
    const auto shape = radiosity().live()->shape;
    const auto solverIs = [](const char* text) {
        return radiosity::name(radiosity().live()->settings.solve.solver) == text;
    };
    const auto rows = [](const char* label) {
        for (const QWidget* row : part<RadiosityPanel>("radiosityPanel")->findChildren<QWidget*>())
            if (row->isVisible() && row->accessibleName() == QLatin1String(label))
                return true;
        return false;
    };
    const ParameterInfo& solver = parameter("view.radiositySolver");
    const ParameterInfo& method = parameter("view.radiosityMethod");
    for (int i = 0; i < static_cast<int>(solver.choices.size()); ++i) {
        set("view.radiositySolver", {Scope::View, 0}, i);
        ASSERT_TRUE(solved()) << solver.choices[static_cast<std::size_t>(i)];
        EXPECT_TRUE(radiosity().failure().isEmpty()) << radiosity().failure().toStdString();
        EXPECT_TRUE(solverIs(solver.choices[static_cast<std::size_t>(i)].data()));
        EXPECT_EQ(radiosity().live()->shape, shape) << "elements stay";
    }
    // The last one, hierarchical, says what it cannot do.
    EXPECT_FALSE(part<QPushButton>("radiosityNext")->isEnabled());
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("no rows")))
        << words("radiosityStep").toStdString();
    EXPECT_TRUE(part<QLabel>("radiosityStatus")->toolTip().contains(QStringLiteral("Links")));
    EXPECT_TRUE(rows("Link error"));
    EXPECT_FALSE(rows("Rays")) << "links are found without";
    EXPECT_NEAR(radiosity().live()->settings.hierarchy.linkError,
                radiosity::HierarchySettings().linkError, 1e-12);
    set("view.radiosityLinkError", {Scope::View, 0}, 30.0f);
    ASSERT_TRUE(solved());
    EXPECT_NEAR(radiosity().live()->settings.hierarchy.linkError, 3e-5, 1e-9);
    controller().undoStack().undo();
    controller().undoStack().undo();
    EXPECT_FALSE(rows("Link error"));
    ASSERT_TRUE(solved());
    EXPECT_TRUE(solverIs("direct"));
    EXPECT_TRUE(part<QPushButton>("radiosityNext")->isEnabled());

    set("view.radiositySolver", {Scope::View, 0}, 0);
    set("view.radiosityCells", {Scope::View, 0}, 17.0f);
    EXPECT_TRUE(rows("Rays"));
    EXPECT_FALSE(rows("Cells"));
    set("view.radiosityMethod", {Scope::View, 0}, 1);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->settings.factors.method, radiosity::FactorMethod::Hemicube);
    EXPECT_EQ(radiosity().live()->settings.factors.resolution, 18) << "even";
    EXPECT_FALSE(rows("Rays"));
    EXPECT_TRUE(rows("Cells"));
    EXPECT_TRUE(part<QLabel>("radiosityStatus")->toolTip().contains(QStringLiteral("hemicubes")));
    set("view.radiosityPairs", {Scope::View, 0}, 2.0f);
    set("view.radiosityMethod", {Scope::View, 0}, 2);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->settings.factors.method, radiosity::FactorMethod::Analytic);
    EXPECT_EQ(method.choices[2], "analytic");
    set("view.radiosityTexels", {Scope::View, 0}, 33.0f);
    EXPECT_FALSE(rows("Texels"));
    set("view.radiosityMethod", {Scope::View, 0}, 3);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->settings.factors.method, radiosity::FactorMethod::Paraboloid);
    EXPECT_EQ(radiosity().live()->settings.factors.resolution, 33);
    EXPECT_TRUE(rows("Texels"));
    EXPECT_TRUE(
        part<QLabel>("radiosityStatus")->toolTip().contains(QStringLiteral("paraboloid maps")));
    controller().undoStack().undo();
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->settings.factors.method, radiosity::FactorMethod::Analytic);
    EXPECT_FALSE(rows("Texels"));
    set("view.radiosityMethod", {Scope::View, 0}, 0);
    ASSERT_TRUE(solved());
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("same form factors")));
}

TEST_F(RadiosityDock, PatchesShootInPlaceOfElements) {
    set("view.radiositySolver", {Scope::View, 0}, 2);
    light();
    EXPECT_FALSE(words("radiosityStatus").contains(QStringLiteral("patches")));
    const std::size_t elements = radiosity().live()->elements().size();
    set("view.radiosityPatches", {Scope::View, 0}, 0.1f);
    ASSERT_TRUE(solved()) << radiosity().failure().toStdString();
    const LiveRadiosityPtr live = radiosity().live();
    ASSERT_FALSE(live->elements().patches().empty());
    EXPECT_LT(live->factors->matrix.size(), elements / 2);
    EXPECT_TRUE(words("radiosityStatus").contains(QStringLiteral("patches")))
        << words("radiosityStatus").toStdString();
    press("radiosityFirst");
    ASSERT_TRUE(eventually([] { return radiosity().step() != nullptr; }));
    EXPECT_EQ(radiosity().step()->perRound, live->elements().senderCount());
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("patch")))
        << words("radiosityStep").toStdString();
    press("radiosityNext");
    ASSERT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done == 1; }));
    keep("radiosity-patches.png");
    auto* plotted = part<QComboBox>("radiosityPlotted");
    plotted->setCurrentIndex(RadiosityPlots::kFactors);
    EXPECT_EQ(factorTable(*live).size(),
              live->elements().senderCount() * live->elements().senderCount());
    plotted->setCurrentIndex(0);

    // Smaller than elements: said, and undone.
    set("view.radiosityPatches", {Scope::View, 0}, 0.001f);
    ASSERT_TRUE(eventually([] { return !radiosity().failure().isEmpty(); }));
    EXPECT_TRUE(words("radiosityStatus").contains(QStringLiteral("smaller than elements")))
        << words("radiosityStatus").toStdString();
    controller().undoStack().undo();
    ASSERT_TRUE(solved());
    EXPECT_TRUE(radiosity().failure().isEmpty());
    // Gathering has no patches, and none are made.
    set("view.radiositySolver", {Scope::View, 0}, 0);
    ASSERT_TRUE(solved()) << radiosity().failure().toStdString();
    EXPECT_TRUE(radiosity().live()->elements().patches().empty());
}

TEST_F(RadiosityDock, AnAreaOfZeroIsAutomatic) {
    light();
    const auto shows = [](const QString& text) {
        for (const NumberField* field :
             part<RadiosityPanel>("radiosityPanel")->findChildren<NumberField*>())
            if (field->text() == text)
                return true;
        return false;
    };
    EXPECT_FALSE(shows(QStringLiteral("auto")));
    set("view.radiosityArea", {Scope::View, 0}, 0.0f);
    EXPECT_TRUE(shows(QStringLiteral("auto")));
    set("view.radiosityArea", {Scope::View, 0}, 0.02f);
    ASSERT_TRUE(solved());
}

} // namespace
} // namespace patina::editor
