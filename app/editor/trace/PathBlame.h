// Which shortcut of the drawn picture makes how much of its error: traced in the background at
// reduced size, beside the traced picture, while the error is shown.
#pragma once

#include "core/document/View.h"
#include "core/job/TaskRunner.h"
#include "core/trace/blame/Blame.h"

#include <QObject>
#include <QPointF>
#include <QSize>
#include <QString>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace patina::editor {

class DocumentController;
class PathError;
class PathView;

class PathBlame : public QObject {
    Q_OBJECT
  public:
    PathBlame(DocumentController& controller, PathView& paths, PathError& error,
              QObject* parent = nullptr);

    // --- The drawn terms, which the viewport brings (render/TermPictures.h) ----------------------
    [[nodiscard]] bool wantsTerms() const;
    // Another one for each picture that they are wanted of.
    using Wanted = std::pair<std::uint64_t, std::uint64_t>;
    [[nodiscard]] Wanted wantedTerms() const { return m_of; }
    [[nodiscard]] QSize size() const { return m_size; } // of these and of what is found, in pixels
    void setTerms(DrawnTerms terms);

    // --- What was found --------------------------------------------------------------------------
    struct Found {
        Blame blame;
        std::shared_ptr<const std::vector<Id>> materials; // seenMaterials()
        std::uint32_t samples = 0;                        // per pixel
    };
    // The newest of the present picture; null: none yet.
    [[nodiscard]] const std::shared_ptr<const Found>& found() const { return m_found; }
    // Of the material at a position, 0…1 from the top left, or of the picture where there is none.
    // `found()` is there.
    [[nodiscard]] const BlameScore& scoreAt(const std::optional<QPointF>& position) const;
    // Of the pixels of that material next to the position, kAround to each side; nothing where no
    // surface is seen, or no position is given.
    static constexpr int kAround = 2;
    [[nodiscard]] std::optional<BlameScore> hereAt(const std::optional<QPointF>& position) const;
    // Why there is none and will not be; empty: there will.
    [[nodiscard]] const QString& problem() const { return m_problem; }
    [[nodiscard]] bool isOn() const; // it is wanted

  Q_SIGNALS:
    void changed();
    void termsWanted();

  private:
    struct Work; // of one task at a time
    [[nodiscard]] std::optional<QPoint> pixelAt(const std::optional<QPointF>& position) const;
    [[nodiscard]] Id materialAt(const QPoint& pixel) const;
    void follow();
    void reset();
    void trace();
    static Result<std::shared_ptr<const Found>> work(Work& work, std::uint32_t samples,
                                                     const JobContext& job);

    DocumentController& m_controller;
    PathView& m_paths;
    PathError& m_error;
    Wanted m_of{0, 0}; // the picture that all of this is of
    QSize m_size;
    QString m_problem;
    std::shared_ptr<Work> m_work; // null: there are no terms yet
    std::size_t m_pass = 0;
    std::shared_ptr<const Found> m_found;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
