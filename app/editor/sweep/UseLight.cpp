#include "app/editor/sweep/UseLight.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/sweep/SweepWork.h"
#include "app/editor/widget/LatLongMap.h"
#include "core/edit/EditSession.h"

#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

// As one step: `edits` and the rotation of the environment that lights the scene, `first` after it
// does, and nothing beside it.
void lightAlone(DocumentController& controller, Id first, std::vector<ParameterEdit> edits,
                double rotationDeg, const std::string& text) {
    EditSession& session = controller.session();
    session.group(text, [&] {
        if (controller.document().mix.second != 0)
            controller.fadeTo(0);
        session.lightWith(first);
        // One by one: GCC 12 takes a temporary that is moved in for uninitialized.
        const auto add = [&](const char* name, const ParameterValue& value) {
            edits.emplace_back().info = &parameter(name);
            edits.back().value = value;
        };
        add("environment.rotationDeg", static_cast<float>(wrapDeg(rotationDeg)));
        add("environment.tiltDeg", 0.0f); // the sweep lights with level ones
        add("environment.rollDeg", 0.0f);
        add("environment.enabled", true);
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
    controller.readEnvironment(
        controller.document().mix.first, toQString(environment.source),
        EnvironmentLayout::Automatic,
        [&controller, rotationDeg, text](Target target, std::vector<ParameterEdit> edits) {
            const Id read = target.id != 0 ? target.id : controller.document().mix.first;
            lightAlone(controller, read, std::move(edits), rotationDeg, text);
        });
    return true;
}

} // namespace patina::editor
