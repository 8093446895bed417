// What the current cell of the wall has of its own: environment, material, snapshot, values; and a
// button elsewhere that chooses which. Seen while there are any.
#pragma once

#include "core/cells/OwnValues.h"

#include <QWidget>
#include <array>
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
    void addElements(const Document& cellDocument); // to the menu
    void addParameters(QMenu& menu, const QString& title, const Target& target,
                       const Document& shown);
    void makeFields();
    // A field's row, begun with its label; its end adds the button that links it again.
    [[nodiscard]] QHBoxLayout* startField(const QString& label);
    template <class Link>
    void endField(const QString& label, Link unlinked);
    void addField(const CellEdit& edit);
    void addElementField(CellElement element);
    void fillElements(QComboBox& box, CellElement element, Id shown);
    void setElement(CellElement element, Id id);     // of the current cell; 0: links it
    [[nodiscard]] const CellOwn& currentOwn() const; // of the current cell

    WallState& m_wall;
    DocumentController& m_controller;
    FlowLayout* m_row;
    QMenu* m_menu;
    QToolButton* m_add;
    std::vector<QWidget*> m_fields;
    std::array<QComboBox*, kCellElements.size()> m_elements{}; // null: it has none of its own
    Cell m_of;                                                 // whose values the fields are
    CellOwn m_made;                                            // that they are made for
};

[[nodiscard]] QString elementLabel(CellElement element); // "Material"
// Empty when it is no longer there.
[[nodiscard]] QString elementName(const Document& document, CellElement element, Id id);

// "Rotation 45°", "Tone curve ACES".
[[nodiscard]] QString ownValueText(const CellEdit& edit);

} // namespace patina::editor
