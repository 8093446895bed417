// Which bake of radiance transfer a sweep of lights reads: the one that the document has, or a
// quick one made for it.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

namespace patina {

// Bands and rays per vertex of a quick bake: pictures as small as a sweep's show no more.
inline constexpr int kQuickSweepBands = 5, kQuickSweepRays = 256;

// The document's radiance transfer whose file is there: per vertex, else per texel; null: none.
[[nodiscard]] BakeArtifactPtr attachedSweepBake(const Document& document);

// Per vertex, of the visible meshes as they are now. Errors: those of bakePrtVertex().
Result<BakeArtifactPtr> quickSweepBake(const Document& document, const JobContext& job);

// The first where there is one, else the second.
struct SweepBake {
    BakeArtifactPtr bake; // never null
    bool quick = false;   // it was made for the sweep
};
Result<SweepBake> chooseSweepBake(const Document& document, const JobContext& job);

} // namespace patina
