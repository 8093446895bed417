// Environments, files or built-in skies, that are dropped onto a wall: onto the caption or a cell
// of an environment they take its place, elsewhere they light the cell, or the cells of the column
// or row, alone.
#pragma once

#include "core/base/Id.h"

#include <QPointF>
#include <QRect>
#include <QStringList>
#include <cstddef>
#include <vector>

namespace patina::editor {

class DocumentController;
class WallOverlay;
class WallState;

struct WallDropPlan {
    struct Part {
        QString file;
        Id replaces = 0;                // an environment of the scene, or …
        std::vector<std::size_t> cells; // … those it lights; none: it is only added to the scene
    };
    std::vector<Part> parts; // none: the wall does not take these files here
    QRect area;              // of the cells, in the viewport
    QStringList lines;       // what it will do, a line for each file
};

class WallDrop {
  public:
    WallDrop(WallState& wall, DocumentController& controller, const WallOverlay& overlay);

    // `position` in the viewport. Several files go to the cells that follow, those beyond the last
    // one are added to the scene. Files that are no environments, alone or among others, are not
    // for cells.
    [[nodiscard]] WallDropPlan plan(const QStringList& files, const QPointF& position) const;
    void drop(const WallDropPlan& plan);

  private:
    // That all of these cells have from their column or row; 0: none, or not the same.
    [[nodiscard]] Id sharedEnvironment(const std::vector<std::size_t>& cells) const;
    [[nodiscard]] QString lineOf(const WallDropPlan::Part& part) const;

    WallState& m_wall;
    DocumentController& m_controller;
    const WallOverlay& m_overlay;
};

} // namespace patina::editor
