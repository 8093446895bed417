#include "app/editor/viewport/PreviewFeed.h"

#include "app/editor/job/BakeService.h"
#include "app/editor/job/LivePreview.h"
#include "render/SceneRenderer.h"

namespace patina::editor {
namespace {

constexpr int kPassPollMs = 100; // how often a bake is asked for a new pass
// How often an unfinished pass is shown: each time redraws the picture, which takes the cores from
// the bake.
constexpr int kPartMs = 1500;
// How often anything is shown while the hand moves: the frame that shows it takes long.
constexpr int kMovingMs = 3000;

} // namespace

PreviewFeed::PreviewFeed(QObject* parent)
    : QObject(parent) {
    m_timer.setInterval(kPassPollMs);
    connect(&m_timer, &QTimer::timeout, this, &PreviewFeed::poll);
}

void PreviewFeed::setBakes(BakeService& bakes) {
    m_bakes = &bakes;
    connect(&bakes, &BakeService::previewChanged, this, [this] {
        m_samples = 0;
        m_sinceShown.start();
        m_pending = m_bakes->preview() != nullptr;
        if (m_pending)
            m_timer.start();
        else
            m_timer.stop();
        Q_EMIT changed(); // also at the end: upload() drops the preview
    });
}

void PreviewFeed::restart() {
    if (!m_bakes || !m_bakes->preview())
        return;
    m_bakes->preview()->markAllChanged();
    m_pending = true;
}

void PreviewFeed::upload(render::SceneRenderer& renderer) {
    const std::shared_ptr<LivePreview> preview = m_bakes ? m_bakes->preview() : nullptr;
    const bool shown = preview && preview->shown();
    if (m_pending && shown) {
        m_pending = false;
        m_shown |= preview->collect(
            [&renderer, kind = preview->kind()](Id mesh, int stride,
                                                std::span<const float> values) {
                renderer.previewVertices(kind, mesh, stride, values);
            },
            [&renderer](Id material, int size, std::span<const float> values) {
                renderer.previewTexels(material, size, values);
            });
    } else if (m_shown && !shown) {
        renderer.clearPreview();
        m_shown = false;
    }
}

// Each complete pass is a usable picture; a long one is shown as far as it has come.
void PreviewFeed::poll() {
    const std::shared_ptr<LivePreview> preview = m_bakes->preview();
    if (!preview)
        return;
    if (!preview->shown()) {
        m_pending = true; // once it is
        if (m_shown)
            Q_EMIT changed();
        return;
    }
    if (m_handMoves && m_sinceShown.isValid() && m_sinceShown.elapsed() < kMovingMs)
        return;
    const bool part = m_sinceShown.isValid() && m_sinceShown.elapsed() > kPartMs;
    if (!m_pending && preview->samplesDone() == m_samples && !(part && preview->changed()))
        return;
    m_samples = preview->samplesDone();
    m_sinceShown.start();
    m_pending = true;
    Q_EMIT changed();
}

} // namespace patina::editor
