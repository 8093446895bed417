// `patina bake …` and `patina merge`.
#include "app/cli/CommandParser.h"
#include "core/math/SphericalHarmonics.h"
#include "core/radiosity/document/RadiosityLightMap.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

namespace patina::cli {

void CommandParser::addRays(CLI::App* command, int& samples, unsigned& seed, const char* per) {
    command
        ->add_option("--samples", samples,
                     fmt::format("Rays per {}, up to 65536; rounded up to a power of two", per))
        ->check(plain(CLI::Range(1, 65536)))
        ->capture_default_str()
        ->type_name("N");
    command->add_option("--seed", seed, "Seed of the sample pattern")
        ->capture_default_str()
        ->type_name("N");
    command->add_flag("--keep-partial", m_invocation.common.keepPartial,
                      "When interrupted, write what has converged so far");
}

// Named before the options it sets, so that those have the last word, in whatever order they are
// given.
void CommandParser::addPreset(CLI::App* command, std::function<void(const BakePreset&)> apply) {
    std::vector<std::string> names;
    for (const BakePreset& preset : bakePresets())
        names.emplace_back(preset.name);
    command
        ->add_option_function<std::string>(
            "--preset",
            [apply = std::move(apply)](const std::string& name) { apply(*findBakePreset(name)); },
            "Rays and side of textures at once, as in the editor; options of their own come first "
            "(default: good)")
        ->check(plain(CLI::IsMember(names)))
        ->type_name(fmt::format("{}", fmt::join(names, "|")));
}

void CommandParser::addBakes() {
    CLI::App* bake = m_app.add_subcommand("bake", "One bake, without a window");
    bake->require_subcommand(1);

    CLI::App* ao = addCommand(*bake, "ao", "Ambient occlusion", m_ao);
    addSceneAndOutput(ao, m_ao, ".png (one for each material) or .exr (for --bake of the others)");
    ao->add_option("--target", m_ao.target, "Where the values live")
        ->transform(plain(CLI::CheckedTransformer(std::map<std::string, BakeTarget>{
            {"texel", BakeTarget::Texel}, {"vertex", BakeTarget::Vertex}})))
        ->default_str("texel")
        ->type_name("texel|vertex");
    addPreset(ao, [this](const BakePreset& preset) {
        m_ao.samples = preset.occlusionSamples;
        m_ao.size = preset.occlusionSize;
    });
    ao->add_option("--size", m_ao.size, "Side of the square texture in texels")
        ->check(plain(CLI::Range(1, 16384)))
        ->capture_default_str()
        ->type_name("N");
    ao->add_option("--distance", m_ao.distance,
                   "How far geometry occludes, in metres (default: unlimited)")
        ->check(plain(CLI::NonNegativeNumber))
        ->type_name("METRES");
    addRays(ao, m_ao.samples, m_ao.seed, "texel or vertex");
    addLongBake(ao, m_ao.work);
    addSets(ao);
    addThreads(ao);

    addBakePrt(*bake);
    addBakeLight(*bake);
    addBakeRadiosity(*bake);
    addBakeIbl(*bake);
}

void CommandParser::addShards(CLI::App* command, LongBakeOptions& o, const char* shardHelp,
                              const char* prefix) {
    const bool begins = std::string_view(prefix).empty(); // the sentence, here
    command->add_option("--shard", o.shard, shardHelp)->type_name("K/N|auto");
    command
        ->add_option("--checkpoint", o.checkpoint,
                     fmt::format("{}{} often to keep what is done in OUT.checkpoint, and to keep "
                                 "it when interrupted (default: every 30s, not when interrupted)",
                                 prefix, begins ? "How" : "how"))
        ->type_name("EVERY");
    command->add_flag("--resume", o.resume,
                      fmt::format("{}{} on from OUT.checkpoint where there is one; keep one when "
                                  "interrupted",
                                  prefix, begins ? "Go" : "go"));
}

void CommandParser::addLongBake(CLI::App* command, LongBakeOptions& o) {
    addShards(command, o,
              "Bake part K of N only, for patina merge; auto: as the farm numbers its tasks");
    command
        ->add_option("--max-memory", o.maxMemory,
                     "Refuse a bake that would take more, e.g. 4GiB (default: what is free)")
        ->type_name("SIZE");
}

void CommandParser::addBakePrt(CLI::App& bake) {
    BakePrtOptions& o = m_prt;
    PrtSettings& s = o.settings;
    CLI::App* c = addCommand(bake, "prt", "Diffuse radiance transfer", o);
    addSceneAndOutput(c, o, ".exr; with --shard a part for patina merge");
    addPreset(c, [&s](const BakePreset& preset) {
        s = withPreset({BakeKind::PrtVertex, {}, s}, preset).prt;
    });
    c->add_option("--order", s.order, "Spherical harmonic bands")
        ->check(plain(CLI::Range(1, kMaxShOrder)))
        ->capture_default_str()
        ->type_name(fmt::format("1…{}", kMaxShOrder));
    c->add_option("--transfer", o.transfer,
                  "unshadowed: the cosine alone; shadowed: and what the scene hides; "
                  "interreflected: and what other surfaces reflect (default: shadowed)")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, TransferKind>{{"unshadowed", TransferKind::Unshadowed},
                                                {"shadowed", TransferKind::Shadowed},
                                                {"interreflected", TransferKind::Interreflected}})))
        ->type_name("KIND");
    c->add_option("--bounces", o.bounces,
                  fmt::format("How often light is reflected; implies --transfer "
                              "interreflected (default: {})",
                              s.bounces))
        ->check(plain(CLI::Range(1, 64)))
        ->type_name("1…64");
    c->add_option("--bounce-samples", o.bounceSamples,
                  fmt::format("Rays per vertex or texel to find what reflects light to it; implies "
                              "--transfer interreflected (default: {})",
                              s.bounceSamples))
        ->check(plain(CLI::Range(1, 65536)))
        ->type_name("N");
    c->add_option("--hit-memory", o.hitMemory,
                  "Memory that what those rays meet may take, e.g. 4GiB; where it is not enough "
                  "they are traced anew for every bounce, to the same result (default: 1GiB)")
        ->type_name("SIZE");
    c->add_option("--target", o.target, "Where the values live")
        ->transform(plain(CLI::CheckedTransformer(std::map<std::string, BakeTarget>{
            {"texel", BakeTarget::Texel}, {"vertex", BakeTarget::Vertex}})))
        ->default_str("vertex")
        ->type_name("vertex|texel");
    c->add_option("--size", o.size,
                  fmt::format("With --target texel: side of the square texture in texels "
                              "(default: {})",
                              s.size))
        ->check(plain(CLI::Range(1, 8192)))
        ->type_name("N");
    c->add_flag_callback(
        "--no-fit", [&s] { s.fitted = false; },
        "Per vertex: values at the vertices instead of the best fit over the surface");
    c->add_option("--method", s.method,
                  "Sample pattern: qmc (Owen-scrambled Sobol'), stratified (jittered N × N, "
                  "the classical one), random (to compare with)")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, SampleMethod>{{"qmc", SampleMethod::Qmc},
                                                {"stratified", SampleMethod::Stratified},
                                                {"random", SampleMethod::Random}})))
        ->default_str("qmc")
        ->type_name("NAME");
    c->add_option("--tolerance", s.tolerance,
                  "End when passes change the coefficients by less (RMS), with more rays only "
                  "where neighbours differ; --samples is then the most (default: 0, never)")
        ->check(plain(CLI::Range(0.0, 1.0)))
        ->type_name("X");
    c->add_option("--store", o.storage.storage,
                  "Numbers in the file: float (exact), half, or quantised (whole steps of each "
                  "band's own size); the error is reported")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, BakeStorage>{{"float", BakeStorage::Float},
                                               {"half", BakeStorage::Half},
                                               {"quantised", BakeStorage::Quantised}})))
        ->default_str("float")
        ->type_name("NAME");
    c->add_option("--bits", o.bits,
                  fmt::format("With --store quantised: of a coefficient with its sign "
                              "(default: {})",
                              o.storage.bits))
        ->check(plain(CLI::Range(kMinStorageBits, kMaxStorageBits)))
        ->type_name(fmt::format("{}…{}", kMinStorageBits, kMaxStorageBits));
    addRays(c, s.samples, s.seed, "vertex or texel");
    addLongBake(c, o.work);
    addSets(c);
    addThreads(c);
}

void CommandParser::addBakeLight(CLI::App& bake) {
    BakeLightOptions& o = m_light;
    CLI::App* c = addCommand(bake, "light",
                             "A light map: what image-based light is off by at each place, path "
                             "traced, for --lighting lightMap",
                             o);
    addSceneAndOutput(c, o, ".exr, for --bake of the others; with --shard a part for patina merge");
    c->add_option("--environment", o.environment,
                  "Environment that lights the scene; none: no light of one")
        ->type_name("HDR|none");
    addLayout(c, o.environmentLayout);
    c->add_option("--size", o.settings.size, "Side of each material's square texture in texels")
        ->check(plain(CLI::Range(1, kMaxLightMapSize)))
        ->capture_default_str()
        ->type_name("N");
    c->add_flag_callback(
        "--no-smooth", [&o] { o.settings.smooth = false; },
        "Leave the noise in, which texels of a smooth surface else share out");
    addRays(c, o.settings.samples, o.settings.seed, "texel");
    addLongBake(c, o.work);
    addSets(c);
    addThreads(c);
}

void CommandParser::addBakeRadiosity(CLI::App& bake) {
    using radiosity::DivisionRule;
    using radiosity::FactorMethod;
    using radiosity::Solver;
    BakeRadiosityOptions& o = m_radiosity;
    RadiositySettings& settings = o.settings;
    CLI::App* c = addCommand(bake, "radiosity",
                             "Light that surfaces send to one another, at the vertices of the "
                             "scene divided for it or in a light map",
                             o);
    addSceneAndOutput(
        c, o,
        ".dae (of a COLLADA scene: that document, lit), .glb, .gltf (COLOR_0, _RADIANCE), "
        ".ply, or a picture: .png, .exr; with --target texel .dae, .glb, .gltf, or the light map "
        "alone: .png, .exr; with --shard a part for patina merge");
    c->add_option("--target", o.target,
                  "Where the light lives: at the vertices of the scene divided, or in a light map "
                  "of the scene as it is")
        ->transform(plain(CLI::CheckedTransformer(std::map<std::string, BakeTarget>{
            {"texel", BakeTarget::Texel}, {"vertex", BakeTarget::Vertex}})))
        ->default_str("vertex")
        ->type_name("vertex|texel");
    c->add_option("--environment", o.environment,
                  "Environment that lights the scene; none: no light of one")
        ->type_name("HDR|none");
    addLayout(c, o.environmentLayout);
    c->add_option("--form-factors", settings.factors.method,
                  "How the light between two elements is found: by rays, a hemicube, a paraboloid "
                  "map, or polygons in closed form with rays for what is in between")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, FactorMethod>{{"raycast", FactorMethod::Rays},
                                                {"hemicube", FactorMethod::Hemicube},
                                                {"paraboloid", FactorMethod::Paraboloid},
                                                {"analytic", FactorMethod::Analytic}})))
        ->default_str("raycast")
        ->type_name("raycast|hemicube|paraboloid|analytic");
    c->add_option("--resolution", o.resolution,
                  "raycast: rays per element (default 256); hemicube: cells along an edge (256); "
                  "paraboloid: texels along the diameter (512); analytic: pairs of points per two "
                  "elements (64); --solver hierarchical: the same, of "
                  "clusters, too (8)")
        ->type_name("N");
    c->add_option("--stands", o.stands,
                  "hemicube, paraboloid: how many stand along each direction of an element that "
                  "others are near to (1: one alone, at its centre; 3 x 3 take ten times as long)")
        ->check(plain(CLI::Range(1, 8)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--device", o.device,
                  "hemicube: what finds which element is in each cell: rays (cpu), or OpenGL, "
                  "which draws them (gpu); auto: OpenGL where there is a graphics card, but for "
                  "parts and with a checkpoint, which may be of several machines")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, HemicubeDevice>{{"auto", HemicubeDevice::Auto},
                                                  {"cpu", HemicubeDevice::Cpu},
                                                  {"gpu", HemicubeDevice::Gpu}})))
        ->default_str("auto")
        ->type_name("auto|cpu|gpu");
    std::map<std::string, Solver> solvers;
    for (const Solver solver :
         {Solver::Progressive, Solver::Southwell, Solver::Overshooting, Solver::GaussSeidel,
          Solver::Jacobi, Solver::Direct, Solver::Hierarchical})
        solvers.emplace(name(solver), solver);
    c->add_option("--solver", settings.solve.solver,
                  "progressive, southwell and overshooting shoot; gathering and jacobi sweep; "
                  "direct is exact, up to 2048 elements; hierarchical links clusters of elements")
        ->transform(plain(CLI::CheckedTransformer(solvers)))
        ->default_str("gathering")
        ->type_name("NAME");
    c->add_option("--link-error", settings.hierarchy.linkError,
                  "hierarchical: share of the light that a link may be wrong by")
        ->check(plain(CLI::Range(1e-12, 1.0)))
        ->capture_default_str()
        ->type_name("X");
    c->add_option("--iterations", settings.solve.maxIterations,
                  "Shots or sweeps at most (default: as many as it takes)")
        ->check(plain(CLI::Range(1, 1'000'000'000)))
        ->type_name("N");
    c->add_option("--shots-per-step", settings.solve.shotsPerStep,
                  "Senders that are chosen together, each by what was unshot before the first of "
                  "them; 1 is progressive radiosity as published")
        ->check(plain(CLI::Range(1, 65536)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--output-every", o.outputEvery,
                  "Also write what is there after every N shots or sweeps: OUT-000001.glb …")
        ->check(plain(CLI::Range(1, 1'000'000'000)))
        ->type_name("N");
    c->add_option("--residual", settings.solve.residual,
                  "Share of the light that may be left unsolved")
        ->check(plain(CLI::Range(1e-12, 1.0)))
        ->capture_default_str()
        ->type_name("X");
    c->add_option("--subdivide", o.subdivide,
                  "Largest element in square metres (default: about 4000 elements); adaptive:X "
                  "divides elements on which the light differs by more than a share X, as .1, "
                  "solution after solution; dynamic:X while light is shot, with --solver "
                  "progressive, southwell or overshooting; adaptive:X,AREA begins with such ones")
        ->type_name("AREA|adaptive:X|dynamic:X");
    std::map<std::string, DivisionRule> rules;
    for (const DivisionRule rule : {DivisionRule::Gradient, DivisionRule::Visibility,
                                    DivisionRule::L1, DivisionRule::L2, DivisionRule::Linf})
        rules.emplace(name(rule), rule);
    c->add_option("--divide-by", settings.divideBy,
                  "Where adaptive:X and dynamic:X divide: by the light at the corners; where light "
                  "is hidden in part; or where a quadratic interpolation differs from the linear "
                  "one, as a norm over the element")
        ->transform(plain(CLI::CheckedTransformer(rules)))
        ->default_str("gradient")
        ->type_name("gradient|visibility|l1|l2|linf");
    c->add_option("--patches", settings.patchArea,
                  "Largest patch in square metres, not smaller than elements: patches shoot, and "
                  "elements only receive, so that there are fewer form factors; with --solver "
                  "progressive, southwell or overshooting (default: each element shoots)")
        ->check(plain(CLI::Range(1e-12, 1e12)))
        ->type_name("AREA");
    c->add_option("--max-elements", settings.maxElements, "Refuse to divide into more than these")
        ->check(plain(CLI::Range(std::size_t{1}, std::size_t{50'000'000})))
        ->capture_default_str()
        ->type_name("N");
    c->add_flag("--estimate-discretisation", o.estimateDiscretisation,
                "Also solve with every element divided in four, and say by how much that differs");
    c->add_flag("--find-leaks", o.findLeaks,
                "Also list where light comes to where it may not (gaps, elements on both sides of "
                "a wall) and where it jumps between surfaces that are not joined");
    c->add_option("--exposure", o.exposure,
                  "k of the colours 1 - e^(-k radiance); none: cut off at 1; auto: the median "
                  "becomes middle grey (default)")
        ->type_name("K|none|auto");
    c->add_option("--look", o.look,
                  "Of a picture or a light map: light interpolated over the surfaces, each element "
                  "in its colour, or light gathered at every point from the solution (slow)")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, radiosity::Look>{{"smooth", radiosity::Look::Smooth},
                                                   {"elements", radiosity::Look::Elements},
                                                   {"gathered", radiosity::Look::Gathered}})))
        ->default_str("smooth")
        ->type_name("smooth|elements|gathered");
    c->add_option("--size", o.size,
                  fmt::format("Of a picture: pixels (default: 1280x720); with --target texel: side "
                              "of the square light map in texels, 1 to {} (default: {})",
                              kMaxRadiosityMapSize, RadiosityMapSettings().size))
        ->type_name("WxH|N");
    c->add_option("--camera", o.camera,
                  "Of a picture: yaw and pitch in degrees about the scene, and the distance; or a "
                  "camera of the scene's files")
        ->type_name("YAW,PITCH[,DISTANCE]|scene:NAME");
    c->add_flag(
        "--classic", settings.classic,
        "Glowing elements shoot like all others, and a hemicube or paraboloid stands at the "
        "centre only, as in the textbooks");
    c->add_option("--samples", settings.lightSamples,
                  "Rays per element to each light and to the environment")
        ->check(plain(CLI::Range(1, 65536)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--seed", settings.factors.seed, "Seed of the sample pattern")
        ->capture_default_str()
        ->type_name("N");
    c->add_flag("--keep-partial", m_invocation.common.keepPartial,
                "When interrupted, write what has converged so far");
    addShards(c, o.work,
              "Find the direct light and the form factors of part K of N only, for patina merge; "
              "auto: as the farm numbers its tasks");
    addSets(c);
    addThreads(c);

    // Needs no scene, and nothing that solving depends on.
    c->get_option("SCENE")->required(false);
    CLI::Option* reexpose =
        c->add_option(
             "--reexpose", o.reexpose,
             "Instead of a scene: a .dae, .glb, .gltf or .ply that was written here, whose "
             "light gets the colours of another --exposure; with --target texel the picture of "
             "its light map, whose light is in the .exr beside it. Such an .exr alone becomes "
             "a .png")
            ->type_name("SOLVED");
    for (CLI::Option* other : c->get_options()) {
        constexpr std::array kTogether{"--help",   "--json",     "--quiet",
                                       "--output", "--exposure", "--threads"};
        if (other != reexpose && std::ranges::none_of(kTogether, [&](const char* name) {
                return other->check_name(name);
            }))
            reexpose->excludes(other);
    }
}

void CommandParser::addMerge() {
    MergeOptions& o = m_merge;
    CLI::App* c =
        addCommand(m_app, "merge",
                   "Parts of a bake, a radiosity or a traced picture (--shard) joined to the very "
                   "bytes of the whole",
                   o);
    c->add_option("PART", o.parts, "All parts, in any order")->required()->type_name("…");
    c->add_option("-o,--output", o.output, "What the bake or render would have written")
        ->required()
        ->type_name("OUT");
    c->add_option("--scene", o.scene, "The baked or lit scene, when it is elsewhere now")
        ->type_name("SCENE");
    addOutside(c);
    addVisualScene(c);
    addThreads(c);
}

void CommandParser::addBakeIbl(CLI::App& bake) {
    BakeIblOptions& o = m_ibl;
    CLI::App* c = addCommand(bake, "ibl",
                             "Image-based light: reflections, irradiance, harmonics, DFG table", o);
    c->add_option("HDR", o.environment,
                  "Environment image, builtin:NAME, or .patina project for its environment")
        ->required()
        ->type_name("");
    addOutside(c);
    c->add_option("-o,--output", o.output, "Folder to write: new, empty, or an earlier bake")
        ->required()
        ->type_name("DIR");
    addLayout(c, o.environmentLayout);
    c->add_option("--size", o.size, "Side of the sharpest cubemap's faces in texels: 16, 32 … 2048")
        ->check(plain(CLI::IsMember({16, 32, 64, 128, 256, 512, 1024, 2048})))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--levels", o.levels,
                  "Roughness levels, each of half the size (default: down to 4 texels)")
        ->check(plain(CLI::Range(2, 12)))
        ->type_name("N");
    c->add_option("--format", o.format, "Kind of files")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, IblFileFormat>{{"exr", IblFileFormat::Exr},
                                                 {"hdr", IblFileFormat::Hdr},
                                                 {"ktx2", IblFileFormat::Ktx2},
                                                 {"dds", IblFileFormat::Dds}})))
        ->default_str("exr")
        ->type_name("exr|hdr|ktx2|dds");
    CLI::Option* layout = c->add_option("--layout", o.layout,
                                        "exr, hdr: a file for each face, "
                                        "or for each level");
    layout
        ->transform(plain(CLI::CheckedTransformer(std::map<std::string, IblLayout>{
            {"faces", IblLayout::Faces}, {"latlong", IblLayout::LatLong}})))
        ->default_str("faces")
        ->each([&o](const std::string&) { o.layoutGiven = true; })
        ->type_name("faces|latlong");
    c->add_option("--precision", o.texels,
                  "Numbers in exr, ktx2 and dds; rgb9e5 only in ktx2 and dds (default: half)")
        ->transform(plain(CLI::CheckedTransformer(
            std::map<std::string, TexelFormat>{{"half", TexelFormat::Rgba16F},
                                               {"float", TexelFormat::Rgba32F},
                                               {"rgb9e5", TexelFormat::Rgb9E5}})))
        ->type_name("half|float|rgb9e5");
    addSets(c);
    addThreads(c);
}

} // namespace patina::cli
