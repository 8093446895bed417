#include "core/bake/document/FollowBounces.h"

#include "core/bake/bounce/Interreflection.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/document/ViewChoices.h"

#include <optional>
#include <utility>

namespace patina {

Result<std::vector<std::string>> followBounces(LightingMode lighting, Document& document,
                                               const JobContext& job) {
    std::vector<std::string> warnings;
    const int bounces = document.view.bounces;
    // Less than 0 bounces: none are shown, which needs no other bake.
    if (document.bakes.empty() || bounces < 0 || lighting != LightingMode::Prt)
        return warnings;
    const BakeInputs inputs = bakeInputs(document);
    const Hash geometry = hashBakeInputs(inputs);
    std::optional<Hash> albedo; // reads every texel of the maps
    for (BakeArtifactPtr& bake : document.bakes) {
        if (!holdsTransfer(bake->kind) || bake->transfer != TransferKind::Interreflected)
            continue;
        if (!albedo)
            albedo = hashBakeAlbedo(inputs);
        const bool otherColors = bake->albedo != *albedo;
        const bool otherNumber = bounces != 0 && bake->bounces != bounces;
        if (!otherColors && !otherNumber)
            continue;
        const bool canFollow = bake->kind == BakeKind::PrtVertex && bake->inputs == geometry;
        if (!otherNumber && !canFollow) {
            warnings.emplace_back("the bounces of the bake are of other colours than the scene "
                                  "has now, and show those; bake it anew");
            continue;
        }
        Result<BakeArtifactPtr> followed =
            withBounces(*bake, inputs, bounces != 0 ? bounces : bake->bounces, job);
        if (!followed)
            return followed.error();
        bake = std::move(*followed);
    }
    return warnings;
}

} // namespace patina
