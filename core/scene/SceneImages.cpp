// Images for maps and environments.
#include "core/base/Check.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/light/EnvironmentResample.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/SceneLoader.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace patina {
namespace {

constexpr int kMaxEnvironmentWidth = 4096;

Error missingEmbedded(const EmbeddedSource& source) {
    return {ErrorKind::InputBroken,
            fmt::format("the image number {} inside of this model cannot be found or has a form "
                        "that Patina does not read",
                        source.index),
            source.model,
            {}};
}

Result<MapImage> takeFirst(Result<LoadedImage> loaded) {
    if (!loaded)
        return loaded.error();
    MapImage result;
    result.repairedSamples = loaded->sanitizedSamples;
    result.image = std::make_shared<const Image>(std::move(loaded->parts.front().image));
    return result;
}

// A picture of other proportions as twice as wide as high; neither side gets smaller.
Image stretched(const Image& picture) {
    const int width = std::max(2, std::max(picture.width(), 2 * picture.height()) / 2 * 2);
    Image result(width, width / 2, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> texels = result.f32();
    const float halfTexel = 0.5f / static_cast<float>(picture.height());
    parallelFor(
        {}, static_cast<std::size_t>(result.height()), 16, [&](std::size_t begin, std::size_t end) {
            for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                for (int x = 0; x < result.width(); ++x) {
                    const float u =
                        (static_cast<float>(x) + 0.5f) / static_cast<float>(result.width());
                    const float v =
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(result.height());
                    // Lookups repeat, but the sky does not continue below the ground.
                    const glm::vec4 pixel =
                        sampleBilinear(picture, u, std::clamp(v, halfTexel, 1.0f - halfTexel));
                    const std::size_t at = 3 * (static_cast<std::size_t>(y) *
                                                    static_cast<std::size_t>(result.width()) +
                                                static_cast<std::size_t>(x));
                    for (int c = 0; c < 3; ++c)
                        texels[at + static_cast<std::size_t>(c)] = pixel[c];
                }
        });
    return result;
}

// What the light needs of a picture: a lat-long, not too large.
Image toLatLong(const EnvironmentPicture& picture, const JobContext& job) {
    if (picture.mapping.isCommonLatLong()) {
        const ImageSize size = picture.mapping.size();
        if (size.width == 2 * size.height)
            return shrinkLatLong(picture.image, kMaxEnvironmentWidth);
        const int limit = kMaxEnvironmentWidth / (size.height > size.width ? 2 : 1);
        return stretched(shrinkImage(picture.image, limit));
    }
    const int width = std::min(picture.mapping.latLongSize().width, kMaxEnvironmentWidth);
    const Result<EnvironmentMapping> latLong = EnvironmentMapping::create(
        EnvironmentLayout::LatLong,
        EnvironmentMapping::imageSize(EnvironmentLayout::LatLong, width));
    return resampleEnvironment(picture.image, picture.mapping, *latLong, {}, job);
}

} // namespace

std::string repairedText(std::size_t samples) {
    return fmt::format("{} samples were infinite, negative or no numbers, and were replaced",
                       samples);
}

Result<MapImage> readMapImage(WorkerClient* worker, const std::string& source,
                              ColorEncoding integerEncoding, const std::vector<Bytes>* embedded) {
    if (isBuiltin(source)) {
        Result<ImagePtr> image = library::map(builtinName(source));
        if (!image)
            return image.error();
        return MapImage{*std::move(image), 0};
    }
    CHECK(worker != nullptr);
    ImageLoadOptions options;
    options.integerEncoding = integerEncoding;
    const std::optional<EmbeddedSource> inside = parseEmbeddedSource(source);
    if (!inside)
        return takeFirst(loadImage(*worker, source, options));
    CHECK(embedded != nullptr);
    const std::size_t index = static_cast<std::size_t>(inside->index);
    if (index >= embedded->size() || (*embedded)[index].empty())
        return missingEmbedded(*inside);
    return takeFirst(loadImageFromMemory(*worker, (*embedded)[index], source, options));
}

Result<ImagePtr> loadMapImage(WorkerClient& worker, const std::string& source,
                              ColorEncoding integerEncoding, std::vector<Notice>* notices) {
    std::vector<Bytes> embedded;
    if (const auto inside = parseEmbeddedSource(source)) {
        Result<ImportedModel> model = importModel(worker, inside->model);
        if (!model)
            return model.error();
        embedded = std::move(model->embeddedImages);
    }
    Result<MapImage> result = readMapImage(&worker, source, integerEncoding, &embedded);
    if (!result)
        return result.error();
    if (result->repairedSamples > 0 && notices != nullptr)
        notices->push_back({repairedText(result->repairedSamples), source});
    return std::move(result->image);
}

Result<ImagePtr> readEnvironmentImage(WorkerClient* worker, const std::string& source,
                                      EnvironmentLayout layout, std::vector<Notice>& notices,
                                      const JobContext& job) {
    if (isBuiltin(source))
        return library::environment(builtinName(source));
    CHECK(worker != nullptr);
    const Result<EnvironmentPicture> picture =
        readEnvironmentPicture(*worker, source, layout, notices, job);
    if (!picture)
        return picture.error();
    auto image = std::make_shared<const Image>(toLatLong(*picture, job));
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "reading was cancelled", source, {}};
    return image;
}

Result<ImagePtr> loadEnvironmentImage(WorkerClient& worker, const std::string& source,
                                      std::vector<Notice>& notices, EnvironmentLayout layout,
                                      const JobContext& job) {
    return readEnvironmentImage(&worker, source, layout, notices, job);
}

} // namespace patina
