// What light costs in the surface pass: 1280 × 720, one sample, five maps of 1024², image-based
// light and four lights, against the yardstick: the same pass with irradiance, reflection and
// lights replaced by a constant. The table says what each term costs: the time of the whole pass
// less the time without the term; and what packing is worth: metallic, roughness and occlusion maps
// in one texture against the same maps in textures of their own.
//
// Times are processor time of all threads (llvmpipe draws on them). Every variant is drawn once per
// round, so that a busy machine disturbs all alike; the table holds minima.
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Camera.h"
#include "render/pass/RelightPass.h"
#include "render/pass/SurfacePass.h"
#include "render/pass/Targets.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <epoxy/gl.h>
#include <functional>
#include <limits>
#include <memory>

namespace patina::render {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kRounds = 12;

double processMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// A tileable map laid out 2 × 2: an image of its own of twice the size.
ImagePtr doubled(const ImagePtr& map) {
    auto large = std::make_shared<Image>(2 * map->width(), 2 * map->height(), map->channels(),
                                         map->type(), map->encoding());
    const std::size_t row = map->bytesPerPixel() * static_cast<std::size_t>(map->width());
    for (int y = 0; y < large->height(); ++y) {
        const auto* source =
            map->bytes().data() + row * static_cast<std::size_t>(y % map->height());
        std::byte* target = large->bytes().data() + 2 * row * static_cast<std::size_t>(y);
        std::memcpy(target, source, row);
        std::memcpy(target + row, source, row);
    }
    return large;
}

Light pointLight(const glm::vec3& position) {
    Light light;
    light.type = LightType::Point;
    light.position = position;
    light.intensity = 8.0f;
    return light;
}

Light directionalLight(float azimuthDeg) {
    Light light;
    light.azimuthDeg = azimuthDeg;
    light.castsShadow = false;
    return light;
}

// The built-in model with five maps, under the studio sky and four lights.
Document litDocument(const char* model) {
    Document document;
    Material material = library::material("worn-painted-metal").value();
    material.id = 1;
    for (MapSlot* map :
         {&material.baseColorMap, &material.metallicMap, &material.perceptualRoughnessMap,
          &material.normalMap, &material.occlusionMap})
        map->image = doubled(map->image);
    document.materials = {material};
    Id id = 1;
    const std::vector<library::ModelPart> parts = library::model(model).value();
    for (const library::ModelPart& part : parts) {
        MeshInstance mesh;
        mesh.id = ++id;
        mesh.mesh = part.mesh;
        mesh.material = material.id;
        document.meshes.push_back(mesh);
    }
    document.environment().image = library::environment("studio").value();
    document.lights = {pointLight({2, 3, 2}), pointLight({-2, 2, 1}), directionalLight(40),
                       directionalLight(-120)};
    return document;
}

// One line of the table: what is taken out of the full pass.
struct Variant {
    const char* name;
    std::vector<std::string> defines;
    std::function<void(Document&)> edit;
    bool mapsApart = false;
};

// Every map in a texture of its own, as if none could be packed.
GpuMaterial withMapsApart(gl::Context& context, TextureCache& textures, const Material& material) {
    GpuMaterial gpu;
    updateGpuMaterial(context, textures, material, gpu);
    for (const MaterialInputInfo& info : kMaterialInputs) {
        Material alone;
        alone.*info.map = material.*info.map;
        gpu.features.maps[info.input] = materialFeatures(alone).maps[info.input];
        if (const ImagePtr& image = (material.*info.map).image)
            gpu.maps[info.input] = textures.texture(image);
    }
    return gpu;
}

void withoutLights(Document& document) {
    document.lights.clear();
}

std::function<void(Document&)> withoutMap(MapSlot Material::*slot) {
    return [slot](Document& document) { document.materials[0].*slot = {}; };
}

std::vector<Variant> variants() {
    return {
        {"everything", {}, nullptr},
        {"yardstick: constant light",
         {"CONSTANT_IRRADIANCE", "CONSTANT_REFLECTION"},
         withoutLights},
        {"maps apart", {}, nullptr, true},
        {"irradiance (cube)", {"CONSTANT_IRRADIANCE"}, nullptr},
        {"… more than nine coefficients", {"HAS_SH_IRRADIANCE"}, nullptr},
        {"reflection (prefiltered cube)", {"CONSTANT_REFLECTION"}, nullptr},
        {"reflectance (DFG table)", {"CONSTANT_DFG"}, nullptr},
        {"one point light", {}, [](Document& d) { d.lights.erase(d.lights.begin()); }},
        {"one directional light", {}, [](Document& d) { d.lights.pop_back(); }},
        {"all four lights", {}, withoutLights},
        {"base colour map", {}, withoutMap(&Material::baseColorMap)},
        {"metallic map", {}, withoutMap(&Material::metallicMap)},
        {"roughness map", {}, withoutMap(&Material::perceptualRoughnessMap)},
        {"normal map", {}, withoutMap(&Material::normalMap)},
        {"occlusion map", {}, withoutMap(&Material::occlusionMap)},
    };
}

// A variant ready to be drawn.
struct Study {
    Study(gl::Context& context, ShaderLibrary& shaders, const Variant& variant, Document document,
          const IblMaps& ibl)
        : scene(context)
        , textures(context)
        , pass(shaders, variant.defines)
        , frameBlock(context, "frame", sizeof(FrameBlock)) {
        if (variant.edit)
            variant.edit(document);
        scene.update(document);
        scene.light().setIbl(ibl);
        items = scene.items();
        if (variant.mapsApart) {
            apart = withMapsApart(context, textures, document.materials.front());
            for (DrawItem& item : items)
                item.material = &apart;
        }
    }
    Study(const Study&) = delete; // items point into it
    Study& operator=(const Study&) = delete;

    GpuScene scene;
    TextureCache textures;
    GpuMaterial apart;
    std::vector<DrawItem> items;
    SurfacePass pass;
    gl::Buffer frameBlock;
    double milliseconds = std::numeric_limits<double>::max();

    // Fills half the picture's height with the model's middle half, so that nearly all pixels
    // count.
    void draw(const Targets& targets) {
        Camera camera = frameBounds(Camera{}, scene.bounds(), 1.0f);
        camera.distance *= 0.5f;
        FrameBlock block;
        block.worldToClip =
            camera.projectionMatrix(static_cast<float>(kWidth) / kHeight, scene.bounds()) *
            camera.viewMatrix();
        block.cameraPosition = glm::vec4(camera.position(), 1.0f);
        scene.fill(block, kDocumentLight, View().reflectionMix);
        frameBlock.writeValue(block);
        frameBlock.bindUniform(kFrameBinding);
        const DrawList list = makeDrawList(items, block.worldToClip, camera.position());
        targets.scene().bind();
        targets.scene().clearColor(0, 0, 0, 1);
        targets.scene().clearDepth(1.0f);
        glFinish();
        const double start = processMilliseconds();
        SurfaceSettings settings;
        settings.hasPunctualLights = block.lightEnds.y > 0;
        settings.hasAreaLights = block.lightEnds.w > block.lightEnds.y;
        settings.lightEnds = block.lightEnds;
        if (!pass.drawOpaque(scene, list, settings))
            return;
        glFinish();
        milliseconds = std::min(milliseconds, processMilliseconds() - start);
    }
};

void surfaceTerms(benchmark::State& state, const char* model) {
    auto context = gl::Context::createHeadless();
    if (!context) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    const Document document = litDocument(model);
    const auto ibl = computeIbl(*document.environment().image, {}, JobContext());
    ShaderLibrary shaders(**context, {});
    Targets targets;
    if (!ibl || !targets.resize(**context, kWidth, kHeight, 1)) {
        state.SkipWithError("no light or no target");
        return;
    }
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glCullFace(GL_BACK);
    std::vector<std::unique_ptr<Study>> studies;
    for (const Variant& variant : variants())
        studies.push_back(std::make_unique<Study>(**context, shaders, variant, document, *ibl));
    for (const auto& study : studies)
        study->draw(targets); // compiles
    for (const auto& study : studies)
        study->milliseconds = std::numeric_limits<double>::max();
    for (auto _ : state)
        for (const auto& study : studies)
            study->draw(targets);

    const double all = studies[0]->milliseconds, constant = studies[1]->milliseconds,
                 apart = studies[2]->milliseconds;
    std::printf("\n%s on %s, CPU ms\n", model, (*context)->info().renderer.c_str());
    const std::vector<Variant> names = variants();
    for (std::size_t i = 0; i < studies.size(); ++i)
        if (i < 3)
            std::printf("  %-30s %7.1f\n", names[i].name, studies[i]->milliseconds);
        else
            std::printf("  %-30s %+7.1f\n", names[i].name, all - studies[i]->milliseconds);
    std::printf("  to constant light %.2f, to maps apart %.2f\n", all / constant, all / apart);
    state.counters["ratio"] = all / constant;
    state.counters["packed_to_apart"] = all / apart;
    state.counters["everything_ms"] = all;
    state.counters["constant_ms"] = constant;
    state.counters["apart_ms"] = apart;
}

// Transfer of order 5 on 100,000 vertices, lit anew, against what image-based light costs a frame:
// irradiance and reflection of the torus knot at 1280 × 720. The coefficients' values do not
// matter.
void relightVertices(benchmark::State& state) {
    auto context = gl::Context::createHeadless();
    if (!context) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    Document document = litDocument("torus-knot");
    const auto ibl = computeIbl(*document.environment().image, {}, JobContext());
    ShaderLibrary shaders(**context, {});
    Targets targets;
    if (!ibl || !targets.resize(**context, kWidth, kHeight, 1)) {
        state.SkipWithError("no light or no target");
        return;
    }
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glCullFace(GL_BACK);
    Study everything(**context, shaders, {"", {}, nullptr}, document, *ibl);
    Study constant(**context, shaders,
                   {"", {"CONSTANT_IRRADIANCE", "CONSTANT_REFLECTION"}, nullptr}, document, *ibl);

    constexpr int kOrder = 5;
    constexpr std::size_t kStride = kOrder * kOrder;
    const std::size_t perMesh = document.meshes[0].mesh->vertexCount();
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = kOrder;
    std::size_t count = 0;
    for (Id id = 100; count < 100'000; ++id, count += perMesh) {
        MeshInstance mesh = document.meshes[0];
        mesh.id = id;
        document.meshes.push_back(mesh);
        bake->vertices.push_back({id, kStride, std::vector<float>(perMesh * kStride, 0.25f),
                                  std::vector<float>(3 * perMesh * kStride, 0.125f)});
    }
    document.bakes = {bake};
    GpuScene scene(**context);
    scene.update(document);
    scene.light().setIbl(*ibl);
    RelightPass relight(**context, shaders);
    gl::Buffer block(**context, "frame", sizeof(FrameBlock));
    FrameBlock frame;
    const auto turn = [&](const std::vector<Light>& lights) {
        document.environment().rotationDeg += 1.0f;
        document.lights = lights;
        scene.update(document);
        frame = FrameBlock();
        scene.fill(frame, kDocumentLight, document.view.reflectionMix);
        block.writeValue(frame);
        block.bindUniform(kFrameBinding);
    };
    const auto milliseconds = [&](LightingMode mode, const std::vector<Light>& lights = {}) {
        turn(lights);
        const std::uint64_t before = relight.elementsDone();
        glFinish();
        const double start = processMilliseconds();
        if (!relight.update(scene, {mode}, frame))
            return std::numeric_limits<double>::max();
        glFinish();
        const double spent = processMilliseconds() - start;
        return spent * 1e5 / static_cast<double>(relight.elementsDone() - before);
    };
    Light point, sphere, rectangle;
    point.type = LightType::Point;
    sphere.type = LightType::Sphere;
    rectangle.type = LightType::Rectangle;
    for (Study* study : {&everything, &constant}) {
        study->draw(targets); // compiles
        study->milliseconds = std::numeric_limits<double>::max();
    }
    double shadowed = 1e9, bounced = 1e9, still = 1e9;
    std::array<double, 3> near{1e9, 1e9, 1e9};
    double kept = 1e9; // a rectangle stands still while the environment rotates
    const std::array<std::vector<Light>, 3> oneLight{{{point}, {sphere}, {rectangle}}};
    milliseconds(LightingMode::Shadowed); // compiles
    for (const std::vector<Light>& lights : oneLight)
        milliseconds(LightingMode::Shadowed, lights);
    milliseconds(LightingMode::Prt);
    for (auto _ : state) {
        everything.draw(targets);
        constant.draw(targets);
        shadowed = std::min(shadowed, milliseconds(LightingMode::Shadowed));
        bounced = std::min(bounced, milliseconds(LightingMode::Prt));
        const double start = processMilliseconds();
        if (relight.update(scene, {LightingMode::Prt}, frame))
            still = std::min(still, processMilliseconds() - start);
        for (std::size_t i = 0; i < near.size(); ++i)
            near[i] = std::min(near[i], milliseconds(LightingMode::Shadowed, oneLight[i]));
        kept = std::min(kept, milliseconds(LightingMode::Shadowed, oneLight[2]));
    }
    const double cost = everything.milliseconds - constant.milliseconds;
    std::printf("\n100,000 vertices, order %d, CPU ms\n  image-based light of a frame %7.1f\n"
                "  relit                        %7.1f\n  relit with bounces           %7.1f\n"
                "  light that stands still      %7.3f\n"
                "  relit with a point           %7.1f\n"
                "  relit with a sphere          %7.1f\n"
                "  relit with a rectangle       %7.1f\n"
                "  the environment rotates by it   %7.1f\n",
                kOrder, cost, shadowed, bounced, still, near[0], near[1], near[2], kept);
    state.counters["ibl_ms"] = cost;
    state.counters["relit_ms"] = shadowed;
    state.counters["relit_with_bounces_ms"] = bounced;
    state.counters["relit_with_rectangle_ms"] = near[2];
    state.counters["relit_beside_rectangle_ms"] = kept;
    state.counters["ratio"] = shadowed / cost;
}

BENCHMARK(relightVertices)
    ->Iterations(kRounds)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(surfaceTerms, torus_knot, "torus-knot")
    ->Iterations(kRounds)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(surfaceTerms, shader_ball, "shader-ball")
    ->Iterations(kRounds)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(surfaceTerms, plane, "plane")
    ->Iterations(kRounds)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace patina::render
