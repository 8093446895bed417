// Saves the traced picture as far as it has come: as displayed, linear, or with all that it
// consists of, which is traced once more for it.
#pragma once

#include "core/document/View.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/path/TraceScene.h"

#include <QString>
#include <cstdint>
#include <memory>

class QWidget;

namespace patina {
class WorkerClient;
}

namespace patina::editor {

class DocumentController;
class JobManager;
class PathView;

struct TracedSave {
    QString file;              // .exr: linear; .png, .jpg, .tif, .tga: as displayed
    ImagePtr picture;          // PathView::picture()
    View look;                 // exposure and tone curve of what is displayed
    std::uint32_t samples = 0; // paths per pixel that it has
    bool withParts = false;    // in an .exr, as `patina render --aov all` of as many samples
    std::shared_ptr<const TraceScene> scene; // for the parts
    TraceView view;
};
// Errors: Usage for another ending, a tone curve of OpenColorIO's; those of writing; Cancelled.
Result<void> writeTraced(const TracedSave& save, WorkerClient& worker, const JobContext& job);

// Asks for the file, and saves what there is when it is asked, as a job; notices say where.
void askAndSaveTraced(const PathView& paths, DocumentController& controller, JobManager& jobs,
                      QWidget& parent);

} // namespace patina::editor
