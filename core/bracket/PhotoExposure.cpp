#include "core/bracket/PhotoExposure.h"

#include "core/base/Check.h"
#include "core/io/ImageIO.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace patina {
namespace {

double numberOf(const std::map<std::string, std::string>& attributes, const char* name) {
    const auto found = attributes.find(name);
    if (found == attributes.end())
        return 0.0;
    double value = 0.0;
    const std::string& text = found->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && std::isfinite(value) && value > 0.0 ? value : 0.0;
}

// What `part` is of each photo, or 1 where no photo has it. The index of a photo without it where
// others have it.
Result<std::vector<double>> allOrNone(std::span<const std::filesystem::path> files,
                                      std::span<const PhotoExposure> exposures,
                                      double PhotoExposure::*part, const char* what) {
    const auto has = [&](const PhotoExposure& exposure) { return exposure.*part > 0.0; };
    if (std::none_of(exposures.begin(), exposures.end(), has))
        return std::vector<double>(exposures.size(), 1.0);
    std::vector<double> result;
    for (std::size_t i = 0; i < exposures.size(); ++i) {
        if (!has(exposures[i]))
            return Error{ErrorKind::Usage,
                         fmt::format("the photo does not say its {}, which others do; give the "
                                     "exposures of all photos",
                                     what),
                         files[i],
                         {}};
        result.push_back(exposures[i].*part);
    }
    return result;
}

} // namespace

PhotoExposure exposureOf(const std::map<std::string, std::string>& attributes) {
    PhotoExposure exposure;
    exposure.seconds = numberOf(attributes, "ExposureTime");
    exposure.fNumber = numberOf(attributes, "FNumber");
    exposure.iso = numberOf(attributes, "Exif:PhotographicSensitivity");
    if (exposure.iso == 0.0) // the tag's name before Exif 2.3
        exposure.iso = numberOf(attributes, "Exif:ISOSpeedRatings");
    return exposure;
}

Result<PhotoExposure> readExposure(WorkerClient& worker, const std::filesystem::path& file) {
    const Result<ImageInfo> info = inspectImage(worker, file);
    if (!info)
        return info.error();
    return exposureOf(info->attributes);
}

std::string exposureText(const PhotoExposure& exposure) {
    // From here on cameras say seconds: 0.3 s is not 1/3 s on their dials.
    constexpr double kLongestFraction = 0.26;
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (exposure.seconds > kLongestFraction)
        add(fmt::format("{:.3g} s", exposure.seconds));
    else if (exposure.seconds > 0.0)
        add(fmt::format("1/{:.0f} s", 1.0 / exposure.seconds));
    if (exposure.fNumber > 0.0)
        add(fmt::format("f/{:.3g}", exposure.fNumber));
    if (exposure.iso > 0.0)
        add(fmt::format("ISO {:.0f}", exposure.iso));
    return text;
}

Result<std::vector<double>> exposuresEv(std::span<const std::filesystem::path> files,
                                        std::span<const PhotoExposure> exposures) {
    CHECK(files.size() == exposures.size());
    for (std::size_t i = 0; i < exposures.size(); ++i)
        if (exposures[i].seconds <= 0.0)
            return Error{ErrorKind::Usage,
                         "the photo does not say its exposure time (Exif); give the exposures of "
                         "all photos, or use the files as the camera wrote them",
                         files[i],
                         {}};
    const auto fNumbers = allOrNone(files, exposures, &PhotoExposure::fNumber, "f-number");
    if (!fNumbers)
        return fNumbers.error();
    const auto isos = allOrNone(files, exposures, &PhotoExposure::iso, "ISO");
    if (!isos)
        return isos.error();
    std::vector<double> result;
    for (std::size_t i = 0; i < exposures.size(); ++i)
        result.push_back(
            std::log2(exposures[i].seconds * (*isos)[i] / ((*fNumbers)[i] * (*fNumbers)[i])));
    const double mean =
        std::accumulate(result.begin(), result.end(), 0.0) / static_cast<double>(result.size());
    for (double& ev : result)
        ev -= mean;
    return result;
}

bool isBracket(std::span<const std::filesystem::path> files,
               std::span<const PhotoExposure> exposures) {
    if (exposures.size() < 2)
        return false;
    const Result<std::vector<double>> evs = exposuresEv(files, exposures);
    if (!evs)
        return false;
    const auto [least, most] = std::minmax_element(evs->begin(), evs->end());
    return *most - *least >= kSameExposureEv;
}

} // namespace patina
