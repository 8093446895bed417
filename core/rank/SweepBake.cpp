#include "core/rank/SweepBake.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/Edit.h"

#include <memory>
#include <utility>

namespace patina {

BakeArtifactPtr attachedSweepBake(const Document& document) {
    for (const BakeKind kind : {BakeKind::PrtVertex, BakeKind::PrtTexel})
        if (BakeArtifactPtr bake = findBake(document, kind); bake && bake->missingFile.empty())
            return bake;
    return nullptr;
}

Result<BakeArtifactPtr> quickSweepBake(const Document& document, const JobContext& job) {
    PrtSettings settings;
    settings.order = kQuickSweepBands;
    settings.samples = kQuickSweepRays;
    TileSink sink;
    Result<BakeArtifact> baked = bakePrtVertex(bakeInputs(document), settings, sink, job);
    if (!baked)
        return baked.error();
    return std::make_shared<const BakeArtifact>(std::move(*baked));
}

Result<SweepBake> chooseSweepBake(const Document& document, const JobContext& job) {
    if (BakeArtifactPtr attached = attachedSweepBake(document))
        return SweepBake{std::move(attached), false};
    Result<BakeArtifactPtr> quick = quickSweepBake(document, job);
    if (!quick)
        return quick.error();
    return SweepBake{std::move(*quick), true};
}

} // namespace patina
