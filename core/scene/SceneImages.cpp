// Images for maps and environments.
#include "core/base/Check.h"
#include "core/document/SceneSource.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/library/Library.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/SceneLoader.h"

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

ImageInMemory embeddedMap(const std::string& source, ColorEncoding integerEncoding,
                          const std::vector<Bytes>& embedded) {
    ImageInMemory image;
    const std::optional<EmbeddedSource> inside = parseEmbeddedSource(source);
    if (!inside || static_cast<std::size_t>(inside->index) >= embedded.size())
        return image;
    image.data = embedded[static_cast<std::size_t>(inside->index)];
    image.name = source;
    image.options.integerEncoding = integerEncoding;
    return image;
}

std::vector<Result<MapImage>> readEmbeddedMaps(WorkerClient& worker,
                                               std::span<const ImageInMemory> images) {
    std::vector<Result<MapImage>> maps;
    for (Result<LoadedImage>& loaded : loadImagesFromMemory(worker, images))
        maps.push_back(takeFirst(std::move(loaded)));
    return maps;
}

Result<ImagePtr> loadMapImage(WorkerClient& worker, const std::string& source,
                              ColorEncoding integerEncoding, std::vector<Notice>* notices) {
    std::vector<Bytes> embedded;
    if (const auto inside = parseEmbeddedSource(source)) {
        const SceneSource model = parseSceneSource(inside->model);
        Result<ImportedModel> imported = importModel(worker, model.file, model.title);
        if (!imported)
            return imported.error();
        embedded = std::move(imported->embeddedImages);
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
        return library::environment(builtinName(source), job);
    CHECK(worker != nullptr);
    const Result<EnvironmentPicture> picture =
        readEnvironmentPicture(*worker, source, layout, notices, job);
    if (!picture)
        return picture.error();
    auto image = std::make_shared<const Image>(latLongOf(*picture, kMaxEnvironmentWidth, job));
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
