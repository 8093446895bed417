#include "app/cli/TracedBackground.h"

#include "app/cli/PreparedLight.h"
#include "core/trace/document/DocumentTraceInputs.h"

namespace patina::cli {

Result<TraceView> traceView(Session& session, const Document& document,
                            const render::FrameSettings& frame) {
    TraceView view;
    view.camera = frame.camera;
    view.width = frame.width;
    view.height = frame.height;
    const auto prepare = [&](const Image& environment) {
        session.job().setActivity("preparing light");
        return prepareLight(environment, session.job());
    };
    if (Result<void> set = setTracedBackground(document, view, prepare); !set)
        return set.error();
    return view;
}

} // namespace patina::cli
