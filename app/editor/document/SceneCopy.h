// The scene as the viewport shows it, copied for a job that draws it with a renderer of its own:
// edits leave it alone.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/io/DisplayTransform.h"
#include "core/job/JobContext.h"
#include "core/light/EnvironmentTexels.h"
#include "render/view/ViewSettings.h"

namespace patina::editor {

struct Session;
class PreparedLights;

struct SceneCopy {
    Document document;
    render::ViewSettings view;   // without a split; one that does not apply is the picture
    DisplayTransformPtr display; // of ToneMap::OpenColorIo; null: none
    NearShadowsPtr shadows;      // that are known already; may be null, or of an earlier state
};
[[nodiscard]] SceneCopy sceneCopy(const Session& session);

// What the viewport computes after an edit, on the job's thread; each has the error Cancelled.

// Environments in full where they are drafts.
Result<void> completeEnvironments(Document& document, const JobContext& job);
// Where `lighting` reads a transfer: its bounces in the materials' colours as they are now, and the
// shadows of local lights, or null with a warning in the log. Errors, too: those of
// followBounces().
Result<void> completeTransfer(SceneCopy& scene, LightingMode lighting, const JobContext& job);
// Of the environment in full; null where none lights the scene and no view looks at one.
Result<EnvironmentTexelsPtr> lightOf(const SceneCopy& scene, PreparedLights& lights,
                                     const JobContext& job);

} // namespace patina::editor
