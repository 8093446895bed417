#include "app/editor/trace/RayTreeProbe.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/trace/PathView.h"
#include "core/math/Shading.h"
#include "core/trace/whitted/WhittedTracer.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kRayTreeTag = "ray tree";

} // namespace

RayTreeProbe::RayTreeProbe(DocumentController& controller, PathView& paths, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_paths(paths)
    , m_tasks(controller.runner()) {
    connect(&paths, &PathView::changed, this, &RayTreeProbe::follow);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        // Nobody traces it anew: what is shown would be of another scene.
        if (change.affects != Affects::Nothing && !m_paths.isWhitted())
            clear();
    });
}

bool RayTreeProbe::picks() const {
    return m_wanted && m_paths.isWhitted();
}

void RayTreeProbe::setWanted(bool wanted) {
    if (wanted == m_wanted)
        return;
    m_wanted = wanted;
    follow();
    Q_EMIT changed();
}

void RayTreeProbe::pick(const QPointF& at) {
    const std::optional<PathView::Frame> frame = m_paths.frame();
    if (!picks() || !frame)
        return;
    const auto inside = [](double share, int size) {
        return std::clamp(static_cast<int>(share * size), 0, size - 1);
    };
    m_pick =
        Pick{frame->view, {inside(at.x(), frame->view.width), inside(at.y(), frame->view.height)}};
    m_selected = RayNode::kNone;
    m_scene = frame->scene;
    m_settings = m_paths.whitted();
    trace();
}

void RayTreeProbe::clear() {
    if (!m_pick && !m_shown)
        return;
    m_tasks.cancel(kRayTreeTag);
    m_pick.reset();
    m_shown = nullptr;
    m_scene = nullptr;
    m_selected = RayNode::kNone;
    Q_EMIT changed();
}

// The picture has become one of another scene, or by other settings: the same pixel, as it is now.
void RayTreeProbe::follow() {
    if (picks() != m_couldPick) {
        m_couldPick = picks();
        Q_EMIT changed();
    }
    const std::optional<PathView::Frame> frame = m_paths.frame();
    if (!picks() || !m_pick || !frame ||
        (frame->scene == m_scene && m_paths.whitted() == m_settings))
        return;
    m_scene = frame->scene;
    m_settings = m_paths.whitted();
    trace();
}

void RayTreeProbe::trace() {
    m_tasks.run(
        {.tag = kRayTreeTag},
        [scene = m_scene, settings = m_settings,
         pick = *m_pick](const JobContext&) -> Result<std::shared_ptr<const Shown>> {
            auto shown = std::make_shared<Shown>();
            shown->tree = traceRayTree(*scene, pick.view, settings, pick.pixel.x, pick.pixel.y, 1);
            shown->subtotals = shown->tree.subtotals();
            shown->view = pick.view;
            shown->pixel = pick.pixel;
            return std::shared_ptr<const Shown>(std::move(shown));
        },
        [this](const Result<std::shared_ptr<const Shown>>& shown) {
            if (!shown || !m_pick)
                return;
            m_shown = *shown;
            if (m_selected >= static_cast<int>(m_shown->tree.nodes().size()))
                m_selected = RayNode::kNone;
            Q_EMIT changed();
        });
}

void RayTreeProbe::select(int node) {
    if (node == m_selected || !m_shown || node >= static_cast<int>(m_shown->tree.nodes().size()))
        return;
    m_selected = node;
    Q_EMIT selectionChanged();
}

int RayTreeProbe::cameraRayOf(int node) const {
    if (!m_shown || m_shown->tree.empty())
        return 0;
    const auto nodes = m_shown->tree.nodes();
    if (node < 0) {
        float most = -1.0f;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (const float light = shading::luminance(m_shown->subtotals[i]);
                nodes[i].kind == RayKind::Camera && light > most) {
                most = light;
                node = static_cast<int>(i);
            }
    }
    while (nodes[static_cast<std::size_t>(node)].parent != RayNode::kNone)
        node = nodes[static_cast<std::size_t>(node)].parent;
    return node;
}

} // namespace patina::editor
