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

    // `size` × `size`, row after row; empty: none. Colours go with the logarithm of the size.
    void setValues(std::vector<float> values, int size, const QString& what);
    [[nodiscard]] float valueAt(int row, int column) const {
        return m_values[static_cast<std::size_t>(row) * static_cast<std::size_t>(m_size) +
                        static_cast<std::size_t>(column)];
    }
    [[nodiscard]] int size() const { return m_size; }
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
    std::vector<float> m_values;
    int m_size = 0;
    QImage m_image;
};

} // namespace patina::editor
