// prt-reference SCENE --environment HDR…: how far the picture of a transfer bake, or one that
// patina rendered from it (scripts/transfer-truth), is from one that paths trace by brute force,
// per order of the light and against the whole environment.
#include "core/bake/Bake.h"
#include "core/bake/TransferRefinement.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/OrientedEnvironment.h"
#include "core/math/SphericalHarmonics.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/reference/PathReference.h"
#include "tests/reference/TransferPicture.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

using namespace patina;
using namespace patina::reference;

namespace {

struct Options {
    std::string scene, pictures, rendered, albedo;
    std::vector<std::string> environments;
    std::vector<int> size{128, 128}, orders{2, 3, 4, 5, 6}, shown{5};
    std::vector<float> camera{30.0f, 15.0f};
    PathSettings paths;
    PrtSettings bake;
    bool texels = false;
    float refine = 0.0f;
    std::vector<float> rotations;
    int rounds = 6, supersample = 1, threads = 0;
};

int fail(const Error& error) {
    std::fprintf(stderr, "prt-reference: %s %s\n", error.file.c_str(), error.message.c_str());
    return 1;
}

void refine(Document& document, const Options& options) {
    RefinementSettings settings;
    settings.bake.order = 3;
    settings.bake.samples = 128;
    settings.tolerance = options.refine;
    settings.rounds = options.rounds;
    const BakeInputs inputs = bakeInputs(document);
    const Result<RefinedMeshes> refined = refineForTransfer(inputs, settings, {});
    if (!refined)
        return;
    for (std::size_t i = 0; i < inputs.meshes.size(); ++i)
        for (MeshInstance& mesh : document.meshes)
            if (mesh.id == inputs.meshes[i].id)
                mesh.mesh = refined->meshes[i];
    std::printf("refined to %zu triangles, error %.5f -> %.5f\n", refined->triangles,
                refined->errorBefore, refined->errorAfter);
}

Image imageOf(const std::vector<glm::dvec3>& pixels, int width, int height) {
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t p = 0; p < pixels.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c)
            image.f32()[3 * p + c] = float(pixels[p][int(c)]);
    return image;
}

// Reference, picture and 20 times their difference side by side, the reference's mean as 0.35.
Image triptych(const std::vector<glm::dvec3>& reference, const std::vector<glm::dvec3>& picture,
               double mean, int width, int height) {
    std::vector<glm::dvec3> pixels;
    for (int y = 0; y < height; ++y)
        for (int part = 0; part < 3; ++part)
            for (int x = 0; x < width; ++x) {
                const std::size_t p = std::size_t(y) * std::size_t(width) + std::size_t(x);
                const glm::dvec3 shown = part == 0   ? reference[p]
                                         : part == 1 ? picture[p]
                                                     : 20.0 * glm::abs(picture[p] - reference[p]);
                pixels.push_back(0.35 / mean * glm::max(shown, glm::dvec3(0.0)));
            }
    return imageOf(pixels, 3 * width, height);
}

// Light that is shown has no negative parts, which sums of bands have.
void cutAtZero(std::vector<glm::dvec3>& truth, std::vector<glm::dvec3>& noise) {
    for (std::size_t p = 0; p < truth.size(); ++p)
        for (int c = 0; c < 3; ++c)
            if (truth[p][c] < 0.0)
                truth[p][c] = noise[p][c] = 0.0;
}

// Means of n × n pixels.
std::vector<glm::dvec3> blocks(const std::vector<glm::dvec3>& pixels, int width, int n) {
    const int across = width / n, down = int(pixels.size()) / width / n;
    std::vector<glm::dvec3> means(std::size_t(across) * std::size_t(down), glm::dvec3(0.0));
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        const int x = int(p) % width, y = int(p) / width;
        means[std::size_t(y / n * across + x / n)] += pixels[p] / double(n * n);
    }
    return means;
}

// Those of the blocks that show something.
std::vector<std::optional<Place>> blocks(const std::vector<std::optional<Place>>& places, int width,
                                         int n) {
    const int across = width / n, down = int(places.size()) / width / n;
    std::vector<std::optional<Place>> shown(std::size_t(across) * std::size_t(down));
    for (std::size_t p = 0; p < places.size(); ++p) {
        const int x = int(p) % width, y = int(p) / width;
        if (places[p])
            shown[std::size_t(y / n * across + x / n)] = places[p];
    }
    return shown;
}

Result<std::vector<glm::dvec3>> loadPixels(WorkerClient& worker, const std::string& file,
                                           std::size_t count) {
    const Result<LoadedImage> loaded = loadImage(worker, file);
    if (!loaded)
        return loaded.error();
    const Image& image = loaded->image();
    std::vector<glm::dvec3> pixels;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            pixels.emplace_back(image.linear(x, y));
    if (pixels.size() != count)
        return Error{ErrorKind::Usage, "is not of --size times --supersample", file, {}};
    return pixels;
}

Result<BakeArtifact> bakeOf(const ReferenceScene& scene, const Options& options) {
    BakeRequest request;
    request.kind = options.texels ? BakeKind::PrtTexel : BakeKind::PrtVertex;
    request.prt = options.bake;
    request.prt.order = kOrders; // holds every lower order
    request.prt.transfer = options.texels ? TransferKind::Shadowed : TransferKind::Interreflected;
    request.prt.bounces = options.paths.bounces;
    TileSink nobody;
    return bake(request, scene.inputs(), nobody, {});
}

// What the camera sees, --supersample places across a pixel.
Result<std::vector<std::optional<Place>>> placesSeen(WorkerClient& worker, const Document& document,
                                                     const ReferenceScene& scene,
                                                     const Options& options) {
    const int n = options.supersample, width = options.size.at(0), height = options.size.at(1);
    Camera camera = document.view.camera;
    camera.yawDeg = options.camera.at(0);
    camera.pitchDeg = options.camera.at(1);
    camera = frameBounds(camera, document.bounds(), float(width) / float(height));
    if (options.camera.size() > 2)
        camera.distance = options.camera[2];
    std::vector<std::optional<Place>> places = scene.look(camera, n * width, n * height);
    if (std::none_of(places.begin(), places.end(),
                     [](const auto& place) { return place.has_value(); }))
        return Error{ErrorKind::Usage,
                     "shows nothing from there; choose another --camera",
                     options.scene,
                     {}};
    if (options.albedo.empty())
        return places;
    const Result<std::vector<glm::dvec3>> albedo =
        loadPixels(worker, options.albedo, places.size());
    if (!albedo)
        return albedo.error();
    for (std::size_t p = 0; p < places.size(); ++p)
        if (places[p])
            places[p]->albedo = (*albedo)[p];
    return places;
}

int run(const Options& options) {
    const ThreadLimit limit(options.threads);
    WorkerClient worker;
    Result<OpenedScene> opened = openScene(worker, options.scene);
    if (!opened)
        return fail(opened.error());
    Document document = std::move(opened->document);
    if (options.refine > 0.0f)
        refine(document, options);
    const Result<ReferenceScene> scene = ReferenceScene::create(document);
    if (!scene)
        return fail(scene.error());

    const int n = options.supersample, width = options.size.at(0), height = options.size.at(1);
    const Result<std::vector<std::optional<Place>>> looked =
        placesSeen(worker, document, *scene, options);
    if (!looked)
        return fail(looked.error());
    const std::vector<std::optional<Place>>& places = *looked;
    const std::vector<std::optional<Place>> shown = blocks(places, n * width, n);

    std::vector<ReferenceLight> lights;
    std::vector<std::vector<glm::vec3>> coefficients;
    for (std::size_t e = 0; e < options.environments.size(); ++e) {
        std::vector<Notice> notices;
        const Result<ImagePtr> image =
            loadEnvironmentImage(worker, options.environments[e], notices);
        if (!image)
            return fail(image.error());
        const float rotation = e < options.rotations.size() ? options.rotations[e] : 0.0f;
        const auto turned =
            std::make_shared<const Image>(orientEnvironment(**image, rotation, 0.0f));
        lights.emplace_back(turned);
        coefficients.push_back(projectLatLong(*turned, kOrders));
    }

    BakeArtifact artifact;
    if (options.rendered.empty()) {
        Result<BakeArtifact> baked = bakeOf(*scene, options);
        if (!baked)
            return fail(baked.error());
        artifact = *std::move(baked);
    }
    PathSettings pathSettings = options.paths;
    pathSettings.side = n;
    pathSettings.width = n * width;
    const PathPictures paths = tracePaths(*scene, places, lights, pathSettings);

    for (std::size_t e = 0; e < lights.size(); ++e) {
        const std::string name = std::filesystem::path(options.environments[e]).stem().string();
        for (const Transport transport : {Transport::Shadowed, Transport::Interreflected}) {
            const bool bounced = transport == Transport::Interreflected;
            if (bounced && options.texels)
                continue;
            std::printf(
                "%s, %s, %s\n  order  of the same light  bias     noise   worst  | of the whole\n",
                options.scene.c_str(), name.c_str(), bounced ? "interreflected" : "shadowed");
            for (const int order : options.orders) {
                const std::string which = "-" + name +
                                          (bounced ? "-interreflected-" : "-shadowed-") +
                                          std::to_string(order);
                Result<std::vector<glm::dvec3>> fine =
                    options.rendered.empty()
                        ? transferPicture(*scene, places, artifact, coefficients[e], order, bounced)
                        : loadPixels(worker, options.rendered + which + ".exr", places.size());
                if (!fine)
                    return fail(fine.error());
                const std::vector<glm::dvec3> picture = blocks(*fine, n * width, n);
                const auto against = [&](int light) {
                    std::vector<glm::dvec3> truth =
                        blocks(paths.mean(e, transport, light), n * width, n);
                    std::vector<glm::dvec3> noise =
                        blocks(paths.halfDifference(e, transport, light), n * width, n);
                    if (!options.rendered.empty())
                        cutAtZero(truth, noise);
                    return distance(shown, picture, truth, noise);
                };
                const Distance same = against(order), whole = against(0);
                std::printf("  %d      %6.3f %%          %6.3f %%  %6.3f %%  %6.2f %% | %6.2f %%\n",
                            order, 100 * same.relative(), 100 * same.bias / same.mean,
                            100 * same.noise / same.mean, 100 * same.worst / same.mean,
                            100 * whole.relative());
                if (options.pictures.empty() ||
                    std::find(options.shown.begin(), options.shown.end(), order) ==
                        options.shown.end())
                    continue;
                const Result<Bytes> png =
                    encodeImage(worker,
                                {{"",
                                  triptych(blocks(paths.mean(e, transport, order), n * width, n),
                                           picture, same.mean, width, height),
                                  {}}},
                                ImageFileFormat::Png);
                if (!png)
                    return fail(png.error());
                const Result<void> written =
                    writeFileAtomically(options.pictures + which + ".png", *png);
                if (!written)
                    return fail(written.error());
            }
        }
    }
    return 0;
}

} // namespace

int main(int argc, char* argv[]) {
    Options options;
    options.bake.samples = 1024;
    options.bake.bounceSamples = 256;
    CLI::App app("How far a transfer bake is from paths traced by brute force");
    app.add_option("scene", options.scene, "Model, .patina project or builtin:NAME")->required();
    app.add_option("--environment", options.environments, "Lit by each of them")->required();
    app.add_option("--rotation", options.rotations, "Of each, in degrees")->delimiter(',');
    app.add_option("--size", options.size, "WIDTH,HEIGHT in pixels")->delimiter(',')->expected(2);
    app.add_option("--camera", options.camera, "YAW,PITCH[,DISTANCE]")->delimiter(',');
    app.add_option("--orders", options.orders, "Orders to compare, 1 to 6")->delimiter(',');
    app.add_option("--paths", options.paths.paths, "Per pixel, twice");
    app.add_option("--bounces", options.paths.bounces, "Of the paths and of the bake");
    app.add_option("--samples", options.bake.samples, "Rays per element of the bake");
    app.add_option("--bounce-samples", options.bake.bounceSamples, "Bounce rays per vertex");
    app.add_flag("--no-fit{false}", options.bake.fitted, "What the vertices themselves see");
    app.add_flag("--texels", options.texels, "Bake per texel (no bounces)");
    app.add_option("--texture", options.bake.size, "Side of the texture of --texels");
    app.add_option("--refine", options.refine, "Refine the meshes first, to this tolerance");
    app.add_option("--rounds", options.rounds, "Of refinement");
    app.add_option("--pictures", options.pictures,
                   "Start of file names: reference, picture, difference × 20");
    app.add_option("--rendered", options.rendered,
                   "Instead of a bake of its own: start of the names of pictures of patina render, "
                   "going on with -HDR-shadowed-ORDER.exr and -HDR-interreflected-ORDER.exr");
    app.add_option("--albedo", options.albedo,
                   "Picture of the albedos that are seen, of patina render --view diffuseAlbedo: "
                   "with maps filtered as in the pictures, instead of texel by texel");
    app.add_option("--supersample", options.supersample,
                   "Compares means of N × N pixels; --paths are shared among them")
        ->check(CLI::PositiveNumber);
    app.add_option("--show", options.shown, "Orders of the pictures")->delimiter(',');
    app.add_option("--threads", options.threads, "0: all");
    CLI11_PARSE(app, argc, argv);
    return run(options);
}
