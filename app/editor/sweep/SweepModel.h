// The lights of a sweep as rows, the worst first.
#pragma once

#include "app/editor/sweep/SweepWork.h"

#include <QAbstractTableModel>
#include <QString>
#include <optional>
#include <vector>

namespace patina::editor {

[[nodiscard]] QString rotationText(double degrees); // "120°"
[[nodiscard]] QString scoreText(double score, RankBy by);
// What is to be known of a light: "clips, black from one side, same as Studio"; may be empty.
[[nodiscard]] QString flagText(const SweepOutcome& outcome, const LightScore& score);

class SweepModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { Rank, Name, Rotation, Score, White, Black, Contrast, Difference, Flags, Count };
    enum Role { SortRole = Qt::UserRole }; // a number, or a text

    using QAbstractTableModel::QAbstractTableModel;

    void setOutcome(SweepOutcomePtr outcome, RankBy by); // null: no rows
    // Index into LightSweep::scores of a row, and back.
    [[nodiscard]] std::size_t lightOf(int row) const {
        return m_order[static_cast<std::size_t>(row)];
    }
    [[nodiscard]] int rowOf(std::size_t light) const { return m_rows[light]; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                      int role) const override;

  private:
    [[nodiscard]] QString text(const LightScore& score, int row, int column) const;
    [[nodiscard]] QVariant sortValue(const LightScore& score, int row, int column) const;

    SweepOutcomePtr m_outcome;
    RankBy m_by = RankBy::Difference;
    std::vector<std::size_t> m_order; // of rows
    std::vector<int> m_rows;          // of lights
};

} // namespace patina::editor
