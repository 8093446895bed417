// The strip under the viewport: every view of a group as a live thumbnail. It folds away, and only
// thumbnails that can be seen are drawn, when nothing else needs the time.
#pragma once

#include "app/editor/viewport/SheetScheduler.h"

#include <QPointer>
#include <QWidget>
#include <utility>
#include <vector>

class QHBoxLayout;
class QScrollArea;
class QTabBar;

namespace patina::editor {

class DocumentController;
class FoldButton;
class ViewState;
class ViewThumb;

class ViewStrip : public QWidget, private SheetClient {
    Q_OBJECT
  public:
    ViewStrip(ViewState& views, DocumentController& controller, SheetScheduler& sheets,
              QWidget* parent = nullptr);
    ~ViewStrip() override;

    [[nodiscard]] bool isFolded() const;
    void setFolded(bool folded); // remembered over sessions
    // A control that belongs to a group: right of its thumbnails.
    void addControl(ViewGroup group, QWidget* control);

  Q_SIGNALS:
    void foldedChanged(bool folded);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] render::ViewSheet wantedSheet() const override;
    void showThumbnail(ViewKind kind, const QImage& picture) override;

    void makeThumbs();
    void showGroup(int group);
    void showControls();
    void refreshShown();
    void refreshWhy();
    void click(ViewKind kind);
    void doubleClick(ViewKind kind);
    void openMenu(ViewKind kind, const QPoint& global);

    ViewState& m_views;
    DocumentController& m_controller;
    QPointer<SheetScheduler> m_sheets; // the viewport's, which may go first
    FoldButton* m_fold;
    QTabBar* m_groups;
    QHBoxLayout* m_row = nullptr; // of the thumbnails
    std::vector<std::pair<ViewGroup, QWidget*>> m_controls;
    QScrollArea* m_scroll;
    std::vector<ViewThumb*> m_thumbs; // by ViewKind
    ViewKind m_marked = -1;           // as shown last
    Id m_light = 0;                   // whose factors the reasons are of
    ViewKind m_beforeClick = shading::kViewFinal;
};

} // namespace patina::editor
