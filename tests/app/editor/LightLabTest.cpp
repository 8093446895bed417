// The Light lab by real events: opened by its keys, followed while things are dragged, read.

#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/panel/LightLabPanel.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/light/DfgLookup.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Shading.h"

#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolButton>
#include <cmath>

namespace patina::editor {
namespace {

using testing::HasSubstr;

// A session with its panel and nothing that draws the scene.
struct LightLabTest : testing::Test {
    static void SetUpTestSuite() {
        s_cache = std::make_unique<QTemporaryDir>();
        s_session = std::make_unique<Session>();
        s_lights = std::make_unique<PreparedLights>(s_cache->path().toStdString());
        s_ibl = std::make_unique<IblUpdater>(s_session->tasks, *s_lights);
        QObject::connect(&controller(), &DocumentController::changed, s_ibl.get(),
                         [] { s_ibl->request(document().environment().image); });
        s_panel = std::make_unique<LightLabPanel>(controller(), *s_ibl, s_session->probe);
    }
    static void TearDownTestSuite() {
        s_panel.reset();
        s_ibl.reset();
        s_lights.reset();
        s_session.reset();
        s_cache.reset();
    }
    void SetUp() override {
        s_session->probe.setPin(std::nullopt);
        controller().newDocument();
        ASSERT_TRUE(settled(*s_session));
        panel().resize(780, 280);
        panel().show();
        panel().activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&panel(), 60'000));
        showSection("All");
        choose({LabKind::Environment, 0});
    }
    void TearDown() override { panel().hide(); }

    static DocumentController& controller() { return s_session->controller; }
    static const Document& document() { return controller().document(); }
    static int undoCount() { return controller().undoStack().count(); }
    static PixelProbe& probe() { return s_session->probe; }
    static LightLabPanel& panel() { return *s_panel; }
    static bool drawn() {
        return eventually([] {
            return panel().idle() && panel().light().lookup.analysis &&
                   panel().light().lookup.analysis->environment == document().environment().image &&
                   s_ibl->finished() && panel().light().lookup.maps == s_ibl->maps() &&
                   panel().dfg() && !panel().stage()->picture().isNull();
        });
    }
    static void showSection(const char* name) {
        QTest::mouseClick(find<QToolButton>(panel(), QStringLiteral("Show %1").arg(name)),
                          Qt::LeftButton);
        QApplication::processEvents();
        ASSERT_TRUE(drawn());
    }
    static void choose(LabView view) {
        LabPicture* picture = panel().picture(view);
        panel().findChild<QScrollArea*>()->ensureWidgetVisible(picture);
        QApplication::processEvents();
        QTest::mouseClick(picture, Qt::LeftButton, {}, picture->rect().center());
        ASSERT_TRUE(drawn());
    }
    static void hover(QWidget& widget, const QPointF& at) {
        QMouseEvent move(QEvent::MouseMove, at, widget.mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                         {});
        QApplication::sendEvent(&widget, &move);
    }
    static void set(std::string_view id, ParameterValue value) {
        const ParameterInfo& info = *findParameter(id);
        controller().setParameter(info, {info.scope, 0}, value);
    }
    static void keep(const QString& name, QWidget& widget) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (!target.isEmpty())
            widget.grab().save(target + QLatin1Char('/') + name);
    }
    static render::Inspection pixel(float NoV, float perceptualRoughness) {
        render::Inspection inspection;
        inspection.mesh = 1;
        const auto put = [&](int record, const glm::vec4& value) {
            inspection.values[static_cast<std::size_t>(record)] = value;
        };
        put(shading::kViewNoV, glm::vec4(NoV));
        put(shading::kViewPerceptualRoughness, glm::vec4(perceptualRoughness));
        put(shading::kViewShadingNormal, {0.0f, 0.6f, -0.8f, 0.0f});
        put(shading::kRecordLobeDirection, {1.2f, 0.0f, -1.6f, 0.0f}); // not normalised
        put(shading::kViewPrefilteredLevel, glm::vec4(2.1f));
        return inspection;
    }

    static std::unique_ptr<QTemporaryDir> s_cache;
    static std::unique_ptr<Session> s_session;
    static std::unique_ptr<PreparedLights> s_lights;
    static std::unique_ptr<IblUpdater> s_ibl;
    static std::unique_ptr<LightLabPanel> s_panel;
};

std::unique_ptr<QTemporaryDir> LightLabTest::s_cache;
std::unique_ptr<Session> LightLabTest::s_session;
std::unique_ptr<PreparedLights> LightLabTest::s_lights;
std::unique_ptr<IblUpdater> LightLabTest::s_ibl;
std::unique_ptr<LightLabPanel> LightLabTest::s_panel;

TEST_F(LightLabTest, ClickingEnlargesAndArrowKeysGoOn) {
    EXPECT_EQ(panel().stage()->view(), (LabView{LabKind::Environment, 0}));
    choose({LabKind::Harmonics, 3});
    EXPECT_EQ(panel().stage()->view(), (LabView{LabKind::Harmonics, 3}));
    EXPECT_EQ(panel().stage()->title(), QStringLiteral("3 bands"));
    EXPECT_GT(panel().stage()->picture().width(),
              2 * panel().picture({LabKind::Harmonics, 3})->picture().width());
    QWidget* focus = panel().picture({LabKind::Harmonics, 3});
    EXPECT_TRUE(focus->hasFocus());
    QTest::keyClick(focus, Qt::Key_Right);
    EXPECT_EQ(panel().stage()->view(), (LabView{LabKind::Harmonics, 4}));
    QTest::keyClick(panel().picture({LabKind::Harmonics, 4}), Qt::Key_Left);
    EXPECT_EQ(panel().stage()->view(), (LabView{LabKind::Harmonics, 3}));
    showSection("DFG");
    EXPECT_EQ(panel().stage()->view(), (LabView{LabKind::Dfg, 0})) << "of what is shown";
    EXPECT_FALSE(panel().picture({LabKind::Harmonics, 3})->isVisible());
    showSection("All");
    EXPECT_TRUE(panel().picture({LabKind::Harmonics, 3})->isVisible());
    EXPECT_EQ(undoCount(), 0) << "looking is no edit";
}

TEST_F(LightLabTest, ThePointerReadsDirectionAndLight) {
    set("environment.rotationDeg", 30.0f);
    choose({LabKind::Prefiltered, 3});
    LabPicture& stage = *panel().stage();
    const glm::vec3 d = glm::vec3(directionFromAngles(-60.0, 25.0));
    hover(stage, stage.position({d, 0, 0}));
    EXPECT_EQ(panel().readout().front(),
              QStringLiteral("azimuth −60.0°, elevation 25.0°  (−0.78  0.42  0.45)"));
    const glm::vec3 value = panel().light().value({LabKind::Prefiltered, 3}, d).value();
    EXPECT_THAT(panel().readout().back().toStdString(),
                HasSubstr(QString::number(static_cast<double>(value.x), 'g', 3).toStdString()));
    EXPECT_THAT(panel().readout().back().toStdString(), HasSubstr("luminance"));
    // The same direction on a cross, where it lies on another picture's face.
    choose({LabKind::Faces, 0});
    hover(stage, stage.position({{0.9f, 0.1f, -0.2f}, 0, 0}));
    EXPECT_THAT(panel().readout().front().toStdString(), HasSubstr("0.97  0.11  −0.22"));
    hover(stage, stage.pictureArea().topLeft() + QPointF(3, 3));
    EXPECT_THAT(panel().readout().front().toStdString(), HasSubstr("Point at")) << "beside it";
    choose({LabKind::Dfg, 0});
    const QRectF area = stage.pictureArea();
    hover(stage, {area.left() + 0.25 * area.width(), area.bottom() - 0.75 * area.height()});
    EXPECT_THAT(panel().readout().front().toStdString(),
                HasSubstr("N·V 0.250, perceptual roughness 0.750"));
    const double scale = static_cast<double>(lookUpDfg(panel().dfg()->table, 0.25f, 0.75f).x);
    EXPECT_THAT(panel().readout().back().toStdString(),
                HasSubstr(QString::number(scale, 'f', 4).left(5).toStdString()));
}

TEST_F(LightLabTest, AFaceOfTheCrossOpensAndCloses) {
    choose({LabKind::Faces, 0});
    LabPicture& stage = *panel().stage();
    const auto click = [&](const glm::vec3& direction) {
        QTest::mouseClick(&stage, Qt::LeftButton, {}, stage.position({direction, 0, 0}).toPoint());
    };
    const struct {
        glm::vec3 direction;
        const char* name;
    } faces[] = {{{1, 0, 0}, "+X"},  {{-1, 0, 0}, "−X"}, {{0, 1, 0}, "+Y"},
                 {{0, -1, 0}, "−Y"}, {{0, 0, 1}, "+Z"},  {{0, 0, -1}, "−Z"}};
    for (int i = 0; i < 6; ++i) {
        click(faces[i].direction);
        EXPECT_EQ(stage.view(), (LabView{LabKind::Faces, i + 1}));
        EXPECT_EQ(stage.title(), QStringLiteral("Face %1").arg(QString::fromUtf8(faces[i].name)));
        // It shows that direction in its middle, and another face's nowhere.
        const QPointF middle = stage.pictureArea().center();
        EXPECT_LT(QLineF(stage.position({faces[i].direction, 0, 0}), middle).length(), 0.5);
        EXPECT_GT(glm::dot(stage.place(middle)->direction, faces[i].direction), 0.9999f);
        EXPECT_FALSE(stage.pictureArea().contains(stage.position({-faces[i].direction, 0, 0})));
        ASSERT_TRUE(drawn());
        const QColor shown = stage.colorAt({faces[i].direction, 0, 0});
        const QColor expected(
            LabTone(document().view, {}, 0.0f)
                .pixel(panel().light().value(stage.view(), faces[i].direction).value()));
        EXPECT_NEAR(shown.green(), expected.green(), 6) << faces[i].name;
        click(faces[i].direction);
        EXPECT_EQ(stage.view(), (LabView{LabKind::Faces, 0}));
    }
    keep(QStringLiteral("light-lab-faces.png"), panel());
}

TEST_F(LightLabTest, FollowsWhileTheEnvironmentIsDragged) {
    LabPicture& picture = *panel().picture({LabKind::Environment, 0});
    QImage last = picture.picture();
    const QString error = panel().picture({LabKind::Harmonics, 8})->detail();
    const DragSession drag = controller().newDragSession();
    for (int step = 1; step <= 3; ++step) {
        controller().setParameter(*findParameter("environment.rotationDeg"),
                                  {Scope::Environment, 0}, 5.0f * static_cast<float>(step), drag);
        ASSERT_TRUE(eventually([&] { return picture.picture() != last; }))
            << "pictures come during the drag";
        last = picture.picture();
    }
    ASSERT_TRUE(drawn());
    EXPECT_EQ(undoCount(), 1);
    EXPECT_EQ(panel().light().lookup.orientation.rotationDeg, document().environment().rotationDeg);
    EXPECT_EQ(picture.picture(), labPicture(panel().light(), picture.view(), picture.pictureSize(),
                                            LabTone(document().view, {}, 0.0f), {}));
    EXPECT_EQ(panel().picture({LabKind::Harmonics, 8})->detail(), error)
        << "turning loses nothing of the light";
}

TEST_F(LightLabTest, FollowsTheSunOfASky) {
    controller().setEnvironmentKind(EnvironmentKind::Sky);
    ASSERT_TRUE(drawn());
    const EnvironmentAnalysisPtr noon = panel().light().lookup.analysis;
    set("environment.skySunElevationDeg", 5.0f);
    ASSERT_TRUE(eventually([&] {
        return panel().light().lookup.analysis != noon && panel().light().lookup.analysis &&
               panel().light().lookup.analysis->environment == document().environment().image;
    }));
    ASSERT_TRUE(drawn());
    EXPECT_THAT(panel().picture({LabKind::Harmonics, 8})->warning().toStdString(),
                HasSubstr("lowest −"))
        << "a sun makes the sums overshoot";
    ASSERT_TRUE(panel().picture({LabKind::Harmonics, 8})->lowest().has_value());
    // The mark is where the sum is lowest.
    const glm::vec3 at = *panel().picture({LabKind::Harmonics, 8})->lowest();
    const float lowest = panel().light().value({LabKind::Harmonics, 8}, at).value().x;
    EXPECT_LT(std::min(lowest, panel().light().value({LabKind::Harmonics, 8}, at).value().z), 0.0f);
}

TEST_F(LightLabTest, ExposureIsOfThePicturesOnly) {
    LabPicture& picture = *panel().picture({LabKind::Irradiance, 0});
    panel().findChild<QScrollArea*>()->ensureWidgetVisible(&picture);
    ASSERT_TRUE(drawn());
    const auto brightness = [&] {
        return picture.picture().pixelColor(picture.picture().width() / 2, 3).lightness();
    };
    const int normal = brightness();
    auto* slider = panel().findChild<Slider*>();
    QTest::mousePress(slider, Qt::LeftButton, {}, {slider->handleX(), 12});
    QTest::mouseMove(slider, {slider->handleX() - 40, 12});
    QTest::mouseRelease(slider, Qt::LeftButton, {}, {slider->handleX(), 12});
    auto* field = find<NumberField>(panel(), QStringLiteral("Light lab exposure"));
    EXPECT_LT(field->value(), -0.5);
    ASSERT_TRUE(eventually([&] { return panel().idle() && brightness() < normal - 10; }))
        << normal << " before, " << brightness() << " at " << field->value() << " EV";
    EXPECT_EQ(undoCount(), 0);
    EXPECT_FALSE(controller().isModified());
    // The viewport's exposure is followed.
    const int darker = brightness();
    set("view.exposureEv", 3.0f);
    ASSERT_TRUE(eventually([&] { return panel().idle() && brightness() > darker + 10; }));
    QTest::mouseClick(field, Qt::LeftButton);
    QTest::keyClicks(field, QStringLiteral("0"));
    QTest::keyClick(field, Qt::Key_Return);
}

TEST_F(LightLabTest, ThePickedPixelIsMarkedWhereItsLightComesFrom) {
    choose({LabKind::Dfg, 1});
    probe().setPin(pixel(0.62f, 0.35f));
    LabPicture& stage = *panel().stage();
    ASSERT_TRUE(stage.picked().has_value());
    EXPECT_FLOAT_EQ(stage.picked()->NoV, 0.62f);
    EXPECT_FLOAT_EQ(stage.picked()->perceptualRoughness, 0.35f);
    const QRectF area = stage.pictureArea();
    const QPointF at = stage.position(*stage.picked());
    EXPECT_NEAR((at.x() - area.left()) / area.width(), 0.62, 1e-6);
    EXPECT_NEAR((area.bottom() - at.y()) / area.height(), 0.35, 1e-6) << "roughness grows upwards";
    const QString bias = QString::number(
        static_cast<double>(lookUpDfg(panel().dfg()->table, 0.62f, 0.35f).y), 'g', 3);
    EXPECT_EQ(stage.pickedLabel(), QStringLiteral("(0.620, 0.350) = %1").arg(bias));
    EXPECT_EQ(panel().picture({LabKind::Dfg, 1})->detail(), bias);
    keep(QStringLiteral("light-lab-picked.png"), panel());

    // Reflections come from the lobe's direction, irradiance from around the normal.
    const auto picked = [](LabKind kind, int index) {
        return panel().picture({kind, index})->picked();
    };
    EXPECT_LT(glm::distance(picked(LabKind::Prefiltered, 2)->direction, {0.6f, 0.0f, -0.8f}),
              1e-6f);
    EXPECT_LT(glm::distance(picked(LabKind::Environment, 0)->direction, {0.6f, 0.0f, -0.8f}),
              1e-6f);
    EXPECT_LT(glm::distance(picked(LabKind::Irradiance, 0)->direction, {0.0f, 0.6f, -0.8f}), 1e-6f);
    EXPECT_FALSE(picked(LabKind::Harmonics, 3));
    choose({LabKind::Prefiltered, 2});
    EXPECT_EQ(stage.pickedLabel(), QStringLiteral("picked: roughness 0.35"));

    // A new pixel moves it, the background takes it away.
    probe().setPin(pixel(0.1f, 0.9f));
    EXPECT_FLOAT_EQ(panel().picture({LabKind::Dfg, 0})->picked()->NoV, 0.1f);
    probe().setPin(render::Inspection{});
    EXPECT_FALSE(panel().picture({LabKind::Dfg, 0})->picked());
}

TEST_F(LightLabTest, TheTableIsTheModels) {
    showSection("DFG");
    const QImage before = panel().picture({LabKind::Dfg, 0})->picture();
    const glm::vec3 ggx = lookUpDfg(panel().dfg()->table, 0.3f, 0.8f);
    set("model.distribution", static_cast<int>(Distribution::BlinnPhong));
    ASSERT_TRUE(eventually([&] {
        return panel().idle() && panel().picture({LabKind::Dfg, 0})->picture() != before;
    }));
    const glm::dvec3 exact =
        integrateDfg(0.3f, 0.8f, Distribution::BlinnPhong, Visibility::SmithCorrelated);
    EXPECT_NEAR(lookUpDfg(panel().dfg()->table, 0.3f, 0.8f).x, exact.x, 3e-3);
    EXPECT_GT(glm::distance(lookUpDfg(panel().dfg()->table, 0.3f, 0.8f), ggx), 1e-3f);
}

TEST_F(LightLabTest, APictureOfOnePixel) {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("one.hdr"));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x80"); // 1/2
    file.close();
    const EnvironmentAnalysisPtr before = panel().light().lookup.analysis;
    controller().setEnvironment(path);
    ASSERT_TRUE(settled(*s_session));
    ASSERT_TRUE(eventually([&] { return panel().light().lookup.analysis != before; }));
    ASSERT_TRUE(drawn());
    for (const LabView view : {LabView{LabKind::Harmonics, 8}, LabView{LabKind::Prefiltered, 3}})
        EXPECT_NEAR(panel().light().value(view, {0, 1, 0})->x, 0.5f, 1e-5f);
    EXPECT_EQ(panel().picture({LabKind::Harmonics, 8})->warning(), QString());
}

struct LightLabWindowTest : EditorTest {
    static LightLabPanel& panel() { return *window->findChild<LightLabPanel*>(); }
    static void pressKeys() {
        // Shortcuts belong to the active window; without a window manager nobody else activates it.
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 60'000));
        QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
    }
};

TEST_F(LightLabWindowTest, OpensByItsKeysAtAUsefulHeight) {
    window->resize(1440, 900);
    window->resetLayout();
    ASSERT_FALSE(panel().isVisible());
    EXPECT_EQ(panel().light().lookup.analysis, nullptr) << "nothing is computed for nobody";
    EXPECT_FALSE(session->probe.wanted());
    pressKeys();
    ASSERT_TRUE(eventually([] { return panel().isVisible(); }));
    EXPECT_TRUE(window->actions().lightLab->isChecked());
    EXPECT_TRUE(session->probe.wanted());
    auto* dock = window->findChild<QDockWidget*>(QStringLiteral("lightLab"));
    ASSERT_TRUE(eventually([&] { return dock->height() >= 240; }));
    EXPECT_GE(window->viewport().height(), 300) << "the viewport stays usable";
    ASSERT_TRUE(eventually([] { return panel().idle() && panel().light().lookup.maps; }));
    EXPECT_EQ(panel().light().lookup.maps, session->ibl.maps()) << "the viewport's own";

    // Behind another tab the keys bring it to the front; in front they close it.
    auto* log = window->findChild<QDockWidget*>(QStringLiteral("log"));
    log->show();
    QApplication::processEvents(); // it becomes a tab
    log->raise();
    ASSERT_TRUE(eventually([] { return !window->actions().lightLab->isChecked(); }));
    EXPECT_FALSE(session->probe.wanted());
    const float before = panel().light().lookup.orientation.rotationDeg;
    controller().setParameter(*findParameter("environment.rotationDeg"), {Scope::Environment, 0},
                              50.0f);
    EXPECT_EQ(panel().light().lookup.orientation.rotationDeg, before) << "nobody sees it";
    controller().undoStack().undo();
    controller().undoStack().clear();
    pressKeys();
    ASSERT_TRUE(eventually([] { return window->actions().lightLab->isChecked(); }));
    EXPECT_TRUE(session->probe.wanted());
    pressKeys();
    EXPECT_FALSE(panel().isVisible());
    EXPECT_FALSE(window->actions().lightLab->isChecked());
    EXPECT_EQ(undoCount(), 0);
}

TEST(LightLabWithoutADocument, SaysThatThereIsNoEnvironment) {
    Session session;
    const QTemporaryDir folder;
    PreparedLights lights(folder.path().toStdString());
    IblUpdater ibl(session.tasks, lights);
    LightLabPanel panel(session.controller, ibl, session.probe);
    panel.resize(700, 260);
    panel.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel, 60'000));
    ASSERT_EQ(session.controller.document().environment().image, nullptr);
    ASSERT_TRUE(eventually([&] { return panel.idle() && panel.dfg(); }));
    EXPECT_THAT(panel.stage()->accessibleDescription().toStdString(),
                HasSubstr("There is no environment."));
    EXPECT_TRUE(panel.picture({LabKind::Harmonics, 3})->picture().isNull());
    EXPECT_FALSE(panel.picture({LabKind::Dfg, 0})->picture().isNull()) << "it needs none";
    EXPECT_TRUE(session.probe.wanted());
    panel.hide();
    EXPECT_FALSE(session.probe.wanted());
}

// As a low, wide dock and as a high, narrow one.
TEST_F(LightLabTest, ReflowsWithItsShape) {
    for (const QSize size : {QSize(800, 260), QSize(356, 600), QSize(1200, 800), QSize(320, 220)}) {
        panel().resize(size);
        test::handleEvents();
        ASSERT_TRUE(drawn());
        const auto* scroll = panel().findChild<QScrollArea*>();
        const int available = scroll->viewport()->width();
        for (const LabPicture* picture : panel().findChildren<LabPicture*>()) {
            if (picture == panel().stage())
                continue;
            EXPECT_GE(picture->mapTo(scroll->widget(), QPoint(0, 0)).x(), 0);
            EXPECT_LE(picture->mapTo(scroll->widget(), picture->rect().topRight()).x(), available);
            EXPECT_GE(picture->width(), 100);
        }
        // The large picture is larger than the small ones, and neither covers the other.
        const QRect stage = panel().stage()->geometry().translated(
            panel().stage()->parentWidget()->mapTo(&panel(), QPoint(0, 0)));
        EXPECT_FALSE(stage.intersects(scroll->geometry()));
        EXPECT_TRUE(panel().rect().contains(stage)) << size.width();
        EXPECT_GE(panel().stage()->pictureArea().width(), 90) << size.width();
        EXPECT_GE(scroll->height(), 60) << size.width();
        keep(QStringLiteral("light-lab-%1.png").arg(size.width()), panel());
    }
}

} // namespace
} // namespace patina::editor
