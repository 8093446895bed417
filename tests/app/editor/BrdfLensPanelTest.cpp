// The BRDF Lens dock by real events: angles dragged, models compared, values read out, and what it
// says when there is nothing to show.

#include "app/editor/panel/BrdfLensPanel.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include "app/editor/panel/LensControls.h"
#include "app/editor/widget/CurvePlot.h"
#include "app/editor/widget/LitSphere.h"
#include "app/editor/widget/LobeView.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/PolarPlot.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"
#include "core/edit/Parameters.h"
#include "core/light/DfgTable.h"
#include "core/material/ModelPresets.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <cmath>
#include <numbers>
#include <set>

namespace patina::editor {
namespace {

struct BrdfLensPanelTest : ::testing::Test {
    static void SetUpTestSuite() { session = std::make_unique<Session>(); }
    static void TearDownTestSuite() { session.reset(); }

    void SetUp() override {
        session->controller.newDocument();
        ASSERT_TRUE(eventually([] { return !session->controller.tasks().busy(); }));
        panel = std::make_unique<BrdfLensPanel>(session->controller, session->selection,
                                                session->probe, session->lobe);
        panel->resize(800, 260);
        panel->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.get(), 60'000));
        ASSERT_TRUE(settled());
    }
    void TearDown() override { panel.reset(); }

    bool settled() {
        return eventually(
            [this] { return panel->upToDate() && space().upToDate() && ball().upToDate(); });
    }
    template <class Widget>
    Widget& named(const char* name) {
        for (Widget* widget : panel->findChildren<Widget*>())
            if (widget->accessibleName() == QString::fromUtf8(name))
                return *widget;
        ADD_FAILURE() << name;
        std::abort();
    }
    PolarPlot& polar() { return *panel->findChild<PolarPlot*>(); }
    LobeView& space() { return *panel->findChild<LobeView*>(); }
    LitSphere& ball() { return *panel->findChild<LitSphere*>(); }
    CurvePlot& plot(const char* name) { return named<CurvePlot>(name); }
    void press(const char* name) { QTest::mouseClick(&named<QToolButton>(name), Qt::LeftButton); }
    const LensCurves& scene() { return panel->result().curves.front(); }
    static void set(const char* id, const ParameterValue& value) {
        const ParameterInfo& info = parameter(id);
        session->controller.setParameter(
            info, {info.scope, info.scope == Scope::Material ? session->selection.material() : 0},
            value);
    }
    void keep(const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        test::handleEvents();
        if (!target.isEmpty())
            panel->grab().save(target + QLatin1Char('/') + name);
    }

    static std::unique_ptr<Session> session;
    std::unique_ptr<BrdfLensPanel> panel;
};

std::unique_ptr<Session> BrdfLensPanelTest::session;

// Numbers without maps, that closed forms are known of.
struct PlainMetal : BrdfLensPanelTest {
    void SetUp() override {
        BrdfLensPanelTest::SetUp();
        for (const char* map : {"material.baseColor.map", "material.metallic.map",
                                "material.perceptualRoughness.map"})
            clearMap(map);
        set("material.baseColor", glm::vec3(1.0f));
        set("material.metallic", 1.0f);
        set("material.perceptualRoughness", 0.5f);
        ASSERT_TRUE(settled());
    }
    static void clearMap(const char* id) {
        session->controller.clearMap(parameter(id),
                                     {Scope::Material, session->selection.material()});
    }
};

TEST_F(BrdfLensPanelTest, PlotsFollowTheMouseAndTheKeyboard) {
    // A press in the dial puts the light there, a drag takes it along.
    const auto onDial = [&](double degrees) {
        const QPointF middle = polar().position(0.0, 0.0);
        const double radius = middle.y() - polar().lightPosition().y();
        const double r = radius / std::cos(polar().incidence() * std::numbers::pi / 180.0);
        const double a = degrees * std::numbers::pi / 180.0;
        return (middle + 0.8 * r * QPointF(-std::sin(a), -std::cos(a))).toPoint();
    };
    QTest::mousePress(&polar(), Qt::LeftButton, {}, onDial(30.0));
    EXPECT_NEAR(panel->controls().incidence(), 30.0, 1.0);
    QTest::mouseMove(&polar(), onDial(62.0));
    EXPECT_NEAR(panel->controls().incidence(), 62.0, 1.0);
    QTest::mouseRelease(&polar(), Qt::LeftButton, {}, onDial(62.0));
    QTest::mouseMove(&polar(), onDial(10.0));
    EXPECT_NEAR(panel->controls().incidence(), 62.0, 1.0) << "let go";
    EXPECT_NEAR(named<NumberField>("Angle of incidence").value(), panel->controls().incidence(),
                0.05);
    ASSERT_TRUE(settled());
    EXPECT_NEAR(panel->result().request.incidence,
                panel->controls().incidence() * std::numbers::pi / 180.0, 1e-4);

    polar().setFocus();
    const double before = panel->controls().incidence();
    QTest::keyClick(&polar(), Qt::Key_Right, Qt::AltModifier);
    EXPECT_NEAR(panel->controls().incidence(), before - 1.0, 1e-9);
    QTest::keyClick(&polar(), Qt::Key_Left, Qt::AltModifier | Qt::ControlModifier);
    EXPECT_NEAR(panel->controls().incidence(), before + 9.0, 1e-9);

    // The slider, and a number that is typed.
    auto& slider = named<Slider>("Angle of incidence slider");
    QTest::mouseClick(&slider, Qt::LeftButton, {}, {slider.width() - 2, slider.height() / 2});
    EXPECT_EQ(panel->controls().incidence(), 89.0) << "light along the surface does not arrive";
    auto& field = named<NumberField>("Angle of incidence");
    QTest::mouseDClick(&field, Qt::LeftButton);
    QTest::keyClicks(&field, QStringLiteral("20"));
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(panel->controls().incidence(), 20.0);
    EXPECT_NEAR(polar().incidence(), 20.0, 1e-6);
}

TEST_F(PlainMetal, CurvesAreTheShadersNumbers) {
    panel->controls().setIncidence(60.0);
    ASSERT_TRUE(settled());
    // D's peak is 1 / (pi alpha²); G2 at (N·V, N·L) = (1, 0.5) is G1; F of a white metal is 1.
    EXPECT_NEAR(scene().distribution.front().y, 5.09295817894f, 1e-4f);
    EXPECT_NEAR(scene().masking.front().y, 0.957063849442f, 1e-4f);
    EXPECT_NEAR(scene().fresnel.back().y, 1.0f, 1e-6f);
    // Albedo at 60° is what the table holds at N·V = 0.5, and compensation makes it 1.
    const glm::dvec3 dfg = integrateDfg(0.5f, 0.5f);
    const auto at60 = [](const LensCurves::Curve& curve) {
        for (const glm::vec2& point : curve)
            if (std::abs(point.x - 60.0f) < 0.01f)
                return double(point.y);
        return -1.0;
    };
    EXPECT_NEAR(at60(scene().single), dfg.x + dfg.y, 2e-3);
    EXPECT_NEAR(at60(scene().multi), 1.0, 1e-5);
    EXPECT_NEAR(at60(scene().exact), 1.0, 3e-3);

    // What lobes show is a choice.
    const float peak = panel->result().peak;
    auto& quantity = named<QComboBox>("Quantity");
    quantity.setFocus();
    QTest::keyClick(&quantity, Qt::Key_Down);
    ASSERT_TRUE(settled());
    EXPECT_LT(panel->result().peak, 0.75f * peak) << "times the cosine, 0.5 near the peak";
    EXPECT_GT(panel->result().peak, 0.25f * peak);
    auto& channel = named<QComboBox>("Channel");
    set("material.baseColor", glm::vec3(1.0f, 0.5f, 0.0f));
    channel.setFocus();
    QTest::keyClick(&channel, Qt::Key_Down);
    QTest::keyClick(&channel, Qt::Key_Down);
    ASSERT_TRUE(settled());
    EXPECT_NEAR(scene().fresnel.front().y, 0.5f, 1e-5f) << "green";
}

TEST_F(PlainMetal, EveryStepOfADragIsFollowed) {
    const ParameterInfo& info = parameter("material.perceptualRoughness");
    const Target target{Scope::Material, session->selection.material()};
    const DragSession drag = session->controller.newDragSession();
    const QImage ballBefore = ball().picture(), spaceBefore = space().picture();
    const auto shown = [&] {
        return panel->result().request.looks.front().point.perceptualRoughness;
    };
    for (int step = 1; step <= 5; ++step) {
        const float last = shown();
        session->controller.setParameter(info, target, 0.5f + 0.08f * float(step), drag);
        ASSERT_TRUE(eventually([&] { return shown() != last; })) << "not only where it ended";
    }
    ASSERT_TRUE(settled());
    EXPECT_NEAR(panel->result().request.looks.front().point.perceptualRoughness, 0.9f, 1e-5f);
    EXPECT_NEAR(scene().distribution.front().y, 1.0 / (std::numbers::pi * std::pow(0.81, 2)), 1e-4);
    EXPECT_NE(ball().picture(), ballBefore);
    EXPECT_NE(space().picture(), spaceBefore);
    session->controller.undoStack().undo();
    ASSERT_TRUE(settled());
    EXPECT_NEAR(scene().distribution.front().y, 5.09295817894f, 1e-4f);
}

TEST_F(PlainMetal, ModelsStandSideBySide) {
    // By the menu, as a hand does it.
    const auto choose = [&](const QString& text) {
        auto& button = named<QToolButton>("Compare");
        bool chosen = false;
        QTimer::singleShot(0, &button, [&] {
            QMenu& menu = *button.menu();
            for (QAction* action : menu.actions())
                if (action->text() == text) {
                    QTest::mouseClick(&menu, Qt::LeftButton, {},
                                      menu.actionGeometry(action).center());
                    chosen = true;
                }
            menu.close();
        });
        QTest::mouseClick(&button, Qt::LeftButton);
        EXPECT_TRUE(eventually([&] { return chosen; })) << text.toStdString();
    };
    choose(QStringLiteral("Unreal Engine 4"));
    ASSERT_TRUE(settled());
    ASSERT_EQ(panel->result().curves.size(), 2u);
    // Its k = (r + 1)² / 8 hides more, and it forgets what scatters twice.
    EXPECT_LT(panel->result().curves[1].masking.front().y, scene().masking.front().y);
    EXPECT_LT(panel->result().curves[1].exact.front().y, 0.95f);
    EXPECT_EQ(plot("By angle").curves().size(), 2u);
    EXPECT_NE(plot("By angle").curves()[0].look, plot("By angle").curves()[1].look);
    EXPECT_EQ(plot("Albedo").curves().size(), 6u);

    choose(QStringLiteral("No compensation"));
    choose(QStringLiteral("Freeze as It Is Now"));
    set("material.perceptualRoughness", 0.8f);
    ASSERT_TRUE(settled());
    ASSERT_EQ(panel->result().request.looks.size(), 4u);
    EXPECT_FALSE(panel->result().request.looks[2].model.multiScatter);
    EXPECT_EQ(panel->result().request.looks[2].point.perceptualRoughness, 0.8f);
    EXPECT_EQ(panel->result().request.looks[3].point.perceptualRoughness, 0.5f) << "frozen";
    EXPECT_NEAR(panel->result().curves[3].distribution.front().y, 5.09295817894f, 1e-4f);
    std::set<int> looks;
    for (const PlotCurve& curve : plot("By angle").curves())
        looks.insert(curve.look);
    EXPECT_EQ(looks.size(), 4u) << "each has its own colour";
    keep("lens-four-looks.png");

    // A fourth pushes the oldest out; a click in the legend takes one away.
    choose(QStringLiteral("Blinn-Phong"));
    ASSERT_TRUE(settled());
    EXPECT_EQ(panel->result().request.looks.size(), 4u);
    EXPECT_FALSE(panel->result().request.looks[1].model.multiScatter);
    press("Legend: Blinn-Phong");
    ASSERT_TRUE(settled());
    EXPECT_EQ(panel->result().request.looks.size(), 3u);
    choose(QStringLiteral("Compare with Nothing"));
    ASSERT_TRUE(settled());
    EXPECT_EQ(panel->result().request.looks.size(), 1u);
}

TEST_F(PlainMetal, ThePointerReadsValuesOut) {
    CurvePlot& albedo = plot("Albedo");
    press("Show Albedo");
    ASSERT_TRUE(eventually([&] { return albedo.isVisible() && !polar().isVisible(); }));
    const glm::dvec3 dfg = integrateDfg(0.5f, 0.5f);
    const QStringList lines = albedo.readout(60.0);
    ASSERT_EQ(lines.size(), 3);
    EXPECT_TRUE(lines[0].contains(QStringLiteral("compensated")));
    EXPECT_TRUE(lines[1].endsWith(plotNumber(std::round(1e3 * (dfg.x + dfg.y)) / 1e3)))
        << lines[1].toStdString();
    const QImage before = albedo.grab().toImage();
    QTest::mouseMove(&albedo, albedo.position(60.0, 0.5).toPoint());
    ASSERT_TRUE(eventually([&] { return albedo.grab().toImage() != before; }));
    keep("lens-readout.png");

    // An angle in one plot is shown in all: h stands half way between the light and the viewer.
    press("Show D G F");
    CurvePlot& factor = plot("G  not hidden");
    ASSERT_TRUE(eventually([&] { return factor.isVisible(); }));
    const QImage distribution = plot("D  facing h").grab().toImage();
    const QImage fresnel = plot("F  Fresnel").grab().toImage();
    QTest::mouseMove(&factor, factor.position(30.0, 0.5).toPoint());
    ASSERT_TRUE(eventually([&] {
        return plot("D  facing h").grab().toImage() != distribution &&
               plot("F  Fresnel").grab().toImage() != fresnel;
    }));
    // The numbers' text: the peak of D at alpha 0.25.
    EXPECT_EQ(plot("D  facing h").readout(0.0).front(), QStringLiteral("5.09 sr⁻¹"));
}

TEST_F(PlainMetal, LobesOrbitAndTheLightMoves) {
    const LobeCamera before = space().camera();
    const QImage picture = space().picture();
    const QPoint middle = space().rect().center();
    QTest::mousePress(&space(), Qt::LeftButton, {}, middle);
    QTest::mouseMove(&space(), middle + QPoint(40, -20));
    QTest::mouseRelease(&space(), Qt::LeftButton, {}, middle + QPoint(40, -20));
    EXPECT_NE(space().camera(), before);
    ASSERT_TRUE(settled());
    EXPECT_NE(space().picture(), picture);
    // Never from below.
    QTest::mousePress(&space(), Qt::LeftButton, {}, middle);
    QTest::mouseMove(&space(), middle - QPoint(0, 2000));
    EXPECT_GE(space().camera().elevationDeg, 0.0);
    QTest::mouseRelease(&space(), Qt::LeftButton, {}, middle);
    QTest::mouseDClick(&space(), Qt::LeftButton, {}, middle);
    EXPECT_EQ(space().camera(), before);

    const glm::vec3 toLight = ball().light().toLight;
    const QImage lit = ball().picture();
    QTest::mousePress(&ball(), Qt::LeftButton, {}, ball().rect().center() + QPoint(25, 0));
    EXPECT_GT(ball().light().toLight.x, 0.1f) << "the highlight comes to the pointer";
    EXPECT_NE(ball().light().toLight, toLight);
    EXPECT_NEAR(glm::length(ball().light().toLight), 1.0f, 1e-5f);
    ASSERT_TRUE(settled());
    EXPECT_NE(ball().picture(), lit);
}

TEST_F(PlainMetal, NothingToShowIsSaid) {
    // A metal has no diffuse lobe.
    auto& lobe = named<QComboBox>("Lobe");
    lobe.setFocus();
    QTest::keyClick(&lobe, Qt::Key_Down);
    QTest::keyClick(&lobe, Qt::Key_Down);
    ASSERT_TRUE(settled());
    EXPECT_TRUE(polar().message().contains(QStringLiteral("no diffuse lobe")));
    EXPECT_TRUE(plot("By angle").message().contains(QStringLiteral("no diffuse lobe")));
    keep("lens-nothing.png");
    // A black dielectric reflects at its surface only.
    set("material.metallic", 0.0f);
    set("material.baseColor", glm::vec3(0.0f));
    ASSERT_TRUE(settled());
    EXPECT_FALSE(polar().message().isEmpty());
    QTest::keyClick(&lobe, Qt::Key_Up);
    ASSERT_TRUE(settled());
    EXPECT_TRUE(polar().message().isEmpty());
    EXPECT_GT(panel->result().peak, 0.0f);

    // Roughness 0: a mirror, which lights see a little wider.
    set("material.perceptualRoughness", 0.0f);
    ASSERT_TRUE(settled());
    EXPECT_TRUE(std::isfinite(panel->result().peak));
    EXPECT_GT(panel->result().peak, 100.0f);
    EXPECT_TRUE(named<QLabel>("Looked at").text().contains(QStringLiteral("0.045")));
}

TEST_F(BrdfLensPanelTest, WithoutAMaterialItSaysSo) {
    Session empty; // no document yet
    panel =
        std::make_unique<BrdfLensPanel>(empty.controller, empty.selection, empty.probe, empty.lobe);
    panel->resize(800, 260);
    panel->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.get(), 60'000));
    EXPECT_FALSE(polar().isVisible());
    const auto labels = panel->findChildren<QLabel*>();
    EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->isVisible() && label->text().contains(QStringLiteral("No material"));
    }));
    keep("lens-no-material.png");
    empty.controller.newDocument();
    EXPECT_TRUE(eventually([&] { return polar().isVisible() && !panel->result().curves.empty(); }));
    panel.reset();
}

TEST_F(BrdfLensPanelTest, MapsCountByTheirMeanAndAPinnedPointByItself) {
    const Material& material =
        *session->controller.document().material(session->selection.material());
    ASSERT_TRUE(material.baseColorMap.assigned()) << "the start scene's ball has maps";
    const auto point = [&] { return panel->result().request.looks.front().point; };
    EXPECT_LT(point().perceptualRoughness, material.perceptualRoughness);
    EXPECT_TRUE(named<QLabel>("Looked at").text().contains(QStringLiteral("mean of its maps")));

    render::Inspection pin;
    pin.mesh = session->controller.document().meshes.front().id;
    pin.material = material.id;
    pin.values[shading::kViewBaseColor] = glm::vec4(0.25f, 0.5f, 0.75f, 1.0f);
    pin.values[shading::kViewMetallic] = glm::vec4(1.0f);
    pin.values[shading::kViewPerceptualRoughness] = glm::vec4(0.5f);
    session->probe.setPin(pin);
    ASSERT_TRUE(settled());
    EXPECT_EQ(point().baseColor, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_NEAR(scene().distribution.front().y, 5.09295817894f, 1e-4f);
    EXPECT_TRUE(named<QLabel>("Looked at").text().contains(QStringLiteral("pinned")));
    pin.material = material.id + 1000; // of another material
    session->probe.setPin(pin);
    ASSERT_TRUE(settled());
    EXPECT_NE(point().baseColor, glm::vec3(0.25f, 0.5f, 0.75f));
    session->probe.setPin(std::nullopt);
}

TEST_F(BrdfLensPanelTest, ItFitsWideAndTall) {
    for (const QSize size : {QSize(800, 260), QSize(356, 600)})
        for (const char* page : {"Show Lobe", "Show D G F", "Show Albedo"}) {
            panel->resize(size);
            press(page);
            ASSERT_TRUE(settled());
            test::handleEvents();
            int shown = 0;
            for (const QWidget* plotWidget : panel->findChildren<QWidget*>())
                if ((qobject_cast<const CurvePlot*>(plotWidget) ||
                     qobject_cast<const PolarPlot*>(plotWidget) ||
                     qobject_cast<const LobeView*>(plotWidget) ||
                     qobject_cast<const LitSphere*>(plotWidget)) &&
                    plotWidget->isVisible()) {
                    ++shown;
                    const QRect place(plotWidget->mapTo(panel.get(), QPoint()), plotWidget->size());
                    EXPECT_TRUE(panel->rect().contains(place)) << page << ' ' << size.width();
                    EXPECT_GE(place.height(), 130);
                    EXPECT_GE(place.width(), 145);
                }
            EXPECT_GE(shown, 1);
            keep(QStringLiteral("lens-%1-%2.png").arg(size.width()).arg(QLatin1String(page + 5)));
        }
    press("Show All");
    panel->resize(1400, 760);
    test::handleEvents();
    ASSERT_TRUE(settled());
    keep("lens-all.png");
}

TEST_F(BrdfLensPanelTest, NothingIsComputedForNobody) {
    panel->hide();
    const LensRequest before = panel->result().request;
    set("material.perceptualRoughness", 0.123f);
    QTest::qWait(100); // nothing to wait for: it shows that nothing comes
    EXPECT_EQ(panel->result().request, before);
    EXPECT_FALSE(panel->upToDate());
    panel->show();
    ASSERT_TRUE(settled());
    EXPECT_NE(panel->result().request, before);
}

// --- The lobe on the surface ---------------------------------------------------------------------

struct OnSurface : PlainMetal {
    void SetUp() override {
        PlainMetal::SetUp();
        m_light = session->controller.addLight(LightType::Directional);
        m_pin.mesh = session->controller.document().meshes.front().id;
        m_pin.material = session->selection.material();
        m_pin.values[shading::kRecordPosition] = glm::vec4(0.1f, 0.2f, 0.3f, 1.0f);
        m_pin.values[shading::kViewShadingNormal] = glm::vec4(0, 0, 1, 0);
        m_pin.values[shading::kViewTangent] = glm::vec4(0.6f, 0.8f, 0.1f, 0); // leans a little
        m_pin.values[shading::kViewBitangent] = glm::vec4(0.8f, -0.6f, 0, 0); // a mirrored map
        m_pin.values[shading::kViewBaseColor] = glm::vec4(1.0f);
        m_pin.values[shading::kViewMetallic] = glm::vec4(1.0f);
        m_pin.values[shading::kViewPerceptualRoughness] = glm::vec4(0.5f);
        m_pin.lights = {{m_light, glm::normalize(glm::vec3(1, 0, 1)), glm::vec3(1), 1.0f, {}, {}}};
        session->probe.setPin(m_pin);
        Camera camera = session->controller.document().view.camera;
        camera.target = glm::vec3(0);
        camera.pitchDeg = 30.0f;
        camera.yawDeg = 0.0f;
        session->controller.setCamera(camera);
    }
    void TearDown() override {
        session->probe.setPin(std::nullopt);
        PlainMetal::TearDown();
        EXPECT_EQ(lobe(), nullptr) << "it leaves with the lens";
        EXPECT_FALSE(session->probe.wanted()) << "nobody looks any more";
    }
    static std::shared_ptr<const render::SurfaceLobe> lobe() { return session->lobe.lobe(); }
    bool ready() {
        return eventually([] { return session->lobe.upToDate(); }) && settled();
    }
    void choose(int index) {
        auto& box = named<QComboBox>("Lobe on the surface");
        box.setFocus();
        while (box.currentIndex() != index)
            QTest::keyClick(&box, box.currentIndex() < index ? Qt::Key_Down : Qt::Key_Up);
    }

    Id m_light = 0;
    render::Inspection m_pin;
};

TEST_F(OnSurface, StandsInTheFrameOfThePinnedPoint) {
    EXPECT_EQ(lobe(), nullptr);
    EXPECT_FALSE(session->probe.wanted());
    choose(1); // the viewer
    EXPECT_TRUE(session->probe.wanted());
    ASSERT_TRUE(ready());
    ASSERT_NE(lobe(), nullptr);
    EXPECT_EQ(lobe()->end, LobeEnd::Viewer);
    EXPECT_EQ(lobe()->position, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(lobe()->normal, glm::vec3(0, 0, 1));
    EXPECT_NEAR(glm::dot(lobe()->tangent, glm::vec3(0.6f, 0.8f, 0)), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(lobe()->bitangent, glm::vec3(0.8f, -0.6f, 0)), 1.0f, 1e-5f);
    const glm::vec3 eye = session->controller.document().view.camera.position();
    EXPECT_NEAR(glm::dot(lobe()->toFixed, glm::normalize(eye - lobe()->position)), 1.0f, 1e-5f);

    // Its peak lies near the mirror direction, in the world.
    const auto peak = [&] {
        glm::vec3 farthest(0.0f);
        for (const glm::vec3& p : lobe()->mesh->positions)
            if (glm::length(p) > glm::length(farthest))
                farthest = p;
        return glm::normalize(farthest.x * lobe()->tangent + farthest.y * lobe()->bitangent +
                              farthest.z * lobe()->normal);
    };
    EXPECT_GT(glm::dot(peak(), glm::reflect(-lobe()->toFixed, lobe()->normal)), 0.95f);

    // Looked at from elsewhere it turns.
    Camera camera = session->controller.document().view.camera;
    camera.yawDeg = 40.0f;
    session->controller.setCamera(camera);
    ASSERT_TRUE(ready());
    EXPECT_LT(glm::dot(lobe()->toFixed, glm::normalize(eye - lobe()->position)), 0.9f);

    // What becomes of the light's.
    auto& box = named<QComboBox>("Lobe on the surface");
    choose(box.count() - 1);
    ASSERT_TRUE(ready());
    EXPECT_EQ(lobe()->end, LobeEnd::Light);
    EXPECT_GT(glm::dot(peak(), glm::normalize(glm::vec3(-1, 0, 1))), 0.95f);
    choose(0);
    EXPECT_EQ(lobe(), nullptr);
}

TEST_F(OnSurface, FollowsTheMaterialAndRestsWhenNothingChanges) {
    choose(1);
    ASSERT_TRUE(ready());
    const auto before = lobe();
    session->probe.setPin(m_pin); // another frame, the same answer
    ASSERT_TRUE(ready());
    EXPECT_EQ(lobe(), before) << "else every frame would ask for the next";
    m_pin.values[shading::kViewPerceptualRoughness] = glm::vec4(0.2f);
    session->probe.setPin(m_pin);
    ASSERT_TRUE(ready());
    EXPECT_NE(lobe(), before);
    const auto after = lobe();
    set("model.distribution", int(Distribution::Beckmann));
    ASSERT_TRUE(ready());
    EXPECT_NE(lobe(), after);
}

TEST_F(OnSurface, WhatCannotBeShownIsSaid) {
    const auto note = [&] { return named<QLabel>("Looked at").text(); };
    choose(1);
    ASSERT_TRUE(ready());
    session->probe.setPin(std::nullopt);
    EXPECT_EQ(lobe(), nullptr);
    EXPECT_TRUE(note().contains(QStringLiteral("Point at the model")));
    auto& box = named<QComboBox>("Lobe on the surface");
    choose(box.count() - 1);
    m_pin.lights[0].toLight = glm::vec3(0, 0, -1);
    session->probe.setPin(m_pin);
    EXPECT_EQ(lobe(), nullptr);
    EXPECT_TRUE(note().contains(QStringLiteral("behind the surface")));
    m_pin.lights.clear();
    session->probe.setPin(m_pin);
    EXPECT_TRUE(note().contains(QStringLiteral("The light is off")));
    session->controller.removeLight(m_light);
    EXPECT_EQ(box.currentIndex(), 0) << "a light that is gone is no choice";
    EXPECT_TRUE(session->lobe.problem().isEmpty());
}

// --- The ball ------------------------------------------------------------------------------------

TEST(SpherePicture, IsShadedAsTheViewportShades) {
    ShadingModel model;
    DfgTables tables;
    const BrdfLens lens(model, {glm::vec3(0.5f), 0.0f, 0.4f, 0.0f}, tables.of(model));
    SphereLight light;
    light.toLight = glm::normalize(glm::vec3(0.3f, 0.4f, 0.8f));
    const glm::vec3 n = glm::normalize(glm::vec3(-0.2f, 0.5f, 0.8f)), v(0.0f, 0.0f, 1.0f);
    // E N·L f_r, in the frame of the surface.
    glm::vec3 t, b;
    shading::orthonormalBasis(n, t, b);
    const auto local = [&](const glm::vec3& d) {
        return glm::vec3(glm::dot(d, t), glm::dot(d, b), glm::dot(d, n));
    };
    const glm::vec3 expected = 3.0f * glm::dot(n, light.toLight) *
                               lens.brdf(local(light.toLight), local(v), LensLobe::Both);
    EXPECT_NEAR(sphereRadiance(lens, light, n).g, expected.g, 1e-5f);

    // A uniform environment of radiance 2 and no light: 2 times the albedo of both lobes.
    light.illuminance = 0.0f;
    IblMaps maps{};
    for (int level = 0; level < 3; ++level)
        maps.prefiltered.push_back({16, std::vector<glm::vec3>(6 * 16 * 16, glm::vec3(2.0f))});
    maps.irradianceSh.fill(glm::vec3(0.0f));
    maps.irradianceSh[0] = glm::vec3(2.0f * shading::kPi / 0.282094792f); // Y00
    light.maps = std::make_shared<const IblMaps>(maps);
    const glm::vec3 share = lens.albedo(std::acos(glm::dot(n, v)), LensLobe::Both).multi;
    EXPECT_NEAR(sphereRadiance(lens, light, n).g, 2.0f * share.g, 1e-4f);
    light.exposureEv = 1.0f;
    EXPECT_NEAR(sphereRadiance(lens, light, n).g, 4.0f * share.g, 2e-4f);

    const QImage picture = spherePicture(lens, light, 64);
    EXPECT_EQ(qAlpha(picture.pixel(1, 1)), 0) << "around the ball is nothing";
    EXPECT_EQ(qAlpha(picture.pixel(32, 32)), 255);
}

} // namespace
} // namespace patina::editor
