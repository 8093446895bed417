#include "app/editor/wall/SheetTracing.h"

#include "core/document/DisplayedPicture.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace patina::editor {
namespace {

constexpr std::uint32_t kSheetPaths = 256, kSheetRays = 64; // per pixel, as the command line's
constexpr double kSheetPassSeconds = 1.0;                   // between looks at the progress

std::uint32_t samplesOfSheet(TracedBy tracer) {
    return tracer == TracedBy::Paths ? kSheetPaths : kSheetRays;
}

Result<Image> traceSheetCell(const SheetTracing& cell, TraceWork::Known& known,
                             const JobContext& job) {
    TraceWork work(cell.subject, cell.tracer, cell.whitted, known);
    work.setFine(samplesOfSheet(cell.tracer));
    ImagePtr picture;
    while (work.samples() < work.mostSamples()) {
        const Result<TraceWork::Pass> pass = work.trace(kSheetPassSeconds, false, job);
        if (!pass)
            return pass.error();
        picture = pass->picture;
        known = pass->known;
        job.setProgress(static_cast<double>(work.samples()) / work.mostSamples());
    }
    return *picture;
}

} // namespace

Result<std::vector<Image>> traceSheetCells(const std::vector<std::optional<SheetTracing>>& cells,
                                           bool linear, const JobContext& job) {
    std::vector<Image> pictures(cells.size());
    const auto count =
        std::ranges::count_if(cells, [](const auto& cell) { return cell.has_value(); });
    TraceWork::Known known; // what the cells have in common is built once
    std::ptrdiff_t done = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!cells[i])
            continue;
        job.setActivity(fmt::format("tracing cell {} of {}", done + 1, count));
        const double share = 1.0 / static_cast<double>(count);
        Result<Image> radiance = traceSheetCell(
            *cells[i], known,
            job.part(share * static_cast<double>(done), share * static_cast<double>(done + 1)));
        if (!radiance)
            return radiance.error();
        ++done;
        if (linear) {
            pictures[i] = *std::move(radiance);
            continue;
        }
        Result<Image> shown =
            displayedPicture(*radiance, cells[i]->subject.look, luminanceOf(*radiance));
        if (!shown)
            return shown.error();
        pictures[i] = *std::move(shown);
    }
    return pictures;
}

std::string tracingText(const std::vector<std::optional<SheetTracing>>& cells) {
    const auto countOf = [&](TracedBy tracer) {
        return std::ranges::count_if(
            cells, [&](const auto& cell) { return cell && cell->tracer == tracer; });
    };
    std::string text;
    for (const auto& [tracer, how] :
         {std::pair(TracedBy::Paths, fmt::format("path traced, {} paths per pixel", kSheetPaths)),
          {TracedBy::Whitted, std::string("Whitted ray traced")}}) {
        const auto count = countOf(tracer);
        if (count == 0)
            continue;
        text += text.empty() ? "" : "  ·  ";
        text +=
            count == std::ssize(cells) ? how : fmt::format("{} of {} {}", count, cells.size(), how);
    }
    return text;
}

} // namespace patina::editor
