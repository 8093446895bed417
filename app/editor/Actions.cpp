#include "app/editor/Actions.h"

#include "app/editor/document/UndoStack.h"
#include "app/editor/style/Icons.h"

#include <QActionGroup>

namespace patina::editor {

Actions::Actions(UndoStack& undoStack, QObject* parent)
    : QObject(parent)
    , newScene(make(tr("&New"), QStringLiteral("new"), {QKeySequence::New},
                    tr("Start over with the built-in scene")))
    , open(make(tr("&Open…"), QStringLiteral("open"), {QKeySequence::Open},
                tr("Open a project or a model in place of the scene")))
    , addModel(make(tr("Add &Model…"), QStringLiteral("add-model"), {tr("Ctrl+I")},
                    tr("Add the meshes and materials of a model file to the scene")))
    , makeHdr(make(tr("Make &HDR from Photos…"), QStringLiteral("bracket"), {},
                   tr("Merge photos of one scene, exposed differently, into an HDR picture")))
    , save(make(tr("&Save"), QStringLiteral("save"), {QKeySequence::Save}, tr("Save the project")))
    , saveAs(make(tr("Save &As…"), QStringLiteral("save-as"), {tr("Ctrl+Shift+S")},
                  tr("Save the project under another name")))
    , saveEnvironment(make(tr("Save En&vironment As…"), QStringLiteral("environment"), {},
                           tr("Write the environment as an HDR or EXR file of any layout")))
    , exportScene(make(tr("&Export…"), QStringLiteral("export"), {tr("Ctrl+E")},
                       tr("Write the scene as glTF or GLB for other programs")))
    , exportRadiosity(make(tr("Export Rad&iosity…"), QStringLiteral("export"), {tr("Ctrl+Alt+E")},
                           tr("Write the solved radiosity as COLLADA, glTF or PLY, at the vertices "
                              "or in a light map; solve it first, by lighting with it")))
    , exportTurntable(make(tr("Export &Turntable…"), QStringLiteral("turntable"),
                           {tr("Ctrl+Shift+E")},
                           tr("Write pictures or a video of the scene with the camera, or the "
                              "environment, going round")))
    , quit(make(tr("&Quit"), QStringLiteral("quit"), {tr("Ctrl+Q")}, tr("Leave Patina")))
    , recover(make(tr("Recover &Unsaved Work…"), {}, {},
                   tr("Show work that was not saved when an editor ended")))
    , undo(undoStack.createUndoAction(this, tr("&Undo")))
    , redo(undoStack.createRedoAction(this, tr("&Redo")))
    , removeSelected(make(tr("Re&move"), QStringLiteral("remove"), {tr("Del")},
                          tr("Remove the mesh, material or light that was selected last")))
    , duplicateSelected(make(tr("&Duplicate"), QStringLiteral("duplicate"), {tr("Ctrl+D")},
                             tr("Duplicate the mesh, material or light that was selected last")))
    , placeHandles(make(tr("Move, R&otate, Scale"), QStringLiteral("move"), {tr("Shift+M")},
                        tr("Show handles on the selected mesh that move, rotate and scale it; "
                           "Ctrl snaps")))
    , dropToGround(make(tr("Drop to &Ground"), QStringLiteral("ground"), {tr("End")},
                        tr("Stand the selected mesh, or the scene, on the ground")))
    , backInPlace(make(tr("Put &Back"), QStringLiteral("reset"), {},
                       tr("Move the selected mesh back to where its file has it")))
    , keepSnapshot(make(tr("&Keep Snapshot"), QStringLiteral("snapshots"), {tr("Ctrl+K")},
                        tr("Keep what the scene looks like, to compare with it and to return to "
                           "it")))
    , frame(make(tr("&Frame"), QStringLiteral("frame"), {tr("F")},
                 tr("Bring the selected mesh, or the whole scene, into view")))
    , home(make(tr("&Reset Camera"), QStringLiteral("home"), {tr("Home")},
                tr("Show the whole scene from where the camera began")))
    , overlays(make(tr("&Grid and Outlines"), QStringLiteral("tiling"), {tr("G")},
                    tr("Show the ground grid, the outline of the selection and the lights")))
    , wall(make(tr("Wall"), QStringLiteral("wall"), {tr("F3")},
                tr("Compare environments, materials or values beside each other; once more: one "
                   "picture again")))
    , pathTraced(
          make(tr("Path Traced"), QStringLiteral("path-traced"), {tr("F12")},
               tr("Trace the picture, or the cell of a wall below the pointer, by paths, with "
                  "all shadows, reflections and bounces; once more: as the viewport draws "
                  "it")))
    , whitted(make(tr("Whitted Ray Traced"), QStringLiteral("whitted"), {tr("Shift+F12")},
                   tr("Trace the picture, or the cell of a wall below the pointer, by the "
                      "classical ray tracer: hard shadows, mirrors and glass; once more: as the "
                      "viewport draws it")))
    , traceCells(make(tr("Trace All Cells"), {}, {tr("Ctrl+F12")},
                      tr("Trace all cells of the wall by paths; once more: as the viewport draws "
                         "them")))
    , whittedCells(make(tr("Whitted Ray Trace All Cells"), {}, {tr("Ctrl+Shift+F12")},
                        tr("Trace all cells of the wall by the classical ray tracer; once more: as "
                           "the viewport draws them")))
    , lightingIbl(make(tr("&Image-Based Light"), {}, {tr("Ctrl+L")},
                       tr("Light from the environment, with every reflection")))
    , lightingPrt(make(tr("&Precomputed Transfer"), {}, {tr("Ctrl+Shift+L")},
                       tr("Light through the baked transfer, with its soft shadows")))
    , lightingRadiosity(make(tr("Ra&diosity"), {}, {tr("Ctrl+Alt+L")},
                             tr("Light that goes from surface to surface, solved by elements; "
                                "everything reflects it diffusely")))
    , nextEnvironment(
          make(tr("Next Environment"), {}, {tr("PgDown")},
               tr("Light the scene with the next environment of the Environment Library")))
    , previousEnvironment(
          make(tr("Previous Environment"), {}, {tr("PgUp")},
               tr("Light the scene with the previous environment of the Environment "
                  "Library")))
    , environmentOn(make(tr("Environment Light"), QStringLiteral("environment"), {tr("Shift+E")},
                         tr("Switch the light of the environment, and its picture, on or off")))
    , fadeEnvironments(make(tr("Fade Between Environments"), {}, {},
                            tr("Fade to the environment that the Environment Library lights the "
                               "scene with, in place of a change at once")))
    , nextModel(make(tr("Isolate Next Model"), {}, {tr("Shift+PgDown")},
                     tr("Show the next model of the scene and hide the others; after the last one "
                        "all; Esc shows all")))
    , previousModel(make(tr("Isolate Previous Model"), {}, {tr("Shift+PgUp")},
                         tr("Show the previous model of the scene and hide the others; before the "
                            "first one all; Esc shows all")))
    , sceneDock(make(tr("S&cene"), QStringLiteral("scene"), {tr("Ctrl+Shift+1")},
                     tr("Show or hide the list of meshes and materials")))
    , materialDock(make(tr("Material"), QStringLiteral("material"), {tr("Ctrl+Shift+2")},
                        tr("Show or hide the parameters of the material")))
    , environmentDock(make(tr("En&vironment"), QStringLiteral("environment"), {tr("Ctrl+Shift+3")},
                           tr("Show or hide what surrounds and lights the scene")))
    , lightsDock(make(tr("Light&s"), QStringLiteral("light-sun"), {tr("Ctrl+Shift+4")},
                      tr("Show or hide the list of lights")))
    , viewDock(make(tr("C&amera"), QStringLiteral("view"), {tr("Ctrl+Shift+5")},
                    tr("Show or hide exposure, tone mapping, display and field of view")))
    , bakeDock(make(tr("Ba&ke"), QStringLiteral("bake"), {tr("Ctrl+Shift+6")},
                    tr("Show or hide the baking of light")))
    , modelDock(make(tr("S&hading"), QStringLiteral("model"), {tr("Ctrl+Shift+7")},
                     tr("Show or hide which shading model is used")))
    , jobsDock(make(tr("&Jobs"), QStringLiteral("jobs"), {tr("Ctrl+Shift+8")},
                    tr("Show or hide what runs in the background")))
    , logDock(make(tr("Log"), QStringLiteral("log"), {tr("Ctrl+Shift+9")},
                   tr("Show or hide the messages of this session")))
    , historyDock(make(tr("Histor&y"), QStringLiteral("history"), {tr("Ctrl+Shift+0")},
                       tr("Show or hide the list of steps, to go back and forth among them")))
    , snapshotsDock(make(tr("Snapshots"), QStringLiteral("snapshots"), {tr("Ctrl+Shift+K")},
                         tr("Show or hide the looks that were kept, with what differs between "
                            "them")))
    , nextDock(make(tr("Next Dock"), {}, {tr("Ctrl+Tab")},
                    tr("Move the keyboard focus to the next dock, or to the viewport")))
    , previousDock(make(tr("Previous Dock"), {}, {tr("Ctrl+Shift+Tab")},
                        tr("Move the keyboard focus to the dock before, or to the viewport")))
    , pixel(make(tr("Pi&xel"), QStringLiteral("pixel"), {tr("Ctrl+1")},
                 tr("Explain the pixel under the pointer: every factor, formula and share")))
    , lightLab(make(tr("Light La&b"), QStringLiteral("light-lab"), {tr("Ctrl+2")},
                    tr("Show what shading makes of the environment: faces, harmonics, irradiance, "
                       "prefiltered levels, DFG table")))
    , lens(make(tr("BRDF Le&ns"), QStringLiteral("lens"), {tr("Ctrl+3")},
                tr("Show how the material reflects: lobes, D, G and F, albedo, on a ball")))
    , energy(make(tr("&Energy"), QStringLiteral("energy"), {tr("Ctrl+4")},
                  tr("Show what the material loses and makes of the light, and what compensation "
                     "gives back")))
    , mixer(make(tr("Light &Mixer"), QStringLiteral("mixer"), {tr("Ctrl+5")},
                 tr("Mix the lights and environments as on a mixing desk: gain, tint, mute, solo, "
                    "cross-fade")))
    , transfer(make(tr("&Transfer"), QStringLiteral("transfer"), {tr("Ctrl+6")},
                    tr("Show how light comes to a point by the baked transfer: its lobe, its "
                       "coefficients, what it sees of the environment")))
    , lightSweep(make(tr("Light Sweep"), QStringLiteral("light-sweep"), {tr("Ctrl+7")},
                      tr("Find the light, among environments and their rotations, in which the "
                         "material fails")))
    , rayTree(make(tr("Ray Tree"), QStringLiteral("ray-tree"), {tr("Ctrl+8")},
                   tr("Show the rays that a pixel of the Whitted picture is made of, as a tree and "
                      "in the viewport")))
    , radiosity(make(tr("Radiosity"), QStringLiteral("radiosity"), {tr("Ctrl+0")},
                     tr("Light the scene by radiosity, watch it being solved step by step, and see "
                        "who lights an element and where its light goes")))
    , ladder(make(tr("Lighting Ladder"), QStringLiteral("ladder"), {tr("Ctrl+9")},
                  tr("Compare all lighting modes with the path-traced picture: how far they are "
                     "from it, and what they cost")))
    , library(make(tr("Environment Library"), QStringLiteral("library"), {tr("Ctrl+B")},
                   tr("Show or hide the environments of your folders, with what was measured of "
                      "them, to pick light from")))
    , pinPixel(make(tr("Pin Pixel"), QStringLiteral("pin"), {tr("P")},
                    tr("Keep looking at the point of the surface under the pointer; once more: "
                       "take the pin away")))
    , focusHere(make(tr("Focus Here"), {}, {tr("Shift+P")},
                     tr("Then click in the viewport: what is there becomes sharp, with depth of "
                        "field; Esc: leave the focus as it is")))
    , furnace(make(tr("&White Furnace"), QStringLiteral("furnace"), {tr("Shift+F")},
                   tr("Look at the scene in a uniform white environment without lights, where a "
                      "material that loses nothing cannot be seen")))
    , fullScreen(make(tr("F&ull Screen"), QStringLiteral("full-screen"), {tr("F11")},
                      tr("Fill the screen with the window")))
    , resetLayout(make(tr("Reset &Layout"), QStringLiteral("layout"), {},
                       tr("Put all docks back where they were at first")))
    , shortcuts(make(tr("&Keyboard and Mouse"), QStringLiteral("keyboard"), {tr("F1")},
                     tr("List every shortcut and what the mouse does")))
    , memory(make(tr("&Memory"), QStringLiteral("memory"), {},
                  tr("What memory is used for, and how much may be kept for later")))
    , about(make(tr("&About Patina"), QStringLiteral("info"), {},
                 tr("Version, licence and libraries"))) {
    undo->setIcon(icon(QStringLiteral("undo")));
    undo->setShortcut(QKeySequence::Undo);
    undo->setIconText(tr("Undo"));
    describe(undo, tr("Undo the last change"));
    redo->setIcon(icon(QStringLiteral("redo")));
    redo->setShortcuts({tr("Ctrl+Shift+Z"), tr("Ctrl+Y")});
    redo->setIconText(tr("Redo"));
    describe(redo, tr("Redo the change that was undone"));
    placeHandles->setCheckable(true);
    overlays->setCheckable(true);
    overlays->setChecked(true);
    for (QAction* dock : docks() + instruments())
        dock->setCheckable(true);
    wall->setCheckable(true);
    pathTraced->setCheckable(true);
    whitted->setCheckable(true);
    for (QAction* cells : {traceCells, whittedCells}) {
        cells->setCheckable(true);
        cells->setEnabled(false); // until there is a wall
    }
    environmentOn->setCheckable(true);
    fadeEnvironments->setCheckable(true);
    furnace->setCheckable(true);
    focusHere->setCheckable(true);
    fullScreen->setCheckable(true);
    // Elsewhere these keys scroll, or edit text.
    for (QAction* step : {nextEnvironment, previousEnvironment, nextModel, previousModel,
                          removeSelected, duplicateSelected, dropToGround})
        step->setShortcutContext(Qt::WidgetShortcut);
    auto* lighting = new QActionGroup(this);
    for (QAction* action : {lightingIbl, lightingPrt, lightingRadiosity}) {
        action->setCheckable(true);
        lighting->addAction(action);
    }
    quit->setMenuRole(QAction::QuitRole);
    about->setMenuRole(QAction::AboutRole);
}

QAction* Actions::make(const QString& text, const QString& iconName,
                       const QList<QKeySequence>& keys, const QString& sentence) {
    auto* action = new QAction(text, this);
    if (!iconName.isEmpty())
        action->setIcon(icon(iconName));
    action->setShortcuts(keys);
    describe(action, sentence);
    return action;
}

void Actions::describe(QAction* action, const QString& sentence) {
    action->setStatusTip(sentence);
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    action->setToolTip(keys.isEmpty() ? sentence : tr("%1 (%2)").arg(sentence, keys));
}

QList<QAction*> Actions::docks() const {
    return {sceneDock, materialDock, environmentDock, lightsDock,  viewDock,     bakeDock,
            modelDock, jobsDock,     logDock,         historyDock, snapshotsDock};
}

QList<QAction*> Actions::instruments() const {
    return {pixel,      lightLab, lens,      energy, mixer,  transfer,
            lightSweep, rayTree,  radiosity, ladder, library};
}

QList<QAction*> Actions::all() const {
    return QList<QAction*>{newScene,
                           open,
                           addModel,
                           makeHdr,
                           save,
                           saveAs,
                           saveEnvironment,
                           exportScene,
                           exportRadiosity,
                           exportTurntable,
                           quit,
                           undo,
                           redo,
                           removeSelected,
                           duplicateSelected,
                           placeHandles,
                           dropToGround,
                           backInPlace,
                           keepSnapshot,
                           frame,
                           home,
                           overlays,
                           wall,
                           pathTraced,
                           whitted,
                           traceCells,
                           whittedCells,
                           lightingIbl,
                           lightingPrt,
                           lightingRadiosity,
                           nextEnvironment,
                           previousEnvironment,
                           environmentOn,
                           fadeEnvironments,
                           nextModel,
                           previousModel} +
           docks() + QList<QAction*>{nextDock, previousDock} + instruments() +
           QList<QAction*>{pinPixel,  focusHere, furnace, fullScreen, resetLayout,
                           shortcuts, memory,    about,   recover};
}

} // namespace patina::editor
