#include "core/mix/EnvironmentBlend.h"

#include "core/job/Parallel.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/OrientedEnvironment.h"
#include "core/mix/LightMix.h"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace patina {
namespace {

Image fitted(const Image& picture, const Orientation& stands, int width, const JobContext& job) {
    if (picture.width() == width)
        return orientEnvironment(picture, stands, 0.0f, job);
    const auto mapping = [](int w) {
        return EnvironmentMapping::create(EnvironmentLayout::LatLong, {w, w / 2}).value();
    };
    return resampleEnvironment(picture, mapping(picture.width()), mapping(width), {stands, 1.0f},
                               job);
}

} // namespace

std::optional<EnvironmentBlend> environmentBlend(const Document& document) {
    const std::vector<EnvironmentPart> parts = environmentParts(document);
    if (parts.size() < 2)
        return std::nullopt;
    // A rotation of both alike is no part of the picture.
    Orientation first = parts[0].orientation, second = parts[1].orientation;
    second.rotationDeg -= first.rotationDeg;
    first.rotationDeg = 0.0f;
    return EnvironmentBlend{parts[0].image, parts[1].image, first,
                            second,         parts[0].scale, parts[1].scale};
}

ImagePtr blendEnvironments(const EnvironmentBlend& blend, const JobContext& job) {
    const int width = std::max(blend.first->width(), blend.second->width());
    Image sum = fitted(*blend.first, blend.firstStands, width, job);
    const Image second = fitted(*blend.second, blend.secondStands, width, job);
    if (job.cancelled())
        return nullptr;
    const std::span<float> out = sum.f32();
    const std::span<const float> added = second.f32();
    parallelFor(job, out.size() / 3, 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const auto channel = static_cast<int>(c);
                out[3 * i + c] = blend.firstScale[channel] * out[3 * i + c] +
                                 blend.secondScale[channel] * added[3 * i + c];
            }
    });
    if (job.cancelled())
        return nullptr;
    return std::make_shared<const Image>(std::move(sum));
}

std::optional<Environment> mixedEnvironment(const Document& document, const JobContext& job) {
    const std::vector<EnvironmentPart> parts = environmentParts(document);
    if (parts.empty())
        return std::nullopt;
    Environment mixed = document.environment();
    mixed.tint = glm::vec3(1.0f);
    const EnvironmentPart& part = parts.front();
    const bool both = parts.size() == 2;
    const glm::vec3 plain(std::exp2(mixed.exposureEv));
    if (!both && part.role == EnvironmentPart::Role::First && part.scale == plain)
        return mixed;
    if (both) {
        mixed.image = blendEnvironments(*environmentBlend(document), job);
        if (!mixed.image)
            return std::nullopt; // cancelled
    } else {
        Image image = *part.image;
        const std::span<float> texels = image.f32();
        for (std::size_t i = 0; i < texels.size(); ++i)
            texels[i] *= part.scale[static_cast<glm::length_t>(i % 3)];
        mixed.image = std::make_shared<const Image>(std::move(image));
        if (part.role == EnvironmentPart::Role::Second) {
            const Environment& second = *document.secondEnvironment();
            mixed.source = second.source;
            mixed.kind = second.kind;
        }
    }
    const Orientation stands = both ? Orientation{part.orientation.rotationDeg} : part.orientation;
    std::tie(mixed.rotationDeg, mixed.tiltDeg, mixed.rollDeg) =
        std::tie(stands.rotationDeg, stands.tiltDeg, stands.rollDeg);
    mixed.exposureEv = 0.0f;
    return mixed;
}

void resolveBlend(Document& document, const JobContext& job) {
    const std::optional<EnvironmentBlend> blend = environmentBlend(document);
    document.mix.blended = blend ? blendEnvironments(*blend, job) : nullptr;
}

} // namespace patina
