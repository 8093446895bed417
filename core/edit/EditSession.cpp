#include "core/edit/EditSession.h"

#include "core/base/Check.h"
#include "core/edit/EditSteps.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {

void EditSession::replace(Document document) {
    CHECK(m_group == nullptr);
    m_document = std::move(document);
    m_steps.clear();
    m_index = 0;
    ++m_documents;
    ++m_history;
    m_firstFreeId = m_document.nextId;
    m_saved = state();
    historyChanged();
    announce(Change::everything());
}

// --- History -------------------------------------------------------------------------------------

void EditSession::apply(EditStep& step, bool forward) {
    Change change = step.swap(m_document, forward);
    if (m_observer)
        change.affects = change.affects | m_observer->derive(m_document);
    announce(change);
}

void EditSession::announce(const Change& change) {
    ++m_revision;
    if (m_observer)
        m_observer->documentChanged(change);
}

void EditSession::historyChanged() {
    if (m_observer)
        m_observer->historyChanged();
}

void EditSession::undo() {
    if (!canUndo())
        return;
    EditStep& step = *m_steps[static_cast<std::size_t>(m_index - 1)];
    m_step = step.m_stateBefore;
    apply(step, false);
    --m_index;
    historyChanged();
}

void EditSession::redo() {
    if (!canRedo())
        return;
    EditStep& step = *m_steps[static_cast<std::size_t>(m_index)];
    m_step = step.m_stateAfter;
    apply(step, true);
    ++m_index;
    historyChanged();
}

void EditSession::goTo(int index) {
    index = std::clamp(index, 0, count());
    while (m_index > index)
        undo();
    while (m_index < index)
        redo();
}

std::string EditSession::undoText() const {
    return canUndo() ? m_steps[static_cast<std::size_t>(m_index - 1)]->text() : std::string();
}

std::string EditSession::redoText() const {
    return canRedo() ? m_steps[static_cast<std::size_t>(m_index)]->text() : std::string();
}

EditSession::HistoryEntry EditSession::historyEntry(int index) const {
    CHECK(index >= 0 && index <= count());
    if (index == 0)
        return {{}, {}, {m_history, m_steps.empty() ? m_step : m_steps.front()->m_stateBefore, {}}};
    const EditStep& step = *m_steps[static_cast<std::size_t>(index - 1)];
    return {step.text(), step.values(), {m_history, step.m_stateAfter, {}}};
}

void EditSession::clearHistory() {
    m_steps.clear();
    m_index = 0;
    historyChanged();
}

DocumentState EditSession::state() const {
    return {m_history, m_step, m_document.bakes};
}

void EditSession::setSaved(const DocumentState& state) {
    m_saved = state;
    historyChanged();
}

void EditSession::forgetSaved() {
    m_saved.history = 0; // no document's
    historyChanged();
}

int EditSession::unsavedSteps() const {
    if (m_saved.history != m_history)
        return 0;
    for (int index = m_index - 1; index >= 0; --index)
        if (m_steps[static_cast<std::size_t>(index)]->m_stateBefore == m_saved.step)
            return m_index - index;
    for (int index = m_index; index < count(); ++index)
        if (m_steps[static_cast<std::size_t>(index)]->m_stateAfter == m_saved.step)
            return index + 1 - m_index;
    return 0;
}

std::size_t EditSession::historyBytes() const {
    std::size_t bytes = 0;
    for (const auto& step : m_steps)
        bytes += step->payloadBytes();
    return bytes;
}

void EditSession::dropOldest(std::size_t most) {
    std::size_t bytes = historyBytes();
    int dropped = 0;
    while (bytes > most && dropped < m_index)
        bytes -= m_steps[static_cast<std::size_t>(dropped++)]->payloadBytes();
    if (dropped == 0)
        return;
    m_steps.erase(m_steps.begin(), m_steps.begin() + dropped);
    m_index -= dropped;
    historyChanged();
    if (m_observer)
        m_observer->stepsDropped();
}

void EditSession::makeRoomFor(std::size_t payloadBytes) {
    if (payloadBytes == 0)
        return;
    m_steps.resize(static_cast<std::size_t>(m_index)); // what could be redone goes with the step
    dropOldest(m_limits.payloadBytes - std::min(m_limits.payloadBytes, payloadBytes));
}

void EditSession::push(std::unique_ptr<EditStep> step) {
    if (m_group) {
        apply(*step, true);
        m_group->add(std::move(step));
        return;
    }
    makeRoomFor(step->payloadBytes());
    step->m_mergeMark = m_mergeMark;
    step->m_stateBefore = m_step;
    step->m_stateAfter = ++m_lastStep;
    m_step = step->m_stateAfter;
    apply(*step, true);

    m_steps.resize(static_cast<std::size_t>(m_index)); // what could be redone
    EditStep* last = m_steps.empty() ? nullptr : m_steps.back().get();
    if (last && last->m_mergeMark == step->m_mergeMark && last->merge(*step)) {
        last->m_stateAfter = step->m_stateAfter;
        if (last->isEmpty()) {
            m_step = last->m_stateBefore;
            m_steps.pop_back();
        }
    } else {
        m_steps.push_back(std::move(step));
        if (count() > m_limits.steps)
            m_steps.erase(m_steps.begin());
    }
    m_index = count();
    historyChanged();
}

void EditSession::pushOrApply(std::unique_ptr<EditStep> step) {
    if (!canRedo()) {
        push(std::move(step));
        return;
    }
    ++m_history;
    apply(*step, true);
    historyChanged();
}

void EditSession::group(const std::string& text, const std::function<void()>& edits) {
    if (m_group) {
        edits();
        return;
    }
    auto group = std::make_unique<GroupStep>(text);
    const std::uint64_t before = m_step;
    m_group = group.get();
    edits();
    m_group = nullptr;
    if (group->isEmpty())
        return;
    makeRoomFor(group->payloadBytes());
    group->m_mergeMark = m_mergeMark;
    group->m_stateBefore = before;
    m_step = group->m_stateAfter = ++m_lastStep;
    m_steps.resize(static_cast<std::size_t>(m_index));
    m_steps.push_back(std::move(group));
    m_index = count();
    historyChanged();
}

// --- Parameters ----------------------------------------------------------------------------------

void EditSession::setParameter(const ParameterInfo& info, const Target& target,
                               const ParameterValue& value, DragSession session) {
    CHECK(info.scope == target.scope);
    if (!targetExists(m_document, target))
        return;
    const bool isOnlyOne =
        info.ofScene || (info.scope == Scope::Environment && m_document.environments.size() == 1);
    const std::string name = isOnlyOne ? std::string() : nameOf(m_document, target);
    const std::string text = name.empty() ? fmt::format("Change {}", info.label)
                                          : fmt::format("Change {} of {}", info.label, name);
    const std::vector<ParameterEdit> edits = editsFor(m_document, info, target, value);
    if (info.onSet) // always the same parameters, so that edits of one session merge
        setParameters(target, edits, text, session);
    else
        setDiffering(target, edits, text, session);
}

void EditSession::setDiffering(const Target& target, const std::vector<ParameterEdit>& edits,
                               const std::string& text, DragSession session) {
    if (!targetExists(m_document, target))
        return;
    std::vector<ParameterEdit> after;
    for (const ParameterEdit& edit : edits) {
        ParameterValue value = clampToRange(*edit.info, edit.value);
        if (!leadsSomewhere(m_document, *edit.info, value))
            return;
        if (value != edit.info->get(m_document, target.id))
            after.push_back({edit.info, std::move(value)});
    }
    if (!after.empty())
        push(std::make_unique<SetParametersStep>(text, m_document, target, std::move(after),
                                                 session));
}

void EditSession::setParameters(const Target& target, const std::vector<ParameterEdit>& edits,
                                const std::string& text, DragSession session) {
    if (!targetExists(m_document, target))
        return;
    std::vector<ParameterEdit> after;
    bool differs = false;
    for (const ParameterEdit& edit : edits) {
        after.push_back({edit.info, clampToRange(*edit.info, edit.value)});
        if (!leadsSomewhere(m_document, *edit.info, after.back().value))
            return;
        differs = differs || after.back().value != edit.info->get(m_document, target.id);
    }
    if (differs)
        push(std::make_unique<SetParametersStep>(text, m_document, target, std::move(after),
                                                 session));
}

// --- What is no step -----------------------------------------------------------------------------

void EditSession::renewBake(const BakeArtifactPtr& before, BakeArtifactPtr after) {
    const auto found = std::find(m_document.bakes.begin(), m_document.bakes.end(), before);
    if (found == m_document.bakes.end())
        return;
    *found = std::move(after);
    announce({Affects::Bakes, std::nullopt});
    historyChanged();
}

void EditSession::setCamera(const Camera& camera) {
    if (camera == m_document.view.camera)
        return;
    m_document.view.camera = camera;
    announce({Affects::Nothing, Target{Scope::View, 0}});
}

void EditSession::setEnvironmentImage(Id environment, const ImagePtr& image) {
    Environment* made = m_document.environment(environment);
    if (!made)
        return;
    made->image = image;
    if (m_observer)
        m_observer->derive(m_document);
    announce({Affects::EnvironmentMap, Target{Scope::Environment, 0}});
}

void EditSession::setBlendedImage(const ImagePtr& image) {
    m_document.mix.blended = image;
    announce({Affects::EnvironmentMap, Target{Scope::Environment, 0}});
}

const ParameterInfo& parameter(std::string_view id) {
    const ParameterInfo* info = findParameter(id);
    CHECK(info != nullptr);
    return *info;
}

} // namespace patina
