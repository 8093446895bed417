#include "app/editor/job/LightMapWork.h"

#include "app/editor/document/SceneCopy.h"
#include "core/light/Ibl.h"
#include "core/trace/document/DocumentLightMap.h"

#include <utility>

namespace patina::editor {

BakeEnd runLightMap(const LightMapWork& work, const JobContext& job) {
    const auto failed = [](const Error& error) { return BakeEnd{error, nullptr, nullptr, {}}; };
    Document document = work.document;
    if (const Result<void> completed = completeEnvironments(document, job); !completed)
        return failed(completed.error());
    job.setActivity("preparing light");
    const Result<LightMapInputs> inputs = lightMapInputs(
        document, [&](const Image& image) { return computeIbl(image, IblSettings(), job); });
    if (!inputs)
        return failed(inputs.error());
    Result<BakeArtifact> artifact = bakeLightMap(*inputs, work.settings, job);
    if (!artifact)
        return failed(artifact.error());
    const QString summary = bakeSummary(*artifact);
    return {std::nullopt, std::make_shared<const BakeArtifact>(*std::move(artifact)), nullptr,
            summary};
}

} // namespace patina::editor
