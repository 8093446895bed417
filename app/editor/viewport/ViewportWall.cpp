// The part of ViewportWidget that shows a wall of cells: all of them in each frame during
// interaction, as far as its time allows, and piece by piece between events afterwards.
#include "app/editor/document/DocumentController.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/WallState.h"
#include "core/base/Log.h"
#include "core/document/ViewChoices.h"

#include <QCursor>
#include <QElapsedTimer>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

// Of cells in a frame during interaction: those of heavy scenes follow one after another.
constexpr double kMovingMs = 60.0;
constexpr double kSliceMs = 25.0; // as slices of a single picture

} // namespace

void ViewportWidget::setWall(WallState& wall, WallComparison& comparison, TracedCells& traced) {
    m_wallState = &wall;
    m_wall.setWall(wall, comparison, traced);
    connect(&wall, &WallState::changed, this, &ViewportWidget::wallChanged);
    connect(&wall, &WallState::cellsChosen, this, &ViewportWidget::wallChanged);
    connect(&m_wall, &WallPainter::finer, this, &ViewportWidget::drawTracedCells);
    connect(&wall, &WallState::ownChanged, this, [this] {
        hurry();
        redraw();
    });
}

// The frame before them would show what is shown already.
void ViewportWidget::drawTracedCells() {
    if (m_wall.isOn() && m_wallShown && m_renderer && !m_pacing.moving())
        startSlices();
    else
        redraw();
}

void ViewportWidget::wallChanged() {
    m_hand.setHandlesVisible(m_overlays && !m_wall.isOn());
    if (m_lookAhead != nullptr)
        m_lookAhead->end(); // it was for another place
    m_fade.end();
    m_gate.dropCells();
    setWallLayout();
    hurry(); // all cells at once, coarse at first
    redraw();
}

void ViewportWidget::setWallLayout() {
    m_wallLayout =
        m_wall.isOn() ? WallLayout::of(*m_wallState, size(), fontMetrics()) : WallLayout();
    int height = 0;
    for (const QRect& cell : m_wallLayout.cells)
        height = std::max(height, cell.height());
    m_hand.setPictureHeight(height);
}

std::vector<std::size_t> ViewportWidget::cellsUnderPointer() const {
    const QPoint pointer = mapFromGlobal(QCursor::pos());
    if (!m_wall.isOn() || !rect().contains(pointer))
        return {};
    std::vector<std::size_t> cells = m_wallLayout.cellsAt(pointer);
    if (const auto closest = m_wallLayout.closestCell(pointer); cells.empty() && closest)
        cells.push_back(*closest);
    return cells;
}

void ViewportWidget::leaveWall() {
    m_wallShown = false;
    stopSlices();
    m_wall.release();
    m_scene->setDocument(m_controller.document());
    m_bounces.restart();
    m_nearShadows.restart();
    m_radiosity.restart(); // the last cell's is there
    if (m_controller.document().secondEnvironment() != nullptr)
        m_ibl->renew(); // cells that cross-fade set the scene's light
    lookChanged();
}

void ViewportWidget::prepareWall() {
    if (!m_wallShown) {
        m_wallShown = true;
        stopSlices();
        m_picker.frameDrawn({}, false); // there is no one picture to look into
        // Bounces and traced shadows are of the document's surfaces, not of a cell's.
        m_scene->clearBouncedLight();
        m_scene->setNearShadows(nullptr);
        m_wall.setNearShadows(m_nearShadows.shown());
    }
    m_preview.upload(*m_scene);
    m_projections.upload(*m_scene, m_controller.document());
    takeDisplay();
    const double ratio = devicePixelRatioF();
    const auto scaled = [&](int pixels) { return static_cast<int>(std::lround(pixels * ratio)); };
    std::vector<QRect> places;
    for (const QRect& cell : m_wallLayout.cells)
        places.emplace_back(
            QPoint(scaled(cell.left()), scaled(cell.top())),
            QPoint(scaled(cell.left() + cell.width()) - 1, scaled(cell.top() + cell.height()) - 1));
    m_wall.set(*m_scene, nextFrame(), places, m_pacing.scale());
    m_radiosity.setWanted(m_wall.isLitBy(LightingMode::Radiosity));
}

void ViewportWidget::paintWall() {
    QElapsedTimer clock;
    clock.start();
    if (m_pacing.moving())
        holdJobs();
    if (!m_wallShown || m_wallLayout.size != size())
        setWallLayout();
    prepareWall();
    double milliseconds = 0.0;
    if (m_pacing.moving()) {
        const std::size_t due = m_wall.dueFromScene();
        QElapsedTimer drawing;
        drawing.start();
        const Result<bool> drawn = m_wall.draw(kMovingMs);
        milliseconds = static_cast<double>(drawing.nsecsElapsed()) * 1e-6;
        wallDrawn(drawn, due, milliseconds);
    }
    if (const Result<void> shown = m_wall.present(defaultFramebufferObject(), sizeAt(1.0f)); !shown)
        logError("the wall could not be drawn: {}", shown.error().text());
    if (!m_pacing.moving())
        m_wall.measure();
    m_nearShadows.endFrame(*m_scene);
    context()->functions()->glFinish();
    m_slowestFrameMs = std::max(m_slowestFrameMs, static_cast<double>(clock.nsecsElapsed()) * 1e-6);
    m_lastFrameSize = sizeAt(m_pacing.scale());
    m_slicing = !m_wall.complete();
    if (m_slicing)
        m_slices.want();
    else
        m_slices.drop();
    Q_EMIT frameRendered(milliseconds, pictureState());
    letOthersDraw();
}

// What a frame of all cells would take, by those that were drawn, sets how coarse the next ones
// are.
void ViewportWidget::wallDrawn(const Result<bool>& drawn, std::size_t due, double milliseconds) {
    if (!drawn) {
        logError("the wall could not be drawn: {}", drawn.error().text());
        return;
    }
    m_wallMs += milliseconds;
    const std::size_t left = m_wall.dueFromScene(); // traced pictures take no time
    m_wallCells += due - left;
    if (m_wallCells > 0 && (m_pacing.moving() || left == 0)) {
        // At rest of all of them, by which the next movement begins.
        const std::size_t all =
            std::max(m_pacing.moving() ? due : m_wall.cellsFromScene(), m_wallCells);
        m_pacing.frameTook(m_wallMs * static_cast<double>(all) / static_cast<double>(m_wallCells));
    }
    if (m_pacing.moving() || left == 0) { // frames that are added to others do not count
        m_wallMs = 0.0;
        m_wallCells = 0;
    }
}

void ViewportWidget::drawWallSlice() {
    QElapsedTimer clock;
    clock.start();
    makeCurrent();
    prepareWall();
    const std::size_t due = m_wall.due(), dueFromScene = m_wall.dueFromScene();
    const Result<bool> drawn = m_wall.draw(kSliceMs);
    doneCurrent();
    const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    m_slowestFrameMs = std::max(m_slowestFrameMs, milliseconds);
    wallDrawn(drawn, dueFromScene, milliseconds);
    // Cells appear as they are drawn; what is added to them is shown once all of it is there.
    if (due > 0 || !drawn || *drawn)
        redraw();
    else
        m_slices.want();
}

Result<std::optional<Image>> ViewportWidget::drawSheetFrame(const render::CellView& cell,
                                                            bool begins, bool linear) {
    if (!m_scene || !m_wallShown)
        return Error{ErrorKind::Cancelled, "the wall is not shown any more", {}, {}};
    makeCurrent();
    Result<std::optional<Image>> drawn = m_wall.drawSheetFrame(*m_scene, cell, begins, linear);
    doneCurrent();
    return drawn;
}

void ViewportWidget::endSheet() {
    if (!m_scene)
        return;
    makeCurrent();
    m_wall.endSheet();
    doneCurrent();
}

} // namespace patina::editor
