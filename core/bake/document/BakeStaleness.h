// Whether a bake still belongs to the scene, and if not, why; how it differs from what a user asks
// for; whether it was stopped before its last ray.
#pragma once

#include "core/bake/domain/BakeRequest.h"

#include <optional>
#include <string>
#include <vector>

namespace patina {

struct Document;

struct BakeStaleness {
    bool geometry = false;            // must be traced anew
    bool albedo = false;              // only what surfaces hand on to each other has changed
    bool light = false;               // of a light map: what lights and surfaces are
    std::vector<std::string> reasons; // for the user: "“Wall” was hidden"

    [[nodiscard]] bool stale() const { return geometry || albedo || light; }
};

// `inputs`, `albedo` and `light`: hashBakeInputs(), hashBakeAlbedo() and, for light maps alone,
// hashLightMapLight() of the document as it is now.
// Settings do not make a bake stale: it stays right, whatever else could be baked.
[[nodiscard]] BakeStaleness bakeStaleness(const BakeArtifact& artifact, const Document& document,
                                          const Hash& inputs, const Hash& albedo,
                                          const Hash& light = {});

// Where a bake was made with other settings than `wanted` has, a request of its kind. Older files
// do not hold all settings; those count as equal.
struct SettingDifference {
    std::string label;         // "Rays"
    std::string baked, wanted; // "1024", "16384"
    friend bool operator==(const SettingDifference&, const SettingDifference&) = default;
};
[[nodiscard]] std::vector<SettingDifference> settingDifferences(const BakeArtifact& artifact,
                                                                const BakeRequest& wanted);

// A bake that was stopped: the rays per vertex or texel that it has, and those asked for.
struct StoppedBake {
    int done = 0, asked = 0;
};
[[nodiscard]] std::optional<StoppedBake> stoppedEarly(const BakeArtifact& artifact);

} // namespace patina
