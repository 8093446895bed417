#include "core/radiosity/document/SolvedLightMap.h"

#include "core/base/Limits.h"
#include "core/export/LitVertices.h"
#include "core/io/ImageIO.h"
#include "core/radiosity/document/RadiosityLightMap.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>
#include <utility>

namespace patina {
namespace {

constexpr const char* kOtherFile =
    "it is no light map that patina bake radiosity --target texel has written";

Error brokenMap(const std::filesystem::path& file, std::string message) {
    return {ErrorKind::InputBroken, std::move(message), file, {}};
}

// Whatever order the file has them in; empty where they are others.
Image redGreenBlue(const Image& image) {
    const std::vector<std::string>& names = image.channelNames();
    if (image.channels() != 3 || image.type() != PixelType::F32)
        return {};
    std::array<std::size_t, 3> from{0, 1, 2};
    if (!names.empty())
        for (std::size_t c = 0; c < 3; ++c) {
            const auto found = std::ranges::find(names, std::string(1, "RGB"[c]));
            if (found == names.end())
                return {};
            from[c] = static_cast<std::size_t>(found - names.begin());
        }
    Image result(image.width(), image.height(), 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < result.f32().size(); ++i)
        result.f32()[i] = image.f32()[i / 3 * 3 + from[i % 3]];
    return result;
}

// The file's attribute; nullopt where it is none.
std::optional<double> keptExposure(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0.0) ||
        !std::isfinite(value))
        return std::nullopt;
    return value;
}

} // namespace

Result<SolvedLightMap> SolvedLightMap::read(WorkerClient& worker, const std::filesystem::path& file,
                                            const JobContext& job) {
    SolvedLightMap map;
    map.m_file = file;
    Result<Bytes> bytes = readFile(file, limits::kMaxImageBytes);
    if (!bytes)
        return bytes.error();
    map.m_bytes = std::move(*bytes);
    ImageLoadOptions options;
    options.sanitize = false; // what is broken is said, not repaired
    Result<LoadedImage> loaded = loadImageFromMemory(worker, map.m_bytes, file.string(), options);
    if (!loaded)
        return loaded.error();
    if (job.cancelled())
        return bakeCancelled();
    map.m_radiance = redGreenBlue(loaded->image());
    if (loaded->format != "openexr" || map.m_radiance.empty() ||
        map.m_radiance.width() != map.m_radiance.height() ||
        map.m_radiance.width() > kMaxRadiosityMapSize)
        return brokenMap(
            file,
            fmt::format("{}: those are OpenEXR, square, with the channels R, G and B", kOtherFile));
    const std::map<std::string, std::string>& attributes = loaded->parts.front().attributes;
    if (const auto kept = attributes.find(kAutomaticExposureAttribute); kept != attributes.end()) {
        map.m_automatic = keptExposure(kept->second);
        if (!map.m_automatic)
            return brokenMap(file, fmt::format("its attribute {} is no number above 0; bake the "
                                               "scene again",
                                               kAutomaticExposureAttribute));
    } else {
        // Older versions said nothing of what a file is. Other bakes do, and other light maps have
        // 16 bits.
        const Result<ImageInfo> info = inspectImage(worker, file);
        if (!info)
            return info.error();
        if (info->pixelType != "float" ||
            std::ranges::any_of(attributes, [](const auto& attribute) {
                return attribute.first.starts_with("patina:");
            }))
            return brokenMap(file, fmt::format("{}: those have 32-bit floats and the attribute {}",
                                               kOtherFile, kAutomaticExposureAttribute));
    }
    if (!std::ranges::all_of(map.m_radiance.f32(),
                             [](float value) { return std::isfinite(value); }))
        return brokenMap(file, "one of its texels is not finite; bake the scene again");
    return map;
}

Result<double> SolvedLightMap::exposureOf(const ExposureRequest& request) const {
    if (request.kind == ExposureRequest::Kind::None)
        return 0.0;
    if (request.kind == ExposureRequest::Kind::Value)
        return request.k;
    if (m_automatic)
        return *m_automatic;
    return Error{ErrorKind::Usage,
                 fmt::format("it does not hold its automatic exposure ({}), as an older version "
                             "has written it; give --exposure K or none, or bake the scene again",
                             kAutomaticExposureAttribute),
                 m_file,
                 {}};
}

Result<Bytes> SolvedLightMap::picture(WorkerClient& worker, double k) const {
    return encodeImage(worker,
                       *shownLightMap(m_radiance, k > 0.0 ? std::optional(k) : std::nullopt),
                       ImageFileFormat::Png);
}

} // namespace patina
