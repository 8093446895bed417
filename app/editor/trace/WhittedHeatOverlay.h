// Over the viewport: what the pixels of the classical picture take, in colours with their legend,
// and the boxes of the hierarchy.
#pragma once

#include <QStringList>
#include <QWidget>

namespace patina::editor {

class DocumentController;
class ViewLines;
class ViewportWidget;
class WhittedHeat;

class WhittedHeatOverlay : public QWidget {
    Q_OBJECT
  public:
    WhittedHeatOverlay(WhittedHeat& heat, DocumentController& controller, ViewportWidget& viewport);
    [[nodiscard]] QStringList lines() const; // of the legend

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    void paintBoxes(QPainter& painter) const;
    void paintLegend(QPainter& painter) const;

    WhittedHeat& m_heat;
    DocumentController& m_controller;
    ViewportWidget& m_viewport;
};

} // namespace patina::editor
