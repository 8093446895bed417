// Keeps the images of a document's environments what their kinds ask for, and the picture of two
// environments what the mix asks for: while they are edited a draft is made at once, and the full
// picture follows in the background.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"

#include <QObject>
#include <QTimer>
#include <deque>
#include <map>

namespace patina::editor {

class EnvironmentResolver : public QObject {
    Q_OBJECT
  public:
    explicit EnvironmentResolver(TaskRunner& runner, QObject* parent = nullptr);

    // Another document, whose images are as they should be.
    void reset(const Document& document);
    // After an edit: gives the environments their images, in a few milliseconds. Whether another
    // one than before is shown.
    bool update(Document& document);
    // A full picture in place of a draft is still to come.
    [[nodiscard]] bool isRefining() const { return m_rest.isActive() || m_tasks.busy(); }

  Q_SIGNALS:
    // The full picture for what update() saw last: of one environment, or of both that are mixed.
    void refined(patina::Id environment, const patina::ImagePtr& image);
    void blended(const patina::ImagePtr& image);

  private:
    bool updateImages(Document& document);
    bool updateImage(Environment& environment);
    bool updateBlend(Document& document);
    [[nodiscard]] ImagePtr draftOf(const ImagePtr& image);
    void change();
    void refine();
    void deliver(Id environment, const ImagePtr& image);
    [[nodiscard]] Id nextDraft() const; // that is to be made in full; 0: none

    struct Known {
        EnvironmentRecipe recipe; // of the environment's image
        bool isDraft = false;
    };
    struct Made {
        EnvironmentRecipe recipe;
        ImagePtr image;
    };
    struct Draft {
        ImagePtr image, small;
    };
    QTimer m_rest;               // until nothing has changed for a moment
    std::map<Id, Known> m_known; // of all environments
    Id m_first = 0;              // that lights the scene
    std::deque<Made> m_made;     // the last full pictures, for undo and redo
    std::optional<EnvironmentBlend> m_blend;
    std::deque<Draft> m_drafts;
    ImagePtr m_shown;
    bool m_blendIsDraft = false;
    TaskGroup m_tasks;
};

} // namespace patina::editor
