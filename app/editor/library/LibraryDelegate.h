// Paints an environment of the library: its thumbnail, its name, the number that is sorted by, and
// a star that a click turns on and off. What lights the scene is shown as it is rotated, with a
// handle that says how far.
#pragma once

#include <QStyledItemDelegate>

namespace patina::editor {

class LibraryDelegate : public QStyledItemDelegate {
    Q_OBJECT
  public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                                 const QModelIndex& index) const override;
    // Of an item's rectangle.
    [[nodiscard]] static QRect starRect(const QRect& item);
    [[nodiscard]] static QRect pictureRect(const QRect& item);
    [[nodiscard]] static QRect turnRect(const QRect& item); // of the handle
    bool helpEvent(QHelpEvent* event, QAbstractItemView* view, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;

  Q_SIGNALS:
    void starClicked(const QString& source);

  protected:
    bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                     const QModelIndex& index) override;
};

} // namespace patina::editor
