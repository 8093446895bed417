// The picture of an environment that is made: from its sky or its softboxes, or from a photograph
// without its brightest sources.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/Environment.h"

#include <vector>

namespace patina {

// Heights of the pictures: while something is dragged, and afterwards.
inline constexpr int kDraftEnvironmentHeight = 256;
inline constexpr int kEnvironmentHeight = 1024;

// All that the picture depends on, and nothing else: equal recipes make equal pictures.
struct EnvironmentRecipe {
    EnvironmentKind kind = EnvironmentKind::Image;
    Sky sky;                        // of a Sky only
    glm::vec3 softboxAmbient{0.0f}; // of Softboxes only
    std::vector<Softbox> softboxes; // enabled ones, without ids and names
    ImagePtr file;                  // of an Image that sources are removed from only
    int removedSources = 0;         // likewise
    friend bool operator==(const EnvironmentRecipe&, const EnvironmentRecipe&) = default;
};
[[nodiscard]] EnvironmentRecipe environmentRecipe(const Environment& environment);
// Whether the picture is made; else it is that of the file.
[[nodiscard]] bool isGenerated(const EnvironmentRecipe& recipe);

// Lat-long, F32, 3 channels, 2 height × height, the same on any number of threads; an Image
// as large as the file, but in drafts (below kEnvironmentHeight). Null after a cancel, and where
// nothing is generated.
[[nodiscard]] ImagePtr generateEnvironment(const EnvironmentRecipe& recipe, int height,
                                           const JobContext& job = {});

// Makes `image` what the kind asks for: the file's, or generated in full size.
void resolveEnvironment(Environment& environment, const JobContext& job = {});

} // namespace patina
