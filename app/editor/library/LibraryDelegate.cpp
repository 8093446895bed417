#include "app/editor/library/LibraryDelegate.h"

#include "app/editor/library/LibraryModel.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"

#include <QAbstractItemView>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <cmath>

namespace patina::editor {
namespace {

constexpr QSize kPicture(128, 64);
constexpr int kAround = 5; // between the picture and the item's edge
constexpr int kStar = 16;  // of the star and the mark of duplicates
constexpr int kBadge = 22; // what they stand on, so that they are seen over any picture
constexpr int kBadgeAlpha = 170;
constexpr int kTurnWidth = 72; // of the handle that rotates: its mark and "-179.5°"

void paintGround(QPainter& painter, const QRect& badge) {
    QColor ground(tokens::kWell);
    ground.setAlpha(kBadgeAlpha);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(badge, tokens::kRadius, tokens::kRadius);
}

void paintBadge(QPainter& painter, const QRect& badge, const QIcon& drawing) {
    paintGround(painter, badge);
    QRect place(0, 0, kStar, kStar);
    place.moveCenter(badge.center());
    drawing.paint(&painter, place);
}

// The mark of a drag to both sides, and the degrees.
void paintTurn(QPainter& painter, const QRect& handle, float degrees) {
    paintGround(painter, handle);
    const QRect mark(handle.left() + 4, handle.center().y() - kStar / 2 + 1, kStar, kStar);
    icon(QStringLiteral("rotate"), tokens::kText).paint(&painter, mark);
    const QRect text = handle.adjusted(kStar + 6, 0, -5, 0);
    const auto shown = static_cast<double>(degrees);
    painter.setPen(QColor(tokens::kText));
    painter.drawText(text, Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("%1°").arg(shown, 0, 'f', shown == std::round(shown) ? 0 : 1));
}

void paintPicture(QPainter& painter, const QRect& place, const QModelIndex& index) {
    QPainterPath rounded;
    rounded.addRoundedRect(place, tokens::kRadius, tokens::kRadius);
    painter.save();
    painter.setClipPath(rounded);
    const auto picture = index.data(LibraryModel::PictureRole).value<QPixmap>();
    if (picture.isNull()) {
        painter.fillRect(place, QColor(tokens::kRaised));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(place, Qt::AlignCenter, QStringLiteral("…"));
    } else {
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        // As the scene sees it: what is rotated counter-clockwise lies further left.
        const double turns = index.data(LibraryModel::RotationRole).toDouble() / 360.0;
        const double shift = (turns - std::floor(turns)) * place.width();
        QRectF part = place;
        part.translate(-shift, 0.0);
        painter.drawPixmap(part, picture, picture.rect());
        if (shift > 0.0)
            painter.drawPixmap(part.translated(place.width(), 0.0), picture, picture.rect());
    }
    painter.restore();
    if (index.data(LibraryModel::CurrentRole).toBool()) {
        painter.setPen(QPen(QColor(tokens::kAccent), 2));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(place).adjusted(-1, -1, 1, 1), tokens::kRadius,
                                tokens::kRadius);
    }
}

} // namespace

QRect LibraryDelegate::pictureRect(const QRect& item) {
    return {item.left() + kAround, item.top() + kAround, kPicture.width(), kPicture.height()};
}

QRect LibraryDelegate::turnRect(const QRect& item) {
    const QRect picture = pictureRect(item);
    QRect handle(0, 0, kTurnWidth, kBadge);
    handle.moveCenter(picture.center());
    handle.moveBottom(picture.bottom() - 3);
    return handle;
}

QRect LibraryDelegate::starRect(const QRect& item) {
    const QRect picture = pictureRect(item);
    return {picture.right() - kBadge - 1, picture.top() + 3, kBadge, kBadge};
}

QSize LibraryDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
    return {kPicture.width() + 2 * kAround,
            kPicture.height() + 2 * option.fontMetrics.lineSpacing() + 3 * kAround};
}

void LibraryDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                            const QModelIndex& index) const {
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const bool selected = option.state.testFlag(QStyle::State_Selected);
    const bool hovered = option.state.testFlag(QStyle::State_MouseOver);
    const bool focused = option.state.testFlag(QStyle::State_HasFocus);
    if (selected || hovered) {
        painter->setPen(Qt::NoPen);
        painter->setBrush(QColor(selected ? tokens::kAccentDeep : tokens::kHover));
        painter->drawRoundedRect(option.rect, tokens::kRadius, tokens::kRadius);
    }
    if (focused && !selected) {
        painter->setPen(QColor(tokens::kAccent));
        painter->setBrush(Qt::NoBrush);
        painter->drawRoundedRect(QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5),
                                 tokens::kRadius, tokens::kRadius);
    }
    const QRect picture = pictureRect(option.rect);
    paintPicture(*painter, picture, index);
    if (const QVariant rotation = index.data(LibraryModel::RotationRole); rotation.isValid())
        paintTurn(*painter, turnRect(option.rect), rotation.toFloat());
    const bool favourite = index.data(LibraryModel::FavouriteRole).toBool();
    if (favourite)
        paintBadge(*painter, starRect(option.rect),
                   icon(QStringLiteral("star-filled"), tokens::kAccent));
    else if (hovered || selected)
        paintBadge(*painter, starRect(option.rect), icon(QStringLiteral("star"), tokens::kText));
    if (index.data(LibraryModel::DuplicateRole).toBool())
        paintBadge(*painter, {picture.left() + 3, picture.top() + 3, kBadge, kBadge},
                   icon(QStringLiteral("duplicate"), tokens::kCopper));

    const int line = option.fontMetrics.lineSpacing();
    QRect text(picture.left(), picture.bottom() + kAround, picture.width(), line);
    const auto write = [&](int role, QRgb color) {
        painter->setPen(QColor(color));
        painter->drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
                          option.fontMetrics.elidedText(index.data(role).toString(),
                                                        Qt::ElideMiddle, text.width()));
        text.translate(0, line);
    };
    write(Qt::DisplayRole, tokens::kText);
    write(LibraryModel::SubtitleRole, selected ? tokens::kText : tokens::kTextDim);
    painter->restore();
}

bool LibraryDelegate::helpEvent(QHelpEvent* event, QAbstractItemView* view,
                                const QStyleOptionViewItem& option, const QModelIndex& index) {
    if (event->type() != QEvent::ToolTip || !index.data(LibraryModel::RotationRole).isValid() ||
        !turnRect(option.rect).contains(event->pos()))
        return QStyledItemDelegate::helpEvent(event, view, option, index);
    QToolTip::showText(event->globalPos(),
                       tr("Drag to rotate the environment; or Shift and drag anywhere in the "
                          "picture, or Shift with ← →"),
                       view);
    return true;
}

bool LibraryDelegate::editorEvent(QEvent* event, QAbstractItemModel*,
                                  const QStyleOptionViewItem& option, const QModelIndex& index) {
    if (event->type() != QEvent::MouseButtonPress && event->type() != QEvent::MouseButtonDblClick &&
        event->type() != QEvent::MouseButtonRelease)
        return false;
    const auto* mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() != Qt::LeftButton || !starRect(option.rect).contains(mouse->pos()))
        return false;
    // The release counts; that the star was pressed must not start anything else.
    if (event->type() == QEvent::MouseButtonRelease)
        Q_EMIT starClicked(index.data(LibraryModel::SourceRole).toString());
    return true;
}

} // namespace patina::editor
