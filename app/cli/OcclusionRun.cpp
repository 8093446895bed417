#include "app/cli/OcclusionRun.h"

#include "app/cli/BakeOutput.h"
#include "app/cli/BakeRun.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/OcclusionTextures.h"
#include "core/bake/file/BakeFileSize.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::cli {

Result<void> bakeOcclusionPictures(Session& session, const Document& document,
                                   const BakeInputs& inputs, const BakeRequest& request,
                                   std::uint64_t maxMemory, const std::filesystem::path& output) {
    const std::size_t atOnce = texturesAtOnce(request, inputs, maxMemory);
    if (atOnce == 0) // says how much that would take, and what would fit
        if (Result<void> fits = checkBakeMemory(request, inputs, maxMemory); !fits)
            return fits;
    Report& report = session.report();
    session.beginPhase();
    Result<OcclusionTextures> textures =
        OcclusionTextures::prepare(inputs, request.ao, session.job());
    if (!textures)
        return textures.error();
    report.warn(fmt::format(
        "{} textures of {} × {} texels do not fit into {} of memory together: {} are baked at a "
        "time and written as they are finished, up to {} in all. Meshes that share a material and "
        "UVs that do not overlap share one texture.",
        countText(textures->count()), request.ao.size, request.ao.size, memoryText(maxMemory),
        atOnce, memoryText(bakePictureBytes(request, inputs))));
    report.json()["plan"]["texturesAtOnce"] = atOnce;

    PictureWriter writer(session, document, output, textures->count() > 1);
    BakeArtifact summary;
    while (textures->done() < textures->count()) {
        const std::size_t first = textures->done() + 1;
        const std::size_t last = std::min(textures->done() + atOnce, textures->count());
        session.beginPhase();
        session.job().setActivity(
            fmt::format("textures {} to {} of {}", first, last, textures->count()));
        Result<BakeArtifact> group = textures->bakeNext(atOnce, session.job());
        if (!group)
            return group.error();
        for (TexelBake& texel : group->texels) {
            if (Result<void> written = writer.write(texel); !written)
                return written;
            texel.image = nullptr; // makes room for the next
            texel.side = request.ao.size;
        }
        summary.kind = group->kind;
        summary.inputs = group->inputs;
        summary.samplesDone = group->samplesDone;
        if (!group->note.empty())
            summary.note = group->note; // that of the last which has one
        std::ranges::move(group->texels, std::back_inserter(summary.texels));
    }
    reportBake(session, inputs, summary);
    return {};
}

} // namespace patina::cli
