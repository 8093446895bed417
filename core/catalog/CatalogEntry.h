// An environment of a catalog: what it is, what was measured of it and what it looks like.
#pragma once

#include "core/base/Hash.h"
#include "core/base/Result.h"
#include "core/catalog/EnvironmentMeasures.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

struct CatalogEntry {
    std::string source;          // absolute path, of six faces the first; or "builtin:NAME"
    std::string title;           // environmentTitle()
    std::uint64_t fileBytes = 0; // of all six faces together; 0: built in
    int width = 0, height = 0;   // of the file's picture, in pixels; of a face where there are six
    std::string layout;          // "Lat-long", as in the parameter table
    EnvironmentMeasures measures;
    Image thumbnail;                  // environmentThumbnail()
    std::vector<std::string> notices; // doubts of whoever read it: repaired samples, a stretch …
    std::vector<glm::vec3> harmonics; // radiance, kMaxShOrder bands
    Hash texels;                      // of the picture as it was read, below kMaxEnvironmentSide
    friend bool operator==(const CatalogEntry&, const CatalogEntry&) = default;
};
using CatalogEntryPtr = std::shared_ptr<const CatalogEntry>;

// What an entry is made from: the path, size and time of modification of the file or of its six
// faces, and the version of what is measured. Errors: InputMissing.
Result<Hash> catalogKey(const std::string& source);

// Reads the environment (a file in the worker) and measures it. Errors: those of
// readEnvironmentPicture(), Usage (no such built-in environment), Cancelled.
Result<CatalogEntry> makeCatalogEntry(WorkerClient& worker, const std::string& source,
                                      const JobContext& job = {});

struct SameEntry {
    std::size_t of = 0; // the first that is the same light
    float rotationDeg = 0.0f;
    bool exactly = false; // the very texels
};
// For each entry the first one before it that is the same light (core/rank/SweepEnvironment.h): a
// copy, the same at another resolution, or rotated. A black one is none.
[[nodiscard]] std::vector<std::optional<SameEntry>>
findSameEntries(std::span<const CatalogEntryPtr> entries, const JobContext& job = {});

} // namespace patina
