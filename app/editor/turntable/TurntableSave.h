// Saves a turntable, or a turning light, as numbered pictures or as a video: a job with a renderer
// and an OpenGL context of its own (as ProgramWarmer has one), so that editing goes on meanwhile.
// Each picture is the one that `patina render --turntable`, or --light-turn, draws.
#pragma once

#include "app/editor/document/SceneCopy.h"
#include "core/cells/Sequence.h"
#include "core/job/JobContext.h"

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

// On the job's thread. Numbered pictures that were written before a cancel or an error stay, and
// are named; of a video nothing stays.
[[nodiscard]] JobOutcome drawTurntable(const TurntableOrder& order, SceneCopy scene,
                                       WorkerClient& worker, PreparedLights& lights,
                                       const JobContext& job);

// Starts the job; its number. Notices say where the pictures are.
quint64 saveTurntable(const TurntableOrder& order, Session& session);

} // namespace patina::editor
