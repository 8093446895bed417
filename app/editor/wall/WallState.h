// The wall in the viewport: what it compares, the cells that makes of the document, which of them
// is current or enlarged. Like a view it is no part of the document: never undone, never saved.
#pragma once

#include "core/cells/OwnValues.h"
#include "core/cells/WallPlan.h"

#include <QObject>
#include <QString>
#include <optional>
#include <vector>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;

class WallState : public QObject {
    Q_OBJECT
  public:
    explicit WallState(DocumentController& controller, QObject* parent = nullptr);

    // Off: the viewport shows one picture. The first time it compares defaultWallPlan().
    void setOn(bool on);
    [[nodiscard]] bool isOn() const { return m_on; }
    void setPlan(const WallPlan& plan);
    [[nodiscard]] const WallPlan& plan() const { return m_plan; }

    // Of the document as it is. Empty while it is off, and where there is a problem.
    [[nodiscard]] const Wall& wall() const { return m_wall; }
    [[nodiscard]] const std::vector<WallCell>& cells() const { return m_cells; }
    [[nodiscard]] const QString& problem() const { return m_problem; } // why there is no wall
    [[nodiscard]] const DocumentController& controller() const { return m_controller; }

    [[nodiscard]] std::optional<std::size_t> current() const { return m_current; }
    void setCurrent(std::optional<std::size_t> cell);
    void moveCurrent(int columns, int rows); // stays on the wall
    // The one that fills the viewport; nothing: all are shown.
    [[nodiscard]] std::optional<std::size_t> enlarged() const { return m_enlarged; }
    void enlarge(std::optional<std::size_t> cell);
    // The one that the enlarged one is compared with, in its place; nothing: none. Setting it
    // enlarges the current cell, or the first one.
    [[nodiscard]] std::optional<std::size_t> compared() const { return m_compared; }
    void compareWith(std::optional<std::size_t> cell);
    void swapCompared(); // the other one becomes the current one
    // Gives cells an environment, material or snapshot of their own, or takes it away again (0).
    void setOwnElement(const std::vector<WallCell>& cells, CellElement element, Id id);
    // Gives the current cell a value of its own, or takes it away again.
    void setOwnValue(const CellEdit& value);
    void linkValue(const Target& target, const ParameterInfo& info);
    // Makes the scene what the current cell shows, as one step.
    void useInScene();

    // What stands in a cell's place until it has a picture, or why it has none.
    void setTexts(std::vector<QString> texts);
    [[nodiscard]] QString text(std::size_t cell) const;

  Q_SIGNALS:
    void changed();      // on or off, the plan, what cells there are
    void cellsChosen();  // current(), enlarged() or compared()
    void textsChanged(); // text()
    void ownChanged();   // own values of a cell; cells() are those they were otherwise

  private:
    void follow(const Change& change);
    void make(); // the wall of the document; changed() where it is another one

    DocumentController& m_controller;
    bool m_on = false, m_planned = false;
    WallPlan m_plan;
    Wall m_wall;
    std::vector<OwnValues> m_own;
    std::vector<WallCell> m_cells;
    QString m_problem;
    std::optional<std::size_t> m_current, m_enlarged, m_compared;
    std::vector<QString> m_texts;
};

} // namespace patina::editor
