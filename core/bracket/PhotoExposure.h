// How photos of a bracket were exposed: shutter, aperture and sensitivity from Exif, and the
// exposure that follows from them.
#pragma once

#include "core/base/Result.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

struct PhotoExposure {
    double seconds = 0.0; // exposure time; 0: not in the file
    double fNumber = 0.0; // 0: not in the file
    double iso = 0.0;     // 0: not in the file
    friend bool operator==(const PhotoExposure&, const PhotoExposure&) = default;
};

// Of what a file says about itself (ImagePart::attributes). OpenImageIO 2.4 does not read the ISO
// of TIFF files.
[[nodiscard]] PhotoExposure exposureOf(const std::map<std::string, std::string>& attributes);
// Of the file, whose pixels are not read. Errors: those of inspectImage().
Result<PhotoExposure> readExposure(WorkerClient& worker, const std::filesystem::path& file);

// "1/250 s, f/8, ISO 100": what is known of it; empty when nothing is.
[[nodiscard]] std::string exposureText(const PhotoExposure& exposure);

// log2 of seconds · ISO / f-number², which the exposure of a sensor is proportional to, less the
// mean of all photos. An f-number or ISO that none of them has is the same for all. Usage error
// that names the first photo without an exposure time, or without what others have.
Result<std::vector<double>> exposuresEv(std::span<const std::filesystem::path> files,
                                        std::span<const PhotoExposure> exposures);

// Exposures that differ by less are one: the least that cameras bracket by is a third.
inline constexpr double kSameExposureEv = 0.1;

// Whether they are those of a bracket: all known and not all the same.
[[nodiscard]] bool isBracket(std::span<const std::filesystem::path> files,
                             std::span<const PhotoExposure> exposures);

} // namespace patina
