#include "app/editor/job/InterruptedBakes.h"

#include "core/bake/Bake.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/base/FileLock.h"
#include "core/base/Log.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <system_error>

namespace patina::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".checkpoint";
constexpr std::chrono::hours kForgotten(24 * 30);

// An error while a bake writes it; nothing where the drive lets nobody lock.
Result<std::optional<FileLock>> hold(const fs::path& checkpoint) {
    return FileLock::takeWhenFree(checkpoint, std::chrono::milliseconds(0));
}

bool bounces(const BakeRequest& request) {
    return holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Interreflected;
}

} // namespace

BakeManifest bakeManifest(const BakeRequest& request, const BakeInputs& inputs) {
    BakeManifest manifest;
    manifest.kind = request.kind;
    manifest.settings = settingsText(normalized(request));
    manifest.inputs = hashBakeInputs(inputs);
    if (bounces(request))
        manifest.albedo = hashBakeAlbedo(inputs);
    return manifest;
}

fs::path checkpointFile(const fs::path& folder, const Hash& key) {
    return folder / (key.hex() + kExtension);
}

std::vector<InterruptedBake> interruptedBakes(const fs::path& folder, const BakeInputs& inputs) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == kExtension)
            files.push_back(it->path());

    std::vector<InterruptedBake> result;
    const auto now = fs::file_time_type::clock::now();
    for (const fs::path& file : files) {
        const auto lock = hold(file);
        if (!lock)
            continue;
        const Result<BakeManifest> manifest = readBakeManifest(file);
        const fs::file_time_type written = fs::last_write_time(file, error);
        if (!manifest || (!error && now - written > kForgotten)) {
            logWarning("The checkpoint {} is {}; it is removed.", file.string(),
                       manifest ? "a month old" : "damaged");
            fs::remove(file, error);
            continue;
        }
        InterruptedBake bake{file, requestFromText(manifest->kind, manifest->settings),
                             manifest->done, written};
        BakeManifest here = bakeManifest(bake.request, inputs);
        here.points = manifest->points;
        here.ranges = manifest->ranges;
        if (!whyDifferent(*manifest, here))
            result.push_back(std::move(bake));
    }
    std::ranges::sort(result, std::greater(), &InterruptedBake::written);
    return result;
}

Result<void> removeCheckpoint(const fs::path& file) {
    const auto lock = hold(file);
    if (!lock)
        return Error{ErrorKind::CannotCreate, "this bake is being computed by another program",
                     file, lock.error().message};
    std::error_code gone;
    fs::remove(file, gone);
    return {};
}

} // namespace patina::editor
