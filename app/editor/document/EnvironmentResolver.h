// Keeps a document's environment image what its kind asks for: while a sky or softboxes are edited
// a draft is made at once, and the full picture follows in the background.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/GeneratedEnvironment.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <deque>

namespace patina::editor {

class EnvironmentResolver : public QObject {
    Q_OBJECT
  public:
    explicit EnvironmentResolver(QObject* parent = nullptr);
    ~EnvironmentResolver() override; // cancels and waits

    // Another document, whose image is as it should be.
    void reset(const Environment& environment);
    // After an edit: gives the environment the image of its kind, in a few milliseconds. Whether
    // that is another one than before.
    bool update(Environment& environment);

  Q_SIGNALS:
    // The full picture for what update() saw last.
    void refined(const patina::ImagePtr& image);

  private:
    void refine();
    void deliver(quint64 request, const ImagePtr& image);

    struct Made {
        EnvironmentRecipe recipe;
        ImagePtr image;
    };
    QThreadPool m_pool;
    QTimer m_rest; // until nothing has changed for a moment
    JobControl m_control;
    quint64 m_request = 0;
    EnvironmentRecipe m_recipe; // of the environment's image
    std::deque<Made> m_made;    // the last full pictures, for undo and redo
};

} // namespace patina::editor
