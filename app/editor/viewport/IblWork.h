// Image-based light of an environment's picture, as the viewport's textures hold it: what tasks in
// the background do.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/job/TaskRunner.h"
#include "core/light/EnvironmentTexels.h"
#include "core/light/IblCache.h"

#include <filesystem>
#include <memory>

namespace patina::editor {

// Computed light outlives the session; the system may empty this folder at any time.
[[nodiscard]] std::filesystem::path iblCacheFolder();

struct IblLight {
    ImagePtr environment;
    Hash key; // of IblCache
    HalfMipmapsPtr background;
    std::shared_ptr<const IblMaps> maps;
    EnvironmentTexelsPtr texels;
    bool full = false; // else small: some ten milliseconds' worth
};

[[nodiscard]] Hash iblKey(const Image& environment); // of IblCache, for light in full

// From the cache in full, or else small. `key`: of the environment. Errors: Cancelled.
Result<IblLight> firstIbl(const IblCache& cache, const ImagePtr& environment, const Hash& key,
                          const JobContext& job);
// Of what firstIbl() made small. Errors: Cancelled.
Result<IblLight> refinedIbl(IblLight light, const JobContext& job);
// Its maps in full, as firstIbl() finds them or refinedIbl() computes them; no texels.
Result<IblLight> fullIblMaps(const IblCache& cache, const ImagePtr& environment,
                             const JobContext& job);

// Writes full light into the cache when nobody is in a hurry: nobody waits for the disk. `cache`
// outlives the tasks.
void keepIbl(TaskGroup& tasks, const IblCache& cache, const IblLight& full);

} // namespace patina::editor
