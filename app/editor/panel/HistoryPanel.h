// The History dock: every step with its values and, once the viewport has shown it at rest, a small
// picture. Choosing one goes there, by as many undos or redos as that takes; looking changes
// nothing.
#pragma once

#include "core/edit/DocumentState.h"

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <deque>
#include <utility>
#include <vector>

class QListWidget;

namespace patina::editor {

class DocumentController;
class ViewportWidget;
class WallState;

class HistoryPanel : public QWidget {
    Q_OBJECT
  public:
    // Pictures of the newest states alone are kept.
    static constexpr std::size_t kMostPictures = 200;

    // `viewport`: whose pictures are taken, while it shows the scene and no wall.
    HistoryPanel(DocumentController& controller, ViewportWidget& viewport, const WallState& wall,
                 QWidget* parent = nullptr);

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    void follow();
    void takePicture(); // where the viewport is settled on the document as it is
    void refresh();
    void go(int row);
    [[nodiscard]] QImage pictureOf(const DocumentState& state) const;

    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    const WallState& m_wall;
    QListWidget* m_list;
    std::vector<DocumentState> m_states; // by row
    std::deque<std::pair<DocumentState, QImage>> m_pictures;
    quint64 m_picturedRevision = 0; // of the document that has a picture
    QTimer m_refresh;               // after an edit, so that a drag costs nothing
};

} // namespace patina::editor
