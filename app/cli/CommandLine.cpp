#include "app/cli/CommandLine.h"

#include "app/cli/RenderViews.h"
#include "core/material/Parameters.h"
#include "core/math/SphericalHarmonics.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

namespace patina::cli {
namespace {

constexpr std::array kCommands = {"info",   "render", "bake",    "merge",     "environment",
                                  "export", "refine", "compare", "parameters"};

constexpr const char* kAbout =
    "Patina: a desktop editor for physically based materials you can trust.\n\n"
    "  patina [FILE …] [--environment HDR]   start the editor (also: patina edit …)\n"
    "  patina COMMAND …                      do one thing without a window\n\n"
    "SCENE is a model (glTF, GLB, OBJ, FBX, COLLADA, PLY, STL), a .patina project or\n"
    "builtin:NAME; HDR is an image of any layout or builtin:NAME. `patina info builtin:list`\n"
    "prints the built-in names.";
constexpr const char* kFooter =
    "Exit status: 0 done, 2 wrong usage, 65 an input is broken, 66 an input is missing, 69 no\n"
    "OpenGL, 70 a fault of ours, 73 an output cannot be created, 74 I/O error or disk full,\n"
    "75 stopped with a checkpoint to go on from, 130/143 interrupted.";
const std::string kLayouts =
    "lat-long, angular-map, mirror-ball, horizontal-cross, vertical-cross, horizontal-strip, "
    "vertical-strip, six-faces";
constexpr const char* kScene = "Model, .patina project or builtin:NAME";

struct ListViews {}; // thrown by its flag, as CLI11 throws calls for help

// A check whose bounds the help does not repeat in its own notation; errors still name them.
template <class Check>
CLI::Validator plain(const Check& check) {
    return check.description("");
}

class Parser {
  public:
    Parser()
        : m_app(kAbout, "patina") {
        m_app.set_version_flag("--version", "patina " PATINA_VERSION, "Print the version");
        m_app.footer(kFooter);
        m_app.require_subcommand(1);
        addInfo();
        addRender();
        addBakes();
        addMerge();
        addEnvironment();
        addExport();
        addRefine();
        addCompare();
        addParameters();
    }

    Result<std::variant<Invocation, HelpText>> parse(int argc, const char* const* argv) {
        if (argc > 1 && argv[1][0] != '-' &&
            std::find(kCommands.begin(), kCommands.end(), std::string_view(argv[1])) ==
                kCommands.end())
            return Error{ErrorKind::Usage,
                         fmt::format("there is no command or file \"{}\"; commands are {}", argv[1],
                                     fmt::join(kCommands, ", ")),
                         {},
                         {}};
        try {
            m_app.parse(argc, argv);
        } catch (const CLI::CallForHelp&) {
            return {HelpText{m_app.help()}};
        } catch (const ListViews&) {
            return {HelpText{listViews()}};
        } catch (const CLI::CallForVersion&) {
            return {HelpText{m_app.version() + "\n"}};
        } catch (const CLI::ParseError& error) {
            return Error{ErrorKind::Usage,
                         fmt::format("{}; see {} --help", error.what(), innermostName()),
                         {},
                         {}};
        }
        m_invocation.common.command = innermostName().substr(std::string_view("patina ").size());
        m_invocation.options = m_select.at(innermost())();
        return {std::move(m_invocation)};
    }

  private:
    // The most specific command that was named.
    CLI::App* innermost() {
        CLI::App* app = &m_app;
        while (!app->get_subcommands().empty())
            app = app->get_subcommands().front();
        return app;
    }
    std::string innermostName() {
        std::string name = "patina";
        for (CLI::App* app = &m_app; !app->get_subcommands().empty();) {
            app = app->get_subcommands().front();
            name += " " + app->get_name();
        }
        return name;
    }

    template <class Options>
    CLI::App* addCommand(CLI::App& parent, const char* name, const char* help, Options& options) {
        CLI::App* command = parent.add_subcommand(name, help);
        m_select[command] = [&options] { return decltype(m_invocation.options)(options); };
        CommonOptions& common = m_invocation.common;
        command->add_flag("--json", common.json, "Print one JSON object, also on failure");
        command->footer("");
        command->add_flag("--quiet", common.quiet, "No progress and no notices");
        return command;
    }

    void addThreads(CLI::App* command) {
        command
            ->add_option("--threads", m_invocation.common.threads,
                         "Threads to use; the result does not depend on it (default: all cores)")
            ->check(plain(CLI::Range(1, 1024)))
            ->type_name("N");
    }
    void addSets(CLI::App* command) {
        command
            ->add_option("--set", m_invocation.common.sets,
                         "Set a parameter, e.g. material[Body].metallic=1; see patina parameters")
            ->type_name("NAME=VALUE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    }
    template <class Options>
    void addScene(CLI::App* command, Options& options) {
        command->add_option("SCENE", options.scene, kScene)->required()->type_name("");
    }
    template <class Options>
    void addSceneAndOutput(CLI::App* command, Options& options, const char* outputHelp) {
        addScene(command, options);
        command->add_option("-o,--output", options.output, outputHelp)
            ->required()
            ->type_name("OUT");
    }
    CLI::Option* addLayout(CLI::App* command, std::string& layout) {
        return command
            ->add_option("--environment-layout", layout,
                         "How the HDR shows the surroundings (default: guessed): " + kLayouts)
            ->type_name("NAME");
    }
    void addBakeFiles(CLI::App* command, const char* name, std::vector<std::string>& bakes,
                      const char* help) {
        command->add_option(name, bakes, help)
            ->type_name("FILE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    }
    void addRays(CLI::App* command, int& samples, unsigned& seed, const char* per) {
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

    void addInfo() {
        CLI::App* command = addCommand(
            m_app, "info", "What a model, image, environment, project or bake holds", m_info);
        command->add_option("FILE", m_info.file, "File, builtin:NAME or builtin:list")
            ->required()
            ->type_name("");
    }

    void addRender() {
        RenderOptions& o = m_render;
        CLI::App* c = addCommand(m_app, "render", "One picture, without a window", o);
        addScene(c, o);
        // With --inspect a picture need not be written: run() sees to that.
        c->add_option("-o,--output", o.output,
                      "Picture: .png, .jpg, .tif, .tga as displayed, .exr or .hdr linear")
            ->type_name("OUT");
        c->add_option("--environment", o.environment, "Surroundings that light the scene")
            ->type_name("HDR");
        addLayout(c, o.environmentLayout);
        c->add_option("--size", o.size, "Pixels")->capture_default_str()->type_name("WxH");
        c->add_option("--samples", o.samples, "Samples per pixel against jagged edges (MSAA)")
            ->check(plain(CLI::IsMember({1, 2, 4, 8, 16})))
            ->capture_default_str()
            ->type_name("N");
        c->add_option("--camera", o.camera,
                      "Orbit in degrees and metres; without DISTANCE the scene fills the picture")
            ->type_name("YAW,PITCH[,DISTANCE]");
        c->add_option("--fov", o.fov, "Vertical field of view in degrees")->type_name("DEG");
        c->add_option("--exposure", o.exposure,
                      "Brightens the picture, in stops; auto: like an eye used to it")
            ->type_name("EV|auto");
        c->add_option(
             "--tone-map", o.toneMap,
             fmt::format("One of {}", fmt::join(findParameter("view.toneMap")->choices, ", ")))
            ->type_name("NAME");
        c->add_option("--background", o.background,
                      "visible, blurred, transparent (or off), or a colour as R,G,B or #rrggbb")
            ->type_name("NAME");
        c->add_option("--lighting", o.lighting,
                      "ibl, cosine, shIrradiance, unshadowed; with a transfer bake shadowed, prt")
            ->type_name("NAME");
        addBakeFiles(c, "--bake", o.bakes, "Bake file to light with (repeatable)");
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
        c->add_flag_callback(
             "--list-views", [] { throw ListViews(); }, "Print the names of all views")
            ->trigger_on_parse();
        addSets(c);
        addThreads(c);
    }

    void addBakes() {
        CLI::App* bake = m_app.add_subcommand("bake", "One bake, without a window");
        bake->require_subcommand(1);

        CLI::App* ao = addCommand(*bake, "ao", "Ambient occlusion", m_ao);
        addSceneAndOutput(ao, m_ao,
                          ".png (one for each material) or .exr (for --bake of the others)");
        ao->add_option("--target", m_ao.target, "Where the values live")
            ->transform(plain(CLI::CheckedTransformer(std::map<std::string, BakeTarget>{
                {"texel", BakeTarget::Texel}, {"vertex", BakeTarget::Vertex}})))
            ->default_str("texel")
            ->type_name("texel|vertex");
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
        addBakeIbl(*bake);
    }

    void addLongBake(CLI::App* command, LongBakeOptions& o) {
        command
            ->add_option("--shard", o.shard,
                         "Bake part K of N only, for patina merge; auto: as the farm numbers its "
                         "tasks")
            ->type_name("K/N|auto");
        command
            ->add_option("--checkpoint", o.checkpoint,
                         "How often to keep what is done in OUT.checkpoint, and to keep it when "
                         "interrupted (default: every 30s, not when interrupted)")
            ->type_name("EVERY");
        command->add_flag(
            "--resume", o.resume,
            "Go on from OUT.checkpoint where there is one; keep one when interrupted");
        command
            ->add_option("--max-memory", o.maxMemory,
                         "Refuse a bake that would take more, e.g. 4GiB (default: what is free)")
            ->type_name("SIZE");
    }

    void addBakePrt(CLI::App& bake) {
        BakePrtOptions& o = m_prt;
        PrtSettings& s = o.settings;
        CLI::App* c = addCommand(bake, "prt", "Diffuse radiance transfer", o);
        addSceneAndOutput(c, o, ".exr; with --shard a part for patina merge");
        c->add_option("--order", s.order, "Spherical harmonic bands")
            ->check(plain(CLI::Range(1, kMaxShOrder)))
            ->capture_default_str()
            ->type_name(fmt::format("1…{}", kMaxShOrder));
        c->add_option("--transfer", o.transfer,
                      "unshadowed: the cosine alone; shadowed: and what the scene hides; "
                      "interreflected: and what other surfaces reflect (default: shadowed)")
            ->transform(plain(CLI::CheckedTransformer(std::map<std::string, TransferKind>{
                {"unshadowed", TransferKind::Unshadowed},
                {"shadowed", TransferKind::Shadowed},
                {"interreflected", TransferKind::Interreflected}})))
            ->type_name("KIND");
        c->add_option("--bounces", o.bounces,
                      fmt::format("How often light is reflected; implies --transfer "
                                  "interreflected (default: {})",
                                  s.bounces))
            ->check(plain(CLI::Range(1, 64)))
            ->type_name("1…64");
        c->add_option(
             "--bounce-samples", o.bounceSamples,
             fmt::format("Rays per vertex or texel to find what reflects light to it; implies "
                         "--transfer interreflected (default: {})",
                         s.bounceSamples))
            ->check(plain(CLI::Range(1, 65536)))
            ->type_name("N");
        c->add_option(
             "--hit-memory", o.hitMemory,
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
        c->add_flag("!--no-fit", s.fitted,
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

    void addMerge() {
        MergeOptions& o = m_merge;
        CLI::App* c = addCommand(
            m_app, "merge", "Parts of a bake (--shard) joined to the very bytes of the whole", o);
        c->add_option("PART", o.parts, "All parts, in any order")->required()->type_name("…");
        c->add_option("-o,--output", o.output, "What the bake would have written")
            ->required()
            ->type_name("OUT");
        c->add_option("--scene", o.scene, "The baked scene, when it is elsewhere now")
            ->type_name("SCENE");
        addThreads(c);
    }

    void addBakeIbl(CLI::App& bake) {
        BakeIblOptions& o = m_ibl;
        CLI::App* c = addCommand(
            bake, "ibl", "Image-based light: reflections, irradiance, harmonics, DFG table", o);
        c->add_option("HDR", o.environment,
                      "Environment image, builtin:NAME, or .patina project for its environment")
            ->required()
            ->type_name("");
        c->add_option("-o,--output", o.output, "Folder to write: new, empty, or an earlier bake")
            ->required()
            ->type_name("DIR");
        addLayout(c, o.environmentLayout);
        c->add_option("--size", o.size,
                      "Side of the sharpest cubemap's faces in texels: 16, 32 … 2048")
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

    void addEnvironment() {
        EnvironmentOptions& o = m_environment;
        CLI::App* c = addCommand(m_app, "environment", "An environment in another layout", o);
        c->add_option("HDR", o.environment,
                      "Image, one of six faces, builtin:NAME, or a .patina project for its "
                      "surroundings")
            ->required()
            ->type_name("");
        c->add_option("-o,--output", o.output, ".exr or .hdr; six faces are OUT_px, OUT_nx …")
            ->required()
            ->type_name("OUT");
        c->add_option("--layout", o.layout, "Layout to write: " + kLayouts)
            ->capture_default_str()
            ->type_name("NAME");
        c->add_option("--size", o.size,
                      "Width of a lat-long, diameter of a disc, side of a face (default: what "
                      "keeps the detail)")
            ->check(plain(CLI::Range(1, 32768)))
            ->type_name("N");
        addLayout(c, o.environmentLayout);
        c->add_flag("--openexr-envmap", o.openExrEnvmap,
                    "Write a lat-long or vertical strip in OpenEXR's own convention, with its "
                    "envmap attribute");
        CLI::Option* bands =
            c->add_option("--bands", o.bands,
                          "Only what the first N bands of spherical harmonics hold of it; sums go "
                          "below zero beside what is bright, which .exr keeps and .hdr cuts")
                ->check(plain(CLI::Range(1, kMaxShOrder)))
                ->type_name("1…8");
        CLI::Option* method =
            c->add_option("--method", o.method,
                          "How bands are found: exact (every pixel), stratified (one random point "
                          "in each of N × N cells, the classical way), qmc (Owen-scrambled "
                          "Sobol')")
                ->transform(plain(CLI::CheckedTransformer(
                    std::map<std::string, ShMethod>{{"exact", ShMethod::Exact},
                                                    {"stratified", ShMethod::Stratified},
                                                    {"qmc", ShMethod::Qmc}})))
                ->default_str("exact")
                ->needs(bands)
                ->type_name("NAME");
        c->add_option("--samples", o.samples, "Of stratified (rounded up to a square) and qmc")
            ->check(plain(CLI::Range(1, 1 << 28)))
            ->capture_default_str()
            ->needs(method)
            ->type_name("N");
        addSets(c);
        addThreads(c);
    }

    void addExport() {
        ExportOptions& o = m_export;
        CLI::App* c = addCommand(m_app, "export", "A package for another program", o);
        addSceneAndOutput(c, o, ".glb or .gltf");
        c->add_option("--textures", o.jpeg,
                      "Format of colours; data and transparent textures are always png")
            ->transform(plain(CLI::CheckedTransformer(
                std::map<std::string, bool>{{"png", false}, {"jpg", true}})))
            ->default_str("png")
            ->type_name("png|jpg");
        c->add_option("--texture-size", o.textureSize,
                      "Longest side of a texture in texels (default: as they are)")
            ->check(plain(CLI::Range(1, 32768)))
            ->type_name("N");
        addBakeFiles(c, "--bakes", o.bakes,
                     "Bake file to take along: occlusion per texel, radiance transfer per vertex "
                     "(repeatable)");
        c->add_flag("--no-baked-ao", o.noBakedAo, "Leave a project's baked occlusion out");
        c->add_flag("--no-transfer", o.noTransfer, "Leave a project's radiance transfer out");
        c->add_option("--transfer-bands", o.transferBands,
                      "Bands of the radiance transfer to take along (default: all)")
            ->check(plain(CLI::Range(1, 8)))
            ->type_name("N");
        c->add_flag("--environment-light", o.environmentLight,
                    "Take the environment's light along (EXT_lights_image_based)");
        CLI::Option* environment =
            c->add_option("--environment", o.environment,
                          "Surroundings in place of the scene's; implies --environment-light")
                ->type_name("HDR");
        addLayout(c, o.environmentLayout)->needs(environment);
        c->add_flag("--no-lights", o.noLights, "Leave the lights out");
        c->add_flag("--dry-run", o.dryRun, "Say what would be written, and write nothing");
        addSets(c);
        addThreads(c);
    }

    void addRefine() {
        RefineOptions& o = m_refine;
        CLI::App* c = addCommand(m_app, "refine",
                                 "A model with finer triangles where its shadows need them", o);
        addSceneAndOutput(c, o, ".glb or .gltf");
        c->add_option("--tolerance", o.tolerance,
                      "Error of a transfer coefficient above which a triangle is split (RMS)")
            ->check(plain(CLI::Range(1e-6, 1.0)))
            ->capture_default_str()
            ->type_name("X");
        c->add_option("--rounds", o.rounds, "How often triangles may be split")
            ->check(plain(CLI::Range(1, 12)))
            ->capture_default_str()
            ->type_name("N");
        c->add_option("--max-triangles", o.maxTriangles, "Ends before there are more")
            ->capture_default_str()
            ->type_name("N");
        c->add_option("--order", o.order, "Spherical harmonic bands of the bakes in between")
            ->check(plain(CLI::Range(1, 8)))
            ->capture_default_str()
            ->type_name("1…8");
        c->add_option("--samples", o.samples, "Rays per point of those bakes, up to 65536")
            ->check(plain(CLI::Range(1, 65536)))
            ->capture_default_str()
            ->type_name("N");
        c->add_option("--seed", o.seed, "Seed of the sample pattern")
            ->capture_default_str()
            ->type_name("N");
        addSets(c);
        addThreads(c);
    }

    void addCompare() {
        CLI::App* c = addCommand(m_app, "compare",
                                 "Distance of two images: rmse, relmse, psnr, max", m_compare);
        c->add_option("A", m_compare.image, "Image")->required()->type_name("");
        c->add_option("B", m_compare.reference, "Reference")->required()->type_name("");
        c->add_option("-o,--output", m_compare.difference, "Write the absolute difference")
            ->type_name("DIFF");
    }

    void addParameters() {
        CLI::App* c = addCommand(m_app, "parameters",
                                 "All parameters: names, ranges, defaults, meaning", m_parameters);
        c->add_flag("--markdown", m_parameters.markdown, "As a Markdown page");
    }

    CLI::App m_app;
    Invocation m_invocation;
    InfoOptions m_info;
    RenderOptions m_render;
    BakeAoOptions m_ao;
    BakePrtOptions m_prt;
    BakeIblOptions m_ibl;
    MergeOptions m_merge;
    EnvironmentOptions m_environment;
    ExportOptions m_export;
    RefineOptions m_refine;
    CompareOptions m_compare;
    ParametersOptions m_parameters;
    std::map<const CLI::App*, std::function<decltype(m_invocation.options)()>> m_select;
};

} // namespace

Result<std::variant<Invocation, HelpText>> parseCommandLine(int argc, const char* const* argv) {
    return Parser().parse(argc, argv);
}

bool isForEditor(int argc, const char* const* argv) {
    if (argc < 2)
        return true;
    const std::string_view first = argv[1];
    if (first == "edit" || first.starts_with("--environment"))
        return true;
    if (first.starts_with("-") ||
        std::find(kCommands.begin(), kCommands.end(), first) != kCommands.end())
        return false;
    std::error_code ignored;
    return first.find_first_of("./:") != std::string_view::npos ||
           std::filesystem::exists(first, ignored);
}

} // namespace patina::cli
