// What a SolutionCache keeps of a radiosity, under which names: hashes of all that it follows from,
// and of nothing else.
#pragma once

#include "core/base/Hash.h"
#include "core/base/Result.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/radiosity/file/SolutionCache.h"

#include <memory>
#include <optional>

namespace patina {

// Of an adaptive division, which follows from everything: all light, all materials.
[[nodiscard]] Hash divisionKey(const TraceInputs& inputs, const RadiositySettings& settings);

// RadiosityScene::make() of an adaptive division, or the same without solving where the cache has
// it; null: there is none. `division` receives what a cache may keep of it; stopped early: nothing.
// `rows`: the form factors that were found on the way, of the elements that there are in the end.
Result<std::unique_ptr<RadiosityScene>>
divideByLight(const TraceInputs& inputs, const RadiositySettings& settings,
              const radiosity::SolutionCache* cache, std::optional<NamedDivision>& division,
              radiosity::FactorMatrix& rows, const JobContext& job);

// Of the light of single sources, at a power of 1: what the mixer does to one, its name, and other
// sources are not in its key. Ids of lights are, because rays to a light follow from its id; those
// of meshes and materials are not, so that a scene opened again finds its light.
class SolutionKeys {
  public:
    // Of the elements, reflectances and settings of `live`. Reads all vertices.
    explicit SolutionKeys(const LiveRadiosity& live);
    // Reads the texels of environments for the sky, those of all maps for what glows.
    [[nodiscard]] Hash of(const RadiositySource& source) const;

  private:
    const LiveRadiosity& m_live;
    Hash m_elements; // of all but the source
};

// Writes what `live`, which is solved, has and the cache has not. Errors: those of
// SolutionCache::store().
Result<void> keepRadiosity(const LiveRadiosity& live, const radiosity::SolutionCache& cache);

} // namespace patina
