// What the current cell of the wall has of its own: its environment, values, and a button elsewhere
// that chooses which. Seen while there are any.
#pragma once

#include "core/cells/OwnValues.h"

#include <QWidget>
#include <vector>

class QComboBox;
class QHBoxLayout;
class QMenu;
class QToolButton;

namespace patina::editor {

class DocumentController;
class FlowLayout;
class WallState;

class OwnValueControls : public QWidget {
    Q_OBJECT
  public:
    OwnValueControls(WallState& wall, DocumentController& controller, QWidget* parent = nullptr);
    [[nodiscard]] QToolButton* button() const { return m_add; } // for the caller's layout
    void refresh();

  private:
    void fillMenu();
    void addEnvironment(Id shown); // to the menu
    void addParameters(QMenu& menu, const QString& title, const Target& target,
                       const Document& shown);
    void makeFields();
    // A field's row, begun with its label; its end adds the button that links it again.
    [[nodiscard]] QHBoxLayout* startField(const QString& label);
    template <class Link>
    void endField(const QString& label, Link unlinked);
    void addField(const CellEdit& edit);
    void addEnvironmentField();
    void fillEnvironments(Id shown);
    [[nodiscard]] Id shownEnvironment() const; // the current cell's own; 0: none
    [[nodiscard]] const std::vector<CellEdit>& shownValues() const; // of the current cell

    WallState& m_wall;
    DocumentController& m_controller;
    FlowLayout* m_row;
    QMenu* m_menu;
    QToolButton* m_add;
    std::vector<QWidget*> m_fields;
    QComboBox* m_environment = nullptr; // of the first field, where the cell has one of its own
    Cell m_of;                          // whose values the fields are
    std::vector<CellEdit> m_values;     // that they are made for
};

// "Rotation 45°", "Tone curve ACES".
[[nodiscard]] QString ownValueText(const CellEdit& edit);

} // namespace patina::editor
