// Pictures of ambient occlusion of scenes with more materials than fit into memory together: each
// is written as it is finished.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/document/Document.h"

#include <cstdint>
#include <filesystem>

namespace patina::cli {

// `maxMemory`: what the bake may take, 0: no limit is known. Says before the start how many
// textures there will be and how many are baked at a time. An interrupt or an error leaves the
// pictures that are complete. Errors: Usage when not even one texture fits; those of bakeAoTexel()
// and of writing.
Result<void> bakeOcclusionPictures(Session& session, const Document& document,
                                   const BakeInputs& inputs, const BakeRequest& request,
                                   std::uint64_t maxMemory, const std::filesystem::path& output);

} // namespace patina::cli
