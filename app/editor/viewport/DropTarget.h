// Says over the picture what files will do that are held over the window, before they are let go,
// and frames the picture as their target.
#pragma once

#include <QObject>
#include <QStringList>
#include <QWidget>

class QMimeData;

namespace patina::editor {

class DocumentController;
class SelectionModel;

// Paths of the local files that are dragged.
[[nodiscard]] QStringList draggedFiles(const QMimeData& data);

class DropHint : public QWidget {
    Q_OBJECT
  public:
    explicit DropHint(QWidget& viewport);
    void setLines(const QStringList& lines); // covers the viewport; none: hides
    [[nodiscard]] const QStringList& lines() const { return m_lines; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QStringList m_lines;
};

class DropTarget : public QObject {
    Q_OBJECT
  public:
    // Watches `window`, which takes the drops itself; `viewport` shows what they will do.
    DropTarget(QWidget& window, QWidget& viewport, DocumentController& controller,
               SelectionModel& selection);

  protected:
    bool eventFilter(QObject* window, QEvent* event) override;

  private:
    DocumentController& m_controller;
    SelectionModel& m_selection;
    DropHint* m_hint; // owned by the viewport
};

} // namespace patina::editor
