// The label of a row: brighter when the value is not the default, and a double-click resets it.
#pragma once

#include <QLabel>

namespace patina::editor {

class RowLabel : public QLabel {
    Q_OBJECT
  public:
    explicit RowLabel(const QString& text, QWidget* parent = nullptr);
    void setAtDefault(bool atDefault);
    [[nodiscard]] bool isAtDefault() const { return m_atDefault; }

  Q_SIGNALS:
    void resetRequested();

  protected:
    void mouseDoubleClickEvent(QMouseEvent* event) override;

  private:
    bool m_atDefault = false;
};

} // namespace patina::editor
