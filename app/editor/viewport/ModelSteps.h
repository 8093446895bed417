// Steps through the models of the scene, one of them shown at a time: the others are hidden as the
// Scene dock hides them. All steps of such a walk are one undo step, and none once all are shown
// again.
#pragma once

#include "core/document/SceneModels.h"
#include "core/edit/EditStep.h"

#include <QCoreApplication>
#include <cstddef>
#include <utility>
#include <vector>

class QWidget;

namespace patina::editor {

class Actions;
class DocumentController;

class ModelSteps {
    Q_DECLARE_TR_FUNCTIONS(ModelSteps)
  public:
    // Says in the status bar of `viewport`'s window which one is shown.
    ModelSteps(DocumentController& controller, QWidget& viewport);

    // To the next model (1) or the one before (-1); behind the last, and before the first, all.
    void step(int by);
    bool showAll(); // false: they are shown

    // Shift+Page Down and Shift+Page Up in the viewport.
    void connectActions(const Actions& actions);

  private:
    using Visibility = std::vector<std::pair<Id, bool>>; // of all meshes, in their order
    [[nodiscard]] Visibility visibility() const;
    void show(const Visibility& wanted);

    DocumentController& m_controller;
    QWidget& m_viewport;
    DragSession m_session = 0;
    Visibility m_before, m_shown; // when the walk began; as the last step left it
    std::vector<SceneModelPart> m_models;
    std::size_t m_at = 0; // 0: all, else one more than the place in m_models
};

} // namespace patina::editor
