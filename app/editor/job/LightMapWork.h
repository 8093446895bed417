// A light map as the editor's jobs bake it. A function of values, on any thread.
#pragma once

#include "app/editor/job/BakeWork.h"
#include "core/document/Document.h"

namespace patina::editor {

struct LightMapWork {
    Document document; // as it was when the bake began
    LightMapSettings settings;
};

[[nodiscard]] BakeEnd runLightMap(const LightMapWork& work, const JobContext& job);

} // namespace patina::editor
