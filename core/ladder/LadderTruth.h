// The traced picture that all rungs of a ladder are held against.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/blame/BlameFilm.h"
#include "core/trace/error/TracedPicture.h"
#include "core/trace/path/PathTracer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct Document;

struct LadderTruthSettings {
    std::uint32_t samples = 256; // paths per pixel at most, at least 4
    std::optional<double> noise; // Film::noise() that ends it, a share of the mean
    bool blame = false;          // also what blame needs, from as many paths
};

struct LadderTruth {
    TracedPicture picture;
    Film film;
    std::optional<BlameFilm> blame;   // where it was wanted
    std::vector<Id> materials;        // seenMaterials() of it
    std::uint32_t samples = 0;        // paths of each pixel
    double noise = 0.0;               // Film::noise()
    double seconds = 0.0;             // that tracing took
    std::optional<std::string> limit; // TraceScene::limit()
};

// `view`: of the document. `seen`: called after each pass with what there is so far; may be empty.
// Errors: those of TraceScene::build(); Cancelled.
Result<LadderTruth>
traceLadderTruth(const Document& document, const TraceView& view,
                 const LadderTruthSettings& settings, const JobContext& job,
                 const std::function<void(const Film& film, std::uint32_t samples)>& seen = {});

} // namespace patina
