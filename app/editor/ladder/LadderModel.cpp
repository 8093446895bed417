#include "app/editor/ladder/LadderModel.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kLeastEv = 0.005; // less is written as none
constexpr int kBarAlpha = 150;

QString costText(double milliseconds) {
    return milliseconds < 9.95 ? QString::number(milliseconds, 'f', 1)
                               : QString::number(milliseconds, 'f', 0);
}

} // namespace

QString flipText(double flip) {
    return QString::number(flip, 'f', 3);
}

QString evOfLadder(double ev) {
    if (std::abs(ev) < kLeastEv)
        return QStringLiteral("0.00");
    const QString sign = ev > 0.0 ? QStringLiteral("+") : QStringLiteral("−");
    return sign + QString::number(std::abs(ev), 'f', 2);
}

void LadderModel::setShown(const LadderShownPtr& shown, const QSize& thumb, qreal ratio) {
    const int before = rowCount();
    const int after = shown ? static_cast<int>(shown->steps.size()) : 0;
    const bool other = before != after;
    if (other)
        beginResetModel();
    m_shown = shown;
    m_thumbs.clear();
    for (int i = 0; i < after; ++i) {
        const QImage& picture = shown->steps[static_cast<std::size_t>(i)].picture;
        QIcon& icon = m_thumbs.emplace_back();
        if (picture.isNull())
            continue;
        QPixmap pixmap = QPixmap::fromImage(
            picture.scaled(thumb * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation));
        pixmap.setDevicePixelRatio(ratio);
        icon.addPixmap(pixmap);
        icon.addPixmap(pixmap, QIcon::Selected); // without the tint of the selection
    }
    if (other)
        endResetModel();
    else if (after > 0)
        Q_EMIT dataChanged(index(0, 0), index(after - 1, Columns - 1));
}

int LadderModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() || !m_shown ? 0 : static_cast<int>(m_shown->steps.size());
}

int LadderModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : Columns;
}

QString LadderModel::textOf(const LadderStep& step, int column) const {
    if (column == Method)
        return toQString(step.label);
    if (!step.whyNot.empty())
        return {};
    const bool traced = step.name == "path";
    switch (column) {
    case Flip:
        return step.score ? flipText(step.score->flip) : QString();
    case Brightness:
        return step.score ? evOfLadder(step.score->biasEv) : QString();
    case Frame:
        if (traced)
            return m_shown->isDone() ? tr("%1 s").arg(m_shown->seconds, 0, 'f', 1) : QString();
        return step.milliseconds > 0.0 ? tr("%1 ms").arg(costText(step.milliseconds)) : QString();
    case Bake:
        if (!step.bake)
            return {};
        return step.bakeSeconds > 0.0 ? tr("%1 s").arg(step.bakeSeconds, 0, 'f', 1)
                                      : tr("in scene");
    default:
        return {};
    }
}

QString LadderModel::tipOf(const LadderStep& step) const {
    if (!step.whyNot.empty())
        return tr("%1: %2").arg(toQString(step.label), toQString(step.whyNot));
    if (step.name == "path")
        return tr("What the others are compared with: %1 paths per pixel, ± %2 %")
            .arg(m_shown->samples)
            .arg(100.0 * m_shown->noise, 0, 'f', 1);
    if (!step.score)
        return toQString(step.label);
    return tr("%1: visible difference (FLIP) %2, of which noise could make %3; brightness %4 EV, "
              "± %5; relative error %6 %")
        .arg(toQString(step.label), flipText(step.score->flip), flipText(step.score->flipNoise),
             evOfLadder(step.score->biasEv), QString::number(step.score->biasEvNoise, 'f', 2))
        .arg(100.0 * step.score->relative, 0, 'f', 1);
}

QVariant LadderModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || !m_shown)
        return {};
    const auto row = static_cast<std::size_t>(index.row());
    const LadderStep& step = m_shown->steps[row];
    switch (role) {
    case Qt::DisplayRole:
        return textOf(step, index.column());
    case Qt::ToolTipRole:
    case Qt::StatusTipRole:
        return tipOf(step);
    case Qt::DecorationRole:
        return index.column() == Method && !m_thumbs[row].isNull() ? QVariant(m_thumbs[row])
                                                                   : QVariant();
    case Qt::TextAlignmentRole:
        return index.column() == Method ? QVariant(Qt::AlignLeft | Qt::AlignVCenter)
                                        : QVariant(Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ForegroundRole:
        return step.whyNot.empty() ? QVariant() : QVariant(QColor(tokens::kTextDim));
    case kBarRole: {
        if (index.column() != Flip || !step.score)
            return {};
        double most = 0.0;
        for (const LadderStep& other : m_shown->steps)
            if (other.score)
                most = std::max(most, other.score->flip);
        return most > 0.0 ? QVariant(step.score->flip / most) : QVariant();
    }
    default:
        return {};
    }
}

QVariant LadderModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal)
        return {};
    struct Header {
        QString name, help;
    };
    const Header headers[Columns] = {
        {tr("Method"), tr("How the scene is lit, from the coarsest method on")},
        {tr("FLIP"), tr("Visible difference from the path-traced picture, 0 to 1: what you would "
                        "notice when you flip between both")},
        {tr("EV"), tr("How much too bright (+) or too dark (−) the picture is on the whole")},
        {tr("Frame"), tr("Time of one frame of this size here; of the path-traced picture: all of "
                         "it")},
        {tr("Bake"), tr("Time that what it needs took to be baked")}};
    const Header& header = headers[section];
    if (role == Qt::DisplayRole)
        return header.name;
    if (role == Qt::ToolTipRole || role == Qt::StatusTipRole)
        return header.help;
    if (role == Qt::TextAlignmentRole)
        return section == Method ? QVariant(Qt::AlignLeft | Qt::AlignVCenter)
                                 : QVariant(Qt::AlignRight | Qt::AlignVCenter);
    return {};
}

void LadderDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                           const QModelIndex& index) const {
    const QVariant share = index.data(LadderModel::kBarRole);
    QStyledItemDelegate::paint(painter, option, index);
    if (!share.isValid())
        return;
    // Under the number, so that both are read.
    const QRect room = option.rect.adjusted(tokens::kGap, 0, -tokens::kGap, -4);
    QRect bar(room.left(), room.bottom() - 3, room.width(), 4);
    QColor color(tokens::kWell);
    painter->fillRect(bar, color);
    bar.setWidth(std::max(1, static_cast<int>(std::lround(share.toDouble() * bar.width()))));
    color = QColor(tokens::kCopper);
    color.setAlpha(option.state & QStyle::State_Selected ? 255 : kBarAlpha);
    painter->fillRect(bar, color);
}

} // namespace patina::editor
