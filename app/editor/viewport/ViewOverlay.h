// What lies over the viewport while a view is shown: its legend, or two of them and the limit
// between them. Sees to their places.
#pragma once

#include "core/edit/ViewReasons.h"

#include <QObject>

class QWidget;

namespace patina::editor {

class DocumentController;
class SplitHandle;
class TracedSide;
class ViewLegend;
class ViewState;
class WallState;

class ViewOverlay : public QObject {
    Q_OBJECT
  public:
    ViewOverlay(ViewState& views, const TracedSide& traced, DocumentController& controller,
                const WallState& wall, QWidget& viewport);

  Q_SIGNALS:
    void remedyWanted(patina::ViewRemedy remedy); // ViewLegend::remedyWanted()

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void place();

    ViewState& m_views;
    const WallState& m_wall;
    QWidget& m_viewport;
    SplitHandle* m_split;
    ViewLegend *m_shown, *m_other;
};

} // namespace patina::editor
