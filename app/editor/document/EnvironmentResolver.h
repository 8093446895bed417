// Keeps a document's environment image what its kind asks for, and the picture of two environments
// what the mix asks for: while they are edited a draft is made at once, and the full picture
// follows in the background.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"

#include <QObject>
#include <QTimer>
#include <deque>

namespace patina::editor {

class EnvironmentResolver : public QObject {
    Q_OBJECT
  public:
    explicit EnvironmentResolver(TaskRunner& runner, QObject* parent = nullptr);

    // Another document, whose images are as they should be.
    void reset(const Document& document);
    // After an edit: gives the environment its images, in a few milliseconds. Whether another one
    // than before is shown.
    bool update(Document& document);

  Q_SIGNALS:
    // The full picture for what update() saw last: of the first environment, or of both.
    void refined(const patina::ImagePtr& image);
    void blended(const patina::ImagePtr& image);

  private:
    bool updateImage(Environment& environment);
    bool updateBlend(Document& document);
    [[nodiscard]] ImagePtr draftOf(const ImagePtr& image);
    void change();
    void refine();
    void deliver(const ImagePtr& image);

    struct Made {
        EnvironmentRecipe recipe;
        ImagePtr image;
    };
    struct Draft {
        ImagePtr image, small;
    };
    QTimer m_rest;              // until nothing has changed for a moment
    EnvironmentRecipe m_recipe; // of the environment's image
    std::deque<Made> m_made;    // the last full pictures, for undo and redo
    std::optional<EnvironmentBlend> m_blend;
    std::deque<Draft> m_drafts;
    ImagePtr m_shown;
    bool m_imageIsDraft = false, m_blendIsDraft = false;
    TaskGroup m_tasks;
};

} // namespace patina::editor
