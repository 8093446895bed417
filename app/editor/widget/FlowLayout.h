// Widgets beside each other in rows that wrap, each row's height that of its tallest.
#pragma once

#include <QLayout>
#include <QList>

namespace patina::editor {

class FlowLayout : public QLayout {
    Q_OBJECT
  public:
    FlowLayout(int horizontalGap, int verticalGap, QWidget* parent = nullptr);
    ~FlowLayout() override;

    void addItem(QLayoutItem* item) override;
    [[nodiscard]] int count() const override { return static_cast<int>(m_items.size()); }
    [[nodiscard]] QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    [[nodiscard]] Qt::Orientations expandingDirections() const override { return {}; }
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;
    [[nodiscard]] QSize sizeHint() const override { return minimumSize(); }
    [[nodiscard]] QSize minimumSize() const override; // of the widest
    void setGeometry(const QRect& rect) override;

  private:
    int arrange(const QRect& rect, bool apply) const; // returns the height

    QList<QLayoutItem*> m_items; // owned
    int m_horizontalGap, m_verticalGap;
};

} // namespace patina::editor
