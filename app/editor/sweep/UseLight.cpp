#include "app/editor/sweep/UseLight.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/sweep/SweepWork.h"
#include "app/editor/widget/LatLongMap.h"
#include "core/edit/EditSession.h"
#include "core/scene/Scene.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

const QString kUseLightTask = QStringLiteral("light of a sweep");

// As one step: `edits` and the rotation of the environment that lights the scene, `first` after it
// does, and nothing beside it.
void lightAlone(DocumentController& controller, Id first, std::vector<ParameterEdit> edits,
                double rotationDeg, const std::string& text) {
    EditSession& session = controller.session();
    session.group(text, [&] {
        if (controller.document().mix.second != 0)
            controller.fadeTo(0);
        session.lightWith(first);
        edits.push_back(
            {&parameter("environment.rotationDeg"), static_cast<float>(wrapDeg(rotationDeg))});
        edits.push_back({&parameter("environment.enabled"), true});
        session.setDiffering({Scope::Environment, first}, edits, text);
    });
}

} // namespace

bool useLight(DocumentController& controller, const SweptEnvironment& environment,
              double rotationDeg) {
    const std::string text =
        fmt::format("Light with {} at {:.4g}°", environment.title, rotationDeg);
    switch (useOf(environment, controller.document())) {
    case SweptUse::Gone:
        return false;
    case SweptUse::OfDocument:
        lightAlone(controller, environment.id, {}, rotationDeg, text);
        return true;
    case SweptUse::BySource:
        break;
    }
    const QString title = toQString(environment.title);
    controller.tasks().start(
        kUseLightTask, DocumentController::tr("Reading %1").arg(title),
        [target = &controller, source = environment.source, title, text, rotationDeg,
         begun = controller.begun()](const JobContext& job) -> BackgroundTasks::Apply {
            std::vector<Notice> notices; // the sweep read it, too
            auto image = std::make_shared<Result<ImagePtr>>(loadEnvironmentImage(
                target->worker(), source, notices, EnvironmentLayout::Automatic, job));
            return [target, source, title, text, rotationDeg, begun, image] {
                if (!image->ok()) {
                    if (image->error().kind != ErrorKind::Cancelled)
                        Q_EMIT target->noticed(UserNotice::fromError(image->error()));
                    return;
                }
                MapSlot sky;
                sky.source = source;
                sky.image = image->value();
                target->deliver(begun, title, [target, sky, text, rotationDeg] {
                    lightAlone(
                        *target, target->document().mix.first,
                        {{&parameter("environment.kind"), static_cast<int>(EnvironmentKind::Image)},
                         {&parameter("environment.image"), sky},
                         {&parameter("environment.layout"),
                          static_cast<int>(EnvironmentLayout::Automatic)},
                         {&parameter("environment.removedSources"), 0.0f}},
                        rotationDeg, text);
                });
            };
        });
    return true;
}

} // namespace patina::editor
