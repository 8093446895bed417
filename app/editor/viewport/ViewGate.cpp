#include "app/editor/viewport/ViewGate.h"

#include "app/editor/document/DocumentController.h"

#include <algorithm>

namespace patina::editor {
namespace {

using render::FrameKind;
using render::SurfaceOutput;
using render::ViewSettings;

// A driver that takes longer may as well do so in the viewport.
constexpr int kLongestWaitMs = 10'000;

} // namespace

ViewGate::ViewGate(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_warmer(controller.runner()) {
    connect(&m_warmer, &ProgramWarmer::progressed, this, [this] {
        m_known.clear();
        Q_EMIT opened();
    });
    connect(&m_warmer, &ProgramWarmer::finished, this, &ViewGate::opened);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        m_passes |= change.isAnotherDocument();
        if (change.affects != Affects::Nothing)
            m_known.clear();
    });
    m_limit.setSingleShot(true);
    m_limit.setInterval(kLongestWaitMs);
    connect(&m_limit, &QTimer::timeout, this, [this] {
        m_passes = true;
        Q_EMIT opened();
    });
}

ViewSettings ViewGate::choose(const ViewSettings& wanted) {
    const Document& document = m_controller.document();
    std::vector<FrameKind> frames = render::frameKinds(wanted, document);
    // What is looked at already is seen to follow edits at once.
    const bool opens = !std::ranges::all_of(frames, [&](const FrameKind& frame) {
        return std::ranges::find(m_drawn, frame) != m_drawn.end() || isOpen(frame);
    });
    if (opens && !m_passes) {
        m_warmer.request(document, frames, ProgramWarmer::Urgency::Awaited);
        setWaiting(true);
        return lastView();
    }
    for (const FrameKind& frame : frames)
        if (!isOpen(frame)) {
            m_warmer.learn(document, frame);
            m_known[frame] = true;
        }
    m_view = wanted;
    m_lighting = document.view.lighting;
    m_drawn = std::move(frames);
    m_passes = false;
    setWaiting(false);
    return m_view;
}

ViewSettings ViewGate::lastView() const {
    ViewSettings view = m_view;
    if (!view.lighting && m_lighting != m_controller.document().view.lighting)
        view.lighting = m_lighting;
    return view;
}

void ViewGate::setWaiting(bool waiting) {
    if (waiting == m_waiting)
        return;
    m_waiting = waiting;
    if (waiting)
        m_limit.start();
    else
        m_limit.stop();
    Q_EMIT waitingChanged();
}

bool ViewGate::isOpen(const FrameKind& frame) const {
    const auto [entry, isNew] = m_known.try_emplace(frame, false);
    if (isNew)
        entry->second = m_warmer.knows(m_controller.document(), frame);
    return entry->second;
}

bool ViewGate::isOpenForSheets(ViewKind kind) const {
    return isOpen(render::sheetKind(kind, m_controller.document()));
}

FrameKind ViewGate::inspection() const {
    return {SurfaceOutput::Inspection, m_controller.document().view.lighting};
}

bool ViewGate::isOpenForInspection() const {
    return isOpen(inspection());
}

void ViewGate::prepareAwaited() {
    const auto opened = [this](const FrameKind& frame) { return isOpen(frame); };
    std::erase_if(m_sheetFrames, opened);
    std::erase_if(m_cellFrames, opened);
    m_inspectionAwaited = m_inspectionAwaited && !isOpenForInspection();
    std::vector<FrameKind> frames = m_cellFrames;
    frames.insert(frames.end(), m_sheetFrames.begin(), m_sheetFrames.end());
    if (m_inspectionAwaited)
        frames.insert(frames.begin(), inspection());
    if (!frames.empty() && !m_waiting)
        m_warmer.request(m_controller.document(), frames, ProgramWarmer::Urgency::Awaited);
}

void ViewGate::prepareSheets(const std::vector<ViewKind>& kinds) {
    m_sheetFrames.clear();
    for (const ViewKind kind : kinds)
        if (const FrameKind frame = render::sheetKind(kind, m_controller.document());
            std::ranges::find(m_sheetFrames, frame) == m_sheetFrames.end())
            m_sheetFrames.push_back(frame);
    prepareAwaited();
}

bool ViewGate::admitCells(const std::vector<FrameKind>& frames) {
    if (std::ranges::all_of(frames, [this](const FrameKind& frame) { return isOpen(frame); }))
        return true;
    for (const FrameKind& frame : frames)
        if (std::ranges::find(m_cellFrames, frame) == m_cellFrames.end())
            m_cellFrames.push_back(frame);
    prepareAwaited();
    return false;
}

void ViewGate::prepareInspection() {
    m_inspectionAwaited = true;
    prepareAwaited();
}

void ViewGate::rest() {
    if (!m_waiting && !m_warmer.busy())
        m_warmer.request(m_controller.document(), render::allFrameKinds(m_controller.document()),
                         ProgramWarmer::Urgency::Idle);
}

} // namespace patina::editor
