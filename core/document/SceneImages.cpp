// Images for maps and environments.
#include "core/base/Check.h"
#include "core/document/SceneLoader.h"
#include "core/image/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

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

// Any picture as RGB floats of twice the width of its height, which is what the light needs.
Image toLatLong(const Image& source) {
    // Neither side is ever made smaller unless it is beyond the limit.
    const double width = std::max<double>(source.width(), 2.0 * source.height());
    const int targetWidth =
        std::max(2, static_cast<int>(std::min<double>(width, kMaxEnvironmentWidth)) / 2 * 2);
    Image shrunk;
    const Image* image = &source;
    if (width > kMaxEnvironmentWidth) {
        const double scale = kMaxEnvironmentWidth / width;
        const int side = std::max(source.width(), source.height());
        shrunk = shrinkImage(source, std::max(1, static_cast<int>(std::lround(side * scale))));
        image = &shrunk;
    }

    Image result(targetWidth, targetWidth / 2, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> texels = result.f32();
    const bool sameSize = image->width() == result.width() && image->height() == result.height();
    const float halfTexel = 0.5f / static_cast<float>(image->height());
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
                        sameSize
                            ? image->linear(x, y)
                            : sampleBilinear(*image, u, std::clamp(v, halfTexel, 1.0f - halfTexel));
                    const std::size_t at = 3 * (static_cast<std::size_t>(y) *
                                                    static_cast<std::size_t>(result.width()) +
                                                static_cast<std::size_t>(x));
                    for (int c = 0; c < 3; ++c)
                        texels[at + static_cast<std::size_t>(c)] = pixel[c];
                }
        });
    return result;
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
                                      std::vector<Notice>& notices) {
    if (isBuiltin(source))
        return library::environment(builtinName(source));
    CHECK(worker != nullptr);
    const fs::path file = source;
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    Result<LoadedImage> loaded = loadImage(*worker, file, options);
    if (!loaded)
        return loaded.error();
    const Image& image = loaded->image();

    if (loaded->sanitizedSamples > 0)
        notices.push_back({repairedText(loaded->sanitizedSamples), file});
    if (image.type() != PixelType::F32)
        notices.push_back({"this picture has no high dynamic range, so that its lamps and windows "
                           "light the scene too weakly; use an .hdr or .exr file for real light",
                           file});
    if (image.width() != 2 * image.height())
        notices.push_back({fmt::format("the picture is {} × {} and not twice as wide as high, as a "
                                       "lat-long environment is; it was stretched",
                                       image.width(), image.height()),
                           file});
    return std::make_shared<const Image>(toLatLong(image));
}

Result<ImagePtr> loadEnvironmentImage(WorkerClient& worker, const std::string& source,
                                      std::vector<Notice>& notices) {
    return readEnvironmentImage(&worker, source, notices);
}

} // namespace patina
