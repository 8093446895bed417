#include "core/bake/file/BakeIO.h"

#include "core/bake/file/BakePacking.h"
#include "core/bake/file/BakeParts.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"

namespace patina {

Result<Bytes> encodeBake(WorkerClient& worker, const BakeArtifact& artifact,
                         const Document& document, const BakeFileOptions& options) {
    ImageSaveOptions save;
    save.half = options.storage != BakeStorage::Float; // whole numbers are exact in halves
    return encodeImage(worker, packParts(bakeToParts(artifact, document, options)),
                       ImageFileFormat::Exr, save);
}

Result<BakeArtifact> loadBake(WorkerClient& worker, const std::filesystem::path& file,
                              const Document& document) {
    ImageLoadOptions options;
    options.sanitize = false; // coefficients are signed
    options.allParts = true;
    Result<LoadedImage> image = loadImage(worker, file, options);
    if (!image)
        return image.error();
    const Result<std::vector<ImagePart>> parts = unpackParts(std::move(image->parts), file);
    if (!parts)
        return parts.error();
    return bakeFromParts(*parts, document, file);
}

} // namespace patina
