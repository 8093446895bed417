#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/base/Check.h"
#include "core/edit/Parameters.h"
#include "core/light/OrientedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"

#include <bit>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

// The smallest level when nothing else is said: as in the editor.
constexpr int kSmallestLevel = 4;
constexpr int kIrradianceSize = 32;
constexpr int kDfgSize = 128;

int levelsFor(const BakeIblOptions& options) {
    if (options.levels > 0)
        return options.levels;
    return std::countr_zero(static_cast<unsigned>(options.size / kSmallestLevel)) + 1;
}

const char* formatName(IblFileFormat format) {
    switch (format) {
    case IblFileFormat::Exr:
        return "exr";
    case IblFileFormat::Hdr:
        return "hdr";
    case IblFileFormat::Ktx2:
        return "ktx2";
    case IblFileFormat::Dds:
        return "dds";
    }
    return "";
}

// Options that contradict each other are refused, not ignored.
Result<void> checkOptions(const BakeIblOptions& options) {
    const auto refuse = [](std::string why) {
        return Error{ErrorKind::Usage, std::move(why), {}, {}};
    };
    if (options.size >> (levelsFor(options) - 1) == 0)
        return refuse(
            fmt::format("a cubemap of {0} texels has {1} levels at most; use --levels {1}",
                        options.size, std::countr_zero(static_cast<unsigned>(options.size)) + 1));
    const bool pictures =
        options.format == IblFileFormat::Exr || options.format == IblFileFormat::Hdr;
    if (!pictures && options.layoutGiven)
        return refuse(fmt::format("--layout is for exr and hdr; .{} files hold a cubemap with all "
                                  "its levels",
                                  formatName(options.format)));
    if (options.format == IblFileFormat::Hdr && options.texels)
        return refuse("--precision is not for hdr, whose pixels are RGBE; use exr, ktx2 or dds");
    if (options.format == IblFileFormat::Exr && options.texels == TexelFormat::Rgb9E5)
        return refuse("OpenEXR has no rgb9e5; use --precision half or float, or ktx2 or dds");
    return {};
}

std::string parameterText(const Document& document, const char* id) {
    const ParameterInfo* info = findParameter(id);
    CHECK(info != nullptr);
    return formatParameterValue(*info, info->get(document, 0));
}

void describe(Session& session, const IblMaps& maps, const IblPackage& package) {
    nlohmann::ordered_json& json = session.report().json();
    std::size_t texels = 0, bytes = 0;
    for (const CubeLevel& level : maps.prefiltered)
        texels += level.texels.size();
    for (const FolderFile& file : package.files)
        bytes += file.data.size();
    json["counts"] = {{"files", package.files.size()},
                      {"levels", maps.prefiltered.size()},
                      {"texels", texels},
                      {"bytes", bytes},
                      {"clampedTexels", package.clamped}};
    nlohmann::ordered_json& sh = json["irradianceSh"] = nlohmann::ordered_json::array();
    for (const glm::vec3& c : maps.irradianceSh)
        sh.push_back({c.x, c.y, c.z});
}

} // namespace

Result<void> run(Session& session, const BakeIblOptions& options) {
    if (Result<void> valid = checkOptions(options); !valid)
        return valid;
    if (Result<void> output = checkFolderOutput(options.output, isIblPackage); !output)
        return output;
    IblPackageSettings package{options.format, options.layout,
                               options.texels.value_or(TexelFormat::Rgba16F)};
    IblSettings settings;
    settings.cubeSize = options.size;
    settings.levels = levelsFor(options);
    settings.spacing = LevelSpacing::Even; // levels are mips
    settings.irradianceSize = kIrradianceSize;
    session.report().json()["settings"] = {{"environment", options.environment},
                                           {"size", settings.cubeSize},
                                           {"levels", settings.levels},
                                           {"format", formatName(options.format)}};

    session.beginPhase();
    Result<Document> document =
        openEnvironmentFor(session, options.environment, options.environmentLayout);
    if (!document)
        return document.error();
    if (document->environment().image == nullptr) // a sky or softboxes, not finished
        return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
    // What a project mixes (tint, fade, a second picture) is baked in; what it mutes is not asked
    // for.
    const Environment environment =
        mixedEnvironment(*document, session.job()).value_or(document->environment());
    session.beginPhase();
    const Image oriented = orientEnvironment(*environment.image, orientationOf(environment),
                                             environment.exposureEv, session.job());
    Result<IblMaps> maps = computeIbl(oriented, settings, session.job());
    if (!maps)
        return maps.error();
    const ShadingModel& model = document->model;
    const Image table = computeDfgTable(kDfgSize, model.distribution, model.visibility);

    session.beginPhase();
    const IblPackageSource source{environment.kind == EnvironmentKind::Image
                                      ? environment.source
                                      : parameterText(*document, "environment.kind"),
                                  orientationOf(environment), environment.exposureEv,
                                  parameterText(*document, "model.distribution"),
                                  parameterText(*document, "model.visibility")};
    Result<IblPackage> packed =
        packIbl(session.worker(), *maps, table, source, package, session.job());
    if (!packed)
        return packed.error();
    if (packed->clamped > 0)
        session.report().warn(fmt::format(
            "{} brighter than {}, the most that {} can hold, and cut to it; --precision float "
            "keeps "
            "them",
            packed->clamped == 1 ? "one texel was" : countText(packed->clamped) + " texels were",
            largestValue(package.texels),
            package.texels == TexelFormat::Rgb9E5 ? "rgb9e5" : "a half float"));
    const JobContext job = session.job();
    if (Result<void> written = writeFolderAtomically(options.output, packed->files, isIblPackage,
                                                     [&job] { return job.cancelled(); });
        !written)
        return written;
    describe(session, *maps, *packed);
    std::size_t bytes = 0;
    for (const FolderFile& file : packed->files)
        bytes += file.data.size();
    session.report().output(options.output,
                            fmt::format("{} files, {}", packed->files.size(), bytesText(bytes)));
    return {};
}

} // namespace patina::cli
