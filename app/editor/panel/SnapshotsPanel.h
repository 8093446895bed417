// The Snapshots dock: looks that were kept, with their pictures; one of them against the scene as
// it is, or two against each other, value by value.
#pragma once

#include "core/base/Id.h"
#include "core/image/Image.h"

#include <QTimer>
#include <QWidget>

class QListWidget;
class QToolButton;

namespace patina::editor {

class DocumentController;
class SnapshotComparison;
class ViewportWidget;
class WallState;

class SnapshotsPanel : public QWidget {
    Q_OBJECT
  public:
    // `viewport`: whose pictures are kept, while it shows the scene and no wall.
    SnapshotsPanel(DocumentController& controller, ViewportWidget& viewport, const WallState& wall,
                   QWidget* parent = nullptr);

    void keep(); // the scene as it is, as one step

    [[nodiscard]] QListWidget& list() { return *m_list; }
    [[nodiscard]] SnapshotComparison& comparison() { return *m_comparison; }

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeButtons();
    void follow();
    void refresh();
    void refreshList();
    void compare();
    void takePictures(); // where the viewport is settled on the document as it is
    void restore();
    void remove();
    [[nodiscard]] ImagePtr picture() const; // of the viewport; null: it shows a wall, or nothing
    [[nodiscard]] std::vector<Id> selected() const; // in the order of the list

    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    const WallState& m_wall;
    QListWidget* m_list;
    QToolButton *m_restore, *m_rename, *m_remove;
    SnapshotComparison* m_comparison;
    // Kept while the viewport was about to show something else: its picture follows.
    struct {
        Id snapshot = 0;
        quint64 revision = 0;
    } m_awaited;
    ImagePtr m_now; // of the scene, the last time it was settled
    quint64 m_nowRevision = 0;
    bool m_refreshing = false;
    QTimer m_refresh; // after an edit, so that a drag costs nothing
};

} // namespace patina::editor
