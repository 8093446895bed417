// How much the tests that print times of frames draw. What they assert does not depend on it: by
// default it is little. PATINA_FRAME_FIGURES=1 in the environment gives figures worth reading, and
// takes minutes: PATINA_FRAME_FIGURES=1 ctest -R test_frame_times -V, with nothing else running.
#pragma once

#include <QSize>
#include <QString>
#include <QtGlobal>

namespace patina::editor {

struct FigureSize {
    QSize viewport{480, 270};
    QString model = QStringLiteral("builtin:sphere"); // on which all views are shown
    int dragMs = 300;
    int torusSide = 96;    // vertices around the baked torus and around its tube
    int steps = 4;         // of an edit
    int blocks = 2;        // edits: by turns an orbit and a slider's drag
    int quietMs = 100;     // that a paused bake has traced nothing more
    bool compiled = false; // edits begin when even what nobody waits for is compiled
};

inline FigureSize figureSize() {
    if (qEnvironmentVariableIntValue("PATINA_FRAME_FIGURES") == 0)
        return {};
    return {QSize(1280, 720), QStringLiteral("builtin:torus-knot"), 3000, 320, 12, 6, 400, true};
}

} // namespace patina::editor
