// Says over the viewport that what it shows is a preview, and of what.
#pragma once

#include <QLabel>

namespace patina::editor {

class EnvironmentPreview;
class ViewportWidget;

class PreviewBadge : public QLabel {
    Q_OBJECT
  public:
    PreviewBadge(EnvironmentPreview& preview, ViewportWidget& viewport);

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void refresh();
    void place();

    EnvironmentPreview& m_preview;
    ViewportWidget& m_viewport;
};

} // namespace patina::editor
