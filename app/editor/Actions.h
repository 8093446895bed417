// Every action of the main window, made in one place: text, icon, shortcut, what it does in a
// sentence. Menus, tool bar and the page of shortcuts are filled from here.
#pragma once

#include <QAction>
#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QString>

namespace patina::editor {

class UndoStack;

class Actions : public QObject {
    Q_OBJECT
  public:
    Actions(UndoStack& undoStack, QObject* parent);

    QAction *newScene, *open, *addModel, *makeHdr, *save, *saveAs, *saveEnvironment, *exportScene;
    QAction *exportRadiosity, *exportTurntable, *quit;
    QAction* recover;
    QAction *undo, *redo, *removeSelected, *duplicateSelected;
    QAction *placeHandles, *dropToGround, *backInPlace; // of the selected mesh
    QAction* keepSnapshot;
    QAction *frame, *home, *overlays, *wall, *pathTraced, *whitted;
    QAction *traceCells, *whittedCells; // all of the wall
    QAction *lightingIbl, *lightingPrt, *lightingRadiosity;
    QAction *nextEnvironment, *previousEnvironment; // of the library, in the viewport
    QAction *environmentOn, *fadeEnvironments;
    QAction *nextModel, *previousModel; // one alone, in the viewport
    QAction *sceneDock, *materialDock, *environmentDock, *lightsDock, *viewDock, *bakeDock;
    QAction *modelDock, *jobsDock, *logDock, *historyDock, *snapshotsDock;
    QAction *nextDock, *previousDock; // by key
    // Docks to look closer with.
    QAction *pixel, *lightLab, *lens, *energy, *mixer, *transfer, *lightSweep, *rayTree, *radiosity,
        *ladder, *library;
    QAction *pinPixel, *focusHere;
    QAction* furnace;
    QAction *fullScreen, *resetLayout;
    QAction *shortcuts, *memory, *about;

    [[nodiscard]] QList<QAction*> all() const;
    // Each shows a dock or closes it, checked while it is seen.
    [[nodiscard]] QList<QAction*> docks() const;
    [[nodiscard]] QList<QAction*> instruments() const;
    // The usual completion: a tool tip that names the shortcut, and a status tip.
    static void describe(QAction* action, const QString& sentence);

  private:
    QAction* make(const QString& text, const QString& iconName, const QList<QKeySequence>& keys,
                  const QString& sentence);
};

} // namespace patina::editor
