// The methods of a ladder as rows: a small picture and its name, errors and costs.
#pragma once

#include "app/editor/ladder/LadderWork.h"

#include <QAbstractTableModel>
#include <QIcon>
#include <QStyledItemDelegate>
#include <vector>

namespace patina::editor {

[[nodiscard]] QString flipText(double flip); // "0.093"
[[nodiscard]] QString evOfLadder(double ev); // "+0.15"

class LadderModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { Method, Flip, Brightness, Frame, Bake, Columns };
    // 0…1: how long the bar behind a number is; invalid: none.
    static constexpr int kBarRole = Qt::UserRole;

    using QAbstractTableModel::QAbstractTableModel;

    void setShown(const LadderShownPtr& shown, const QSize& thumb, qreal ratio); // null: nothing

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                      int role) const override;

  private:
    [[nodiscard]] QString textOf(const LadderStep& step, int column) const;
    [[nodiscard]] QString tipOf(const LadderStep& step) const;

    LadderShownPtr m_shown;
    std::vector<QIcon> m_thumbs; // as the steps
};

// Paints the bar behind a number.
class LadderDelegate : public QStyledItemDelegate {
    Q_OBJECT
  public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
};

} // namespace patina::editor
