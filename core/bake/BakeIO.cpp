#include "core/bake/BakeIO.h"

#include "core/bake/BakeParts.h"
#include "core/image/ImageIO.h"

namespace patina {

Result<Bytes> encodeBake(WorkerClient& worker, const BakeArtifact& artifact,
                         const Document& document) {
    return encodeImage(worker, bakeToParts(artifact, document), ImageFileFormat::Exr);
}

Result<BakeArtifact> loadBake(WorkerClient& worker, const std::filesystem::path& file,
                              const Document& document) {
    ImageLoadOptions options;
    options.sanitize = false; // coefficients are signed
    options.allParts = true;
    const Result<LoadedImage> image = loadImage(worker, file, options);
    if (!image)
        return image.error();
    return bakeFromParts(image->parts, document, file);
}

} // namespace patina
