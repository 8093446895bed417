#include "app/cli/BakeOutput.h"

#include "app/cli/SceneSetup.h"
#include "core/bake/file/BakeIO.h"
#include "core/base/LowerCase.h"
#include "core/io/ImageIO.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

Error bakeCancelled() {
    return {ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
}

Result<void> writeBakeFile(Session& session, const Document& document, const BakeArtifact& artifact,
                           const fs::path& output, const BakeFileOptions& storage) {
    Result<Bytes> bytes = encodeBake(session.worker(), artifact, document, storage);
    if (!bytes)
        return bytes.error();
    if (session.job().cancelled())
        return bakeCancelled();
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

// All of them or, where one cannot be encoded, none.
Result<void> writeBakedPictures(Session& session, const Document& document,
                                const BakeArtifact& artifact, const fs::path& output) {
    PictureWriter writer(session, document, output, artifact.texels.size() > 1);
    std::vector<std::pair<fs::path, Bytes>> files;
    for (const TexelBake& texel : artifact.texels) {
        Result<std::pair<fs::path, Bytes>> file = writer.encode(texel);
        if (!file)
            return file.error();
        files.push_back(*std::move(file));
    }
    if (session.job().cancelled())
        return bakeCancelled();
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
               ? writeBakedPictures(session, document, artifact, output)
               : writeBakeFile(session, document, artifact, output, storage);
}

Result<std::pair<fs::path, Bytes>> PictureWriter::encode(const TexelBake& texel) {
    fs::path path = m_output;
    if (m_several) {
        const Material* material = m_document.material(texel.material);
        const std::string name =
            fileSafeName(material != nullptr ? material->name : "", "material");
        path.replace_filename(fmt::format("{}-{}{}", m_output.stem().string(), m_names.take(name),
                                          m_output.extension().string()));
    }
    Result<Bytes> bytes = encodeImage(m_session.worker(), *texel.image, ImageFileFormat::Png);
    if (!bytes)
        return bytes.error();
    return std::pair(std::move(path), *std::move(bytes));
}

Result<void> PictureWriter::write(const TexelBake& texel) {
    const Result<std::pair<fs::path, Bytes>> file = encode(texel);
    if (!file)
        return file.error();
    if (m_session.job().cancelled())
        return bakeCancelled();
    if (Result<void> written = writeFileAtomically(file->first, file->second); !written)
        return written;
    m_session.report().output(file->first, bytesText(file->second.size()));
    return {};
}

} // namespace patina::cli
