// The light mixer as the user handles it: real mouse and key events, and what they do to the
// document.
#include "app/editor/panel/MixerPanel.h"
#include "app/editor/Session.h"
#include "app/editor/widget/Fader.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/mix/LightMix.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"
#include "tests/support/SecondEnvironment.h"

#include <QLabel>
#include <QMenu>
#include <QTest>
#include <QToolButton>
#include <cmath>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

struct MixerPanelTest : ::testing::Test {
    void SetUp() override {
        controller().newDocument();
        ASSERT_TRUE(eventually([this] { return !controller().tasks().busy(); }));
        light = controller().addLight(LightType::Directional);
        controller().rename({Scope::Light, light}, QStringLiteral("Sun"));
        panel.resize(800, 300);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel, 60'000));
    }
    DocumentController& controller() { return session.controller; }
    const Document& document() { return controller().document(); }
    const Light& sun() { return *document().light(light); }
    template <class Widget>
    Widget& named(const QString& name) {
        for (Widget* widget : panel.findChildren<Widget*>())
            if (widget->accessibleName() == name)
                return *widget;
        ADD_FAILURE() << name.toStdString();
        std::abort();
    }
    Fader& fader(const char* name) { return named<Fader>(tr("Gain of %1").arg(name)); }
    QString level(const char* name) { return named<QLabel>(tr("Level of %1").arg(name)).text(); }
    void press(const QString& name) {
        QTest::mouseClick(&named<QToolButton>(name), Qt::LeftButton);
    }
    static QString tr(const char* text) { return QString::fromUtf8(text); }
    void addSecond() {
        controller().addEnvironment(QStringLiteral("builtin:sunset"),
                                    DocumentController::EnvironmentUse::FadeTo);
        ASSERT_TRUE(eventually([this] { return !controller().tasks().busy(); }));
        ASSERT_NE(document().secondEnvironment(), nullptr);
        ASSERT_NE(document().secondEnvironment()->image, nullptr);
    }
    void keep(const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        test::handleEvents();
        if (!target.isEmpty())
            panel.grab().save(target + QLatin1Char('/') + name);
    }

    Session session;
    MixerPanel panel{session.controller};
    Id light = 0;
};

TEST_F(MixerPanelTest, ADragOfAFaderIsOneUndoStep) {
    Fader& gain = fader("Sun");
    const int steps = controller().undoStack().count();
    const QPoint from = gain.handle();
    QTest::mousePress(&gain, Qt::LeftButton, {}, from);
    QTest::mouseMove(&gain, from - QPoint(0, 8));
    QTest::mouseMove(&gain, from - QPoint(0, 20));
    QTest::mouseRelease(&gain, Qt::LeftButton, {}, from - QPoint(0, 20));
    EXPECT_GT(sun().gainEv, 0.5f);
    EXPECT_LE(sun().gainEv, 6.0f);
    EXPECT_EQ(controller().undoStack().count(), steps + 1);
    EXPECT_EQ(gain.handle().x(), from.x());
    EXPECT_NEAR(gain.handle().y(), from.y() - 20, 1) << "steps of the gain are no whole pixels";
    controller().undoStack().undo();
    EXPECT_EQ(sun().gainEv, 0.0f);
    EXPECT_EQ(gain.handle(), from);
    // There and back is exactly where it was.
    QTest::mousePress(&gain, Qt::LeftButton, {}, from);
    QTest::mouseMove(&gain, from + QPoint(0, 30));
    QTest::mouseMove(&gain, from);
    QTest::mouseRelease(&gain, Qt::LeftButton, {}, from);
    EXPECT_EQ(sun().gainEv, 0.0f);
}

TEST_F(MixerPanelTest, FadersGoByKeys) {
    Fader& gain = fader("Sun");
    gain.setFocus();
    const int steps = controller().undoStack().count();
    QTest::keyClick(&gain, Qt::Key_Up);
    EXPECT_FLOAT_EQ(sun().gainEv, 0.1f);
    QTest::keyClick(&gain, Qt::Key_PageDown);
    EXPECT_FLOAT_EQ(sun().gainEv, -0.9f);
    QTest::keyClick(&gain, Qt::Key_Down);
    EXPECT_FLOAT_EQ(sun().gainEv, -1.0f);
    EXPECT_EQ(controller().undoStack().count(), steps + 1); // quick steps are one
    EXPECT_EQ(level("Sun"), tr("1.5 lx"));                  // of 3
    QTest::keyClick(&gain, Qt::Key_Home);
    EXPECT_EQ(sun().gainEv, 0.0f);
    EXPECT_EQ(level("Sun"), tr("3 lx"));
    for (int i = 0; i < 8; ++i)
        QTest::keyClick(&gain, Qt::Key_PageUp);
    EXPECT_FLOAT_EQ(sun().gainEv, 6.0f); // the end of the scale
    // Every control is reached by the keyboard and says what it is.
    for (const QWidget* widget : panel.findChildren<QWidget*>())
        if (qobject_cast<const Fader*>(widget) || qobject_cast<const QToolButton*>(widget) ||
            qobject_cast<const NumberField*>(widget)) {
            EXPECT_NE(widget->focusPolicy() & Qt::TabFocus, 0);
            EXPECT_FALSE(widget->accessibleName().isEmpty());
            EXPECT_FALSE(widget->toolTip().isEmpty());
        }
}

TEST_F(MixerPanelTest, MuteAndSoloAreOfOneDesk) {
    const QString sky = QString::fromStdString("Studio");
    press(tr("Mute Sun"));
    EXPECT_FALSE(sun().enabled);
    EXPECT_EQ(level("Sun"), tr("dark"));
    controller().undoStack().undo();
    EXPECT_TRUE(sun().enabled);
    EXPECT_FALSE(named<QToolButton>(tr("Mute Sun")).isChecked());
    press(tr("Solo Sun"));
    EXPECT_TRUE(sun().solo);
    EXPECT_TRUE(environmentParts(document()).empty()); // the environment is silent
    EXPECT_EQ(named<QLabel>(tr("Level of %1").arg(sky)).text(), tr("dark"));
    press(tr("Solo %1").arg(sky));
    EXPECT_EQ(environmentParts(document()).size(), 1u);
    press(tr("Solo Sun"));
    EXPECT_FALSE(isActive(document(), sun()));
    EXPECT_EQ(level("Sun"), tr("dark"));
    keep(QStringLiteral("mixer-solo.png"));
}

TEST_F(MixerPanelTest, EnvironmentsAreFadedAndTheLightFollows) {
    EXPECT_FALSE(named<NumberField>(tr("Cross-fade")).isEnabled());
    addSecond();
    ASSERT_TRUE(named<NumberField>(tr("Cross-fade")).isEnabled());
    EXPECT_EQ(panel.findChildren<Fader*>().size(), 3);
    // It is seen at once, beside the first one; taking it back is one step.
    EXPECT_EQ(document().mix.fade, 0.5f);
    EXPECT_NE(level("Sunset"), tr("dark"));
    controller().undoStack().undo();
    EXPECT_EQ(document().mix.fade, 0.0f);
    EXPECT_EQ(document().environments.size(), 1u);
    EXPECT_EQ(document().mix.second, 0u);
    controller().undoStack().redo();
    controller().setParameter(parameter("environment.fade"), {Scope::Environment, 0}, 0.0f);
    EXPECT_EQ(shownEnvironment(document()).image, document().environment().image);
    EXPECT_EQ(level("Sunset"), tr("dark")); // faded out
    // Solo, it is there however it is faded.
    const Target second{Scope::Environment, document().mix.second};
    controller().setParameter(parameter("environment.solo"), second, true);
    EXPECT_NE(level("Sunset"), tr("dark"));
    EXPECT_EQ(shownEnvironment(document()).image, document().secondEnvironment()->image);
    controller().setParameter(parameter("environment.solo"), second, false);
    Slider& fade = named<Slider>(tr("Cross-fade"));
    const int steps = controller().undoStack().count();
    QTest::mousePress(&fade, Qt::LeftButton, {}, QPoint(fade.handleX(), fade.height() / 2));
    QTest::mouseMove(&fade, QPoint(fade.width() / 2, fade.height() / 2));
    QTest::mouseRelease(&fade, Qt::LeftButton, {}, QPoint(fade.width() / 2, fade.height() / 2));
    EXPECT_NEAR(document().mix.fade, 0.5f, 0.02f);
    EXPECT_EQ(controller().undoStack().count(), steps + 1);
    // At once a draft of both, then the full picture.
    ASSERT_NE(document().mix.blended, nullptr);
    EXPECT_EQ(shownEnvironment(document()).image, document().mix.blended);
    EXPECT_LE(document().mix.blended->height(), 256);
    EXPECT_NE(level("Sunset"), tr("dark"));
    EXPECT_TRUE(eventually([this] {
        const ImagePtr& blended = document().mix.blended;
        return blended && blended->height() == document().environment().image->height();
    }));
    keep(QStringLiteral("mixer.png"));
    // Gain of the second, then away with it: everything is as before.
    fader("Sunset").setFocus();
    QTest::keyClick(&fader("Sunset"), Qt::Key_PageUp);
    EXPECT_FLOAT_EQ(document().secondEnvironment()->exposureEv, 1.0f);
    controller().fadeTo(0);
    EXPECT_EQ(panel.findChildren<Fader*>().size(), 2);
    EXPECT_EQ(document().mix.blended, nullptr);
    EXPECT_EQ(shownEnvironment(document()).image, document().environment().image);
    while (controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(document().environments.size(), 1u);
}

TEST_F(MixerPanelTest, ChannelsFollowTheDocument) {
    Fader* before = &fader("Sun");
    before->setFocus();
    const Id lamp = controller().addLight(LightType::Point);
    EXPECT_EQ(panel.findChildren<Fader*>().size(), 3);
    EXPECT_EQ(&fader("Sun"), before); // it may have the keyboard
    controller().removeLight(lamp);
    EXPECT_EQ(panel.findChildren<Fader*>().size(), 2);
    controller().setParameter(parameter("light.gainEv"), {Scope::Light, light}, -2.5f);
    EXPECT_FLOAT_EQ(static_cast<float>(named<NumberField>(tr("Gain of Sun in EV")).value()), -2.5f);
    controller().rename({Scope::Light, light}, QStringLiteral("Moon"));
    EXPECT_EQ(&fader("Moon"), before);
}

} // namespace
} // namespace patina::editor
