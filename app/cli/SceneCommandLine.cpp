// What is done with models, pictures and environments without baking.
#include "app/cli/CommandParser.h"
#include "app/cli/TracingOptions.h"
#include "core/edit/Parameters.h"
#include "core/light/BrightSources.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina::cli {

void CommandParser::addInfo() {
    CLI::App* command = addCommand(
        m_app, "info", "What a model, image, environment, project or bake holds", m_info);
    command->add_option("FILE", m_info.file, "File, builtin:NAME or builtin:list")
        ->required()
        ->type_name("");
    CLI::Option* light = command->add_flag(
        "--light", m_info.light,
        "Also the Light lab's numbers of an environment, or of a project's: dominant light, what "
        "1 to 8 bands of spherical harmonics hold, prefiltered levels, error of irradiance");
    command
        ->add_option("--direction", m_info.direction,
                     "Also the light that is looked up in a direction, in degrees: azimuth 0 is "
                     "+Z, 90 is +X, elevation 90 is up")
        ->needs(light)
        ->type_name("AZIMUTH,ELEVATION");
    addOutside(command);
    addVisualScene(command);
}

void CommandParser::addEnvironmentOption(CLI::App* c, PictureOptions& o) {
    c->add_option("--environment", o.environment,
                  "Environment that lights the scene; none: no light of one")
        ->type_name("HDR|none");
    addLayout(c, o.environmentLayout);
}

void CommandParser::addLook(CLI::App* c, PictureOptions& o) {
    c->add_option("--camera", o.camera,
                  "Orbit in degrees and metres; without DISTANCE the scene fills the picture. "
                  "scene:NAME: a camera of the scene's files, as patina info lists them")
        ->type_name("YAW,PITCH[,DISTANCE]|scene:NAME");
    c->add_option("--fov", o.fov, "Vertical field of view in degrees")->type_name("DEG");
    c->add_option("--exposure", o.exposure,
                  "Brightens the picture, in stops; auto: like an eye used to it")
        ->type_name("EV|auto");
    c->add_option("--tone-map", o.toneMap,
                  fmt::format("One of {}", fmt::join(findParameter("view.toneMap")->choices, ", ")))
        ->type_name("NAME");
}

void CommandParser::addPicture(CLI::App* c, PictureOptions& o) {
    c->add_option("--samples", o.samples, "Samples per pixel against jagged edges (MSAA)")
        ->capture_default_str()
        ->type_name("N");
    addLook(c, o);
    c->add_option("--background", o.background,
                  "visible, blurred, transparent (or off), or a colour as R,G,B or #rrggbb")
        ->type_name("NAME");
    c->add_option("--lighting", o.lighting,
                  "ibl, cosine, shIrradiance, unshadowed; with a transfer bake shadowed, prt")
        ->type_name("NAME");
    addBakeFiles(c, "--bake", o.bakes, "Bake file to light with (repeatable)");
    c->add_option(
         "--max-memory", o.maxMemory,
         "Of shadows of local lights with a transfer bake, e.g. 2GiB; where they would take "
         "more they stay soft (default: what is free)")
        ->type_name("SIZE");
}

void CommandParser::addSheet() {
    SheetOptions& o = m_sheet;
    CLI::App* c = addCommand(m_app, "sheet",
                             "A wall of pictures: environments, materials, lighting modes or a "
                             "parameter's values",
                             o);
    addSceneAndOutput(c, o,
                      "Sheet: .png, .jpg, .tif, .tga, or an .exr with a part for each cell, "
                      "linear");
    // One after the other on the command line: columns, rows.
    const auto many = [&](const char* name, std::vector<std::string>& names, const char* type,
                          const char* help) {
        return c->add_option(name, names, help)->type_name(type);
    };
    CLI::Option* environments =
        many("--environments", o.environments, "HDR …",
             "Environments: files, builtin:NAME or names of the scene's own");
    CLI::Option* materials = many("--materials", o.materials, "NAME …",
                                  "Materials of the scene, else built-in ones, by name");
    CLI::Option* lightings =
        many("--lightings", o.lightings, "NAME …", "Lighting modes, named as for --lighting");
    CLI::Option* snapshots = many("--snapshots", o.snapshots, "NAME …",
                                  "Snapshots of a project, by name: looks kept in the editor");
    CLI::Option* wedge =
        c->add_option("--wedge", o.wedges,
                      "Values of a number of patina parameters, evenly spaced, both ends among "
                      "them; given twice, columns and rows")
            ->type_name("NAME=FROM:TO:COUNT")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    many("--meshes", o.meshes, "NAME …",
         "What --materials are put on (default: all visible meshes)")
        ->needs(materials);
    c->add_option("--size", o.size, "Pixels of a cell")->capture_default_str()->type_name("WxH");
    c->add_option("--columns", o.columns,
                  "Of a sheet of one thing, which wraps (default: what reads well)")
        ->check(plain(CLI::Range(1, 8)))
        ->type_name("N");
    c->add_flag("--no-captions", o.noCaptions, "Pictures alone, without title and captions");
    c->add_flag("--skip-broken", o.skipBroken,
                "Draw the others when environments cannot be read; their cells say why")
        ->needs(environments);
    addEnvironmentOption(c, o);
    addPicture(c, o);
    CLI::Option* samples = c->get_option("--samples");
    samples->check(plain(CLI::Range(1, kMostPaths)))
        ->description("Samples per pixel: 1, 2, 4, 8 or 16 against jagged edges (MSAA); 8: the "
                      "mean of eight frames, as the editor shows cells at rest; with --renderer "
                      "path as many paths as there are at most (default: 256)");
    addTracing(c, o);
    addSets(c);
    addThreads(c);
    m_select[c] = [&o, c, samples, environments, materials, lightings, snapshots, wedge] {
        o.samplesGiven = samples->count() > 0;
        using Kind = SheetOptions::AxisKind;
        std::size_t wedges = 0;
        for (const CLI::Option* option : c->parse_order()) {
            const auto once = [&](Kind kind) {
                if (std::ranges::find(o.axes, kind, &SheetOptions::Axis::kind) == o.axes.end())
                    o.axes.push_back({kind, {}});
            };
            if (option == environments)
                once(Kind::Environments);
            else if (option == materials)
                once(Kind::Materials);
            else if (option == lightings)
                once(Kind::Lightings);
            else if (option == snapshots)
                once(Kind::Snapshots);
            else if (option == wedge)
                o.axes.push_back({Kind::Wedge, o.wedges.at(wedges++)});
        }
        return decltype(m_invocation.options)(o);
    };
}

void CommandParser::addRank() {
    RankOptions& o = m_rank;
    CLI::App* c = addCommand(m_app, "rank",
                             "Environments and their rotations, in the order of what a scene loses "
                             "in them",
                             o);
    addSceneAndOutput(c, o, "Ranking: .json");
    c->add_option("--environments", o.environments,
                  "Environments: folders of .hdr and .exr, files, builtin:NAME")
        ->required()
        ->type_name("FOLDER|HDR …");
    addLayout(c, o.environmentLayout);
    c->add_flag("--skip-broken", o.skipBroken,
                "Rank the others when environments that are named cannot be read; those of "
                "folders are always listed");
    c->add_option("--rotations", o.rotations, "Of each environment, evenly spaced from 0°")
        ->check(plain(CLI::Range(1, 3600)))
        ->capture_default_str()
        ->type_name("N");
    c->add_option("--by", o.by,
                  "What the worst light has most of: clipping (share of the pixels at either end "
                  "of the display), contrast (what is lost of it), difference (FLIP of the worst "
                  "thousandth of the pixels)")
        ->check(plain(CLI::IsMember({"clipping", "contrast", "difference"})))
        ->capture_default_str()
        ->type_name("NAME");
    c->add_option("--reference", o.reference,
                  "Light whose look the others are compared with: an environment by its name or "
                  "file, and a rotation in degrees (default: the mean look)")
        ->type_name("ENV[@DEG]");
    c->add_option("--sensitivity", o.sensitivity,
                  "Also write where the light decides what is seen: standard deviation in stops, "
                  "as numbers into an .exr, as colours into .png, .jpg, .tif, .tga")
        ->type_name("FILE");
    c->add_option("--size", o.size, "Pixels of a picture, which no file shows")
        ->capture_default_str()
        ->type_name("WxH");
    addLook(c, o);
    addBakeFiles(c, "--bake", o.bakes,
                 "Radiance transfer of the scene (default: the project's, else a quick bake)");
    c->add_flag("--unshadowed", o.unshadowed, "Without a bake: nothing hides the environment");
    addSets(c);
    addThreads(c);
}

void CommandParser::addEnvironment() {
    EnvironmentOptions& o = m_environment;
    CLI::App* c = addCommand(m_app, "environment", "An environment in another layout", o);
    c->add_option("HDR", o.environment,
                  "Image, one of six faces, builtin:NAME, or a .patina project for its "
                  "environment")
        ->required()
        ->type_name("");
    addOutside(c);
    c->add_option("-o,--output", o.output, ".exr or .hdr; six faces are OUT_px, OUT_nx …")
        ->required()
        ->type_name("OUT");
    c->add_option("--layout", o.layout, "Layout to write: " + std::string(kLayoutNames))
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
    CLI::Option* extract =
        c->add_option(
             "--extract", o.extract,
             "Without its N brightest sources (the sun, light fixtures), for which lights are to "
             "stand: they are listed, with --json under \"sources\"")
            ->check(plain(CLI::Range(1, kMostBrightSources)))
            ->type_name("1…8");
    CLI::Option* bands =
        c->add_option("--bands", o.bands,
                      "Only what the first N bands of spherical harmonics hold of it; sums go "
                      "below zero beside what is bright, which .exr keeps and .hdr cuts")
            ->check(plain(CLI::Range(1, kMaxShOrder)))
            ->excludes(extract)
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

void CommandParser::addBracket() {
    BracketCommandOptions& o = m_bracket;
    CLI::App* c = addCommand(m_app, "bracket", "One HDR picture from photos of one scene", o);
    c->add_option("PHOTO", o.photos,
                  "Photos of one size, exposed differently, in any order; their exposures are read "
                  "from Exif")
        ->required()
        ->type_name("…");
    c->add_option("-o,--output", o.output, ".exr or .hdr")->required()->type_name("OUT");
    c->add_option("--exposures", o.exposures,
                  "Exposures of the photos in stops, in place of Exif; only their differences "
                  "count, e.g. -2,0,2")
        ->type_name("EV,EV…");
    c->add_flag("--no-align", o.noAlign, "Take the photos as they are, without shifting them");
    c->add_option("--marks", o.marks,
                  "Also write a picture in which clipped pixels (pink: white, blue: black) and "
                  "those in which photos disagree (yellow) are coloured")
        ->type_name("PNG");
    addThreads(c);
}

void CommandParser::addExport() {
    ExportOptions& o = m_export;
    CLI::App* c = addCommand(m_app, "export", "A package for another program", o);
    addSceneAndOutput(c, o, ".glb or .gltf");
    c->add_option("--textures", o.jpeg,
                  "Format of colours; data and transparent textures are always png")
        ->transform(plain(
            CLI::CheckedTransformer(std::map<std::string, bool>{{"png", false}, {"jpg", true}})))
        ->default_str("png")
        ->type_name("png|jpg");
    c->add_option("--texture-size", o.textureSize,
                  "Longest side of a texture in texels (default: as they are)")
        ->check(plain(CLI::Range(1, 32768)))
        ->type_name("N");
    addBakeFiles(
        c, "--bakes", o.bakes,
        "Bake file to take along: occlusion per texel, radiance transfer per vertex, light "
        "map (repeatable)");
    c->add_flag("--no-baked-ao", o.noBakedAo, "Leave a project's baked occlusion out");
    c->add_flag(
        "--transfer", o.transfer,
        "Take a bake of radiance transfer along, as vertex attributes _PRT_n with its light "
        "and a shader beside the file");
    c->add_option("--transfer-bands", o.transferBands,
                  "Bands of the radiance transfer to take along (default: all)")
        ->check(plain(CLI::Range(1, 8)))
        ->type_name("N");
    c->add_flag("--no-light-map", o.noLightMap, "Leave a project's light map out");
    c->add_flag("--environment-light", o.environmentLight,
                "Take the environment's light along (EXT_lights_image_based)");
    CLI::Option* environment =
        c->add_option("--environment", o.environment,
                      "Environment in place of the scene's; implies --environment-light")
            ->type_name("HDR");
    addLayout(c, o.environmentLayout)->needs(environment);
    c->add_flag("--hidden", o.hidden, "Take hidden meshes along");
    c->add_flag("--no-lights", o.noLights, "Leave the lights out");
    c->add_flag("--no-variants", o.noVariants,
                "Leave a project's snapshots out, whose materials are written as variants "
                "(KHR_materials_variants)");
    c->add_flag("--dry-run", o.dryRun, "Say what would be written, and write nothing");
    addSets(c);
    addThreads(c);
}

void CommandParser::addRefine() {
    RefineOptions& o = m_refine;
    CLI::App* c =
        addCommand(m_app, "refine", "A model with finer triangles where its shadows need them", o);
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

void CommandParser::addCompare() {
    CompareOptions& o = m_compare;
    CLI::App* c = addCommand(m_app, "compare",
                             "Distance of two images: rmse, relmse, psnr, max, flip, ssim", o);
    c->add_option("A", o.image, "Image")->required()->type_name("");
    c->add_option("B", o.reference, "Reference")->required()->type_name("");
    CLI::Option* output = c->add_option("-o,--output", o.output,
                                        "Write the difference: numbers into an .exr, colours "
                                        "into .png, .jpg, .tif, .tga")
                              ->type_name("DIFF");
    CLI::Option* difference =
        c->add_option("--difference", o.difference,
                      "What DIFF shows at a pixel: its channels' absolute differences, or one "
                      "value in colours: signed (A - B: blue below, orange above), absolute, "
                      "relative (to B, as in relmse), flip (0 to 1)")
            ->transform(plain(CLI::CheckedTransformer(
                std::map<std::string, DifferenceShown>{{"channels", DifferenceShown::Channels},
                                                       {"signed", DifferenceShown::Signed},
                                                       {"absolute", DifferenceShown::Absolute},
                                                       {"relative", DifferenceShown::Relative},
                                                       {"flip", DifferenceShown::Flip}})))
            ->default_str("channels")
            ->needs(output)
            ->type_name("NAME");
    c->add_option("--range", o.range,
                  "What the last colour stands for (default: the largest error; flip: 1)")
        ->check(plain(CLI::Range(1e-30, 1e30))) // positive as a float, too
        ->needs(difference)
        ->type_name("X");
    c->add_option("--visible", o.visible,
                  "Leave what is hardly noticed out of DIFF: where flip is below X")
        ->check(plain(CLI::Range(0.0, 1.0)))
        ->needs(difference)
        ->type_name("X");
    const auto addLimits = [&](const char* name, std::vector<std::string>& limits,
                               const char* help) {
        c->add_option(name, limits, help)
            ->type_name("METRIC=X")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    };
    addLimits("--fail-above", o.failAbove,
              "Exit status 1 where rmse, relmse, max or flip is above X (repeatable)");
    addLimits("--fail-below", o.failBelow,
              "The same for psnr or ssim, which are higher for better pictures, below X");
    c->add_flag("--fit", o.fit,
                "Scale B to the size of A (else images of different sizes are refused)");
    addThreads(c);
}

void CommandParser::addParameters() {
    CLI::App* c = addCommand(m_app, "parameters",
                             "All parameters: names, ranges, defaults, meaning", m_parameters);
    c->add_flag("--markdown", m_parameters.markdown, "As a Markdown page");
}

} // namespace patina::cli
