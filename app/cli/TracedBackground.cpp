#include "app/cli/TracedBackground.h"

#include "app/cli/PreparedLight.h"
#include "core/document/ViewChoices.h"
#include "core/mix/LightMix.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <utility>

namespace patina::cli {

Result<void> setBackground(Session& session, const Document& document, TraceView& view) {
    const View& look = document.view;
    switch (look.background) {
    case BackgroundMode::Environment:
        return {}; // as it is
    case BackgroundMode::Off:
        view.transparent = true;
        return {};
    case BackgroundMode::Color:
        view.background = [color = look.backgroundColor](const glm::vec3&) { return color; };
        return {};
    case BackgroundMode::Blurred:
        break;
    }
    const EnvironmentPart shown = shownEnvironment(document);
    if (!shown.image)
        return {};
    session.job().setActivity("preparing light");
    Result<IblMaps> maps = prepareLight(*shown.image, session.job());
    if (!maps)
        return maps.error();
    view.background = blurredBackground(std::make_shared<const IblMaps>(*std::move(maps)), shown,
                                        look.backgroundBlur);
    return {};
}

} // namespace patina::cli
