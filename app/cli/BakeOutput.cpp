#include "app/cli/BakeOutput.h"

#include "app/cli/SceneSetup.h"
#include "core/bake/BakeIO.h"
#include "core/export/Names.h"
#include "core/image/ImageIO.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

Result<void> writeBakeFile(Session& session, const Document& document, const BakeArtifact& artifact,
                           const fs::path& output, const BakeFileOptions& storage) {
    Result<Bytes> bytes = encodeBake(session.worker(), artifact, document, storage);
    if (!bytes)
        return bytes.error();
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
    if (Result<void> written = writeFileAtomically(output, *bytes); !written)
        return written;
    std::string what = bytesText(bytes->size());
    if (storage.storage != BakeStorage::Float) {
        const std::string error = storageErrorText(storageError(artifact, storage));
        session.report().json()["storageError"] = error;
        what += ", " + error;
    }
    session.report().output(output, what);
    return {};
}

// One picture for each material: OUT.png, or OUT-<material>.png when there are several.
Result<void> writePictures(Session& session, const Document& document, const BakeArtifact& artifact,
                           const fs::path& output) {
    UniqueNames names;
    std::vector<std::pair<fs::path, Bytes>> files;
    for (const TexelBake& texel : artifact.texels) {
        fs::path path = output;
        if (artifact.texels.size() > 1) {
            const Material* material = document.material(texel.material);
            const std::string name =
                fileSafeName(material != nullptr ? material->name : "", "material");
            path.replace_filename(fmt::format("{}-{}{}", output.stem().string(), names.take(name),
                                              output.extension().string()));
        }
        Result<Bytes> bytes = encodeImage(session.worker(), *texel.image, ImageFileFormat::Png);
        if (!bytes)
            return bytes.error();
        files.emplace_back(std::move(path), std::move(*bytes));
    }
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
    for (const auto& [path, bytes] : files) {
        if (Result<void> written = writeFileAtomically(path, bytes); !written)
            return written;
        session.report().output(path, bytesText(bytes.size()));
    }
    return {};
}

} // namespace

Result<void> checkBakeOutput(const fs::path& output, BakeKind kind) {
    const bool picture = kind == BakeKind::AoTexel;
    const std::string extension = extensionOf(output);
    if (extension != ".exr" && !(picture && extension == ".png"))
        return Error{ErrorKind::Usage,
                     picture ? "the extension decides the format; name the output .png or .exr"
                             : "bakes of this kind are kept in OpenEXR; name the output .exr",
                     output,
                     {}};
    return checkOutput(output);
}

Result<void> writeBake(Session& session, const Document& document, const BakeArtifact& artifact,
                       const fs::path& output, const BakeFileOptions& storage) {
    return extensionOf(output) == ".png"
               ? writePictures(session, document, artifact, output)
               : writeBakeFile(session, document, artifact, output, storage);
}

} // namespace patina::cli
