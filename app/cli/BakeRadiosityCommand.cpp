#include "app/cli/BakeRadiosity.h"

#include "app/cli/Commands.h"
#include "app/cli/LeakReport.h"
#include "app/cli/LongRadiosity.h"
#include "app/cli/Numbers.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/RadiosityReport.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/base/LowerCase.h"
#include "core/export/Export.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/io/ImageIO.h"
#include "core/math/Shading.h"
#include "core/radiosity/RadiosityPicture.h"
#include "core/radiosity/document/Discretisation.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/LitFiles.h"
#include "core/radiosity/document/RadiosityLightMap.h"
#include "core/radiosity/document/Reexpose.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "render/GpuHemicubes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::cli {
namespace {

using namespace radiosity;

constexpr std::string_view kAutomatic = "auto";                            // --exposure
constexpr std::string_view kAdaptive = "adaptive:", kDynamic = "dynamic:"; // --subdivide

std::string extensionOf(const std::filesystem::path& output) {
    return lowerCase(output.extension().string());
}
bool isPly(const std::filesystem::path& output) {
    return extensionOf(output) == ".ply";
}
bool isPicture(const std::filesystem::path& output) {
    return extensionOf(output) == ".png" || extensionOf(output) == ".exr";
}

bool isCollada(const std::filesystem::path& output) {
    return extensionOf(output) == ".dae";
}

// --subdivide and --divide-by.
Result<void> readDivision(const BakeRadiosityOptions& options, RadiositySettings& settings) {
    std::string_view division = options.subdivide;
    bool further = false;
    for (const std::string_view kind : {kAdaptive, kDynamic})
        if (division.starts_with(kind)) {
            division.remove_prefix(kind.size());
            settings.dynamic = kind == kDynamic;
            further = true;
        }
    std::vector<double> numbers;
    const bool read = options.subdivide.empty() || parseNumbers(division, ',', numbers);
    if (!read || numbers.size() > (further ? 2 : 1) ||
        (numbers.empty() && !options.subdivide.empty()) ||
        !std::ranges::all_of(numbers, [](double n) { return n > 0.0 && std::isfinite(n); }))
        return usageError("--subdivide is an area in square metres; or adaptive:X or dynamic:X "
                          "with a share X of the light, as adaptive:0.1, and the area of the "
                          "first elements if need be, as adaptive:0.1,0.01");
    if (!numbers.empty())
        (further ? settings.adaptive : settings.maxArea) = numbers[0];
    if (numbers.size() > 1)
        settings.maxArea = numbers[1];
    if (settings.dynamic && !shoots(settings.solve.solver))
        return usageError(fmt::format("--subdivide dynamic is for solvers that shoot: progressive, "
                                      "southwell and overshooting, not {}; give one of them, or "
                                      "adaptive:X",
                                      name(settings.solve.solver)));
    if (!further && settings.divideBy != DivisionRule::Gradient)
        return usageError("--divide-by says where --subdivide adaptive:X or dynamic:X divides: "
                          "give one of them, too");
    return {};
}

// With --target texel, --size is one number, as that of all other bakes per texel.
Result<int> lightMapSize(const BakeRadiosityOptions& options) {
    if (!options.size)
        return RadiosityMapSettings().size;
    std::vector<double> numbers;
    if (!parseNumbers(*options.size, ',', numbers) || numbers.size() != 1 ||
        numbers[0] != std::floor(numbers[0]) || !(numbers[0] >= 1.0) ||
        !(numbers[0] <= kMaxRadiosityMapSize))
        return usageError(fmt::format("--size of a light map is its side in texels, from 1 to {}, "
                                      "not {}",
                                      kMaxRadiosityMapSize, *options.size));
    return static_cast<int>(numbers[0]);
}

// As displayed into a .png, radiance into an .exr.
Result<void> writePicture(Session& session, const BakeRadiosityOptions& options,
                          const SceneRequest& request, const Document& document,
                          const RadiosityScene& scene, const Solution& solution,
                          std::optional<double> exposure, const std::filesystem::path& output) {
    PictureOptions picture;
    picture.size = options.size.value_or(picture.size);
    picture.camera = options.camera.value_or("");
    const Result<render::FrameSettings> frame = frameSettings(picture);
    if (!frame)
        return frame.error();
    TraceView view;
    view.width = frame->width;
    view.height = frame->height;
    const Result<Camera> camera =
        chooseCamera(session, picture, document, request,
                     static_cast<float>(view.width) / static_cast<float>(view.height));
    if (!camera)
        return camera.error();
    view.camera = *camera;
    view.transparent = true;
    PictureSettings settings;
    settings.look = options.look.value_or(Look::Smooth);
    settings.seed = options.settings.factors.seed;
    session.job().setActivity("drawing");
    const SeenSolution seen(scene.scene(), scene.elements(), scene.lit(), solution);
    const Result<Image> drawn = seen.picture(view, settings, session.job());
    if (!drawn)
        return drawn.error();
    if (extensionOf(output) == ".exr") {
        if (Result<void> saved = saveImage(session.worker(), *drawn, output); !saved)
            return saved;
    } else {
        Image shown(view.width, view.height, 4, PixelType::U8, ColorEncoding::Srgb);
        const std::span<const float> light = drawn->f32();
        for (std::size_t i = 0; i < light.size(); i += 4) {
            const glm::vec3 radiance(light[i], light[i + 1], light[i + 2]);
            const glm::vec3 color =
                exposure ? exposed(radiance, *exposure) : glm::clamp(radiance, 0.0f, 1.0f);
            // Files have colours without their coverage.
            const float alpha = light[i + 3];
            for (int c = 0; c < 4; ++c) {
                const float value =
                    c == 3 ? alpha
                           : shading::srgbEncode(alpha > 0.0f ? std::min(color[c] / alpha, 1.0f)
                                                              : 0.0f);
                shown.u8()[i + static_cast<std::size_t>(c)] =
                    static_cast<std::uint8_t>(std::lround(255.0f * value));
            }
        }
        if (Result<void> saved = saveImage(session.worker(), shown, output); !saved)
            return saved;
    }
    session.report().output(output, fmt::format("{} x {}", view.width, view.height));
    return {};
}

// All files of it, or none.
Result<void> writePlan(Session& session, const ExportPlan& plan) {
    const auto written = runExport(session.worker(), plan, session.job());
    if (!written)
        return written.error();
    for (const std::filesystem::path& file : *written) {
        std::error_code unknown;
        const std::uintmax_t size = std::filesystem::file_size(file, unknown);
        session.report().output(file, unknown ? "" : bytesText(size));
    }
    return {};
}

// A document whose surfaces are black, and glow with the light of an earlier bake, is no scene.
Result<void> checkColladaScene(const std::filesystem::path& scene) {
    const Result<ColladaDocument> document = ColladaDocument::read(scene);
    if (!document)
        return document.error();
    // As new documents are written: surfaces that only show what is at their vertices.
    const bool unlit = std::ranges::any_of(document->materials(), &ColladaMaterial::unlit) &&
                       std::ranges::all_of(document->materials(), &ColladaMaterial::unlit);
    const auto lit = document->litGeometries();
    const bool showsVertices = unlit && lit && !lit->empty();
    if (document->showsLightMap() || showsVertices)
        return Error{ErrorKind::Usage,
                     fmt::format("its surfaces show {} already; bake the scene that it was made "
                                 "from",
                                 showsVertices ? "baked light" : "a light map"),
                     scene,
                     {}};
    return {};
}

// nullopt: values as they are. `automatic`: the exposure that is chosen by the light.
Result<std::optional<double>> exposureOf(const std::string& text, double automatic) {
    if (text.empty() || text == kAutomatic)
        return std::optional(automatic);
    if (text == "none")
        return std::optional<double>();
    std::vector<double> numbers;
    if (!parseNumbers(text, ',', numbers) || numbers.size() != 1 || !(numbers[0] > 0.0) ||
        !std::isfinite(numbers[0]))
        return usageError("--exposure is a number above 0, none or auto");
    return std::optional(numbers[0]);
}

// OUT-000012.glb of OUT.glb.
std::filesystem::path numbered(const std::filesystem::path& output, std::uint64_t iterations) {
    std::filesystem::path result = output;
    result.replace_filename(
        fmt::format("{}-{:06}{}", output.stem().string(), iterations, output.extension().string()));
    return result;
}

// A COLLADA scene's light goes into the document that it came from.
Result<void> writeLit(Session& session, const BakeRadiosityOptions& options,
                      const SceneRequest& request, const Document& document, const LitDocument& lit,
                      const std::filesystem::path& output) {
    LitFilesSettings files;
    files.output = output;
    if (isCollada(output) && isCollada(options.scene)) {
        files.document = options.scene;
        files.visualScene = session.options().visualScene;
    } else if (isCollada(output)) {
        const Result<Camera> camera = chooseCamera(session, {}, document, request, 16.0f / 9.0f);
        if (!camera)
            return camera.error();
        files.camera = *camera;
    }
    const Result<ExportPlan> plan = planLitFiles(lit, document, files);
    if (!plan)
        return plan.error();
    for (const std::string& warning : plan->warnings)
        session.report().warn(warning);
    return writePlan(session, *plan);
}

// As `output`, which may be another file than the options say.
Result<void> writeSolution(Session& session, const BakeRadiosityOptions& options,
                           const SceneRequest& request, const Document& document,
                           const RadiosityScene& scene, const Solution& solution,
                           const std::filesystem::path& output) {
    const std::vector<LitPart> parts = litParts(scene.surfaces(), solution);
    const double automatic = automaticExposure(document, parts);
    const auto exposure = exposureOf(options.exposure, automatic);
    if (!exposure)
        return exposure.error();
    if (*exposure)
        session.report().json()["exposure"] = **exposure;
    if (options.target == BakeTarget::Vertex)
        return isPicture(output) ? writePicture(session, options, request, document, scene,
                                                solution, *exposure, output)
                                 : writeLit(session, options, request, document,
                                            litDocument(document, parts, *exposure), output);

    const Result<int> size = lightMapSize(options);
    if (!size)
        return size.error();
    RadiosityMapSettings settings;
    settings.size = *size;
    settings.picture.look = options.look.value_or(Look::Smooth);
    settings.picture.seed = options.settings.factors.seed;
    const auto map = radiosityLightMap(scene.surfaces(), solution, settings, session.job());
    if (!map)
        return map.error();
    const auto lit = static_cast<std::size_t>(std::ranges::count(map->lit, std::uint8_t{1}));
    session.report().json()["lightMap"] = {{"size", map->side}, {"texels", lit}};
    session.report().table({}, {{"Light map", fmt::format("{0} × {0}, {1} of its texels lie on "
                                                          "surfaces",
                                                          map->side, countText(lit))}});
    if (!isPicture(output))
        return writeLit(session, options, request, document,
                        litDocument(document, *map, *exposure, automatic), output);
    const Result<Bytes> image =
        extensionOf(output) == ".exr"
            ? encodeLightMap(session.worker(), *map->radiance, automatic)
            : encodeImage(session.worker(), *shownLightMap(*map->radiance, *exposure),
                          ImageFileFormat::Png);
    if (!image)
        return image.error();
    if (Result<void> saved = writeFileAtomically(output, *image); !saved)
        return saved;
    session.report().output(output, fmt::format("{0} x {0}", map->side));
    return {};
}

// Hemicubes are drawn where --device says so, or not at all. What it has chosen is `device` then.
Result<void> openDevice(Session& session, BakeRadiosityOptions& options,
                        RadiositySettings& settings) {
    const bool chooses = options.device == HemicubeDevice::Auto;
    // Parts, and what is gone on with, may be of machines that differ.
    const LongBakeOptions& work = options.work;
    const bool anywhere = !work.shard.empty() || !work.checkpoint.empty() || work.resume;
    if (chooses) {
        options.device = HemicubeDevice::Cpu;
        if (anywhere || settings.factors.method != FactorMethod::Hemicube ||
            settings.solve.solver == Solver::Hierarchical)
            return {};
    }
    if (options.device == HemicubeDevice::Cpu && !chooses)
        return {};
    auto hemicubes = render::GpuHemicubes::create();
    if (chooses && (!hemicubes || (*hemicubes)->info().software))
        return {}; // rays are as fast as an OpenGL that draws on the CPU, and the same everywhere
    options.device = HemicubeDevice::Gpu;
    if (!hemicubes) {
        Error error = hemicubes.error();
        error.message += " Or leave --device gpu out: rays find the same on the CPU.";
        return error;
    }
    const gl::ContextInfo& info = (*hemicubes)->info();
    session.report().json()["openGl"] = {
        {"vendor", info.vendor}, {"renderer", info.renderer}, {"version", info.version}};
    settings.factors.drawer = *std::move(hemicubes);
    return {};
}

// Apart from the bound, because it is none.
Result<void> reportDiscretisation(Session& session, const RadiosityScene& scene,
                                  const RadiositySettings& settings, const Solved& solved) {
    session.beginPhase();
    const auto estimate = estimateDiscretisation(scene, solved.solution, settings, session.job());
    if (!estimate)
        return estimate.error();
    session.report().json()["discretisationEstimate"] = {
        {"elements", estimate->elements}, {"rms", estimate->rms}, {"largest", estimate->largest}};
    const auto percent = [&](double value) {
        return 100.0 * value / std::max(solved.report.meanRadiosity, 1e-300);
    };
    session.report().table(
        {}, {{"Discretisation (estimate)",
              fmt::format("{:.2g} W/m², {:.2g} % of the mean radiosity; the largest {:.2g} %: what "
                          "{} elements change",
                          estimate->rms, percent(estimate->rms), percent(estimate->largest),
                          countText(estimate->elements))}});
    return {};
}

Result<void> runReexpose(Session& session, const BakeRadiosityOptions& options) {
    const auto k = exposureOf(options.exposure, 1.0);
    if (!k)
        return k.error();
    const std::filesystem::path output = options.output;
    if (Result<void> possible = checkOutput(output); !possible)
        return possible;
    ExposureRequest request;
    if (!options.exposure.empty() && options.exposure != kAutomatic)
        request = *k ? ExposureRequest{ExposureRequest::Kind::Value, **k}
                     : ExposureRequest{ExposureRequest::Kind::None, 0.0};
    session.report().json()["settings"] = {
        {"reexpose", options.reexpose},
        {"exposure", options.exposure.empty() ? std::string(kAutomatic) : options.exposure}};
    const Result<Reexposed> result =
        reexpose(session.worker(), options.reexpose, output, request, session.job());
    if (!result)
        return result.error();
    for (const std::string& notice : result->notices)
        session.report().warn(notice);
    const int side = result->lightMapSide;
    if (side > 0)
        session.report().json()["lightMap"] = {{"size", side}};
    else
        session.report().json()["counts"] = {{"vertices", result->vertices}};
    if (result->k > 0.0)
        session.report().json()["exposure"] = result->k;
    session.report().table({}, {side > 0 ? std::pair{"Light map", fmt::format("{0} × {0}", side)}
                                         : std::pair{"Vertices", countText(result->vertices)},
                                {"Exposure", result->k > 0.0 ? fmt::format("{:.4g}", result->k)
                                                             : std::string("none: cut off at 1")}});
    for (const std::filesystem::path& file : result->files) {
        std::error_code unknown;
        const std::uintmax_t size = std::filesystem::file_size(file, unknown);
        session.report().output(file, unknown ? "" : bytesText(size));
    }
    return {};
}

} // namespace

Result<void> checkRadiosityFile(const BakeRadiosityOptions& options) {
    const std::filesystem::path output = options.output;
    if (!isPly(output) && !isCollada(output) && !isPicture(output) && !exportFormatOf(output))
        return usageError(fmt::format(
            "{}: radiosity is written to .dae, .glb, .gltf, .ply, or as a picture to .png or .exr",
            output.filename().string()));
    const bool texels = options.target == BakeTarget::Texel;
    if (texels && isPly(output))
        return usageError(fmt::format("{}: PLY has no textures; with --target texel radiosity is "
                                      "written to .dae, .glb, .gltf, or alone to .png or .exr",
                                      output.filename().string()));
    if (texels && options.camera)
        return usageError("--camera is for pictures, and --target texel makes a light map");
    if (!texels && !isPicture(output) && (options.size || options.camera || options.look))
        return usageError("--size, --camera and --look are for pictures: -o OUT.png or OUT.exr; "
                          "--size and --look are also for light maps: --target texel");
    return checkOutput(output);
}

Result<RadiositySettings> radiositySettingsOf(const BakeRadiosityOptions& options) {
    RadiositySettings settings = options.settings;
    if (settings.solve.solver == Solver::Hierarchical) {
        if (settings.factors.method != FactorMethod::Rays)
            return usageError("--form-factors has no effect on --solver hierarchical, which uses "
                              "pairs of points; leave it out");
        HierarchySettings& hierarchy = settings.hierarchy;
        hierarchy.seed = settings.factors.seed;
        hierarchy.pairs = options.resolution.value_or(hierarchy.pairs);
        if (hierarchy.pairs < 2 || hierarchy.pairs > 65536)
            return usageError(fmt::format("--resolution of hierarchical is from 2 to 65536, not {}",
                                          hierarchy.pairs));
    }
    if (options.device == HemicubeDevice::Gpu && settings.factors.method != FactorMethod::Hemicube)
        return usageError("--device gpu draws hemicubes: give --form-factors hemicube, too, or "
                          "leave it out");
    const ResolutionRange range = resolutionRange(settings.factors.method);
    settings.factors.resolution = options.resolution.value_or(range.usual);
    const bool odd =
        settings.factors.method == FactorMethod::Hemicube && settings.factors.resolution % 2 != 0;
    if (settings.factors.resolution < range.lowest || settings.factors.resolution > range.highest ||
        odd)
        return usageError(fmt::format("--resolution of {} is {}from {} to {}, not {}",
                                      name(settings.factors.method), odd ? "even, " : "",
                                      range.lowest, range.highest, settings.factors.resolution));
    settings.factors.centreOnly = settings.classic;
    settings.factors.stands = options.stands;
    if (options.stands > 1 && (!hasStands(settings.factors.method) || settings.classic))
        return usageError("--stands is for --form-factors hemicube and paraboloid without "
                          "--classic, which has one at the centre; leave it out");
    if (settings.solve.shotsPerStep > 1 && !shoots(settings.solve.solver))
        return usageError(fmt::format("--shots-per-step is for solvers that shoot: progressive, "
                                      "southwell and overshooting, not {}",
                                      name(settings.solve.solver)));
    if (options.outputEvery && *options.outputEvery % settings.solve.shotsPerStep != 0)
        return usageError(fmt::format("--output-every {} is no multiple of --shots-per-step {}",
                                      *options.outputEvery, settings.solve.shotsPerStep));
    if (Result<void> division = readDivision(options, settings); !division)
        return division.error();
    if (settings.patchArea > 0.0 && !shoots(settings.solve.solver))
        return usageError(fmt::format("--patches is for solvers that shoot: progressive, southwell "
                                      "and overshooting, not {}",
                                      name(settings.solve.solver)));
    if (settings.patchArea > 0.0 && settings.patchArea < settings.maxArea)
        return usageError(fmt::format("--patches {:g} is smaller than the elements of --subdivide "
                                      "{:g}, into which patches are divided",
                                      settings.patchArea, settings.maxArea));
    return settings;
}

namespace {

// How long it will take, before it is begun: where that is long enough for somebody to think
// better of it. `found`: rows that are there already.
Result<void> reportExpected(Session& session, const BakeRadiosityOptions& options,
                            const RadiositySettings& settings, const RadiosityScene& scene,
                            std::size_t found) {
    constexpr double kWorthSaying = 10.0;              // s
    if (settings.factors.method == FactorMethod::Rays) // a tenth of a millisecond a row
        return {};
    session.job().setActivity("timing form factors");
    const Result<double> all = scene.expectedFactorSeconds(settings, session.job());
    if (!all)
        return all.error();
    if (session.job().cancelled())
        return cancelledError();
    const std::size_t rows = scene.elements().senderCount();
    const double seconds = *all * (1.0 - static_cast<double>(found) / static_cast<double>(rows));
    if (seconds < kWorthSaying)
        return {};
    session.report().json()["expectedFactorSeconds"] = seconds;
    const std::string text = seconds < 100.0 ? fmt::format("about {:.0f} s", seconds)
                                             : fmt::format("about {:.0f} min", seconds / 60.0);
    session.endProgress();
    session.report().table(
        {}, {{"Form factors will take",
              fmt::format("{}, {} rows by {}{}", text, countText(rows - found),
                          name(settings.factors.method),
                          options.device == HemicubeDevice::Gpu ? " on the graphics card" : "")}});
    return {};
}

} // namespace

Result<SolvedRadiosity> solveRadiosity(Session& session, const BakeRadiosityOptions& options,
                                       const RadiositySettings& settings, RadiosityInputs& inputs,
                                       SolveKeeper* keeper) {
    session.beginPhase();
    auto scene = RadiosityScene::make(inputs.traced, settings, session.job(), keeper);
    if (!scene)
        return scene.error();
    session.beginPhase();
    if (Result<void> said = reportExpected(session, options, settings, **scene,
                                           keeper != nullptr ? keeper->state().rows.rowCount() : 0);
        !said)
        return said.error();
    session.beginPhase();
    session.allowPartialResult();
    // What is there after so many shots or sweeps, in files of their own.
    Result<void> partial;
    std::uint64_t nextOutput = options.outputEvery.value_or(0);
    const auto isDue = [&](std::uint64_t iterations) {
        if (nextOutput == 0 || iterations < nextOutput)
            return false;
        nextOutput = (iterations / *options.outputEvery + 1) * *options.outputEvery;
        return true;
    };
    if (keeper != nullptr) // whose steps were written then
        for (const SolveStep& step : keeper->state().solver.steps)
            static_cast<void>(isDue(step.iterations));
    const auto keepPartial = [&](std::uint64_t iterations, double,
                                 const std::function<Solution()>& solution) {
        if (!isDue(iterations))
            return true;
        partial = writeSolution(session, options, inputs.request, inputs.document, **scene,
                                solution(), numbered(options.output, iterations));
        return partial.ok();
    };
    Result<Solved> solved = (*scene)->solve(settings, session.job(), keepPartial, keeper);
    if (!solved)
        return solved.error();
    if (!partial)
        return partial.error();
    reportRadiosity(session.report(), options, settings, **scene, solved->report);
    session.report().json()["partial"] = session.interrupted();
    return SolvedRadiosity{*std::move(scene), *std::move(solved)};
}

Result<void> writeRadiositySolution(Session& session, const BakeRadiosityOptions& options,
                                    const RadiositySettings& settings,
                                    const RadiosityInputs& inputs, const SolvedRadiosity& solved) {
    if (options.estimateDiscretisation && !session.interrupted())
        if (Result<void> estimated =
                reportDiscretisation(session, *solved.scene, settings, solved.solved);
            !estimated)
            return estimated;
    if (options.findLeaks && !session.interrupted())
        if (Result<void> found = reportLeaksAndSeams(session, inputs, settings, solved); !found)
            return found;
    session.beginPhase();
    session.job().setActivity("writing");
    return writeSolution(session, options, inputs.request, inputs.document, *solved.scene,
                         solved.solved.solution, options.output);
}

Result<RadiosityInputs> openRadiosityScene(Session& session, const BakeRadiosityOptions& options,
                                           std::optional<std::vector<std::string>> sets) {
    if (isCollada(options.scene))
        if (Result<void> scene = checkColladaScene(options.scene); !scene)
            return scene.error();
    session.beginPhase();
    RadiosityInputs inputs;
    inputs.request = {options.scene, options.environment, options.environmentLayout, {}, {}};
    inputs.request.sets = std::move(sets);
    inputs.request.ownLightAlone = true;
    Result<Document> document = openSceneFor(session, inputs.request);
    if (!document)
        return document.error();
    inputs.document = *std::move(document);
    session.report().table({}, {{"Lit by", lightNamesText(lightNames(inputs.document))}});
    inputs.traced = traceInputs(inputs.document);
    return inputs;
}

void reportRadiositySettings(Session& session, const BakeRadiosityOptions& options,
                             const RadiositySettings& settings) {
    session.report().json()["settings"] = {
        {"scene", options.scene},
        {"formFactors", name(settings.factors.method)},
        {"resolution", settings.factors.resolution},
        {"device", options.device == HemicubeDevice::Gpu ? "gpu" : "cpu"},
        {"solver", name(settings.solve.solver)},
        {"linkError", settings.hierarchy.linkError},
        {"iterations", settings.solve.maxIterations},
        {"residual", settings.solve.residual},
        {"subdivide", settings.maxArea},
        {"adaptive", settings.adaptive},
        {"divideBy", name(settings.divideBy)},
        {"dynamic", settings.dynamic},
        {"patches", settings.patchArea},
        {"classic", settings.classic},
        {"samples", settings.lightSamples},
        {"seed", settings.factors.seed}};
    if (hasStands(settings.factors.method))
        session.report().json()["settings"]["stands"] = settings.factors.stands;
    const bool texels = options.target == BakeTarget::Texel;
    session.report().json()["settings"]["target"] = texels ? "texel" : "vertex";
    if (texels)
        session.report().json()["settings"]["size"] = *lightMapSize(options);
}

Result<void> run(Session& session, const BakeRadiosityOptions& options) {
    if (!options.reexpose.empty())
        return runReexpose(session, options);
    if (options.scene.empty())
        return usageError("SCENE is missing: the scene to solve, or --reexpose with a solved file");
    Result<RadiositySettings> settings = radiositySettingsOf(options);
    if (!settings)
        return settings.error();
    if (const auto exposure = exposureOf(options.exposure, 1.0); !exposure)
        return exposure.error();
    if (options.target == BakeTarget::Texel)
        if (const Result<int> size = lightMapSize(options); !size)
            return size.error();
    BakeRadiosityOptions chosen = options;
    if (Result<void> opened = openDevice(session, chosen, *settings); !opened)
        return opened;
    return bakeRadiosity(session, chosen, *settings);
}

} // namespace patina::cli
