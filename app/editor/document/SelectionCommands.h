// Commands for what is selected: remove, duplicate, put in place. Their keys work in the viewport
// and in the lists that show the selection.
#pragma once

#include "core/edit/Parameters.h"

#include <QObject>
#include <QWidget>
#include <initializer_list>
#include <optional>

namespace patina::editor {

class Actions;
class DocumentController;
class SelectionModel;

class SelectionCommands : public QObject {
    Q_OBJECT
  public:
    // `viewport`: there keys remove and duplicate meshes and lights alone, as materials are not
    // seen in it. `lists` show what is selected.
    SelectionCommands(DocumentController& controller, SelectionModel& selection,
                      const Actions& actions, QWidget& viewport,
                      std::initializer_list<QWidget*> lists, QObject* parent);

    void remove();
    void duplicate();
    void dropToGround(); // the selected mesh, or its whole model; without one, all that is visible
    void backInPlace();

  private:
    void refresh();
    // What a key means; nothing, with `hint`, where nothing is selected or it is not seen.
    [[nodiscard]] std::optional<Target> meant(const QString& hint) const;

    DocumentController& m_controller;
    SelectionModel& m_selection;
    const Actions& m_actions;
    QWidget& m_viewport;
};

} // namespace patina::editor
