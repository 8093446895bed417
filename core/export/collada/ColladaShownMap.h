// The light map that surfaces of a document show already, and its files under other names.
#pragma once

#include "core/export/collada/ColladaScene.h"

namespace patina::collada {

// Of surfaces that have one. Throws Fault: several light maps, or none that their materials show.
[[nodiscard]] ColladaLightMap shownMap(const SceneContents& contents);
// Whatever names the files of `from` names those of `to`, in all scenes of the document.
void renameMap(const Tree& tree, const ColladaLightMap& from, const ColladaLightMap& to);

} // namespace patina::collada
