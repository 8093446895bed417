#include "app/editor/library/LibraryDelegate.h"

#include "app/editor/library/LibraryModel.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

namespace patina::editor {
namespace {

constexpr QSize kPicture(128, 64);
constexpr int kAround = 5; // between the picture and the item's edge
constexpr int kStar = 16;  // of the star and the mark of duplicates
constexpr int kBadge = 22; // what they stand on, so that they are seen over any picture
constexpr int kBadgeAlpha = 170;

QRect pictureRect(const QRect& item) {
    return {item.left() + kAround, item.top() + kAround, kPicture.width(), kPicture.height()};
}

void paintBadge(QPainter& painter, const QRect& badge, const QIcon& drawing) {
    QColor ground(tokens::kWell);
    ground.setAlpha(kBadgeAlpha);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(badge, tokens::kRadius, tokens::kRadius);
    QRect place(0, 0, kStar, kStar);
    place.moveCenter(badge.center());
    drawing.paint(&painter, place);
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
        painter.drawPixmap(place, picture);
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
