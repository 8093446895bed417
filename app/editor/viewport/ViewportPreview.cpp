// The part of ViewportWidget that shows the preview of an environment: a picture of its own beside
// that of the document, which waits as it is; or the current cell of the wall.
#include "app/editor/document/DocumentController.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/WallState.h"

#include <QOpenGLContext>
#include <utility>

namespace patina::editor {
namespace {

constexpr std::size_t kPreviewBytes = 16 << 20; // of textures between events: some 10 ms

} // namespace

void ViewportWidget::setEnvironmentPreview(EnvironmentPreview& preview) {
    m_lookAhead = &preview;
    m_wall.setPreview(preview);
    connect(&preview, &EnvironmentPreview::changed, this, &ViewportWidget::previewChanged);
}

bool ViewportWidget::showsPreviews() const {
    return !m_wall.isOn() || m_wallState->current().has_value();
}

QRect ViewportWidget::previewArea() const {
    if (m_wall.isOn())
        if (const std::optional<std::size_t> cell = m_wallState->current();
            cell && *cell < m_wallLayout.cells.size() && !m_wallLayout.cells[*cell].isNull())
            return m_wallLayout.cells[*cell];
    return rect();
}

void ViewportWidget::previewChanged() {
    if (!m_renderer)
        return;
    const bool wall = m_wall.isOn();
    if (m_previewLight != render::kDocumentLight && (wall || !m_lookAhead->isOn()))
        leavePreview();
    if (wall) {
        m_wall.recompose();
        hurry();
        redraw();
        return;
    }
    if (!m_lookAhead->isOn())
        return;
    makeCurrent();
    if (m_previewLight == render::kDocumentLight)
        m_previewLight =
            m_scene->addLight(m_lookAhead->inPlaceOf(m_controller.document().environment()));
    m_scene->beginEnvironment(m_lookAhead->texels(), m_previewLight);
    doneCurrent();
    m_previewUpload.want();
}

// A piece of its light, between events.
void ViewportWidget::feedPreview() {
    if (!m_renderer || m_previewLight == render::kDocumentLight)
        return;
    makeCurrent();
    const bool complete = m_scene->proceedEnvironment(kPreviewBytes, m_previewLight);
    doneCurrent();
    if (!complete) {
        m_previewUpload.want();
        return;
    }
    if (!m_documentPicture)
        enterPreview();
    m_pacing.pictureChanged();
    refineLater();
    redraw();
}

// The picture of the document, its eye and how fine it is wait for the preview's end.
void ViewportWidget::enterPreview() {
    fadeFromHere();
    stopSlices();
    makeCurrent();
    m_documentPicture = std::exchange(m_renderer, std::make_unique<render::ViewRenderer>(*m_scene));
    doneCurrent();
    m_documentPacing = m_pacing;
    m_documentFrameSize = m_lastFrameSize;
    m_documentPainted = m_painted;
    m_documentPixels = sizeAt(1.0f);
    m_documentCamera = m_lastCamera;
    hurry();
}

void ViewportWidget::leavePreview() {
    m_previewUpload.drop();
    if (m_documentPicture)
        fadeFromHere();
    makeCurrent();
    if (m_documentPicture) {
        stopSlices();
        m_renderer = std::move(m_documentPicture);
        m_painted = m_documentPainted;
        m_pacing = m_documentPacing;
        m_lastFrameSize = m_documentFrameSize;
        m_lastCamera = m_documentCamera;
        m_onlyDisplay = true; // what was there is there
        refineLater();
        if (m_documentPixels != sizeAt(1.0f))
            hurry(); // it would be distorted
        redraw();
    }
    m_scene->removeLight(std::exchange(m_previewLight, render::kDocumentLight));
    doneCurrent();
}

} // namespace patina::editor
