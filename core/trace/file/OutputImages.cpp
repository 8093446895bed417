#include "core/trace/file/OutputImages.h"

#include "core/base/Check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr std::array kOutputs = {
    OutputInfo{OutputKind::Beauty, "beauty", "Beauty", "", "RGB"},
    OutputInfo{OutputKind::Background, "background", "Background", "", "RGB"},
    OutputInfo{OutputKind::Emission, "emission", "Emission", "", "RGB"},
    OutputInfo{OutputKind::DirectDiffuse, "directDiffuse", "Direct diffuse", "", "RGB"},
    OutputInfo{OutputKind::DirectSpecular, "directSpecular", "Direct specular", "", "RGB"},
    OutputInfo{OutputKind::IndirectDiffuse, "indirectDiffuse", "Indirect diffuse", "", "RGB"},
    OutputInfo{OutputKind::IndirectSpecular, "indirectSpecular", "Indirect specular", "", "RGB"},
    OutputInfo{OutputKind::Albedo, "albedo", "Albedo", "", "RGB"},
    OutputInfo{OutputKind::Normal, "normal", "Shading normal, world", "", "XYZ"},
    OutputInfo{OutputKind::Position, "position", "Position, world", "m", "XYZ"},
    OutputInfo{OutputKind::Depth, "depth", "Distance from the camera's plane", "m", "Z"},
    OutputInfo{OutputKind::Coverage, "coverage", "Share of paths that met a surface", "", "Y"},
    OutputInfo{OutputKind::Samples, "samples", "Paths of the pixel", "", "Y"},
    OutputInfo{OutputKind::StandardError, "standardError", "Standard error of the luminance", "",
               "Y"}};

using PixelValue = std::function<glm::dvec3(const Film::Pixel&, const TraceOutputs::Pixel&)>;

// Light: the mean over all paths.
PixelValue meanOf(glm::vec3 TraceOutputs::Pixel::*sum) {
    return [sum](const Film::Pixel& pixel, const TraceOutputs::Pixel& outputs) {
        return pixel.samples > 0 ? glm::dvec3(outputs.*sum) / static_cast<double>(pixel.samples)
                                 : glm::dvec3(0.0);
    };
}

// Of a surface: over those that met one.
PixelValue seenOf(glm::vec3 TraceOutputs::Pixel::*sum) {
    return [sum](const Film::Pixel&, const TraceOutputs::Pixel& outputs) {
        return outputs.hits > 0 ? glm::dvec3(outputs.*sum) / static_cast<double>(outputs.hits)
                                : glm::dvec3(0.0);
    };
}

PixelValue valueOf(OutputKind kind, const Camera& camera) {
    using Sums = TraceOutputs::Pixel;
    switch (kind) {
    case OutputKind::Background:
        return meanOf(&Sums::background);
    case OutputKind::Emission:
        return meanOf(&Sums::emission);
    case OutputKind::DirectDiffuse:
        return meanOf(&Sums::directDiffuse);
    case OutputKind::DirectSpecular:
        return meanOf(&Sums::directSpecular);
    case OutputKind::IndirectDiffuse:
        return meanOf(&Sums::indirectDiffuse);
    case OutputKind::IndirectSpecular:
        return meanOf(&Sums::indirectSpecular);
    case OutputKind::Albedo:
        return seenOf(&Sums::albedo);
    case OutputKind::Normal:
        return [mean = seenOf(&Sums::normal)](const Film::Pixel& pixel, const Sums& outputs) {
            const glm::dvec3 normal = mean(pixel, outputs);
            const double length = glm::length(normal);
            return length > 0.0 ? normal / length : normal;
        };
    case OutputKind::Position:
        return [mean = seenOf(&Sums::position), eye = glm::dvec3(camera.position())](
                   const Film::Pixel& pixel, const Sums& outputs) {
            return outputs.hits > 0 ? eye + mean(pixel, outputs) : glm::dvec3(0.0);
        };
    case OutputKind::Depth:
        return [mean = seenOf(&Sums::position), forward = glm::dvec3(camera.forward())](
                   const Film::Pixel& pixel, const Sums& outputs) {
            return glm::dvec3(glm::dot(mean(pixel, outputs), forward));
        };
    case OutputKind::Coverage:
        return [](const Film::Pixel& pixel, const Sums& outputs) {
            return glm::dvec3(pixel.samples > 0 ? static_cast<double>(outputs.hits) / pixel.samples
                                                : 0.0);
        };
    case OutputKind::Samples:
        return [](const Film::Pixel& pixel, const Sums&) {
            return glm::dvec3(static_cast<double>(pixel.samples));
        };
    case OutputKind::StandardError:
        // One sample tells nothing of its error: all of it may be one.
        return [](const Film::Pixel& pixel, const Sums&) {
            return glm::dvec3(pixel.samples < 2 ? pixel.luminance() : std::sqrt(pixel.variance()));
        };
    case OutputKind::Beauty:
        break;
    }
    CHECK(false);
    return {};
}

bool readsOutputs(OutputKind kind) {
    return kind != OutputKind::Beauty && kind != OutputKind::Samples &&
           kind != OutputKind::StandardError;
}

} // namespace

std::span<const OutputInfo> outputInfos() {
    return kOutputs;
}

Result<std::vector<const OutputInfo*>> parseOutputs(std::string_view text) {
    std::array<bool, kOutputs.size()> wanted{};
    wanted[0] = true;
    for (std::string_view left = text; !left.empty() || text.empty();) {
        const std::size_t comma = std::min(left.find(','), left.size());
        const std::string_view name = left.substr(0, comma);
        left.remove_prefix(std::min(comma + 1, left.size()));
        if (name == "all") {
            wanted.fill(true);
            continue;
        }
        const auto found = std::ranges::find(kOutputs, name, &OutputInfo::id);
        if (found == kOutputs.end()) {
            std::string names;
            for (const OutputInfo& info : kOutputs)
                names += fmt::format(", {}", info.id);
            return Error{ErrorKind::Usage,
                         fmt::format("outputs are \"all\", or names separated by commas: {}; not "
                                     "\"{}\"",
                                     names.substr(2), name),
                         {},
                         {}};
        }
        wanted[static_cast<std::size_t>(found - kOutputs.begin())] = true;
    }
    std::vector<const OutputInfo*> chosen;
    for (std::size_t i = 0; i < kOutputs.size(); ++i)
        if (wanted[i])
            chosen.push_back(&kOutputs[i]);
    return chosen;
}

std::string namesOf(std::span<const OutputInfo* const> chosen) {
    std::string names;
    for (const OutputInfo* info : chosen)
        names += fmt::format("{}{}", names.empty() ? "" : ",", info->id);
    return names;
}

bool needTraceOutputs(std::span<const OutputInfo* const> chosen) {
    return std::ranges::any_of(chosen,
                               [](const OutputInfo* info) { return readsOutputs(info->kind); });
}

Image outputImage(OutputKind kind, const Film& film, const TraceOutputs& outputs,
                  const Camera& camera, bool alpha) {
    if (kind == OutputKind::Beauty)
        return film.radiance(alpha);
    CHECK(!outputs.empty() || !readsOutputs(kind));
    const std::string_view channels =
        std::ranges::find(kOutputs, kind, &OutputInfo::kind)->channels;
    Image image(film.width(), film.height(), static_cast<int>(channels.size()), PixelType::F32,
                ColorEncoding::Linear);
    std::vector<std::string> names;
    for (const char channel : channels)
        names.emplace_back(1, channel);
    image.setChannelNames(names);
    const PixelValue value = valueOf(kind, camera);
    const TraceOutputs::Pixel none;
    float* out = image.f32().data();
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const glm::dvec3 v = value(film.pixels()[i], outputs.empty() ? none : outputs.pixels()[i]);
        for (int c = 0; c < static_cast<int>(channels.size()); ++c)
            *out++ = static_cast<float>(v[c]);
    }
    return image;
}

} // namespace patina
