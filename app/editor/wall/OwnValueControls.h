// What the current cell of the wall has of its own: the values, and a button elsewhere that chooses
// which. Seen while there are any.
#pragma once

#include "core/cells/OwnValues.h"

#include <QWidget>
#include <vector>

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
    void addParameters(QMenu& menu, const QString& title, const Target& target,
                       const Document& shown);
    void makeFields();
    void addField(const CellEdit& edit);
    [[nodiscard]] const std::vector<CellEdit>& shownValues() const; // of the current cell

    WallState& m_wall;
    DocumentController& m_controller;
    FlowLayout* m_row;
    QMenu* m_menu;
    QToolButton* m_add;
    std::vector<QWidget*> m_fields;
    Cell m_of;                      // whose values the fields are
    std::vector<CellEdit> m_values; // that they are made for
};

// "Rotation 45°", "Tone curve ACES".
[[nodiscard]] QString ownValueText(const CellEdit& edit);

} // namespace patina::editor
