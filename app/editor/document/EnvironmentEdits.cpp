// The part of DocumentController that edits generated environments.

#include "app/editor/document/Commands.h"
#include "app/editor/document/DocumentController.h"
#include "core/library/SoftboxRigs.h"

namespace patina::editor {
namespace {

void setUp(Document& document, const library::SoftboxRig& rig) {
    document.environment.softboxes.clear();
    for (const Softbox& softbox : rig.softboxes)
        patina::addSoftbox(document, softbox);
}

} // namespace

void DocumentController::setEnvironmentKind(EnvironmentKind kind) {
    if (kind == m_document.environment.kind)
        return;
    const ParameterInfo& info = parameter("environment.kind");
    const QString title =
        QString::fromUtf8(info.choiceLabels[static_cast<std::size_t>(kind)].data());
    // A dark room would look like a fault: the first rig comes along, in the same step.
    const bool empty =
        kind == EnvironmentKind::Softboxes && m_document.environment.softboxes.empty();
    const QString text = tr("Light with %1").arg(title);
    if (empty) {
        m_undo.beginMacro(text);
        setSoftboxRig(library::softboxRigs().front());
    }
    pushParameters({Scope::Environment, 0}, {{&info, static_cast<int>(kind)}}, 0, text);
    if (empty)
        m_undo.endMacro();
}

void DocumentController::setSoftboxRig(const library::SoftboxRig& rig) {
    editStructure(tr("Set Up %1").arg(QString::fromStdString(rig.title)),
                  [&](Document& document) { setUp(document, rig); });
}

Id DocumentController::addSoftbox(float azimuthDeg, float elevationDeg) {
    if (m_document.environment.softboxes.size() >= kMaxSoftboxes)
        return 0;
    Softbox softbox;
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    Id id = 0;
    editStructure(tr("Add Softbox"),
                  [&](Document& document) { id = patina::addSoftbox(document, softbox); });
    return id;
}

Id DocumentController::duplicateSoftbox(Id original) {
    const Softbox* softbox = m_document.softbox(original);
    if (!softbox || m_document.environment.softboxes.size() >= kMaxSoftboxes)
        return 0;
    Id id = 0;
    editStructure(tr("Duplicate %1").arg(nameText({Scope::Softbox, original})),
                  [&](Document& document) {
                      id = patina::duplicateSoftbox(document, original);
                      // Beside the original, where it is seen. Azimuths wrap at 180°.
                      Softbox& copy = *document.softbox(id);
                      const ParameterInfo& azimuth = parameter("softbox.azimuthDeg");
                      azimuth.set(document, id,
                                  clampToRange(azimuth, copy.azimuthDeg - 0.5f * copy.widthDeg));
                  });
    return id;
}

void DocumentController::removeSoftbox(Id id) {
    if (m_document.softbox(id))
        editStructure(tr("Remove %1").arg(nameText({Scope::Softbox, id})),
                      [id](Document& document) { patina::removeSoftbox(document, id); });
}

} // namespace patina::editor
