// The part of ViewportWidget that works between events, in its schedule's turns: it refines the
// picture in slices, takes over environments in pieces, and lets programs be compiled ahead; and
// what of all that is still to come.
#include "app/editor/document/DocumentController.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/Log.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/mix/LightMix.h"
#include "render/FollowedRadiosity.h"

#include <QElapsedTimer>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kRestMs = 250.0; // without movement until the picture is refined
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
        m_environmentUpload.want();
        return;
    }
    if (m_environmentOnItsWay == shownEnvironment(m_controller.document()).image)
        m_fade.begin();
    if (m_environmentOnItsWay)
        m_wall.setSceneLight(std::exchange(m_environmentOnItsWay, nullptr));
    m_pacing.pictureChanged();
    refineLater();
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

void ViewportWidget::refineLater() {
    m_rest.want(kRestMs);
}

void ViewportWidget::refineAtRest() {
    // A held button or key is a hand that has not let go yet.
    if (m_hand.holding()) {
        refineLater();
        return;
    }
    m_preview.setHandMoves(false);
    if (m_wall.isOn()) {
        if (m_pacing.refine()) {
            redraw();
            refineLater();
        } else if (!m_slicing) {
            compileAhead();
        }
    } else if (m_slicing && !m_pacing.refined()) {
        refineLater(); // one step after the other
    } else if (m_pacing.refine()) {
        if (m_renderer && drawsInSlices(m_viewFeed.drawn())) {
            // What is shown stays: painting it again would take long, too.
            wantFrame(nextFrame());
            startSlices();
            letOthersDraw();
        } else {
            redraw();
        }
        refineLater(); // the next step
    } else {
        compileAhead();
    }
}

void ViewportWidget::drawNextAdded() {
    if (!m_renderer || m_slicing || !m_pacing.accumulating())
        return;
    if (!drawsInSlices(m_viewFeed.drawn())) {
        redraw();
        return;
    }
    makeCurrent();
    bringIn();
    doneCurrent();
    startSlices();
}

void ViewportWidget::startSlices() {
    m_slicing = true;
    m_slicesMs = 0.0;
    m_slices.want();
}

void ViewportWidget::stopSlices() {
    m_slicing = false;
    m_slices.drop();
    m_complete.drop();
}

void ViewportWidget::drawSlice() {
    if (!m_renderer || !m_slicing)
        return;
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
        m_complete.want(); // shown after the events that have come meanwhile
    } else {
        m_slices.want();
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
    const bool adding = m_accumulation.isWanted();
    return m_pacing.refined() && !adding && !m_slicing && !m_gate.waiting() && !m_wall.isTracing()
               ? PictureState::Refined
               : PictureState::Refining;
}

Awaited ViewportWidget::awaited() const {
    if (!m_renderer)
        return Awaited::OpenGl;
    if (m_gate.waiting())
        return Awaited::Programs;
    if (m_controller.showsDraft() || !m_ibl->finished() || m_environmentUpload.isWanted())
        return Awaited::Light;
    const bool underTransfer = render::isLitBy(
        LightingMode::Prt, m_controller.document().view.lighting, m_viewFeed.drawn());
    if ((underTransfer && m_bounces.isOnItsWay()) || m_nearShadows.isOnItsWay() ||
        m_radiosity.isOnItsWay() || m_projections.isOnItsWay())
        return Awaited::Coefficients;
    if (m_pacing.moving())
        return Awaited::Input;
    if (m_redraws || m_panels.isWanted())
        return Awaited::Frame;
    if (m_slicing || m_accumulation.isWanted() || m_rest.isWanted() || !showsWhatIsSet())
        return Awaited::FinerFrame;
    if (m_eye.isRunning())
        return Awaited::Eye;
    if (m_lookAhead != nullptr && m_lookAhead->isOn())
        return Awaited::Preview;
    return m_fade.isOn() ? Awaited::Fade : Awaited::Nothing;
}

// As fine as it gets: what was drawn last, in whatever way that is.
bool ViewportWidget::showsWhatIsSet() const {
    if (m_wall.isOn())
        return !m_wall.preparing() && m_wall.isCurrent() && !m_wall.isTracing();
    if (m_paths != nullptr && m_paths->isOn())
        return m_paths->progress().refined;
    return m_documentPicture != nullptr || m_renderer->isCurrent(m_sliced);
}

void ViewportWidget::compileAhead() {
    if (m_compilesAhead)
        m_gate.rest();
}

void ViewportWidget::setCompilesAhead(bool compiles) {
    m_compilesAhead = compiles;
    if (compiles && !m_rest.isWanted())
        m_gate.rest();
}

} // namespace patina::editor
