#include "app/cli/TracedBackground.h"

#include "app/cli/PreparedLight.h"
#include "core/trace/document/DocumentTraceInputs.h"

namespace patina::cli {

Result<void> setBackground(Session& session, const Document& document, TraceView& view) {
    return setTracedBackground(document, view, [&](const Image& environment) {
        session.job().setActivity("preparing light");
        return prepareLight(environment, session.job());
    });
}

} // namespace patina::cli
