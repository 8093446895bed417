// The Environment panel alone, with what tests do to its lat-long view.
#pragma once

#include "tests/app/editor/EditorFixture.h"

#include "app/editor/panel/EnvironmentPanel.h"
#include "app/editor/panel/SoftboxList.h"
#include "app/editor/widget/LatLongView.h"
#include "core/edit/EditSession.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/LatLongGrid.h"

#include <QToolButton>
#include <cmath>

namespace patina::editor {

// The panel in a window of its own: a viewport would draw each step and filter its light, which
// takes long and shows nothing of the panel.
struct EnvironmentPanelTest : EditorTest {
    static void SetUpTestSuite() {
        session = std::make_unique<Session>();
        alone = std::make_unique<EnvironmentPanel>(session->controller, session->thumbnails);
        alone->resize(400, 700);
        alone->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(alone.get(), 60'000));
    }
    static void TearDownTestSuite() {
        alone.reset();
        session.reset();
    }
    static EnvironmentPanel& panel() { return *alone; }
    static LatLongView& view() { return *panel().view(); }
    static const Environment& environment() { return document().environment(); }
    static const Softbox& softbox(std::size_t index) { return environment().softboxes.at(index); }

    void SetUp() override {
        EditorTest::SetUp();
        ASSERT_TRUE(view().isVisible());
    }
    static void choose(const char* kind) {
        auto* button = find<QToolButton>(panel(), QStringLiteral("Environment kind %1").arg(kind));
        ASSERT_NE(button, nullptr);
        QTest::mouseClick(button, Qt::LeftButton);
        EXPECT_TRUE(button->isChecked());
        QApplication::processEvents();
    }
    // One softbox alone, selected.
    static Id chooseOneSoftbox(const Softbox& softbox) {
        choose("Softboxes");
        Id id = 0;
        controller().editStructure(QStringLiteral("one"), [&](Document& edited) {
            edited.environment().softboxes.clear();
            id = patina::addSoftbox(edited, softbox);
        });
        panel().softboxes()->select(id);
        controller().undoStack().clear();
        QApplication::processEvents();
        return id;
    }
    static QString tr(const char* text) { return QString::fromUtf8(text); }
    static QPoint pointOf(double azimuthDeg, double elevationDeg) {
        return view().map().point(directionFromAngles(azimuthDeg, elevationDeg)).toPoint();
    }
    static QPoint handlePoint(SoftboxHandle wanted) {
        for (const auto& [handle, point] : handlesOf(softbox(0), view().map()))
            if (handle == wanted)
                return point.toPoint();
        ADD_FAILURE() << "no such handle";
        return {};
    }
    static void press(QPoint point, Qt::KeyboardModifiers keys = {}) {
        QTest::mousePress(&view(), Qt::LeftButton, keys, point);
    }
    static void moveTo(QPoint point, Qt::KeyboardModifiers keys = {}) {
        QMouseEvent move(QEvent::MouseMove, point, view().mapToGlobal(QPointF(point)), Qt::NoButton,
                         Qt::LeftButton, keys);
        QApplication::sendEvent(&view(), &move);
    }
    static void release(QPoint point) { QTest::mouseRelease(&view(), Qt::LeftButton, {}, point); }
    static void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = {}) {
        press(from, keys);
        for (int step = 1; step <= 8; ++step)
            moveTo(from + (to - from) * step / 8, keys);
        release(to);
    }
    // Radiance of the environment's image, green.
    static float radiance(double azimuthDeg, double elevationDeg) {
        const Image& image = *environment().image;
        const glm::dvec3 d = directionFromAngles(azimuthDeg, elevationDeg);
        const double u = 0.5 + std::atan2(d.x, -d.z) / 6.283185307179586;
        const double v = std::acos(d.y) / 3.141592653589793;
        return image
            .linear(static_cast<int>(u * image.width()) % image.width(),
                    std::min(static_cast<int>(v * image.height()), image.height() - 1))
            .g;
    }
    static double degreesPerPixel() { return 360.0 / view().map().area().width(); }

    static inline std::unique_ptr<EnvironmentPanel> alone;
};

inline Softbox plainBox(float azimuthDeg, float elevationDeg) {
    Softbox softbox;
    softbox.name = "Key";
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    softbox.intensity = 10.0f;
    return softbox;
}

} // namespace patina::editor
