// A panel's scrolling body: as wide as the dock, with the house's margins.
#pragma once

#include <QScrollArea>

class QVBoxLayout;

namespace patina::editor {

class PanelScroll : public QScrollArea {
    Q_OBJECT
  public:
    explicit PanelScroll(QWidget* parent = nullptr);
    [[nodiscard]] QVBoxLayout* contents() { return m_layout; }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override; // the body's width may grow

  private:
    QVBoxLayout* m_layout;
};

} // namespace patina::editor
