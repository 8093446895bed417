#include "core/ladder/LadderTruth.h"

#include "core/document/Document.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/error/SeenMaterials.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace patina {
namespace {

constexpr std::uint32_t kMostInTruthPass = 16;

Error cancelledTruth() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

} // namespace

Result<LadderTruth>
traceLadderTruth(const Document& document, const TraceView& view,
                 const LadderTruthSettings& settings, const JobContext& job,
                 const std::function<void(const Film& film, std::uint32_t samples)>& seen) {
    const Result<TraceScene> scene = TraceScene::build(traceInputs(document), job);
    if (!scene)
        return scene.error();
    const auto start = std::chrono::steady_clock::now();
    Film film(view.width, view.height);
    LadderTruth truth;
    truth.limit = scene->limit();
    for (std::uint32_t pass = 2; truth.samples < settings.samples;
         pass = std::min(2 * pass, kMostInTruthPass)) {
        pass = std::min(pass, settings.samples - truth.samples);
        job.setActivity(fmt::format("tracing: {} paths per pixel", truth.samples));
        if (Result<void> traced = tracePaths(*scene, view, {}, film, truth.samples, pass, job);
            !traced)
            return traced.error();
        truth.samples += pass;
        truth.noise = film.noise().value_or(0.0);
        job.setProgress(static_cast<double>(truth.samples) / settings.samples);
        if (job.stopping())
            return cancelledTruth();
        if (seen)
            seen(film, truth.samples);
        if (settings.noise && truth.samples > 2 && truth.noise <= *settings.noise)
            break;
    }
    truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (settings.blame) {
        job.setActivity("tracing what each shortcut stands for");
        Result<BlameFilm> blame = traceBlame(*scene, view, document.model, 0, truth.samples, job);
        if (!blame)
            return blame.error();
        truth.blame = *std::move(blame);
    }
    truth.picture = *tracedPicture(film);
    truth.film = std::move(film);
    truth.materials = seenMaterials(*scene, view, job);
    if (truth.materials.empty())
        return cancelledTruth();
    return truth;
}

} // namespace patina
