#include "app/cli/LocalShadows.h"

#include "app/cli/LongBake.h"
#include "core/base/ProcessMemory.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {

Result<NearShadowsPtr> traceLocalShadows(Session& session, const PictureOptions& options,
                                         const Document& document, bool readsTransfer,
                                         const NearShadowsPtr& before) {
    std::uint64_t most = availableMemory();
    if (!options.maxMemory.empty()) {
        const Result<std::uint64_t> bytes = parseSize("--max-memory", options.maxMemory);
        if (!bytes)
            return bytes.error();
        most = *bytes;
    }
    if (!readsTransfer || !hasTransfer(document))
        return NearShadowsPtr();
    const NearShadowRequest request = nearShadowRequest(document);
    if (request.empty())
        return NearShadowsPtr();
    session.beginPhase();
    session.job().setActivity("tracing shadows of local lights");
    Result<NearShadowsPtr> shadows = traceNearShadows(request, before, most, session.job());
    if (!shadows) {
        if (shadows.error().kind == ErrorKind::Cancelled)
            return shadows.error();
        session.report().warn(
            fmt::format("shadows of local lights stay soft, and let some light through: {}",
                        shadows.error().text()));
        return NearShadowsPtr();
    }
    if (!(*shadows)->note.empty())
        session.report().warn((*shadows)->note);
    session.report().json()["localShadows"] = {{"lights", request.lights.size()}};
    return shadows;
}

} // namespace patina::cli
