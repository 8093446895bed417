// The History dock: every step with its values and, once the viewport has shown it at rest, a small
// picture. Choosing one goes there, by as many undos or redos as that takes; looking changes
// nothing.
#pragma once

#include "core/edit/DocumentState.h"

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

class QListWidget;

namespace patina::editor {

class DocumentController;

class HistoryPanel : public QWidget {
    Q_OBJECT
  public:
    // Pictures of the newest states alone are kept.
    static constexpr std::size_t kMostPictures = 200;

    // `picture`: what the viewport shows, small; null where that is not the scene at rest.
    HistoryPanel(DocumentController& controller, std::function<QImage(const QSize&)> picture,
                 QWidget* parent = nullptr);

    void viewportRests(); // it shows the document as it is

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    void follow();
    void refresh();
    void go(int row);
    [[nodiscard]] QImage pictureOf(const DocumentState& state) const;

    DocumentController& m_controller;
    std::function<QImage(const QSize&)> m_picture;
    QListWidget* m_list;
    std::vector<DocumentState> m_states; // by row
    std::deque<std::pair<DocumentState, QImage>> m_pictures;
    QTimer m_refresh; // after an edit, so that a drag costs nothing
};

} // namespace patina::editor
