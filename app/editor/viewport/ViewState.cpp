#include "app/editor/viewport/ViewState.h"

#include <algorithm>

namespace patina::editor {

using render::ViewMode;
using render::ViewSettings;

namespace {

std::size_t groupIndex(ViewKind kind) {
    return static_cast<std::size_t>(viewInfo(kind).group);
}

} // namespace

bool hasRange(const render::ViewChoice& choice) {
    return choice.mode == ViewMode::Raw && (viewInfo(choice.kind).value == ViewValue::Scalar ||
                                            choice.kind == shading::kViewLuminance);
}

ViewState::ViewState(QObject* parent)
    : QObject(parent) {
    // What a group begins with; the picture itself has a key of its own.
    for (auto info = views().rbegin(); info != views().rend(); ++info)
        if (info->kind != shading::kViewFinal)
            m_lastOfGroup[static_cast<std::size_t>(info->group)] = info->kind;
}

void ViewState::set(const ViewSettings& settings) {
    if (settings == m_settings)
        return;
    if (settings.shown.kind != shown())
        m_before = shown();
    m_settings = settings;
    if (shown() != shading::kViewFinal) {
        m_lastOfGroup[groupIndex(shown())] = shown();
        m_lastFactor = shown();
    }
    Q_EMIT changed();
}

render::ViewChoice ViewState::choice(ViewKind kind) const {
    render::ViewChoice choice;
    choice.kind = kind;
    choice.mode = viewInfo(kind).contribution.empty() ? ViewMode::Raw : m_mode;
    if (const auto range = m_ranges.find(kind); range != m_ranges.end())
        choice.range = range->second;
    return choice;
}

void ViewState::show(ViewKind kind) {
    edit([&](ViewSettings& settings) { settings.shown = choice(kind); });
}

void ViewState::showOther(ViewKind kind) {
    edit([&](ViewSettings& settings) {
        if (!settings.split)
            settings.split.emplace();
        settings.split->other = choice(kind);
    });
}

void ViewState::toggleFinal() {
    show(shown() == shading::kViewFinal ? m_lastFactor : shading::kViewFinal);
}

void ViewState::cycle(ViewGroup group, bool back) {
    const auto index = static_cast<std::size_t>(group);
    if (viewInfo(shown()).group != group) {
        show(m_lastOfGroup[index]);
        return;
    }
    std::vector<ViewKind> members;
    for (const ViewInfo& info : views())
        if (info.group == group)
            members.push_back(info.kind);
    const auto now = std::find(members.begin(), members.end(), shown()) - members.begin();
    const auto count = static_cast<std::ptrdiff_t>(members.size());
    const auto next = (now + (back ? count - 1 : 1)) % count;
    show(members[static_cast<std::size_t>(next)]);
}

void ViewState::toggleSplit() {
    if (m_settings.split) {
        edit([](ViewSettings& settings) { settings.split.reset(); });
        return;
    }
    if (m_traced && m_settings.isOrdinary(m_settings.shown)) {
        showOther(shading::kViewFinal);
        return;
    }
    // Two different ones: what came before, else the picture, else the first factor there is.
    const ViewKind picture = shading::kViewFinal;
    ViewKind other = m_before;
    if (other == shown())
        other = shown() == picture ? m_lastFactor : picture;
    if (other == shown())
        other = shading::kViewBaseColor;
    showOther(other);
}

void ViewState::setMode(ViewMode mode) {
    if (mode == m_mode)
        return;
    m_mode = mode;
    const ViewSettings before = m_settings;
    edit([&](ViewSettings& settings) {
        settings.shown = choice(settings.shown.kind);
        if (settings.split)
            settings.split->other = choice(settings.split->other.kind);
    });
    if (m_settings == before) // no view that is shown has one
        Q_EMIT changed();
}

void ViewState::setRange(ViewKind kind, const std::optional<render::ViewRange>& range) {
    if (range)
        m_ranges[kind] = *range;
    else
        m_ranges.erase(kind);
    edit([&](ViewSettings& settings) {
        if (settings.shown.kind == kind)
            settings.shown.range = range;
        if (settings.split && settings.split->other.kind == kind)
            settings.split->other.range = range;
    });
}

void ViewState::setMeasuredRanges(const std::optional<render::ViewRange>& shown,
                                  const std::optional<render::ViewRange>& other) {
    if (shown == m_shownRange && other == m_otherRange)
        return;
    m_shownRange = shown;
    m_otherRange = other;
    Q_EMIT rangeMeasured();
}

render::ViewRange ViewState::rangeOf(const render::ViewChoice& choice) const {
    if (choice.range)
        return *choice.range;
    const ViewInfo& info = viewInfo(choice.kind);
    const auto& measured = choice.kind == shown() ? m_shownRange : m_otherRange;
    if (info.automaticRange && measured)
        return *measured;
    return {info.rangeMin, info.rangeMax};
}

void ViewState::setPreparing(bool preparing) {
    if (preparing == m_preparing)
        return;
    m_preparing = preparing;
    Q_EMIT preparingChanged();
}

} // namespace patina::editor
