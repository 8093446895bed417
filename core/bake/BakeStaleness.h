// Whether a bake still belongs to the scene and to what is asked for, and if not, why.
#pragma once

#include "core/bake/BakeRequest.h"

#include <string>
#include <vector>

namespace patina {

struct Document;

struct BakeStaleness {
    bool geometry = false;            // must be traced anew
    bool albedo = false;              // only what surfaces hand on to each other has changed
    bool settings = false;            // it is right, but not what is asked for
    std::vector<std::string> reasons; // for the user: "“Wall” was hidden"

    [[nodiscard]] bool stale() const { return geometry || albedo || settings; }
};

// `inputs` and `albedo`: hashBakeInputs() and hashBakeAlbedo() of the document as it is now.
// `wanted`: the request of the artifact's kind that it is held against; null: none.
[[nodiscard]] BakeStaleness bakeStaleness(const BakeArtifact& artifact, const Document& document,
                                          const Hash& inputs, const Hash& albedo,
                                          const BakeRequest* wanted);

} // namespace patina
