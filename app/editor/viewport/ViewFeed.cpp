#include "app/editor/viewport/ViewFeed.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/viewport/ViewGate.h"
#include "app/editor/viewport/ViewState.h"
#include "core/edit/ViewReasons.h"
#include "render/ViewRenderer.h"

#include <utility>

namespace patina::editor {

using render::ViewSettings;

ViewFeed::ViewFeed(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {}

void ViewFeed::setViews(ViewState& views) {
    m_views = &views;
    connect(&views, &ViewState::changed, this, &ViewFeed::follow);
    follow();
}

void ViewFeed::follow() {
    const ViewSettings& now = m_views->settings();
    const ViewSettings before = std::exchange(m_followed, now);
    const auto marks = [](const render::ViewChoice& choice) {
        return choice.kind == shading::kViewInvalid;
    };
    m_blink.setActive(marks(now.shown) || (now.split && marks(now.split->other)));

    // Which view is shown, and where the split lies, is nothing that thumbnails depend on.
    const auto scene = [](ViewSettings settings) {
        settings.shown = {};
        settings.split.reset();
        return settings;
    };
    if (scene(now) != scene(before))
        Q_EMIT termsChanged();
    Q_EMIT changed();
}

void ViewFeed::standIn(render::ViewChoice& choice) const {
    if (!whyEmpty(choice.kind, m_controller.document(), m_views->settings().light).empty())
        choice = {};
}

ViewSettings ViewFeed::beginFrame(ViewGate& gate) {
    if (!m_views)
        return {};
    ViewSettings settings = m_views->settings();
    standIn(settings.shown);
    if (settings.split)
        standIn(settings.split->other);
    if (m_traced != nullptr)
        settings = m_traced->drawn(settings);
    m_drawsOther = m_traced != nullptr && m_traced->side() == ViewSide::Shown &&
                   m_views->settings().split && !settings.split;
    settings = gate.choose(settings);
    m_same = settings == m_drawn;
    m_drawn = settings;
    settings.flags = m_blink.strength();
    return settings;
}

void ViewFeed::endFrame(const render::ViewRenderer& renderer) {
    if (!m_views)
        return;
    if (m_drawsOther)
        m_views->setMeasuredRanges(std::nullopt, renderer.shownRange());
    else
        m_views->setMeasuredRanges(renderer.shownRange(), renderer.otherRange());
}

void ViewFeed::setPreparing(bool preparing) {
    if (m_views)
        m_views->setPreparing(preparing);
}

} // namespace patina::editor
