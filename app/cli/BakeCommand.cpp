#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/Bake.h"
#include "core/bake/BakeIO.h"
#include "core/export/Names.h"
#include "core/image/ImageIO.h"
#include "core/mesh/UvUnwrap.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

Result<void> checkBakeOutput(const std::string& output, bool picture) {
    const std::string extension = extensionOf(output);
    if (extension != ".exr" && !(picture && extension == ".png"))
        return Error{ErrorKind::Usage,
                     picture ? "the extension decides the format; name the output .png or .exr"
                             : "values per vertex are kept in OpenEXR; name the output .exr",
                     output,
                     {}};
    return checkOutput(output);
}

// Runs the bake and describes what it made.
template <class Bake>
Result<BakeArtifact> runBake(Session& session, const Document& document, const Bake& bake) {
    const BakeInputs inputs = bakeInputs(document);
    TileSink nobodyWatches;
    session.beginPhase();
    session.allowPartialResult();
    Result<BakeArtifact> artifact = bake(inputs, nobodyWatches, session.job());
    if (!artifact)
        return artifact;

    std::size_t triangles = 0, vertices = 0, texels = 0;
    for (const BakeMesh& mesh : inputs.meshes) {
        triangles += mesh.mesh->triangleCount();
        vertices += mesh.mesh->vertexCount();
    }
    for (const TexelBake& texel : artifact->texels)
        texels += texel.image
                      ? static_cast<std::size_t>(texel.image->width()) *
                            static_cast<std::size_t>(texel.image->height())
                      : static_cast<std::size_t>(texel.side) * static_cast<std::size_t>(texel.side);
    nlohmann::ordered_json& json = session.report().json();
    json["counts"] = {{"meshes", inputs.meshes.size()},
                      {"triangles", triangles},
                      {"vertices", vertices},
                      {"texels", texels}};
    json["inputs"] = artifact->inputs.hex();
    json["samplesDone"] = artifact->samplesDone;
    json["partial"] = session.interrupted();
    return artifact;
}

Result<void> writeBakeFile(Session& session, const Document& document, const BakeArtifact& artifact,
                           const fs::path& output) {
    Result<Bytes> bytes = encodeBake(session.worker(), artifact, document);
    if (!bytes)
        return bytes.error();
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
    if (Result<void> written = writeFileAtomically(output, *bytes); !written)
        return written;
    session.report().output(output, bytesText(bytes->size()));
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

void warnAboutOverlaps(Session& session, const Document& document) {
    for (const MeshInstance& mesh : document.meshes)
        if (mesh.visible && mesh.mesh != nullptr && hasOverlappingUvs(*mesh.mesh))
            session.report().warn(fmt::format(
                "{}: its texture coordinates overlap, so that places share a texel; bake with "
                "--target vertex, or unwrap the mesh",
                mesh.name));
}

} // namespace

Result<void> run(Session& session, const BakeAoOptions& options) {
    const bool perTexel = options.target == BakeTarget::Texel;
    if (Result<void> output = checkBakeOutput(options.output, perTexel); !output)
        return output;
    session.report().json()["settings"] = {{"scene", options.scene},
                                           {"target", perTexel ? "texel" : "vertex"},
                                           {"samples", options.samples},
                                           {"distance", options.distance},
                                           {"seed", options.seed}};
    if (perTexel)
        session.report().json()["settings"]["size"] = options.size;
    session.beginPhase();
    SceneRequest request;
    request.scene = options.scene;
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    if (perTexel)
        warnAboutOverlaps(session, *document);

    AoSettings settings;
    settings.samples = options.samples;
    settings.maxDistance = options.distance;
    settings.size = options.size;
    settings.seed = options.seed;
    Result<BakeArtifact> artifact =
        runBake(session, *document, [&](const BakeInputs& inputs, TileSink& sink, auto job) {
            return perTexel ? bakeAoTexel(inputs, settings, sink, job)
                            : bakeAoVertex(inputs, settings, sink, job);
        });
    if (!artifact)
        return artifact.error();
    if (extensionOf(options.output) == ".png")
        return writePictures(session, *document, *artifact, options.output);
    return writeBakeFile(session, *document, *artifact, options.output);
}

Result<void> run(Session& session, const BakePrtOptions& options) {
    if (Result<void> output = checkBakeOutput(options.output, false); !output)
        return output;
    session.report().json()["settings"] = {{"scene", options.scene},
                                           {"order", options.order},
                                           {"samples", options.samples},
                                           {"seed", options.seed}};
    session.beginPhase();
    SceneRequest request;
    request.scene = options.scene;
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();

    PrtSettings settings;
    settings.order = options.order;
    settings.samples = options.samples;
    settings.seed = options.seed;
    Result<BakeArtifact> artifact =
        runBake(session, *document, [&](const BakeInputs& inputs, TileSink& sink, auto job) {
            return bakePrtVertex(inputs, settings, sink, job);
        });
    if (!artifact)
        return artifact.error();
    return writeBakeFile(session, *document, *artifact, options.output);
}

} // namespace patina::cli
