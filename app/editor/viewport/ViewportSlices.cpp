// The part of ViewportWidget that uses idle time: it refines the picture in slices between events,
// takes over environments in pieces,
// and lets programs be compiled ahead.
#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/Log.h"
#include "core/document/ToneResponse.h"
#include "core/mix/LightMix.h"

#include <QElapsedTimer>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kSliceMs = 25.0; // with Qt's part of a frame at rest input waits no 50 ms

constexpr std::size_t kEnvironmentBytes = 16 << 20; // of textures between frames: some 10 ms

} // namespace

// A piece of the environment that has been prepared. The old one is shown until all are there.
void ViewportWidget::feedEnvironment() {
    if (!m_renderer)
        return; // its making starts this again
    makeCurrent();
    if (EnvironmentTexelsPtr next = m_ibl->take()) {
        m_environmentOnItsWay = next->image;
        m_scene->beginEnvironment(std::move(next));
    }
    const bool complete = m_scene->proceedEnvironment(kEnvironmentBytes);
    doneCurrent();
    if (!complete) {
        m_environmentTimer.start();
        return;
    }
    if (m_environmentOnItsWay == shownEnvironment(m_controller.document()).image)
        m_fade.begin();
    if (m_environmentOnItsWay)
        m_wall.setSceneLight(std::exchange(m_environmentOnItsWay, nullptr));
    m_pacing.pictureChanged();
    m_restTimer.start();
    lookChanged();
}

// The sides of a split are drawn one after the other, and none is there to be displayed anew for an
// eye that adapts: such frames are drawn in one piece.
bool ViewportWidget::drawsInSlices(const render::ViewSettings& view) const {
    return m_pacing.slices() && !m_lastFrameSize.isEmpty() &&
           !(view.split && needsLuminance(m_controller.document().view));
}

void ViewportWidget::wantFrame(const render::FrameSettings& frame) {
    m_sliced = frame;
    m_sliced.adaptSeconds = 0.0f; // the eye looks at what is shown
    m_sliced.accumulate = m_pacing.accumulating();
}

void ViewportWidget::startSlices() {
    m_slicing = true;
    m_slicesMs = 0.0;
    m_sliceTimer.start();
}

void ViewportWidget::stopSlices() {
    m_slicing = false;
    m_sliceTimer.stop();
    m_completeTimer.stop();
}

void ViewportWidget::drawSlice() {
    if (!m_renderer || !m_slicing)
        return;
    if (std::exchange(m_sliceWaits, false)) {
        m_sliceTimer.start(); // something else has just taken its time
        return;
    }
    if (m_wall.isOn()) {
        drawWallSlice();
        return;
    }
    QElapsedTimer clock;
    clock.start();
    makeCurrent();
    const Result<bool> complete = m_renderer->prepare(m_sliced, kSliceMs, m_pacing.expectedMs());
    doneCurrent();
    const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    m_slicesMs += milliseconds;
    m_slowestFrameMs = std::max(m_slowestFrameMs, milliseconds);
    if (!complete) {
        logError("the frame could not be drawn: {}", complete.error().text());
        stopSlices();
    } else if (*complete) {
        m_completeTimer.start(); // shown after the events that have come meanwhile
    } else {
        m_sliceTimer.start();
    }
}

// A picture of another size would be distorted until the next one is complete.
void ViewportWidget::resizeGL(int, int) {
    if (m_pacing.slices())
        hurry();
}

PictureState ViewportWidget::pictureState() const {
    if (m_pacing.moving())
        return PictureState::Moving;
    const bool adding = m_accumulationTimer.isActive();
    return m_pacing.refined() && !adding && !m_slicing && !m_gate.waiting() && !m_wall.isTracing()
               ? PictureState::Refined
               : PictureState::Refining;
}

void ViewportWidget::compileAhead() {
    if (m_compilesAhead)
        m_gate.rest();
}

void ViewportWidget::setCompilesAhead(bool compiles) {
    m_compilesAhead = compiles;
    if (compiles && !m_restTimer.isActive())
        m_gate.rest();
}

} // namespace patina::editor
