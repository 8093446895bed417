#include "app/editor/library/LibraryView.h"

#include "app/editor/library/LibraryDelegate.h"
#include "app/editor/library/LibraryModel.h"
#include "app/editor/style/Tokens.h"

#include <QContextMenuEvent>
#include <QDrag>
#include <QKeyEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QPainter>

namespace patina::editor {
namespace {

constexpr QSize kDragged(128, 64); // picture at the pointer

} // namespace

LibraryView::LibraryView(QWidget* parent)
    : QListView(parent) {
    setViewMode(QListView::IconMode);
    setMovement(QListView::Static);
    setResizeMode(QListView::Adjust);
    setUniformItemSizes(true);
    setSpacing(2);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setMouseTracking(true); // stars appear under the pointer
    setDragEnabled(true);
    setDragDropMode(QAbstractItemView::DragOnly);
    setAcceptDrops(false);
    viewport()->setAcceptDrops(false); // folders go to the panel around it
    setEditTriggers(QAbstractItemView::NoEditTriggers);
}

void LibraryView::setEmptyText(const QString& text) {
    m_emptyText = text;
    viewport()->update();
}

QString LibraryView::currentSource() const {
    return currentIndex().data(LibraryModel::SourceRole).toString();
}

void LibraryView::currentChanged(const QModelIndex& current, const QModelIndex& previous) {
    QListView::currentChanged(current, previous);
    Q_EMIT currentSourceChanged();
}

void LibraryView::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (enter && event->modifiers() == (event->modifiers() & Qt::KeypadModifier) &&
        currentIndex().isValid()) {
        Q_EMIT useRequested(currentSource());
        return;
    }
    const QString before = currentSource();
    QListView::keyPressEvent(event);
    const bool steps = event->key() == Qt::Key_Left || event->key() == Qt::Key_Right ||
                       event->key() == Qt::Key_Up || event->key() == Qt::Key_Down;
    if (steps && event->modifiers() == (event->modifiers() & Qt::KeypadModifier) &&
        currentIndex().isValid() && currentSource() != before)
        Q_EMIT stepRequested(currentSource());
}

void LibraryView::mouseDoubleClickEvent(QMouseEvent* event) {
    const QModelIndex index = indexAt(event->position().toPoint());
    QListView::mouseDoubleClickEvent(event);
    if (event->button() == Qt::LeftButton && index.isValid() &&
        !LibraryDelegate::starRect(visualRect(index)).contains(event->position().toPoint()))
        Q_EMIT useRequested(index.data(LibraryModel::SourceRole).toString());
}

void LibraryView::contextMenuEvent(QContextMenuEvent* event) {
    const bool byKey = event->reason() == QContextMenuEvent::Keyboard;
    const QModelIndex index = byKey ? currentIndex() : indexAt(event->pos());
    if (index.isValid())
        setCurrentIndex(index);
    Q_EMIT menuRequested(index.data(LibraryModel::SourceRole).toString(),
                         byKey ? viewport()->mapToGlobal(visualRect(index).center())
                               : event->globalPos());
}

void LibraryView::startDrag(Qt::DropActions) {
    const QModelIndexList indexes = selectedIndexes();
    QMimeData* data = model()->mimeData(indexes);
    if (data->formats().isEmpty()) {
        delete data;
        return;
    }
    auto* drag = new QDrag(this);
    drag->setMimeData(data);
    QPixmap picture = indexes.front().data(LibraryModel::PictureRole).value<QPixmap>();
    if (!picture.isNull()) {
        picture = picture.scaled(kDragged * devicePixelRatioF(), Qt::KeepAspectRatio,
                                 Qt::SmoothTransformation);
        picture.setDevicePixelRatio(devicePixelRatioF());
        drag->setPixmap(picture);
    }
    drag->exec(Qt::CopyAction);
}

void LibraryView::paintEvent(QPaintEvent* event) {
    QListView::paintEvent(event);
    if (model() == nullptr || model()->rowCount() > 0)
        return;
    QPainter painter(viewport());
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(viewport()->rect().adjusted(tokens::kMargin, 0, -tokens::kMargin, 0),
                     Qt::AlignCenter | Qt::TextWordWrap, m_emptyText);
}

} // namespace patina::editor
