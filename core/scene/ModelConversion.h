// An imported model in the document's terms.
#pragma once

#include "core/library/Library.h"
#include "core/scene/SceneLoader.h"

namespace patina {

// `source`: the model's path, for naming embedded images.
[[nodiscard]] SceneLoader::Model convertModel(ImportedModel model, const std::string& source);
[[nodiscard]] SceneLoader::Model convertModel(const std::vector<library::ModelPart>& parts);

} // namespace patina
