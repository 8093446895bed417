// The editor's window: it assembles panels, menus and status bar, and decides nothing.
#pragma once

#include "app/editor/viewport/ModelSteps.h"

#include <QElapsedTimer>
#include <QMainWindow>

class QLabel;
class QMenu;

namespace patina::editor {

class Actions;
class BusyIndicator;
class Docks;
class DropTarget;
class FileFlow;
class MaterialPanel;
class NoticeArea;
class ViewActions;
class SceneProgress;
class ViewOverlay;
class ViewportWidget;
enum class PictureState;
struct Session;
struct UserNotice;

class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    explicit MainWindow(Session& session);
    ~MainWindow() override;

    [[nodiscard]] Actions& actions() { return *m_actions; }
    [[nodiscard]] ViewActions& looks() { return *m_looks; }
    [[nodiscard]] FileFlow& files() { return *m_files; }
    [[nodiscard]] NoticeArea& notices() { return *m_notices; }
    [[nodiscard]] ViewportWidget& viewport() { return *m_viewport; }

    [[nodiscard]] QMenu* createPopupMenu() override;
    // Of the window on a screen with so much room, in the first session.
    [[nodiscard]] static QSize firstSize(const QSize& available);
    void restoreLayout(); // of the last time, or the first one
    // Leaves those that are open at first; the titles of the others.
    QStringList closeOpenedDocks();
    void resetLayout();

  protected:
    void changeEvent(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    QWidget* makeReflectionMix();
    void makeDocks();
    void saveLayout() const;
    void makeMenus();
    void makeToolBar();
    void makeStatusBar();
    void connectActions();
    void connectTracers();
    void fillRecentMenu();
    void refreshTitle();
    void refreshView();
    void refreshTriangles();
    void showFrame(double milliseconds, PictureState state);
    void notice(const UserNotice& notice);
    void openExportDialog();
    void openEnvironmentSaveDialog();

    Session& m_session;
    Actions* m_actions;
    ViewActions* m_looks;
    FileFlow* m_files;
    Docks* m_docks;
    ViewportWidget* m_viewport;
    ModelSteps m_models;
    ViewOverlay* m_overlay = nullptr;    // over the viewport
    SceneProgress* m_progress = nullptr; // likewise
    DropTarget* m_drop = nullptr;
    NoticeArea* m_notices; // over the viewport
    QMenu* m_recentMenu = nullptr;
    BusyIndicator* m_busy = nullptr;
    QLabel *m_gpu = nullptr, *m_frameTime = nullptr, *m_triangles = nullptr;
    QElapsedTimer m_frameTimeShown;
    bool m_mayClose = false;
};

} // namespace patina::editor
