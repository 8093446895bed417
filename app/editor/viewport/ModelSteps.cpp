#include "app/editor/viewport/ModelSteps.h"

#include "app/editor/Actions.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SourceName.h"
#include "app/editor/widget/StatusHint.h"
#include "core/edit/EditSteps.h"

#include <QWidget>
#include <algorithm>
#include <memory>

namespace patina::editor {
namespace {

QString shownName(const SceneModelPart& model) {
    return model.source.empty() ? toQString(model.name) : sourceName(toQString(model.source));
}

} // namespace

ModelSteps::ModelSteps(DocumentController& controller, QWidget& viewport)
    : m_controller(controller)
    , m_viewport(viewport) {}

ModelSteps::Visibility ModelSteps::visibility() const {
    Visibility result;
    for (const MeshInstance& mesh : m_controller.document().meshes)
        result.emplace_back(mesh.id, mesh.visible);
    return result;
}

void ModelSteps::show(const Visibility& wanted) {
    m_controller.session().push(std::make_unique<ShowMeshesStep>(
        tr("Step Through Models").toStdString(), m_controller.document(), wanted, m_session));
    m_shown = visibility();
}

void ModelSteps::step(int by) {
    // Whatever else was hidden, added or undone meanwhile begins another walk.
    if (m_at == 0 || visibility() != m_shown) {
        m_at = 0;
        m_before = visibility();
        m_models = sceneModels(m_controller.document());
        m_session = m_controller.newDragSession();
    }
    if (m_models.size() < 2) {
        showHint(m_viewport, m_models.empty()
                                 ? tr("No model of the scene is visible")
                                 : tr("%1 is the only model of the scene that is visible")
                                       .arg(shownName(m_models.front())));
        return;
    }
    const auto places = static_cast<std::ptrdiff_t>(m_models.size()) + 1;
    m_at = static_cast<std::size_t>((static_cast<std::ptrdiff_t>(m_at) + by + places) % places);
    if (m_at == 0) {
        show(m_before);
        showHint(m_viewport, tr("All %1 models").arg(m_models.size()));
        return;
    }
    const SceneModelPart& model = m_models[m_at - 1];
    Visibility alone = m_before;
    for (auto& [mesh, visible] : alone)
        visible = std::ranges::find(model.meshes, mesh) != model.meshes.end();
    show(alone);
    showHint(
        m_viewport,
        tr("%1 of %2: %3 (Esc shows all)").arg(m_at).arg(m_models.size()).arg(shownName(model)));
}

bool ModelSteps::showAll() {
    if (m_at == 0 || visibility() != m_shown)
        return false;
    m_at = 0;
    show(m_before);
    showHint(m_viewport, tr("All %1 models").arg(m_models.size()));
    return true;
}

void ModelSteps::connectActions(const Actions& actions) {
    m_viewport.addActions({actions.nextModel, actions.previousModel});
    QObject::connect(actions.nextModel, &QAction::triggered, &m_viewport, [this] { step(1); });
    QObject::connect(actions.previousModel, &QAction::triggered, &m_viewport, [this] { step(-1); });
}

} // namespace patina::editor
