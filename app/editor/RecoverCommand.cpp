#include "app/editor/RecoverCommand.h"

#include <QCoreApplication>
#include <map>
#include <utility>

namespace patina::editor {
namespace {

// The same part of the same file was read twice.
void shareMeshes(const Document& from, Document& to) {
    std::map<std::pair<std::string, int>, MeshPtr> known;
    for (const MeshInstance& instance : from.meshes)
        known[{instance.source, instance.sourceIndex}] = instance.mesh;
    for (MeshInstance& instance : to.meshes) {
        const auto found = known.find({instance.source, instance.sourceIndex});
        if (found != known.end() && found->second && instance.mesh &&
            *found->second == *instance.mesh)
            instance.mesh = found->second;
    }
}

} // namespace

RecoverCommand::RecoverCommand(DocumentController& controller, Document after)
    : DocumentCommand(controller,
                      QCoreApplication::translate("RecoverCommand", "Recover Unsaved Work"))
    , m_before(controller.document())
    , m_after(std::move(after)) {
    shareMeshes(m_before, m_after);
}

Change RecoverCommand::swap(Document& document, bool forward) {
    // What was prepared for the state that goes (a finer environment, light that bounced) goes on
    // with it.
    (forward ? m_before : m_after) = document;
    document = forward ? m_after : m_before;
    return {Affects::Structure | Affects::Geometry | Affects::Picture | Affects::EnvironmentMap |
                Affects::Bakes,
            std::nullopt};
}

} // namespace patina::editor
