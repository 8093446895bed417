// What the viewport shows of a traced picture: it, the drawn one, or how far the drawn one is from
// it, which is measured in the background while both become finer.
#pragma once

#include "core/document/View.h"
#include "core/job/TaskRunner.h"
#include "core/trace/error/PictureErrorMap.h"

#include <QImage>
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;
class PathView;

enum class PathPicture { Traced, Drawn, Exposure, Relative, Visible };

class PathError : public QObject {
    Q_OBJECT
  public:
    PathError(DocumentController& controller, PathView& paths, QObject* parent = nullptr);

    void setShown(PathPicture shown);
    [[nodiscard]] PathPicture shown() const { return m_shown; }
    void setPeeking(bool peeking); // at the drawn picture, as long as a key is held
    [[nodiscard]] bool isPeeking() const { return m_peeking; }
    // Of the pictures other than the traced one: whether they are asked for.
    [[nodiscard]] bool isOn() const;

    // --- The drawn picture, which the viewport brings --------------------------------------------
    // The scene, or what draws it, has become another one.
    void outdate();
    [[nodiscard]] bool wantsDrawn() const;
    // Grows with each picture that is wanted: one that was begun before is of no use.
    [[nodiscard]] std::uint64_t wantedDrawn() const { return m_wanted; }
    // F32, linear, of the traced picture's camera and size.
    void setDrawn(Image drawn);

    // --- What was measured -----------------------------------------------------------------------
    struct Measured {
        std::shared_ptr<const Image> drawn;
        std::shared_ptr<const TracedPicture> traced;
        PictureError error;
        QImage exposure, relative, visible, shownDrawn; // as they are displayed
    };
    // The newest of the present scene; null: none yet.
    [[nodiscard]] const std::shared_ptr<const Measured>& measured() const { return m_measured; }
    [[nodiscard]] const QString& problem() const { return m_problem; } // why there is none
    // What stands in the picture's place; null: nothing, or the traced one itself.
    [[nodiscard]] QImage picture() const;
    [[nodiscard]] const DocumentController& controller() const { return m_controller; }

  Q_SIGNALS:
    void changed(); // what is shown, what was measured
    void drawnWanted();

  private:
    void measure();
    static Result<std::shared_ptr<const Measured>> work(std::shared_ptr<const Image> drawn,
                                                        std::shared_ptr<const TracedPicture> traced,
                                                        const std::vector<Id>& materials,
                                                        const View& view, const JobContext& job);

    DocumentController& m_controller;
    PathView& m_paths;
    PathPicture m_shown = PathPicture::Traced;
    bool m_peeking = false;
    std::uint64_t m_wanted = 1, m_has = 0; // numbers of drawn pictures
    std::uint64_t m_ofTraced = 0;          // PathView::number() that the drawn one is of
    std::shared_ptr<const Image> m_drawn;
    std::shared_ptr<const Measured> m_measured;
    View m_measuredView; // of it
    QString m_problem;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
