// A built-in room as any model opens: a room by itself is lit by its own lamp, through radiosity,
// with automatic exposure.
#pragma once

#include "app/editor/Session.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"

namespace patina::editor {

inline void putUnderSky(DocumentController& controller) {
    const auto set = [&](const char* id, const Target& target, const ParameterValue& value) {
        controller.setParameter(*findParameter(id), target, value);
    };
    set("view.lighting", {Scope::View, 0}, static_cast<int>(LightingMode::Ibl));
    set("view.exposureMode", {Scope::View, 0}, static_cast<int>(ExposureMode::Fixed));
    set("environment.enabled", {Scope::Environment, 0}, true);
}

// And nothing solves the room meanwhile.
inline void putUnderSky(Session& session) {
    session.radiosity.stop();
    putUnderSky(session.controller);
}

} // namespace patina::editor
