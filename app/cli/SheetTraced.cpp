// Cells of a sheet traced by rays, without OpenGL.
#include "app/cli/PreparedLight.h"
#include "app/cli/RenderWhitted.h"
#include "app/cli/Report.h"
#include "app/cli/SheetCells.h"
#include "app/cli/TracedPicture.h"
#include "app/cli/TracingOptions.h"
#include "core/document/DisplayedPicture.h"
#include "core/mix/LightMix.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/file/FilmTracer.h"

#include <fmt/format.h>
#include <set>
#include <utility>

namespace patina::cli {
namespace {

class SheetTraced : public SheetCells {
  public:
    explicit SheetTraced(SheetSource source)
        : SheetCells(std::move(source)) {}

    Result<void> begin() override {
        const render::FrameSettings& frame = m_source.frame;
        const ImageFileFormat format = frame.floats ? ImageFileFormat::Exr : ImageFileFormat::Png;
        for (const WallCell& cell : cellsOf(m_source.wall.wall)) {
            const Result<Document> shown = documentOf(m_source.document, cell.cell);
            if (!shown)
                return shown.error();
            if (Result<void> fits = checkDisplay(shown->view, format); !fits)
                return fits;
        }
        return checkTracingMemory(frame.width, frame.height,
                                  sizeof(Film::Pixel) + 4 * sizeof(float));
    }

    Result<sheet::DrawnCell> draw(const Cell& cell, const std::string& of, double from,
                                  double to) override {
        const JobContext job = m_source.session.job().part(from, to);
        if (job.stopping() && !job.cancelled())
            return stopped();
        job.setActivity(of + "preparing the scene");
        const Result<Document> shown = shownBy(cell);
        if (!shown)
            return shown.error();
        const JobContext preparing = job.part(0.0, 0.0); // it has a progress of its own
        const Result<TraceView> view = viewOf(*shown, preparing);
        if (!view)
            return view.error();
        // What cells have in common of their geometry and environments is built once.
        Result<TraceScene> scene =
            TraceScene::build(traceInputs(*shown), preparing, m_scene ? &*m_scene : nullptr);
        if (!scene)
            return scene.error();
        m_scene = *std::move(scene);
        return trace(*shown, *view, of, job);
    }

  private:
    void letGoOfLight() override {
        m_blurredImage = nullptr;
        m_blurred = {};
    }

    // Light of the last picture is most often the next one's, too.
    Result<TraceView> viewOf(const Document& shown, const JobContext& job) {
        TraceView view;
        view.camera = shown.view.camera;
        view.width = m_source.frame.width;
        view.height = m_source.frame.height;
        const auto prepare = [&](const Image& environment) -> Result<IblMaps> {
            if (m_blurredImage.get() == &environment)
                return m_blurred;
            Result<IblMaps> maps = prepareLight(environment, job);
            if (maps) {
                m_blurredImage = shownEnvironment(shown).image;
                m_blurred = *maps;
            }
            return maps;
        };
        if (Result<void> set = setTracedBackground(shown, view, prepare); !set)
            return set.error();
        return view;
    }

    // By a signal.
    static sheet::DrawnCell stopped() {
        sheet::DrawnCell cell;
        cell.problem = "stopped before it was traced";
        return cell;
    }

    // What paths cannot show of a scene is said once.
    void warnOfLimit() {
        if (const std::optional<std::string> limit = m_scene->limit();
            limit && !isWhitted(m_source.options) && m_limits.insert(*limit).second)
            m_source.session.report().warn(*limit);
    }

    Result<sheet::DrawnCell> trace(const Document& shown, const TraceView& view,
                                   const std::string& of, const JobContext& job) {
        const SheetOptions& options = m_source.options;
        warnOfLimit();
        FilmTracerSettings settings;
        settings.samples = samplesOf(options);
        settings.unit = unitOf(options);
        settings.of = of;
        if (options.noise)
            settings.noise = *options.noise / 100.0;
        settings.manifest.width = view.width;
        settings.manifest.height = view.height;
        FilmTracer tracer(std::move(settings));
        PathSettings paths;
        paths.maxBounces = options.maxBounces;
        paths.seed = options.seed;
        Result<void> traced;
        if (isWhitted(options)) {
            Result<WhittedPicture> whitted =
                WhittedPicture::prepare(*m_scene, view, whittedSettings(options), {}, job);
            if (!whitted)
                return whitted.error();
            traced = tracer.trace(whitted->pass(), job);
        } else {
            traced = tracer.trace(*m_scene, view, paths, job);
        }
        if (!traced)
            return traced.error();
        sheet::DrawnCell cell;
        cell.samples = tracer.manifest().samples;
        if (cell.samples == 0)
            return stopped();
        cell.noise = tracer.noise();
        cell.attributes["patina:renderer"] = options.renderer;
        cell.attributes["patina:render.samplesDone"] = std::to_string(cell.samples);
        if (const std::size_t invalid = tracer.film().invalid(); invalid > 0)
            m_source.session.report().warn(
                fmt::format("{} {} brought no finite number and count as black; look for values "
                            "that are not finite in the scene's maps",
                            invalid, unitOf(options)));
        Image radiance = tracer.film().radiance(view.transparent);
        if (m_source.frame.floats) {
            cell.picture = std::move(radiance);
            return cell;
        }
        Result<Image> displayed = displayedPicture(radiance, shown.view, luminanceOf(radiance));
        if (!displayed)
            return displayed.error();
        cell.picture = *std::move(displayed);
        return cell;
    }

    std::optional<TraceScene> m_scene; // of the last cell
    ImagePtr m_blurredImage;           // of m_blurred
    IblMaps m_blurred;
    std::set<std::string> m_limits; // that were said
};

} // namespace

std::unique_ptr<SheetCells> tracedCells(SheetSource source) {
    return std::make_unique<SheetTraced>(std::move(source));
}

std::string tracingText(const SheetOptions& options, std::uint32_t least, std::uint32_t most) {
    if (isWhitted(options) && !whittedSettings(options).isStochastic())
        return "Whitted ray traced";
    return fmt::format("{}, {} {} per pixel",
                       isWhitted(options) ? "Whitted ray traced" : "path traced",
                       least == most ? std::to_string(most) : fmt::format("{} to {}", least, most),
                       unitOf(options));
}

} // namespace patina::cli
