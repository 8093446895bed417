// What the user asked for on the command line, as plain structs with their defaults.
#pragma once

#include "core/bake/Bake.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/export/IblPackage.h"
#include "core/light/EnvironmentProjection.h"
#include "core/radiosity/RadiosityPicture.h"
#include "core/radiosity/certificate/Certificate.h"
#include "core/radiosity/document/LitDocument.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace patina::cli {

struct CommonOptions {
    std::string command;           // "bake ao"
    std::vector<std::string> sets; // NAME=VALUE
    bool json = false;
    bool quiet = false;
    bool allowOutside = false; // pictures that files name outside their folders are read
    std::string visualScene;   // of a COLLADA file that holds several; empty: the one it names
    bool keepPartial = false;  // bakes: an interrupt writes what has converged
    bool requeues = false;     // bakes: an interrupt means "for now" (--checkpoint, --resume)
    int threads = 0;           // 0: all cores
};

struct InfoOptions {
    std::string file;
    bool light = false;    // of an environment or a project's: what the Light lab shows
    std::string direction; // AZIMUTH,ELEVATION that light is looked up in; empty: none
};

// Of every command that draws pictures.
struct PictureOptions {
    std::string scene, output;
    std::string environment, environmentLayout;
    std::string size = "1280x720";
    std::string camera;                           // YAW,PITCH,DISTANCE or scene:NAME
    std::string exposure, toneMap, fov, lighting; // as for --set; empty: as the scene has it
    std::string background;                       // visible, blurred, transparent or a colour
    std::vector<std::string> bakes;
    std::string maxMemory; // a size; empty: what the machine has to give
    int samples = 4;
};

// How a long bake, or a traced picture, is split, kept and gone on with.
struct LongBakeOptions {
    std::string shard;      // K/N or auto; empty: all of it
    std::string checkpoint; // a time; empty: every 30 s, and none when interrupted
    bool resume = false;
    std::string maxMemory; // a size; empty: what the machine has to give
};

// Of --renderer whitted; nothing: as WhittedSettings has it.
struct WhittedOptions {
    std::optional<std::string> model; // patina, 1980
    std::optional<float> minContribution, contrast;
    std::optional<int> subdivisions;
    bool softShadows = false, gloss = false, depthOfField = false;
};

// A picture that may be traced in place of drawn.
struct TracingOptions : PictureOptions {
    std::string renderer = "raster"; // or path, whitted: those that trace
    std::optional<double> noise;     // traced: ends there, percent of the mean
    std::optional<int> maxBounces;   // traced; nothing: no limit, of whitted 8
    unsigned seed = 0;               // traced
    bool samplesGiven = false;
    WhittedOptions whitted;
};

struct RenderOptions : TracingOptions {
    std::string view;    // of core/document/Views.h, or all
    std::string inspect; // X,Y of a pixel to explain
    std::string viewMode = "raw", viewRange, viewLight;
    int turntable = 0,
        lightTurn = 0;        // pictures round the camera's target, of a turning environment
    int framesPerSecond = 24; // of a video
    // Traced: "all" or names of OutputImages.h, of whitted those of RayCountImages.h; empty: the
    // picture alone.
    std::string aov;
    std::string errorAgainst; // a linear picture; empty: none
    LongBakeOptions work;     // traced; its maxMemory is that of the pictures
    std::string rayTree;      // whitted: X,Y of a pixel whose rays are listed
};

struct LadderOptions : PictureOptions {
    LadderOptions() { size = "640x360"; }
    int paths = 256;             // per pixel, at most
    std::optional<double> noise; // ends there, percent of the mean
    int order = 5, rays = 256;   // of what is baked
    bool blame = false;          // which shortcut makes which share of the errors
    std::string blamePictures;   // .exr; empty: none
};
struct SheetOptions : TracingOptions {
    SheetOptions() { size = "320x240"; } // of a cell
    enum class AxisKind { Environments, Materials, Lightings, Snapshots, Wedge };
    struct Axis {
        AxisKind kind;
        std::string wedge; // NAME=FROM:TO:COUNT
    };
    std::vector<Axis> axes; // in the order of the command line: columns, rows
    std::vector<std::string> environments, materials, lightings, snapshots, wedges;
    std::vector<std::string> meshes; // that materials are put on; empty: all that are visible
    int columns = 0;                 // of a single axis; 0: chosen
    bool noCaptions = false;
    bool skipBroken = false; // environments that cannot be read
};

struct RankOptions : PictureOptions {
    RankOptions() { size = "128x128"; }
    std::vector<std::string> environments; // folders, files, builtin:NAME
    int rotations = 36;
    std::string by = "difference"; // or clipping, contrast
    std::string reference;         // ENV[@DEG]; empty: the mean look
    std::string sensitivity;       // a picture of it; empty: none
    bool unshadowed = false;
    bool skipBroken = false;
};

enum class BakeTarget { Texel, Vertex };

struct BakeAoOptions {
    std::string scene, output;
    LongBakeOptions work;
    int size = 1024;
    int samples = 256;
    float distance = 0.0f; // metres; 0: unlimited
    unsigned seed = 0;
    BakeTarget target = BakeTarget::Texel;
};

struct BakePrtOptions {
    std::string scene, output;
    LongBakeOptions work;
    PrtSettings settings;
    BakeTarget target = BakeTarget::Vertex;
    std::optional<TransferKind> transfer; // not given: shadowed, or as the others ask for
    std::optional<int> bounces, bounceSamples, size, bits;
    std::string hitMemory; // a size; empty: as the settings have it
    BakeFileOptions storage;
};

struct BakeLightOptions {
    std::string scene, output;
    LongBakeOptions work;
    std::string environment, environmentLayout; // empty: the scene's own; guessed
    LightMapSettings settings;
};

// What draws or casts hemicubes.
enum class HemicubeDevice {
    Auto, // Gpu where there is a graphics card, and nothing has to be the same on all machines
    Cpu,
    Gpu,
};

struct BakeRadiosityOptions {
    std::string scene, output;
    std::string environment, environmentLayout; // empty: the scene's own; guessed
    BakeTarget target = BakeTarget::Vertex;
    std::optional<std::string> size;     // of a picture, WxH; of a light map, N
    std::optional<std::string> camera;   // of a picture
    std::optional<radiosity::Look> look; // of either
    RadiositySettings settings;
    std::optional<int> resolution; // not given: as the method has it
    HemicubeDevice device = HemicubeDevice::Auto;
    int stands = 1;                           // of hemicubes and paraboloids
    std::optional<std::uint64_t> outputEvery; // shots or sweeps
    // An area, "adaptive:X" or "dynamic:X", of which the area of first elements may follow after a
    // comma; empty: as the settings have it.
    std::string subdivide;
    std::string exposure; // a number, "none" or "auto"; empty: auto
    std::string reexpose; // a solved file, instead of a scene
    bool estimateDiscretisation = false;
    bool findLeaks = false; // and seams
    LongBakeOptions work;   // without maxMemory
};

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output;
    std::string scene; // empty: where the parts found it
};

// The defaults of levels and texels depend on other options.
struct BakeIblOptions {
    std::string environment, environmentLayout, output;
    int size = 256;
    int levels = 0; // 0: down to 4 texels
    IblFileFormat format = IblFileFormat::Exr;
    IblLayout layout = IblLayout::Faces;
    bool layoutGiven = false;
    std::optional<TexelFormat> texels;
};

struct EnvironmentOptions {
    std::string environment, output;
    std::string environmentLayout; // of the input; empty: guessed
    std::string layout = "lat-long";
    int size = 0; // 0: keeps the detail
    bool openExrEnvmap = false;
    int bands = 0; // of spherical harmonics; 0: the environment itself
    ShMethod method = ShMethod::Exact;
    int samples = 200 * 200; // of the other methods
    int extract = 0;         // sources that lights are to stand for
};

struct BracketCommandOptions {
    std::vector<std::string> photos;
    std::string output;
    std::string exposures; // EV,EV…; empty: Exif
    bool noAlign = false;
    std::string marks; // a picture of what is doubtful; empty: none
};

struct ExportOptions {
    std::string scene, output;
    std::vector<std::string> bakes;
    bool jpeg = false;
    int textureSize = 0;           // 0: as they are
    std::string environment;       // replaces the scene's, and is taken along
    std::string environmentLayout; // of it; empty: guessed
    bool environmentLight = false; // takes the scene's along
    int transferBands = 0;         // 0: all
    bool hidden = false;           // takes hidden meshes along
    bool noLights = false, noBakedAo = false, noVariants = false;
    bool transfer = false; // a bake of it as vertex attributes
    bool noLightMap = false;
    bool dryRun = false;
};

struct RefineOptions {
    std::string scene, output;
    float tolerance = 0.01f;
    int rounds = 6;
    std::size_t maxTriangles = 1'000'000;
    int order = 3;
    int samples = 128;
    unsigned seed = 0;
};

enum class DifferenceShown { Channels, Signed, Absolute, Relative, Flip };

struct CompareOptions {
    std::string image, reference;
    std::string output; // the difference as a picture; empty: none
    DifferenceShown difference = DifferenceShown::Channels;
    std::optional<float> range; // what the last colour stands for; not given: the largest error
    float visible = 0.0f;       // of FLIP: what is below is left out of the difference; 0: nothing
    std::vector<std::string> failAbove, failBelow; // METRIC=X
    bool fit = false;                              // scales the reference to the image's size
};

struct CertificateOptions {
    std::string output; // .json; empty: none
    radiosity::CertificateSettings settings;
};

struct ParametersOptions {
    bool markdown = false;
};

struct Invocation {
    CommonOptions common;
    std::variant<InfoOptions, RenderOptions, LadderOptions, SheetOptions, RankOptions,
                 BakeAoOptions, BakePrtOptions, BakeLightOptions, BakeRadiosityOptions,
                 BakeIblOptions, MergeOptions, EnvironmentOptions, BracketCommandOptions,
                 ExportOptions, RefineOptions, CompareOptions, CertificateOptions,
                 ParametersOptions>
        options;
};

} // namespace patina::cli
