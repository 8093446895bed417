// `patina render`.
#include "app/cli/CommandParser.h"
#include "app/cli/RenderTraced.h"
#include "app/cli/RenderViews.h"
#include "core/cells/Sequence.h"
#include "core/io/VideoWriter.h"
#include "core/trace/file/OutputImages.h"
#include "core/trace/whitted/RayCountImages.h"

#include <fmt/format.h>
#include <string>

namespace patina::cli {

void CommandParser::addTracing(CLI::App* c, TracingOptions& o) {
    c->add_option("--renderer", o.renderer,
                  "raster: as the viewport draws it; path: light as it goes, by paths from "
                  "surface to surface, without shortcuts; whitted: the classical ray tracer")
        ->check(plain(CLI::IsMember({"raster", "path", "whitted"})))
        ->capture_default_str()
        ->type_name("raster|path|whitted");
    addWhitted(c, o.whitted);
    c->add_option("--noise", o.noise,
                  "Path: ends when the standard error of a pixel is this many percent of the "
                  "picture's mean, on the average over the pixels")
        ->check(plain(CLI::Range(0.001, 100.0)))
        ->type_name("PERCENT");
    c->add_option("--max-bounces,--max-depth", o.maxBounces,
                  "Path: on surfaces after the one that is seen (default: no limit); whitted: "
                  "reflections and refractions of a branch (default: 8)")
        ->check(plain(CLI::Range(0, 10000)))
        ->type_name("N");
    c->add_option("--seed", o.seed, "Traced: seed of the sample pattern")->type_name("N");
    c->add_flag("--keep-partial", m_invocation.common.keepPartial,
                "Path: when interrupted, write what has converged so far");
}

void CommandParser::addWhitted(CLI::App* c, WhittedOptions& o) {
    c->add_option("--whitted-model", o.model,
                  "Whitted: how surfaces reflect the light of lights: patina, as the viewport, or "
                  "1980, with the paper's equation (default: patina)")
        ->check(plain(CLI::IsMember({"patina", "1980"})))
        ->type_name("patina|1980");
    c->add_option("--min-contribution", o.minContribution,
                  "Whitted: a branch that would contribute less ends (default: 0.002)")
        ->check(plain(CLI::Range(kLeastContribution, 1.0f)))
        ->type_name("SHARE");
    c->add_option("--contrast", o.contrast,
                  "Whitted: squares of a pixel whose corners' contrast is above this are divided; "
                  "0: all that differ (default: 0.1)")
        ->check(plain(CLI::Range(0.0f, 1.0f)))
        ->type_name("0…1");
    c->add_option("--subdivisions", o.subdivisions,
                  "Whitted: how often at most; 0: the mean of a pixel's corners (default: 2)")
        ->check(plain(CLI::Range(0, kMostSubdivisions)))
        ->type_name("N");
    c->add_flag("--soft-shadows", o.softShadows,
                "Whitted: shadow rays to points all over the lights, in place of their centres; a "
                "pixel is then the mean of --samples rays (default: 64)");
    c->add_flag("--gloss", o.gloss,
                "Whitted: mirror rays from rough surfaces, too, spread by their roughness; also "
                "by --samples");
    c->add_flag("--depth-of-field", o.depthOfField,
                "Whitted: rays from points all over the lens (view.depthOfField), in place of its "
                "middle; also by --samples");
}

void CommandParser::addRender() {
    RenderOptions& o = m_render;
    CLI::App* c = addCommand(m_app, "render", "One picture, without a window", o);
    addScene(c, o);
    // With --inspect or --ray-tree a picture need not be written: run() sees to that.
    c->add_option("-o,--output", o.output,
                  "Picture: .png, .jpg, .tif, .tga as displayed, .exr or .hdr linear; with a turn "
                  "numbered pictures, or a video: .mp4, .webm")
        ->type_name("OUT");
    addEnvironmentOption(c, o);
    c->add_option("--size", o.size, "Pixels")->capture_default_str()->type_name("WxH");
    addPicture(c, o);
    CLI::Option* samples = c->get_option("--samples");
    samples->check(plain(CLI::Range(1, kMostPaths)))
        ->description("Samples per pixel: 1, 2, 4, 8 or 16 against jagged edges (MSAA); with "
                      "--renderer path as many paths as there are at most (default: 256)");
    addTracing(c, o);
    c->add_option("--ray-tree", o.rayTree,
                  "Whitted: the rays of this pixel, counted from the top left, as a tree: what "
                  "each met, what it contributes, why it ended; with --json as JSON. OUT may then "
                  "be left out")
        ->type_name("X,Y");
    c->add_option("--error-against", o.errorAgainst,
                  "Also say how far the picture is from this linear one of the same scene and "
                  "camera: rmse, relmse, psnr, flip, bias in EV, max")
        ->type_name("REF.exr");
    std::string outputs;
    for (const OutputInfo& info : outputInfos())
        outputs += fmt::format("{}{}", outputs.empty() ? "" : ", ", info.id);
    std::string counts;
    for (const RayCountInfo& info : rayCountInfos())
        counts += fmt::format("{}{}", counts.empty() ? "" : ", ", info.id);
    c->add_option("--aov", o.aov,
                  fmt::format("Path: a part of the .exr each for the picture and what it consists "
                              "of: all, or {}; whitted: what its pixels took: all, or {}",
                              outputs, counts))
        ->check(plain(CLI::Validator(
            [](const std::string& text) {
                const auto parsed = parseOutputs(text);
                return parsed || parseRayCounts(text) ? std::string() : parsed.error().message;
            },
            "")))
        ->type_name("all|NAME,…");
    addShards(c, o.work,
              "Path: trace part K of N only, for patina merge; auto: as the farm numbers its tasks",
              "Path: ");
    m_select[c] = [&o, samples] {
        o.samplesGiven = samples->count() > 0;
        return decltype(m_invocation.options)(o);
    };
    c->add_option("--view", o.view,
                  "A term of the shading equation instead of the picture (see --list-views); "
                  "all: a part each of an .exr, else a contact sheet of pictures of this size")
        ->type_name("VIEW|all");
    c->add_option("--view-mode", o.viewMode,
                  "The term's own value, or what it contributes to the picture")
        ->check(plain(CLI::IsMember({"raw", "contribution"})))
        ->capture_default_str()
        ->type_name("raw|contribution");
    c->add_option("--view-range", o.viewRange, "What the colours of a view's numbers span")
        ->type_name("MIN,MAX");
    c->add_option("--view-light", o.viewLight,
                  "Whose D, G, F and cosines are shown (default: the mirror direction)")
        ->type_name("NAME");
    c->add_option("--inspect", o.inspect,
                  "Explain this pixel, counted from the top left: maps, factors, formulas, "
                  "sum, display; with --json as JSON. OUT may then be left out")
        ->type_name("X,Y");
    const auto turn = [&](const char* name, int& count, const char* help) {
        c->add_option(name, count, help)
            ->check(plain(CLI::Range(2, kMostSequenceFrames)))
            ->type_name("N");
    };
    turn("--turntable", o.turntable,
         "The camera goes once round its target in N pictures: OUT-0001.png …, or a video");
    turn("--light-turn", o.lightTurn, "The same with the environment, which turns round the scene");
    c->add_option("--fps", o.framesPerSecond, "Pictures per second of a video")
        ->check(plain(CLI::Range(1, kMostVideoRate)))
        ->capture_default_str()
        ->type_name("N");
    c->add_flag_callback(
         "--list-views", [] { throw ListViews(); }, "Print the names of all views")
        ->trigger_on_parse();
    addSets(c);
    addThreads(c);
}

} // namespace patina::cli
