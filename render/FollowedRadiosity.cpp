#include "render/FollowedRadiosity.h"

#include "core/base/Log.h"
#include "core/document/ViewChoices.h"
#include "core/radiosity/document/KeptRadiosity.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "render/SceneRenderer.h"

namespace patina::render {

bool isLitBy(LightingMode lighting, LightingMode ofDocument, const ViewSettings& view) {
    const LightingMode own = view.lighting.value_or(ofDocument);
    return lightingOf(view.shown.kind, own) == lighting ||
           (view.split && lightingOf(view.split->other.kind, own) == lighting);
}

Result<void> FollowedRadiosity::update(SceneRenderer& scene, const Document& document,
                                       const ViewSettings& view, const JobContext& job) {
    if (!isLitBy(LightingMode::Radiosity, document.view.lighting, view))
        return {};
    const Result<LiveRadiosityPtr> live =
        followRadiosity(traceInputs(document), radiositySettings(document.view), m_live, job, {},
                        {.cache = m_cache ? &*m_cache : nullptr, .factors = false});
    if (!live)
        return live.error();
    if (m_cache && !m_live && (*live)->solved)
        if (const Result<void> kept = keepRadiosity(**live, *m_cache); !kept)
            logWarning("The solved radiosity is not kept for the next time: {}",
                       kept.error().text());
    if (*live != m_live)
        scene.setRadiosity(shownRadiosity(**live, (*live)->solution));
    m_live = *live;
    return {};
}

} // namespace patina::render
