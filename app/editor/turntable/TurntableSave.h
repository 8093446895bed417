// Saves a turntable, or a turning light, as numbered pictures or as a video: a job with a renderer
// and an OpenGL context of its own (as ProgramWarmer has one), so that editing goes on meanwhile.
// Each picture is the one that `patina render --turntable`, or --light-turn, draws.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/cells/Sequence.h"
#include "core/document/Document.h"
#include "core/io/DisplayTransform.h"
#include "core/job/JobContext.h"
#include "render/view/ViewSettings.h"

#include <QString>
#include <QtGlobal>

namespace patina {
class WorkerClient;
}

namespace patina::editor {

struct JobOutcome;
struct Session;
class PreparedLights;

struct TurntableOrder {
    QString file; // its extension says which kind
    Turning turning = Turning::Camera;
    int count = 72;           // pictures
    int framesPerSecond = 24; // of a video
    int width = 1280, height = 720;
    int samples = 4;
};

// What the pictures are of: a copy, which edits leave alone.
struct TurntableScene {
    Document document;
    render::ViewSettings view;   // without a split
    DisplayTransformPtr display; // of ToneMap::OpenColorIo; null: none
    NearShadowsPtr shadows;      // that are known already; may be null, or of an earlier state
};
// As the viewport shows it: a view that does not apply is the picture.
[[nodiscard]] TurntableScene turntableScene(const Session& session);

// On the job's thread. Numbered pictures that were written before a cancel or an error stay, and
// are named; of a video nothing stays.
[[nodiscard]] JobOutcome drawTurntable(const TurntableOrder& order, TurntableScene scene,
                                       WorkerClient& worker, PreparedLights& lights,
                                       const JobContext& job);

// Starts the job; its number. Notices say where the pictures are.
quint64 saveTurntable(const TurntableOrder& order, Session& session);

} // namespace patina::editor
