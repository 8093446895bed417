// A matrix over the elements of a radiosity solution as colours: a row for each element that
// receives, downwards, a column for each that sends; a press chooses the element of the row.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <QImage>
#include <vector>

namespace patina::editor {

class FactorMap : public PlotFrame {
    Q_OBJECT
  public:
    explicit FactorMap(QWidget* parent = nullptr);

    // `size` elements in groups of `group`, the last one of what is left: a value for each pair of
    // groups, row after row; of no elements: none. Colours go with the logarithm of the size.
    void setValues(std::vector<float> values, int size, int group, const QString& what);
    // Of elements, and so of their groups.
    [[nodiscard]] float valueAt(int row, int column) const {
        return m_values[static_cast<std::size_t>(row / m_group) *
                            static_cast<std::size_t>(cells()) +
                        static_cast<std::size_t>(column / m_group)];
    }
    [[nodiscard]] int size() const { return m_size; }
    [[nodiscard]] int group() const { return m_group; }
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;

  Q_SIGNALS:
    void elementPicked(int element);

  protected:
    [[nodiscard]] bool hasValues() const override { return m_size > 0; }
    [[nodiscard]] QString placeText(const QPointF& place) const override;
    [[nodiscard]] QPointF allowed(const QPointF& place) const override;
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    void paintValues(QPainter& painter) const override;

  private:
    [[nodiscard]] int cells() const { return (m_size + m_group - 1) / m_group; }

    std::vector<float> m_values;
    int m_size = 0, m_group = 1;
    QImage m_image;
};

} // namespace patina::editor
