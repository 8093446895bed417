#include "render/WarmUp.h"

#include "core/base/ById.h"
#include "core/base/Hash.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/MaterialInputs.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "render/pass/SurfacePass.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <set>

namespace patina::render {
namespace {

constexpr int kSide = 16;         // pixels of a square
constexpr std::size_t kMost = 48; // squares: more programs than that are left to the first frame
constexpr float kSpacing = 1.25f; // between the centres of squares of side 1
constexpr int kReducedSide = 4;   // of maps; 3 where the side is no power of two

const MeshPtr& square() {
    static const MeshPtr kSquare = [] {
        Mesh mesh;
        mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.tangents.assign(4, {1, 0, 0, 1});
        mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        return std::make_shared<const Mesh>(std::move(mesh));
    }();
    return kSquare;
}

// llvmpipe compiles for textures with and without mipmaps, and for sides that are powers of two.
int reducedSide(int side) {
    if (side <= kReducedSide)
        return side;
    return std::has_single_bit(static_cast<unsigned>(side)) ? kReducedSide : kReducedSide - 1;
}

using Size = std::pair<int, int>;

Size sizeOf(const Image& image) {
    return {image.width(), image.height()};
}

ImagePtr reduced(const Image& image, const Size& size) {
    return std::make_shared<const Image>(size.first, size.second, image.channels(), image.type(),
                                         image.encoding());
}

ImagePtr reduced(const Image& image) {
    return reduced(image, {reducedSide(image.width()), reducedSide(image.height())});
}

// The maps of a material with as few texels as compile to the same programs: those that share an
// image still do, and sizes that differ still differ, as maps of one size may be packed.
void reduceMaps(Material& material) {
    std::map<Size, Size> sizes; // few: one for each map at most
    const auto isTaken = [&](const Size& size) {
        return std::ranges::any_of(sizes, [&](const auto& of) { return of.second == size; });
    };
    const auto grown = [](int side) { // a power of two or not, as it was
        return std::has_single_bit(static_cast<unsigned>(side)) ? 2 * side : side + 2;
    };
    const auto isSmall = [](const Size& size) {
        return std::max(size.first, size.second) <= kReducedSide;
    };
    for (const bool small : {true, false}) // what stays as it is comes first
        forEachMap(material, [&](const MapSlot& map) {
            if (!map.image || isSmall(sizeOf(*map.image)) != small)
                return;
            const auto [width, height] = sizeOf(*map.image);
            if (sizes.contains({width, height}))
                return;
            Size size{reducedSide(width), reducedSide(height)};
            while (isTaken(size))
                size = width > kReducedSide ? Size{grown(size.first), size.second}
                                            : Size{size.first, grown(size.second)};
            sizes[{width, height}] = size;
        });
    std::map<ImagePtr, ImagePtr> images;
    forEachMap(material, [&](MapSlot& map) {
        if (!map.image)
            return;
        ImagePtr& image = images[map.image];
        if (!image)
            image = reduced(*map.image, sizes.at(sizeOf(*map.image)));
        map.image = image;
    });
}

SurfaceSettings settingsOf(const Document& document, const FrameKind& frame) {
    FrameBlock block;
    packLights(document, {}, block);
    SurfaceSettings settings;
    settings.lighting = frame.lighting;
    settings.lightEnds = block.lightEnds;
    settings.hasPunctualLights = block.lightEnds.y > 0;
    settings.hasAreaLights = block.lightEnds.w > block.lightEnds.y;
    settings.shadows = std::min(static_cast<int>(castingLights(document).size()), kMaxShadows);
    settings.model = document.model;
    settings.output = frame.output;
    return settings;
}

// What the document's bakes hold, found by the ids of meshes and materials.
class BakedValues {
  public:
    explicit BakedValues(const Document& document)
        : m_prtVertices(verticesOf(document, BakeKind::PrtVertex))
        , m_aoVertices(verticesOf(document, BakeKind::AoVertex))
        , m_prtTexels(texelsOf(document, BakeKind::PrtTexel))
        , m_aoTexels(texelsOf(document, BakeKind::AoTexel)) {}

    [[nodiscard]] SurfaceBakes of(const MeshInstance& mesh) const {
        const VertexBake* transfer = fitting(m_prtVertices, mesh);
        const VertexBake* ao = fitting(m_aoVertices, mesh);
        const bool texels = filled(m_prtTexels, mesh.material);
        return {texels ||
                    (transfer && static_cast<std::size_t>(transfer->stride) <= kMaxTransferCount),
                texels, filled(m_aoTexels, mesh.material), ao && ao->stride == 1};
    }

  private:
    static ById<VertexBake> verticesOf(const Document& document, BakeKind kind) {
        const BakeArtifactPtr bake = findBake(document, kind);
        return bake ? ById(bake->vertices, &VertexBake::mesh) : ById<VertexBake>();
    }
    static ById<TexelBake> texelsOf(const Document& document, BakeKind kind) {
        const BakeArtifactPtr bake = findBake(document, kind);
        return bake ? ById(bake->texels, &TexelBake::material) : ById<TexelBake>();
    }
    static const VertexBake* fitting(const ById<VertexBake>& bakes, const MeshInstance& mesh) {
        const VertexBake* bake = bakes.find(mesh.id);
        return bake && bake->values.size() ==
                           mesh.mesh->vertexCount() * static_cast<std::size_t>(bake->stride)
                   ? bake
                   : nullptr;
    }
    static bool filled(const ById<TexelBake>& bakes, Id material) {
        const TexelBake* bake = bakes.find(material);
        return bake && (bake->image || bake->side > 0);
    }

    // Into the document's artifacts, which outlive this.
    ById<VertexBake> m_prtVertices, m_aoVertices;
    ById<TexelBake> m_prtTexels, m_aoTexels;
};

void addFormats(Hasher& hasher, const Material& material) {
    forEachMap(material, [&](const MapSlot& map) {
        if (!map.image)
            return;
        const Image& image = *map.image;
        hasher.value(image.channels())
            .value(image.type())
            .value(image.encoding())
            .value(reducedSide(image.width()))
            .value(reducedSide(image.height()));
    });
}

// The values of a bake for squares.
BakeArtifactPtr reducedBake(const BakeArtifact& bake, const std::set<Id>& meshes) {
    BakeArtifact result = bake;
    std::erase_if(result.vertices,
                  [&](const VertexBake& values) { return !meshes.contains(values.mesh); });
    const std::size_t corners = square()->vertexCount();
    for (VertexBake& values : result.vertices) {
        const auto resize = [&](std::vector<float>& of, std::size_t each) {
            if (!of.empty())
                of.assign(corners * each, 0.5f);
        };
        const auto stride = static_cast<std::size_t>(values.stride);
        resize(values.values, stride);
        resize(values.bounced, 3 * stride);
        resize(values.sky, 1);
        resize(values.error, 1);
    }
    for (TexelBake& texels : result.texels) {
        if (texels.image)
            texels.image = reduced(*texels.image);
        if (texels.side == 0)
            continue;
        texels.side = reducedSide(texels.side);
        const auto count = static_cast<std::size_t>(texels.side * texels.side);
        const auto shrink = [&](std::vector<float>& of, std::size_t each) {
            if (!of.empty())
                of.resize(count * each);
        };
        const auto stride = static_cast<std::size_t>(texels.stride);
        shrink(texels.values, stride);
        shrink(texels.bounced, 3 * stride);
        shrink(texels.sky, 1);
        shrink(texels.error, 1);
    }
    return std::make_shared<const BakeArtifact>(std::move(result));
}

// A sky of the same kind of texture as most environments have.
EnvironmentTexels someSky() {
    constexpr std::uint16_t kHalf = 0x3800; // 0.5
    HalfMipmaps mipmaps;
    for (const auto& [width, height] : {std::pair(4, 2), std::pair(2, 1), std::pair(1, 1)})
        mipmaps.push_back(
            {width, height,
             std::vector<std::uint16_t>(
                 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kHalf)});
    const IblMaps light = [] {
        IblMaps maps;
        maps.prefiltered.push_back({1, std::vector<glm::vec3>(6, glm::vec3(0.5f))});
        maps.irradianceSh.fill(glm::vec3(0.5f));
        maps.radianceSh.fill(glm::vec3(0.5f));
        return maps;
    }();
    return makeEnvironmentTexels(
        std::make_shared<const Image>(4, 2, 3, PixelType::F32, ColorEncoding::Linear), light,
        std::make_shared<const HalfMipmaps>(std::move(mipmaps)));
}

} // namespace

std::vector<FrameKind> frameKinds(const ViewSettings& view, const Document& document) {
    const LightingMode lighting = view.lighting.value_or(document.view.lighting);
    const auto kindOf = [&](const ViewChoice& choice) {
        return FrameKind{view.isOrdinary(choice) ? SurfaceOutput::Picture : SurfaceOutput::OneView,
                         lightingOf(choice.kind, lighting)};
    };
    std::vector<FrameKind> kinds{kindOf(view.shown)};
    if (view.split && kindOf(view.split->other) != kinds.front())
        kinds.push_back(kindOf(view.split->other));
    return kinds;
}

FrameKind sheetKind(ViewKind kind, const Document& document) {
    return {SurfaceOutput::EightViews, lightingOf(kind, document.view.lighting)};
}

std::vector<FrameKind> allFrameKinds(const Document& document) {
    const LightingMode own = document.view.lighting;
    std::vector<FrameKind> kinds{{SurfaceOutput::OneView, own},
                                 {SurfaceOutput::EightViews, own},
                                 {SurfaceOutput::Inspection, own},
                                 {SurfaceOutput::Picture, own}};
    for (const SurfaceOutput output : {SurfaceOutput::Picture, SurfaceOutput::EightViews})
        for (const ViewInfo& info : views())
            if (const LightingMode lighting = lightingOf(info.kind, own);
                lighting != own && lighting != LightingMode::Radiosity &&
                whyEmpty(info.kind, document).empty())
                kinds.push_back({output, lighting});
    return kinds;
}

std::map<std::uint64_t, Id> surfacePrograms(const Document& document, const FrameKind& frame) {
    const SurfaceSettings settings = settingsOf(document, frame);
    std::map<std::uint64_t, Id> programs;
    const ById materials(document.materials);
    const BakedValues baked(document);
    static const Material kDefault; // of a mesh whose material is not there
    for (const MeshInstance& mesh : document.meshes) {
        if (!mesh.visible || !mesh.mesh || mesh.mesh->indices.empty())
            continue;
        const Material* found = materials.find(mesh.material);
        const Material& material = found ? *found : kDefault;
        SurfaceBakes bakes = baked.of(mesh);
        bakes.radiosity = frame.lighting == LightingMode::Radiosity;
        const SurfaceFeatures features =
            surfaceFeatures(materialFeatures(material), bakes, settings);
        Hasher hasher;
        hashVariant(hasher, surfaceVariant(features, settings));
        addFormats(hasher, material);
        programs.emplace(hasher.finish().low, mesh.id);
    }
    return programs;
}

Document warmUpScene(const Document& document) {
    Document scene = document;
    scene.meshes.clear();
    std::set<Id> needed, meshes, materials;
    for (const FrameKind& frame : allFrameKinds(document))
        for (const auto& [program, id] : surfacePrograms(document, frame))
            needed.insert(id);
    for (const Id id : needed) {
        if (scene.meshes.size() == kMost)
            break;
        MeshInstance mesh = *document.mesh(id);
        mesh.mesh = square();
        mesh.placement = glm::translate(
            glm::mat4(1.0f),
            glm::vec3(kSpacing * static_cast<float>(scene.meshes.size()), 0.0f, 0.0f));
        meshes.insert(mesh.id);
        materials.insert(mesh.material);
        scene.meshes.push_back(std::move(mesh));
    }
    std::erase_if(scene.materials, [&](const Material& m) { return !materials.contains(m.id); });
    for (Material& material : scene.materials)
        reduceMaps(material);
    for (BakeArtifactPtr& bake : scene.bakes)
        bake = reducedBake(*bake, meshes);
    Camera camera; // in front
    camera.yawDeg = camera.pitchDeg = 0.0f;
    const auto aspect = static_cast<float>(std::max(scene.meshes.size(), std::size_t{1}));
    scene.view.camera = frameBounds(camera, scene.bounds(), aspect);
    scene.environment().image = nullptr;
    scene.environment().fileImage = nullptr;
    return scene;
}

WarmUp::WarmUp(gl::Context& context, std::unique_ptr<SceneRenderer> renderer,
               const Document& document)
    : m_context(context)
    , m_renderer(std::move(renderer))
    , m_picture(std::make_unique<ViewRenderer>(*m_renderer))
    , m_thumbnails(std::make_unique<SheetRenderer>(*m_renderer))
    , m_scene(warmUpScene(document)) {
    m_frame.width = kSide * std::max(1, static_cast<int>(m_scene.meshes.size()));
    m_frame.height = kSide;
    m_frame.camera = m_scene.view.camera;
    m_frame.showOverlays = true;
    m_frame.dither = true;
    m_frame.measureLuminance = true;
    if (!m_scene.meshes.empty())
        m_frame.selectedMesh = m_scene.meshes.front().id;
    if (!m_scene.lights.empty())
        m_frame.selectedLight = m_scene.lights.front().id;
}

Result<WarmUp> WarmUp::create(gl::Context& context, const Document& document) {
    auto renderer = SceneRenderer::create(context);
    if (!renderer)
        return renderer.error();
    WarmUp result(context, std::move(*renderer), document);
    result.m_renderer->setEnvironment(std::make_shared<const EnvironmentTexels>(someSky()));
    result.m_renderer->setDocument(result.m_scene);
    return result;
}

// The coarsest that there is: what matters is that the squares have one.
Result<void> WarmUp::prepareRadiosity(LightingMode lighting, const JobContext& job) {
    if (lighting != LightingMode::Radiosity || m_hasRadiosity)
        return {};
    RadiositySettings settings;
    settings.maxArea = std::numeric_limits<double>::max();
    settings.lightSamples = settings.factors.resolution = 1;
    const Result<LiveRadiosityPtr> solved =
        followRadiosity(traceInputs(m_scene), settings, nullptr, job);
    if (!solved)
        return solved.error();
    m_renderer->setRadiosity(shownRadiosity(**solved, (*solved)->solution));
    m_hasRadiosity = true;
    return {};
}

Result<void> WarmUp::drawFrame(const ViewSettings& view, const JobContext& job) {
    m_frame.view = view;
    // A software renderer's code for several samples is never kept on disk.
    for (const int samples : {1, 4}) {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        m_frame.samples = samples;
        if (auto done = m_picture->render(m_frame, 0); !done || m_context.info().software)
            return done;
    }
    return {};
}

Result<void> WarmUp::drawViews(LightingMode lighting, const JobContext& job) {
    for (const ViewMode mode : {ViewMode::Raw, ViewMode::Contribution})
        for (const ViewInfo& info : views()) {
            if (mode == ViewMode::Contribution && info.contribution.empty())
                continue;
            if (info.lighting) // in other light, or by programs that others need, too
                continue;
            ViewSettings view;
            view.shown = {info.kind, mode, {}};
            view.lighting = lighting;
            // The picture itself, with a term switched off, is made by the same program as a view.
            if (view.isOrdinary(view.shown))
                view.terms[0] = false;
            if (auto done = drawFrame(view, job); !done)
                return done;
        }
    return {};
}

Result<void> WarmUp::drawSheet(LightingMode lighting, const JobContext& job) {
    ViewSettings view;
    view.lighting = lighting;
    if (auto done = drawFrame(view, job); !done)
        return done;
    ViewSheet sheet{{shading::kViewFinal, shading::kViewBaseColor, shading::kViewNoV}};
    sheet.width = m_frame.width;
    sheet.height = m_frame.height;
    if (auto drawn = m_thumbnails->draw(m_frame, sheet, *m_picture); !drawn)
        return drawn.error();
    // A light that is set up later finds its programs, too.
    return m_picture->prepareNearLights(lighting);
}

Result<void> WarmUp::inspectAll(LightingMode lighting, const JobContext& job) {
    ViewSettings view;
    view.lighting = lighting;
    if (auto done = drawFrame(view, job); !done)
        return done;
    const glm::mat4 worldToClip =
        m_frame.camera.projectionMatrix(static_cast<float>(m_frame.width) /
                                            static_cast<float>(m_frame.height),
                                        m_scene.bounds()) *
        m_frame.camera.viewMatrix();
    for (const MeshInstance& mesh : m_scene.meshes) {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        const glm::vec4 center = worldToClip * mesh.placement.matrix()[3];
        const auto x = static_cast<int>((0.5f + 0.5f * center.x / center.w) *
                                        static_cast<float>(m_frame.width));
        if (auto done = m_picture->inspect(x, m_frame.height / 2); !done)
            return done.error();
    }
    return {};
}

Result<void> WarmUp::draw(const FrameKind& frame, const JobContext& job) {
    if (m_scene.meshes.empty())
        return {};
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    if (auto done = prepareRadiosity(frame.lighting, job); !done)
        return done;
    switch (frame.output) {
    case SurfaceOutput::Picture: {
        ViewSettings view;
        view.lighting = frame.lighting;
        return drawFrame(view, job);
    }
    case SurfaceOutput::OneView:
        return drawViews(frame.lighting, job);
    case SurfaceOutput::EightViews:
        return drawSheet(frame.lighting, job);
    case SurfaceOutput::Inspection:
        return inspectAll(frame.lighting, job);
    }
    return {};
}

} // namespace patina::render
