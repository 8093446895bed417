// The grid of environments: as many columns as fit, with words where there is nothing to show.
#pragma once

#include <QListView>
#include <QString>

namespace patina::editor {

class LibraryView : public QListView {
    Q_OBJECT
  public:
    explicit LibraryView(QWidget* parent = nullptr);

    void setEmptyText(const QString& text);      // shown while there is no item
    [[nodiscard]] QString currentSource() const; // empty: none

  Q_SIGNALS:
    void useRequested(const QString& source);
    void stepRequested(const QString& source); // it was chosen with an arrow key
    void menuRequested(const QString& source, const QPoint& globalPosition); // empty: of no item
    void currentSourceChanged();

  protected:
    void keyPressEvent(QKeyEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;
    void startDrag(Qt::DropActions actions) override;

  private:
    QString m_emptyText;
};

} // namespace patina::editor
