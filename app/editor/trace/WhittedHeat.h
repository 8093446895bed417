// What the pixels of the classical picture take, counted in the background once the picture is
// done: rays, depth, tests with a hierarchy of boxes and without; and the boxes themselves.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/trace/path/TraceScene.h"
#include "core/trace/whitted/RayCountImages.h"
#include "core/trace/whitted/TeachingHierarchy.h"

#include <QImage>
#include <QObject>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;
class PathView;

class WhittedHeat : public QObject {
    Q_OBJECT
  public:
    WhittedHeat(DocumentController& controller, PathView& paths, QObject* parent = nullptr);

    void setShown(std::optional<RayCountKind> shown); // nothing: the picture
    [[nodiscard]] const std::optional<RayCountKind>& shown() const { return m_shown; }
    void setLevel(std::optional<int> level); // whose boxes are drawn; nothing: none
    [[nodiscard]] const std::optional<int>& level() const { return m_level; }
    [[nodiscard]] bool isOn() const; // either is asked for, and there is a classical picture

    struct Counted {
        bool coarse = true; // of every fourth pixel of every fourth row; there is more to come
        RayCountMap map{0, 0};
        int width = 0, height = 0;
        std::shared_ptr<const TraceScene> scene;
        std::shared_ptr<const TeachingHierarchy> hierarchy; // null: a scene without triangles
        int deepestLevel = 0;                               // that has kMostBoxes at most
        double boxTests = 0.0, triangleTests = 0.0;         // of a ray, on the average
        [[nodiscard]] std::size_t triangles() const {
            return hierarchy ? hierarchy->triangleCount() : 0;
        }
    };
    // Of the present picture; null: none yet.
    [[nodiscard]] std::shared_ptr<const Counted> counted() const;

    // What is shown, in colours, and what their ends stand for; null: nothing.
    struct Picture {
        QImage image;
        double most = 0.0, mean = 0.0; // most: of all pixels but the 0.5 % that took most
    };
    [[nodiscard]] const std::optional<Picture>& picture() const { return m_picture; }
    // Those of the level, or of the deepest one that is drawn.
    [[nodiscard]] std::vector<TeachingHierarchy::Box> boxes() const;

    static constexpr std::size_t kMostBoxes = 4096;

  Q_SIGNALS:
    void changed();

  private:
    void follow();
    void paint();

    PathView& m_paths;
    std::optional<RayCountKind> m_shown; // nothing: the picture
    std::optional<int> m_level;          // of boxes; nothing: none
    std::shared_ptr<const Counted> m_counted;
    std::uint64_t m_number = 0;   // PathView::number() that it is of …
    std::uint64_t m_counting = 0; // … and that is being counted
    std::optional<Picture> m_picture;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
