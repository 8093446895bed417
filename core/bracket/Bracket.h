// Photos of one scene at different exposures, made into one picture of radiance.
#pragma once

#include "core/bracket/BracketMerge.h"
#include "core/bracket/PhotoAlignment.h"
#include "core/bracket/PhotoExposure.h"
#include "core/bracket/ResponseCurve.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

class WorkerClient;

struct BracketOptions {
    // Of each photo, in stops, -100…100; only their differences count. Empty: what the files say
    // (Exif).
    std::vector<double> exposuresEv;
    bool align = true;
};

// What a bracket's photo was found to be.
struct BracketPhoto {
    std::filesystem::path file;
    PhotoExposure exposure;          // as its file says, all unknown where it says nothing
    double ev = 0.0;                 // against the mean of all photos
    PhotoShift shift;                // that was undone
    double white = 0.0, black = 0.0; // shares of its pixels with a clipped channel
};

enum class ResponseKind {
    Recovered, // from the photos
    Srgb,      // recovered, and the same as sRGB's: that is used
    Assumed,   // sRGB's, as too little can be compared; a warning says so
    Linear,    // floating-point photos have none
};

struct BracketReport {
    std::vector<BracketPhoto> photos; // by rising exposure
    ResponseKind response = ResponseKind::Recovered;
    std::vector<LogResponse> curves; // one, or those of red, green, blue; none when linear
    double srgbDifference = 0.0;     // responseDifference() of the worst channel
    double noiseCodes = 0.0;         // of the worst channel
    double clippedAbove = 0.0, clippedBelow = 0.0, disagreeing = 0.0; // shares of the pixels
    std::vector<std::string> warnings;
};

struct Bracket {
    MergedPhotos merged;
    BracketReport report;
};

inline constexpr std::size_t kMaxPhotos = 64;

// Reads the photos in the worker, aligns and merges them. Errors: those of loadImage(); Usage,
// naming the photo, for fewer than two photos, no exposure, exposures that are all the same, sizes
// or kinds that differ; Cancelled.
Result<Bracket> makeBracket(WorkerClient& worker, std::span<const std::filesystem::path> files,
                            const BracketOptions& options = {}, const JobContext& job = {});

// "sRGB", "recovered from the photos" …
[[nodiscard]] std::string_view responseText(ResponseKind kind);

} // namespace patina
