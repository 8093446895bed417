#include "app/editor/panel/LabLight.h"

#include "core/base/Check.h"
#include "core/light/EnvironmentResample.h"

namespace patina::editor {
namespace {

constexpr int kSumHeight = 64; // eight bands have nothing finer
constexpr int kReducedWidths[] = {1024, 512, 256};

} // namespace

const LabFace& labFace(int index) {
    static constexpr LabFace kFaces[] = {{"+X", 2, 1}, {"−X", 0, 1}, {"+Y", 1, 0},
                                         {"−Y", 1, 2}, {"+Z", 3, 1}, {"−Z", 1, 1}};
    CHECK(index >= 1 && index <= 6);
    return kFaces[index - 1];
}

LabReductionsPtr reduceForPictures(const EnvironmentAnalysis& analysis, const JobContext& job) {
    auto reductions = std::make_shared<LabReductions>();
    std::vector<ImagePtr>& smaller = reductions->environment;
    for (const int width : kReducedWidths) {
        const ImagePtr& from = smaller.empty() ? analysis.environment : smaller.back();
        if (job.cancelled())
            return nullptr;
        smaller.push_back(std::make_shared<const Image>(shrinkLatLong(*from, width)));
    }
    for (int n = 1; n <= kMaxShOrder; ++n)
        reductions->sums[static_cast<std::size_t>(n - 1)] = std::make_shared<const Image>(
            shLatLong(analysis.bands.coefficients, n, kSumHeight, job));
    if (job.cancelled())
        return nullptr;
    return reductions;
}

std::optional<glm::vec3> LabLight::value(LabView view, const glm::vec3& world) const {
    switch (view.kind) {
    case LabKind::Environment:
        return lookup.radiance(world);
    case LabKind::Faces:
        return lookup.prefiltered(0.0f, world);
    case LabKind::Irradiance:
        return lookup.irradianceSh9(world);
    case LabKind::IrradianceExact:
        return lookup.irradiance(world);
    case LabKind::Harmonics:
        return lookup.bandSum(view.index, world);
    case LabKind::Prefiltered:
        return lookup.prefiltered(roughnessStep(view.index), world);
    case LabKind::Dfg:
        break;
    }
    return std::nullopt;
}

} // namespace patina::editor
