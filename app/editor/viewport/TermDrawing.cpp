#include "app/editor/viewport/TermDrawing.h"

#include "core/base/Check.h"
#include "render/SceneRenderer.h"

#include <utility>

namespace patina::editor {

Result<bool> TermDrawing::drawFrame() {
    if (m_done > render::kTermPictures)
        return true;
    if (m_picture)
        m_picture->resume();
    else
        m_picture = std::make_unique<render::ViewRenderer>(m_scene);
    render::FrameSettings frame = m_frame;
    if (m_done > 0)
        frame.view.shown = render::termPictures()[m_done - 1];
    if (const Result<void> drawn = m_picture->render(frame, render::ViewRenderer::kNowhere); !drawn)
        return drawn.error();
    if (!m_picture->isSteady())
        return false;
    (m_done == 0 ? m_whole : m_terms[m_done - 1]) = m_picture->readLinear();
    m_picture.reset();
    ++m_done;
    return m_done > render::kTermPictures;
}

DrawnTerms TermDrawing::take() {
    CHECK(m_done > render::kTermPictures);
    return render::drawnTerms(std::move(m_whole), std::move(m_terms));
}

} // namespace patina::editor
