// The part of EditSession that keeps looks and returns to them.

#include "core/base/Utf8.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/edit/EditSteps.h"
#include "core/edit/LookDifference.h"
#include "core/edit/Looks.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>

namespace patina {
namespace {

template <class Element>
std::vector<Id> idsOf(const std::vector<Element>& elements) {
    std::vector<Id> ids;
    ids.reserve(elements.size());
    for (const Element& element : elements)
        ids.push_back(element.id);
    return ids;
}

// Whether the two have the same elements, so that only values differ.
bool sameStructure(const Document& a, const Document& b) {
    const auto softboxes = [](const Document& document) {
        std::vector<std::vector<Id>> ids;
        for (const Environment& environment : document.environments)
            ids.push_back(idsOf(environment.softboxes));
        return ids;
    };
    return idsOf(a.materials) == idsOf(b.materials) && idsOf(a.lights) == idsOf(b.lights) &&
           idsOf(a.environments) == idsOf(b.environments) && softboxes(a) == softboxes(b);
}

// Everything of a look that the element has, as edits.
std::vector<ParameterEdit> lookEdits(const Document& document, const Target& target) {
    const bool ofScene = target.scope == Scope::Environment && target.id == 0;
    std::vector<ParameterEdit> edits;
    for (const ParameterInfo& info : parameters())
        if (info.scope == target.scope && info.ofScene == ofScene && isOfLook(info))
            edits.push_back({&info, info.get(document, target.id)});
    return edits;
}

bool differsIn(const Document& a, const Document& b, const Target& target) {
    return std::ranges::any_of(lookEdits(a, target), [&](const ParameterEdit& edit) {
        return edit.value != edit.info->get(b, target.id);
    });
}

} // namespace

Id EditSession::keepSnapshot(std::string_view name, const ImagePtr& picture) {
    if (m_document.snapshots.size() >= kMaxSnapshots)
        return 0;
    Snapshot snapshot;
    snapshot.id = std::max(m_document.nextId, m_firstFreeId);
    m_firstFreeId = snapshot.id + 1;
    snapshot.name = uniqueSnapshotName(m_document, makeValidUtf8(name));
    // What the newest one has alike is shared with it.
    snapshot.look =
        lookOf(m_document,
               m_document.snapshots.empty() ? nullptr : m_document.snapshots.back().look.get());
    snapshot.picture = picture;
    std::vector<Snapshot> after = m_document.snapshots;
    const Id id = snapshot.id;
    const std::string text = fmt::format("Keep {}", snapshot.name);
    after.push_back(std::move(snapshot));
    push(std::make_unique<ReplaceSnapshotsStep>(text, m_document, std::move(after), id + 1));
    return id;
}

void EditSession::renameSnapshot(Id id, std::string_view name) {
    std::vector<Snapshot> after = m_document.snapshots;
    const auto found = std::ranges::find(after, id, &Snapshot::id);
    const std::string valid = makeValidUtf8(name);
    if (valid.empty() || found == after.end() || found->name == valid)
        return;
    const std::string text = fmt::format("Rename {}", found->name);
    found->name = uniqueSnapshotName(m_document, valid);
    push(std::make_unique<ReplaceSnapshotsStep>(text, m_document, std::move(after),
                                                m_document.nextId));
}

void EditSession::removeSnapshot(Id id) {
    std::vector<Snapshot> after = m_document.snapshots;
    const auto found = std::ranges::find(after, id, &Snapshot::id);
    if (found == after.end())
        return;
    const std::string text = fmt::format("Remove {}", found->name);
    after.erase(found);
    push(std::make_unique<ReplaceSnapshotsStep>(text, m_document, std::move(after),
                                                m_document.nextId));
}

void EditSession::setSnapshotPicture(Id id, const ImagePtr& picture) {
    const auto found = std::ranges::find(m_document.snapshots, id, &Snapshot::id);
    if (found == m_document.snapshots.end())
        return;
    found->picture = picture;
    announce({Affects::Structure, std::nullopt});
}

void EditSession::restoreSnapshot(Id id) {
    const Snapshot* snapshot = m_document.snapshot(id);
    if (snapshot == nullptr)
        return;
    const LookPtr look = snapshot->look;
    restoreLook(*look, differencesOf(*look, *lookOf(m_document, look.get())),
                fmt::format("Restore {}", snapshot->name));
}

void EditSession::restoreLook(const Look& look, const std::vector<LookDifference>& differences,
                              const std::string& text) {
    Document after = m_document;
    patina::restoreLook(after, look, differences);
    std::vector<Target> targets{{Scope::View, 0}, {Scope::Model, 0}, {Scope::Environment, 0}};
    if (!sameStructure(m_document, after)) {
        // The lists as a whole; view, background and model are in none of them.
        group(text, [&] {
            editStructure(text, [&](Document& document) {
                document.materials = after.materials;
                document.lights = after.lights;
                document.environments = after.environments;
                document.meshes = after.meshes;
                document.mix = after.mix;
            });
            for (const Target& target : targets)
                setDiffering(target, lookEdits(after, target), text);
        });
        return;
    }
    for (const LookDifference& one : differences)
        if (std::ranges::find(targets, one.target) == targets.end())
            targets.push_back(one.target);
    std::erase_if(targets, [&](const Target& target) {
        return !targetExists(after, target) || !differsIn(m_document, after, target);
    });
    const auto set = [&](const Target& target) {
        setDiffering(target, lookEdits(after, target), text);
    };
    if (targets.size() == 1) // a step that says its values
        set(targets.front());
    else
        group(text, [&] { std::ranges::for_each(targets, set); });
}

} // namespace patina
