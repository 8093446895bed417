#include "core/base/AtomicFile.h"
#include "core/base/DiskSpace.h"
#include "core/base/OwnFile.h"
#include "core/export/Export.h"
#include "core/export/ExportContents.h"
#include "core/export/GltfEnvironment.h"
#include "core/export/GltfWriter.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <optional>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;

struct FileToWrite {
    fs::path path;
    Bytes data;
};

Error cancelled() {
    return {ErrorKind::Cancelled, "the export was cancelled; nothing was written", {}, {}};
}

Bytes bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// Textures take the time: each is packed and encoded on its own core.
Result<std::vector<Bytes>> encodeTextures(WorkerClient& worker,
                                          const std::vector<PackedTexture>& textures,
                                          const JobContext& job) {
    std::vector<std::optional<Result<Bytes>>> encoded(textures.size());
    std::atomic<std::size_t> done = 0;
    parallelFor(job, textures.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            job.setActivity(fmt::format("packing {}", textures[i].name));
            const Image image = packTexture(textures[i], job);
            if (!image.empty())
                encoded[i] = encodeImage(worker, image, textures[i].format);
            job.setProgress(0.9 * static_cast<double>(++done) /
                            static_cast<double>(textures.size()));
        }
    });
    if (job.cancelled())
        return cancelled();
    std::vector<Bytes> files;
    for (std::optional<Result<Bytes>>& file : encoded) {
        if (!file->ok())
            return file->error();
        files.push_back(std::move(**file));
    }
    return files;
}

// Writes all files, the one that refers to the others last. When one fails, those that were not
// there before disappear again.
// `named`: the one whose name the user chose; a link there is followed.
Result<std::vector<fs::path>> writeAll(std::vector<FileToWrite> files, const fs::path& named,
                                       const JobContext& job) {
    std::vector<fs::path> written, created;
    const auto undo = [&](Error error) {
        std::error_code ignored;
        for (const fs::path& path : created)
            fs::remove(path, ignored);
        return error;
    };
    for (const FileToWrite& file : files) {
        if (job.cancelled())
            return undo(cancelled());
        std::error_code ignored;
        const bool existed = fs::exists(file.path, ignored);
        if (Result<void> result = file.path == named ? writeFileAtomically(file.path, file.data)
                                                     : writeOwnFile(file.path, file.data);
            !result)
            return undo(result.error());
        written.push_back(file.path);
        if (!existed)
            created.push_back(file.path);
    }
    return written;
}

bool matchesPlan(const ExportPlan& plan, const ExportContents& contents) {
    const std::size_t own = plan.settings.format == ExportFormat::Glb ? 1 : 2;
    const std::vector<PackedTexture>& textures = contents.textures.textures;
    const std::size_t environment = contents.environment != nullptr ? 1 : 0;
    const std::size_t transfer = contents.transfer != nullptr ? 2 : 0;
    if (plan.files.size() != own + textures.size() + environment + transfer)
        return false;
    for (std::size_t i = 0; i < textures.size(); ++i)
        if (plan.files[own + i].path != contents.texturePath(plan.settings, textures[i]) ||
            plan.files[own + i].format != textures[i].formatText())
            return false;
    return true;
}

} // namespace

Result<std::vector<fs::path>> runExport(WorkerClient& worker, const Document& document,
                                        const ExportPlan& plan, const JobContext& job) {
    const ExportSettings& settings = plan.settings;
    const ExportContents contents = gatherContents(document, settings);
    if (contents.instances.empty())
        return Error{ErrorKind::Usage,
                     "there is nothing to export; make at least one mesh visible",
                     settings.output,
                     {}};
    if (!matchesPlan(plan, contents))
        return Error{ErrorKind::Usage,
                     "the scene changed after the export was planned; plan it again",
                     settings.output,
                     {}};

    Result<std::vector<Bytes>> images = encodeTextures(worker, contents.textures.textures, job);
    if (!images)
        return images.error();
    std::optional<GltfEnvironment> environment;
    if (contents.environment != nullptr) {
        Result<GltfEnvironment> encoded = encodeGltfEnvironment(worker, *contents.environment, job);
        if (!encoded)
            return encoded.error();
        environment = std::move(*encoded);
    }
    job.setActivity("writing");
    const bool glb = settings.format == ExportFormat::Glb;
    Result<GltfOutput> gltf =
        writeGltf(contents, settings, *images, environment ? &*environment : nullptr);
    if (!gltf)
        return gltf.error();

    std::vector<FileToWrite> files;
    if (contents.transfer != nullptr) {
        const fs::path light = contents.transferLightPath(settings);
        const std::string json = transferLightJson(document, contents.transferLayout, job);
        files.push_back({light, bytesOf(json)});
        files.push_back(
            {contents.transferShaderPath(settings),
             bytesOf(transferShader(contents.transferLayout, settings.output.filename().string(),
                                    light.filename().string()))});
    }
    if (glb) {
        files.push_back({settings.output, packGlb(*gltf)});
    } else {
        for (std::size_t i = 0; i < images->size(); ++i)
            files.push_back({contents.texturePath(settings, contents.textures.textures[i]),
                             std::move((*images)[i])});
        files.push_back({contents.buffer, std::move(gltf->buffer)});
        files.push_back({settings.output, bytesOf(gltf->json)});
    }
    std::uint64_t bytes = 0, largest = 0;
    for (const FileToWrite& file : files) {
        bytes += file.data.size();
        largest = std::max<std::uint64_t>(largest, file.data.size());
    }
    if (Result<void> fits = checkDiskSpace(settings.output, bytes, largest); !fits)
        return fits.error();
    Result<std::vector<fs::path>> written = writeAll(std::move(files), settings.output, job);
    if (written)
        job.setProgress(1.0);
    return written;
}

} // namespace patina
