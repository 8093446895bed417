// Whose rays the Ray Tree dock and the viewport show: a pixel of the classical ray tracer's picture
// that was clicked. The rays stay where they are while the camera moves, and are traced anew when
// the scene changes.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/RayTree.h"
#include "core/trace/whitted/WhittedSettings.h"

#include <QObject>
#include <QPointF>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;
class PathView;

class RayTreeProbe : public QObject {
    Q_OBJECT
  public:
    RayTreeProbe(DocumentController& controller, PathView& paths, QObject* parent = nullptr);

    // Whether the dock is seen: without, clicks are not followed, and no rays shown.
    void setWanted(bool wanted);
    [[nodiscard]] bool isWanted() const { return m_wanted; }
    // A click means a pixel: there is a classical picture.
    [[nodiscard]] bool picks() const;
    void pick(const QPointF& at); // of the picture, each in 0…1 from the upper left
    void clear();

    struct Shown {
        RayTree tree;
        std::vector<glm::vec3> subtotals;
        TraceView view;
        glm::ivec2 pixel{0};
    };
    [[nodiscard]] const std::shared_ptr<const Shown>& shown() const { return m_shown; } // or null

    // A node of the tree; RayNode::kNone: none.
    void select(int node);
    [[nodiscard]] int selected() const { return m_selected; }
    // The camera ray of a node, among the nodes; of none the one that adds most.
    [[nodiscard]] int cameraRayOf(int node) const;

  Q_SIGNALS:
    void changed(); // the tree, whether it is wanted, whether a click means a pixel
    void selectionChanged();

  private:
    void follow();
    void trace();

    DocumentController& m_controller;
    PathView& m_paths;
    bool m_wanted = false, m_couldPick = false;
    struct Pick {
        TraceView view; // from where
        glm::ivec2 pixel{0};
    };
    std::optional<Pick> m_pick;
    std::shared_ptr<const TraceScene> m_scene; // that the tree is of, and …
    WhittedSettings m_settings;                // … how it was traced
    std::shared_ptr<const Shown> m_shown;
    int m_selected = RayNode::kNone;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
