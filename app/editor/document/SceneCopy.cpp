#include "app/editor/document/SceneCopy.h"

#include "app/editor/Session.h"
#include "core/bake/document/FollowBounces.h"
#include "core/base/Log.h"
#include "core/base/ProcessMemory.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/ViewReasons.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightMix.h"

#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

// Drafts of pictures that an edit has just asked for.
bool isDraft(const ImagePtr& picture) {
    return !picture || picture->height() <= kDraftEnvironmentHeight;
}

} // namespace

SceneCopy sceneCopy(const Session& session) {
    SceneCopy scene;
    scene.document = session.controller.document();
    scene.view = session.views.settings();
    scene.view.split.reset();
    scene.view.flags = 1.0f; // marks do not blink
    if (!whyEmpty(scene.view.shown.kind, scene.document, scene.view.light).empty())
        scene.view.shown = {};
    if (scene.document.view.toneMap == ToneMap::OpenColorIo)
        scene.display = session.displays.transform();
    scene.shadows = session.nearShadows.shown();
    return scene;
}

Result<void> completeEnvironments(Document& document, const JobContext& job) {
    for (Environment& environment : document.environments)
        if (isGenerated(environmentRecipe(environment)) && isDraft(environment.image))
            resolveEnvironment(environment, job);
    if (environmentBlend(document) && isDraft(document.mix.blended))
        resolveBlend(document, job);
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

Result<void> completeTransfer(SceneCopy& scene, LightingMode lighting, const JobContext& job) {
    Document& document = scene.document;
    const Result<std::vector<std::string>> followed = followBounces(lighting, document, job);
    if (!followed)
        return followed.error();
    for (const std::string& warning : *followed)
        logWarning("{}", warning);
    if (!readsBake(lighting) || !hasTransfer(document)) {
        scene.shadows = nullptr;
        return {};
    }
    const NearShadowRequest request = nearShadowRequest(document);
    Result<NearShadowsPtr> shadows =
        request.empty() ? NearShadowsPtr()
                        : traceNearShadows(request, scene.shadows, availableMemory(), job);
    if (!shadows && shadows.error().kind == ErrorKind::Cancelled)
        return shadows.error();
    if (!shadows) // the picture shows what the bake's bands know, as the viewport's does
        logWarning("Shadows of local lights stay soft: {}", shadows.error().text());
    scene.shadows = shadows ? std::move(*shadows) : nullptr;
    return {};
}

Result<EnvironmentTexelsPtr> lightOf(const SceneCopy& scene, PreparedLights& lights,
                                     const JobContext& job) {
    const ImagePtr picture = shownEnvironment(scene.document).image;
    const bool lit = !environmentParts(scene.document).empty() || !scene.view.isPlain();
    if (!lit || !picture)
        return EnvironmentTexelsPtr();
    Result<IblLight> light = lights.first(picture, job);
    if (light && !light->full)
        light = refinedIbl(std::move(*light), job);
    if (!light)
        return light.error();
    lights.keep(*light);
    return light->texels;
}

} // namespace patina::editor
