// The window and its radiosity; and that with a Cornell box of few elements and the radiosity dock.
#pragma once

#include "core/light/Light.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/UnderSky.h"

#include <QLabel>
#include <QPushButton>
#include <utility>

namespace patina::editor {

struct RadiosityWindow : EditorTest {
    static RadiosityUpdater& radiosity() { return session->radiosity; }
    static void set(const char* name, Target target, const ParameterValue& value) {
        controller().setParameter(parameter(name), target, value);
    }
    template <class Widget>
    static Widget* part(const char* name) {
        auto* found = window->findChild<Widget*>(QLatin1String(name));
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    static void press(const char* name) {
        auto* button = part<QPushButton>(name);
        ASSERT_TRUE(button->isEnabled()) << name;
        QTest::mouseClick(button, Qt::LeftButton);
    }
    static bool solved() {
        return eventually([] { return radiosity().isWanted() && radiosity().upToDate(); });
    }
};

struct RadiosityDock : RadiosityWindow {
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(360, 300); // software OpenGL pays for each pixel
        controller().openScene(QStringLiteral("builtin:cornell-reference"));
        ASSERT_TRUE(settled(*session));
        putUnderSky(controller()); // that the dock lights it is what is tried
        set("environment.enabled", {Scope::Environment, 0}, false);
        set("view.radiosityArea", {Scope::View, 0}, 0.02f);
        set("view.radiosityRays", {Scope::View, 0}, 64.0f);
        Camera camera = document().view.camera;
        camera.yawDeg = 0.0f;
        camera.pitchDeg = 0.0f;
        controller().setCamera(frameBounds(camera, document().bounds(), 1.2f));
        if (!window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
    }
    void TearDown() override {
        session->views.set({});
        if (window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
    }

    static ViewportWidget& viewport() { return window->viewport(); }
    static void light() {
        press("radiosityLight");
        ASSERT_EQ(document().view.lighting, LightingMode::Radiosity);
        ASSERT_TRUE(solved()) << radiosity().failure().toStdString();
    }
    static QString words(const char* name) { return part<QLabel>(name)->text(); }
    static void keep(const char* name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (!target.isEmpty())
            window->grab().save(target + QLatin1Char('/') + QLatin1String(name));
    }
    static bool atRest() {
        return eventually([] { return viewport().isSettled() && radiosity().upToDate(); });
    }
    static double brightness() {
        const QImage picture = viewport().grabFramebuffer();
        double sum = 0.0;
        for (int y = 0; y < picture.height(); y += 4)
            for (int x = 0; x < picture.width(); x += 4)
                sum += qGray(picture.pixel(x, y));
        return sum;
    }
};

} // namespace patina::editor
