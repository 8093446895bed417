// The Camera dock and the viewport: operators chosen by the mouse, the eye watched while it adapts,
// OpenColorIO by drop, with configurations good and bad.

#include "core/document/ViewChoices.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/panel/ViewPanel.h"
#include "app/editor/widget/NoticeArea.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/ToneCurvePlot.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QToolButton>
#include <cmath>

namespace patina::editor {
namespace {

using testing::HasSubstr;

constexpr const char* kConfig = R"(ocio_profile_version: 1
strictparsing: false
roles: {scene_linear: light, default: light}
displays:
  Monitor:
    - !<View> {name: Soft, colorspace: soft}
    - !<View> {name: Raw, colorspace: light}
  Projector:
    - !<View> {name: Raw, colorspace: light}
colorspaces:
  - !<ColorSpace> {name: light}
  - !<ColorSpace>
    name: soft
    from_reference: !<ExponentTransform> {value: [0.5, 0.5, 0.5, 1]}
)";

struct ViewPanelTest : EditorTest {
    void SetUp() override {
        ::unsetenv("OCIO");
        EditorTest::SetUp();
        window->viewport().setFixedSize(320, 240); // software OpenGL pays for each pixel
        auto* dock = window->findChild<QDockWidget*>(QStringLiteral("view"));
        dock->raise();
        ASSERT_TRUE(eventually([&] { return panel().isVisible() && !frame().isNull(); }));
    }
    static ViewPanel& panel() { return *window->findChild<ViewPanel*>(); }
    static ToneCurvePlot& plot() { return *panel().plot(); }
    static const View& view() { return document().view; }
    static ParameterRow& row(std::string_view id) {
        return *panel().findChild<ParameterList*>()->row(id);
    }
    static QStringList items(const QComboBox& box) {
        QStringList texts;
        for (int i = 0; i < box.count(); ++i)
            texts << box.itemText(i);
        return texts;
    }
    // Walks to the item with the arrow keys.
    static void choose(QComboBox& box, const QString& text) {
        const int index = box.findText(text);
        ASSERT_GE(index, 0) << text.toStdString() << " in " << items(box).join(',').toStdString();
        box.setFocus();
        for (int steps = 0; box.currentIndex() != index && steps < box.count(); ++steps)
            QTest::keyClick(&box, box.currentIndex() < index ? Qt::Key_Down : Qt::Key_Up);
        ASSERT_EQ(box.currentText(), text);
    }
    static void chooseToneMap(const QString& label) {
        choose(*row("view.toneMap").findChild<QComboBox*>(), label);
    }
    static QString text(const char* name) {
        return find<QLabel>(panel(), QLatin1String(name))->text();
    }
    static void drop(const QString& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        QDragEnterEvent enter({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event(QPointF(5, 5), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
    }
    QString write(const QString& name, const char* content) {
        const QString path = folder.filePath(name);
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        file.write(content);
        return path;
    }
    static QImage frame() { return window->viewport().grabFramebuffer(); }
    // The smooth background above the model, which shows the same at any resolution.
    static double shown() {
        const QImage image = frame();
        return image.pixelColor(image.width() / 2, 12).greenF();
    }
    static QString notices() {
        QStringList texts;
        for (const QLabel* label : window->notices().findChildren<QLabel*>())
            texts << label->text();
        return texts.join('\n');
    }
    static void keep(const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        test::handleEvents(); // rows come and go with a layout of their own
        if (!target.isEmpty())
            window->grab().save(target + QLatin1Char('/') + name);
    }
};

TEST_F(ViewPanelTest, EveryOperatorIsOneClickAway) {
    QComboBox& box = *row("view.toneMap").findChild<QComboBox*>();
    EXPECT_EQ(box.currentText(), QStringLiteral("PBR Neutral (Khronos)"));
    EXPECT_EQ(box.count(), 7) << "no OpenColorIO without a configuration";
    std::set<std::string> pictures;
    for (const QString& label : items(box)) {
        chooseToneMap(label);
        EXPECT_EQ(box.currentText(), label);
        const QImage bits = frame();
        pictures.insert(std::string(reinterpret_cast<const char*>(bits.constBits()),
                                    static_cast<std::size_t>(bits.sizeInBytes())));
        // The plot is the operator's curve: the same formula that the shader runs.
        if (view().toneMap == ToneMap::ReinhardPhotographic)
            continue; // depends on the picture
        for (const float stops : {-3.0f, 0.0f, 1.5f})
            EXPECT_NEAR(plot().valueAt(static_cast<double>(stops)),
                        displayedGrey(view(), Luminance{}, 0.18f * std::exp2(stops)), 2e-3)
                << label.toStdString();
    }
    EXPECT_EQ(pictures.size(), 7u) << "each operator shows another picture";
    EXPECT_EQ(view().toneMap, ToneMap::AgX);
    while (undoCount() > 0 && controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(view().toneMap, ToneMap::PbrNeutral);
    EXPECT_EQ(box.currentText(), QStringLiteral("PBR Neutral (Khronos)"));
}

TEST_F(ViewPanelTest, RowsShowWhereTheyApply) {
    const auto hidden = [](std::string_view id) { return row(id).isHidden(); };
    for (const char* id : {"view.reinhardKey", "view.reinhardAutoKey", "view.reinhardWhite",
                           "view.exponentialK", "view.displayGamma"})
        EXPECT_TRUE(hidden(id)) << id;
    EXPECT_FALSE(hidden("view.displayTransfer"));
    chooseToneMap(QStringLiteral("Reinhard, photographic"));
    EXPECT_FALSE(hidden("view.reinhardKey"));
    EXPECT_FALSE(hidden("view.reinhardWhite"));
    QTest::mouseClick(row("view.reinhardAutoKey").findChild<QCheckBox*>(), Qt::LeftButton, {},
                      {8, 12});
    EXPECT_TRUE(view().reinhardAutoKey);
    EXPECT_FALSE(hidden("view.reinhardKey")) << "rows keep their place";
    EXPECT_FALSE(row("view.reinhardKey").isEnabled()) << "found by itself";
    chooseToneMap(QStringLiteral("Exponential"));
    EXPECT_FALSE(hidden("view.exponentialK"));
    EXPECT_TRUE(hidden("view.reinhardWhite"));
    choose(*row("view.displayTransfer").findChild<QComboBox*>(), QStringLiteral("Gamma"));
    EXPECT_FALSE(hidden("view.displayGamma"));
    const double before = plot().valueAt(0.0);
    controller().setParameter(*findParameter("view.displayGamma"), {Scope::View, 0}, 3.0f);
    EXPECT_GT(plot().valueAt(0.0), before + 0.05) << "the plot follows the parameters";
}

// The eye goes on by itself while there is something to get used to, and then the window rests.
TEST_F(ViewPanelTest, TheEyeAdaptsAndThenTheViewportRests) {
    choose(*row("view.exposureMode").findChild<QComboBox*>(), QStringLiteral("Automatic"));
    ASSERT_TRUE(eventually([] { return plot().average().has_value(); }));
    ASSERT_TRUE(eventually([] { return std::abs(*plot().average()) < 0.01; }))
        << "the average becomes middle grey: " << *plot().average();

    std::vector<Luminance> seen;
    const auto watching =
        QObject::connect(&window->viewport(), &ViewportWidget::luminanceMeasured,
                         [&](const Luminance& luminance) { seen.push_back(luminance); });
    QElapsedTimer clock;
    clock.start();
    controller().setParameter(*findParameter("environment.exposureEv"), {Scope::Environment, 0},
                              3.0f);
    ASSERT_TRUE(eventually([&] { return seen.size() > 1 && !seen.back().adapting(); }));
    const double seconds = static_cast<double>(clock.elapsed()) * 1e-3;
    QObject::disconnect(watching);
    keep(QStringLiteral("adapted.png"));

    // At first dazzled, then closer with each frame, from whichever side: a finer picture may be
    // darker. How dazzled it is when first looked at depends on how long a frame takes here.
    float dazzled = 0.0f;
    for (const Luminance& luminance : seen)
        dazzled = std::max(dazzled, luminance.logAverage / luminance.adapted);
    EXPECT_GT(dazzled, 1.1f) << "the way there is seen";
    for (std::size_t i = 1; i < seen.size(); ++i)
        if (seen[i].logAverage == seen[i - 1].logAverage) {
            const float average = seen[i].logAverage;
            EXPECT_LE(std::abs(seen[i].adapted - average),
                      std::abs(seen[i - 1].adapted - average) + 1e-6f);
        }
    EXPECT_GT(seconds, 2.0) << "ln(8 · 512 / ln 2) · 0.825 s is what the way takes";
    EXPECT_NEAR(*plot().average(), 0.0, 0.02);
    EXPECT_THAT(text("Exposure").toStdString(), HasSubstr("EV"));
    EXPECT_NE(text("Adapted to"), QStringLiteral("–"));

    // Then nothing is drawn any more.
    int frames = 0;
    QObject here;
    QObject::connect(&window->viewport(), &ViewportWidget::frameRendered, &here, [&] { ++frames; });
    EXPECT_TRUE(eventually([&] {
        if (!window->viewport().isSettled())
            return false;
        frames = 0;
        QTest::qWait(300); // nothing to wait for: it shows that nothing comes
        return frames == 0;
    }));
}

TEST_F(ViewPanelTest, OpenColorIoByDrop) {
    drop(write(QStringLiteral("studio.ocio"), kConfig));
    EXPECT_EQ(view().toneMap, ToneMap::OpenColorIo);
    EXPECT_EQ(undoCount(), 1) << "one step";
    ASSERT_TRUE(eventually([] { return session->displays.transform() != nullptr; }));
    EXPECT_EQ(row("view.toneMap").findChild<QComboBox*>()->currentText(),
              QStringLiteral("OpenColorIO"));
    EXPECT_TRUE(row("view.displayTransfer").isHidden()) << "the view brings its own";
    auto& display = *find<QComboBox>(panel(), QStringLiteral("OpenColorIO display"));
    auto& choice = *find<QComboBox>(panel(), QStringLiteral("OpenColorIO view"));
    EXPECT_EQ(items(display),
              (QStringList{QStringLiteral("Monitor"), QStringLiteral("Projector")}));
    EXPECT_EQ(items(choice), (QStringList{QStringLiteral("Soft"), QStringLiteral("Raw")}));
    EXPECT_EQ(choice.currentText(), QStringLiteral("Soft"));
    EXPECT_NEAR(plot().valueAt(0.0), std::sqrt(0.18), 2e-3);
    const double soft = shown();
    keep(QStringLiteral("opencolorio.png"));

    choose(choice, QStringLiteral("Raw"));
    EXPECT_EQ(view().ocioView, "Raw");
    ASSERT_TRUE(eventually([] { return session->displays.transform()->view == "Raw"; }));
    ASSERT_TRUE(eventually([&] { return std::abs(shown() - soft) > 0.05; }));
    EXPECT_NEAR(plot().valueAt(0.0), 0.18, 2e-3);
    EXPECT_NEAR(shown(), soft * soft, 0.02) << "without the square root";

    choose(display, QStringLiteral("Projector"));
    EXPECT_EQ(items(choice), (QStringList{QStringLiteral("Raw")}));
    EXPECT_EQ(view().ocioView, "");

    // Away with it.
    QTest::mouseClick(
        find<QToolButton>(panel(), QStringLiteral("Leave the OpenColorIO configuration")),
        Qt::LeftButton);
    EXPECT_EQ(view().toneMap, ToneMap::PbrNeutral);
    EXPECT_EQ(row("view.toneMap").findChild<QComboBox*>()->count(), 7);
}

TEST_F(ViewPanelTest, ABrokenConfigurationIsSaidAloudAndReplaced) {
    const double before = shown();
    drop(write(QStringLiteral("broken.ocio"), "this is a shopping list"));
    ASSERT_TRUE(eventually([] { return !session->displays.problem().isEmpty(); }));
    EXPECT_THAT(notices().toStdString(), HasSubstr("broken.ocio"));
    EXPECT_THAT(notices().toStdString(), HasSubstr("PBR Neutral is shown meanwhile"));
    EXPECT_NEAR(shown(), before, 0.01);
    const auto labels = panel().findChildren<QLabel*>();
    EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->isVisibleTo(&panel()) && label->text() == session->displays.problem();
    }));
    keep(QStringLiteral("opencolorio-broken.png"));
    controller().undoStack().undo();
    EXPECT_EQ(view().toneMap, ToneMap::PbrNeutral);
    EXPECT_TRUE(session->displays.problem().isEmpty());
    EXPECT_NEAR(shown(), before, 0.01);
}

TEST_F(ViewPanelTest, TheEnvironmentVariableOffersTheChoice) {
    const QString config = write(QStringLiteral("site.ocio"), kConfig);
    ::setenv("OCIO", config.toLocal8Bit().constData(), 1);
    controller().newDocument(); // the panel looks again
    ASSERT_TRUE(settled(*session));
    chooseToneMap(QStringLiteral("OpenColorIO"));
    ASSERT_TRUE(eventually([] { return session->displays.transform() != nullptr; }));
    EXPECT_EQ(view().ocioConfig, "");
    ::unsetenv("OCIO");
}

TEST_F(ViewPanelTest, ThePlotIsReadable) {
    // 0 EV lies in the middle, the curve inside of its frame.
    const QRectF frame = QRectF(plot().rect());
    EXPECT_NEAR(plot().position(0, 0).x(),
                (plot().position(-8, 0).x() + plot().position(8, 0).x()) / 2, 0.5);
    EXPECT_TRUE(frame.contains(plot().position(-8, 0)));
    EXPECT_TRUE(frame.contains(plot().position(8, 1)));
    EXPECT_GT(plot().position(0, 0).y(), plot().position(0, 1).y());
    EXPECT_GT(plot().position(8, 0).x() - plot().position(-8, 0).x(), 150);
    ASSERT_TRUE(eventually([] { return plot().average().has_value(); }));
    // The curve is there in colour where it should be.
    const QPoint on = plot().position(0.0, plot().valueAt(0.0)).toPoint();
    const QImage image = plot().grab().toImage();
    const double ratio = image.devicePixelRatio();
    const QColor color = image.pixelColor((QPointF(on) * ratio).toPoint());
    EXPECT_GT(color.green(), color.red() + 30);
}

} // namespace
} // namespace patina::editor
