#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "render/SceneRendererImpl.h"

#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/document/Lighting.h"
#include "core/edit/ViewReasons.h"
#include "core/mix/LightMix.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "render/pass/AdaptationPass.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <glm/matrix.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace patina::render {

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl)
    : m_impl(std::move(impl)) {}

SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>>
SceneRenderer::create(gl::Context& context, const std::filesystem::path& shaderFolder) {
    auto impl = std::make_unique<Impl>(context, shaderFolder);
    // A shader that does not compile is found now, not in the middle of the first frame.
    for (const ProgramKey& key : {ProgramKey{{"surface.vert", "surface.frag"}, {}},
                                  ProgramKey{{"surface.vert", "id.frag"}, {}}})
        if (auto program = impl->shaders.program(key); !program)
            return program.error();
    if (auto done = impl->shadows.compile(); !done)
        return done.error();
    if (auto done = impl->screen.compile(); !done)
        return done.error();
    if (auto done = AdaptationPass::compile(impl->shaders); !done)
        return done.error();
    return std::unique_ptr<SceneRenderer>(new SceneRenderer(std::move(impl)));
}

std::uint64_t SceneRenderer::Impl::revision(const FrameSettings& frame) const {
    const auto ofLight = lightRevisions.find(frame.light);
    return sharedRevision + (frame.look ? 0 : lookRevision) +
           (ofLight != lightRevisions.end() ? ofLight->second : 0);
}

void SceneRenderer::setDocument(const Document& document) {
    Impl& r = *m_impl;
    const auto solos = [](const Document& d) {
        const Environment* second = d.secondEnvironment();
        return std::tuple(anySolo(d), d.environment().solo, second && second->solo);
    };
    const auto before = solos(r.scene.document());
    Dirty dirty = r.scene.update(document);
    if (dirty.view)
        ++r.lookRevision;
    if (dirty.environment)
        r.lightChanged(kDocumentLight);
    dirty.view = dirty.environment = false;
    if (dirty.any() || solos(document) != before)
        ++r.sharedRevision;
}

// --- Environment light ---------------------------------------------------------------------------

LightId SceneRenderer::addLight(const Environment& environment) {
    return m_impl->scene.addLight(environment);
}

void SceneRenderer::changeLight(LightId light, const Environment& environment) {
    if (m_impl->scene.environment(light) == environment)
        return;
    m_impl->scene.changeLight(light, environment);
    m_impl->lightChanged(light);
}

void SceneRenderer::removeLight(LightId light) {
    m_impl->scene.removeLight(light);
    m_impl->relight.removeLight(light);
    m_impl->lightRevisions.erase(light); // its id is never given again
}

void SceneRenderer::setEnvironment(EnvironmentTexelsPtr texels, LightId light) {
    beginEnvironment(std::move(texels), light);
    proceedEnvironment(std::numeric_limits<std::size_t>::max(), light);
}

void SceneRenderer::setIbl(const IblMaps& maps, LightId light) {
    m_impl->scene.light(light).setIbl(maps);
    m_impl->lightChanged(light);
}

void SceneRenderer::beginEnvironment(EnvironmentTexelsPtr texels, LightId light) {
    EnvironmentLight& target = m_impl->scene.light(light);
    const EnvironmentTextures* known = m_impl->scene.texturesOf(texels);
    if (known == nullptr || known == &target.textures()) {
        target.begin(std::move(texels));
        return;
    }
    const EnvironmentTextures before = target.textures();
    target.share(EnvironmentTextures(*known));
    m_impl->scene.keepTextures(before);
    m_impl->lightChanged(light);
}

bool SceneRenderer::proceedEnvironment(std::size_t bytes, LightId light) {
    EnvironmentLight& target = m_impl->scene.light(light);
    const EnvironmentTextures before = target.textures();
    const bool done = target.proceed(bytes);
    if (done && target.textures().prefiltered != before.prefiltered)
        m_impl->scene.keepTextures(before);
    if (done)
        m_impl->lightChanged(light);
    return done;
}

void SceneRenderer::setProjection(const ImagePtr& image, const ProjectionSh& coefficients) {
    m_impl->scene.light().setProjection(image, coefficients);
    m_impl->lightChanged(kDocumentLight);
}

bool SceneRenderer::knowsProjection(const ImagePtr& image) const {
    return m_impl->scene.light().knowsProjection(image);
}

std::vector<glm::vec3> SceneRenderer::transferLight(int order, LightId light) const {
    return m_impl->scene.transferLight(light, order);
}

Result<void> SceneRenderer::setDisplay(const DisplayTransformPtr& display) {
    m_impl->screen.setDisplay(std::nullopt);
    ++m_impl->displayRevision;
    if (!display)
        return {};
    auto program = DisplayProgram::create(m_impl->context, *display);
    if (!program)
        return program.error();
    m_impl->screen.setDisplay(std::move(*program));
    return {};
}

// --- Bakes ---------------------------------------------------------------------------------------

void SceneRenderer::previewVertices(BakeKind kind, Id mesh, int stride,
                                    std::span<const float> values) {
    m_impl->scene.previewVertices(kind, mesh, stride, values);
    ++m_impl->sharedRevision;
}

void SceneRenderer::previewTexels(Id material, int size, std::span<const float> values) {
    m_impl->scene.previewTexels(material, size, values);
    ++m_impl->sharedRevision;
}

void SceneRenderer::clearPreview() {
    m_impl->scene.clearPreview();
    ++m_impl->sharedRevision;
}

void SceneRenderer::setBouncedLight(Id mesh, std::span<const glm::vec3> radiance, LightId light) {
    m_impl->scene.setBouncedLight(light, mesh, radiance);
    m_impl->lightChanged(light);
}

void SceneRenderer::clearBouncedLight() {
    m_impl->scene.clearBouncedLight();
    ++m_impl->sharedRevision;
}

void SceneRenderer::setNearShadows(const NearShadowsPtr& shadows) {
    m_impl->scene.setNearShadows(shadows);
    ++m_impl->sharedRevision;
}

void SceneRenderer::setRadiosity(const ShownRadiosityPtr& radiosity) {
    m_impl->scene.setRadiosity(radiosity);
    ++m_impl->sharedRevision;
}

bool SceneRenderer::takeNearShadowUse() {
    return m_impl->relight.takeNearUse();
}

// --- Programs ------------------------------------------------------------------------------------

std::vector<ProgramKey> SceneRenderer::programs() const {
    return m_impl->shaders.keys();
}

std::vector<std::string> SceneRenderer::reloadShaders() {
    std::vector<std::string> messages = m_impl->shaders.reload();
    ++m_impl->sharedRevision;
    for (const std::string& message : messages)
        logError("{}", message);
    return messages;
}

SceneRenderer::Counts SceneRenderer::counts() const {
    return {m_impl->shadows.mapsDrawn(), m_impl->relight.elementsDone(), m_impl->scenes};
}

// --- Frames --------------------------------------------------------------------------------------

FrameBlock SceneRenderer::Impl::packFrame(const FrameSettings& frame) {
    const auto width = static_cast<float>(frame.width), height = static_cast<float>(frame.height);
    FrameBlock block;
    block.worldToClip =
        frame.camera.projectionMatrix(width / height, scene.bounds()) * frame.camera.viewMatrix();
    block.clipToWorld = glm::inverse(block.worldToClip);
    block.cameraPosition = glm::vec4(frame.camera.position(), 1.0f);
    block.viewport = {width, height, 1.0f / width, 1.0f / height};
    scene.fill(block, frame.light, lookOf(frame).reflectionMix, shadows.lights());
    if (block.lightEnds.w > kUniformLights)
        scene.setManyLights(shadows.lights());
    if (frame.view.furnace)
        block.lightEnds = glm::ivec4(0);
    return block;
}

void SceneRenderer::Impl::useFrame(const FrameBlock& block) {
    frameBlock.writeValue(block);
    frameBlock.bindUniform(kFrameBinding);
    scene.manyLights().bind();
}

LightingMode SceneRenderer::Impl::lightingFor(const FrameSettings& frame, ViewKind kind) const {
    return lightingOf(kind, frame.view.lighting.value_or(lookOf(frame).lighting));
}

RelightSettings SceneRenderer::Impl::relightSettings(const FrameSettings& frame,
                                                     ViewKind kind) const {
    return {lightingFor(frame, kind), frame.light, lookOf(frame).bounces >= 0};
}

SurfaceSettings SceneRenderer::Impl::surfaceSettings(const FrameSettings& frame,
                                                     const FrameBlock& block, SurfaceOutput output,
                                                     ViewKind kind) const {
    SurfaceSettings settings;
    settings.lighting = lightingFor(frame, kind);
    settings.light = frame.light;
    settings.isDocumentsLight = scene.environment(frame.light) == scene.environment(kDocumentLight);
    settings.hasPunctualLights = block.lightEnds.y > 0;
    settings.hasAreaLights = block.lightEnds.w > block.lightEnds.y;
    settings.lightEnds = block.lightEnds;
    settings.shadows = static_cast<int>(shadows.lights().size());
    settings.model = scene.document().model;
    settings.output = output;
    return settings;
}

ViewsBlock SceneRenderer::Impl::viewsBlock(const ViewSettings& view,
                                           std::span<const ViewChoice> choices,
                                           bool halfFloats) const {
    CHECK(choices.size() <= 8);
    ViewsBlock block;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        block.kinds[i] = viewInfo(choices[i].kind).recorded;
        block.modes[i] = choices[i].mode == ViewMode::Contribution ? 1 : 0;
        block.flat |= choices[i].kind == shading::kViewFlat ? 1 : 0;
    }
    const auto on = [&](int i) { return view.terms[static_cast<std::size_t>(i)] ? 1.0f : 0.0f; };
    block.terms = {on(0), on(1), on(2), on(3)};
    block.emissionTerm = on(4);
    const std::vector<Id> order = lightOrder(scene.document());
    const auto chosen = std::find(order.begin(), order.end(), view.light);
    if (view.light != 0 && chosen != order.end())
        block.light = static_cast<int>(chosen - order.begin());
    block.halfFloats = halfFloats ? 1 : 0;
    if (view.furnace)
        block.furnace = glm::vec4(*view.furnace, 1.0f);
    return block;
}

std::optional<glm::mat4> SceneRenderer::Impl::sliceClip(const SceneDraw& draw) {
    if (draw.slice == nullptr)
        return std::nullopt;
    return clipOfRect(draw.slice->rect, draw.frame.width, draw.frame.height) *
           draw.block.worldToClip;
}

DrawList SceneRenderer::Impl::visibleItems(const SceneDraw& draw) const {
    return makeDrawList(scene.items(lightingFor(draw.frame, draw.kind), draw.frame.light),
                        sliceClip(draw).value_or(draw.block.worldToClip),
                        draw.frame.camera.position());
}

Result<void> SceneRenderer::Impl::drawPicture(const SceneDraw& draw) {
    const FrameSettings& frame = draw.frame;
    if (auto done = relight.update(scene, relightSettings(frame, draw.kind), draw.block); !done)
        return done;
    SurfaceSettings settings = surfaceSettings(frame, draw.block, draw.output, draw.kind);
    settings.floats = draw.floats;
    if (frame.coarse)
        settings.coarseView = {draw.block.worldToClip, frame.height};
    shadows.bind();
    const DrawList list = visibleItems(draw);
    settings.clip = sliceClip(draw);
    const std::uint64_t opaque = triangleCount(list.opaque, settings.clip);
    const std::uint64_t all = opaque + triangleCount(list.blended, settings.clip);
    if (draw.slice) {
        settings.triangles = draw.slice->triangles;
        draw.slice->shown = all;
        draw.slice->complete = draw.slice->triangles.end() > all;
    }

    draw.target.bind();
    const std::optional<glm::vec3>& furnace = frame.view.furnace;
    const View& look = lookOf(frame);
    const BackgroundMode background = furnace ? BackgroundMode::Color : look.background;
    const bool transparent =
        !draw.withBackground || frame.transparentBackground || background == BackgroundMode::Off;
    const glm::vec3 clear = transparent || background != BackgroundMode::Color ? glm::vec3(0.0f)
                            : furnace                                          ? *furnace
                                      : look.backgroundColor;
    if (settings.triangles.first == 0) {
        draw.target.clearColor(clear.r, clear.g, clear.b, transparent ? 0.0f : 1.0f);
        draw.target.clearDepth(1.0f);
    }

    if (auto done = surface.drawOpaque(scene, list, settings); !done)
        return done;
    // The sky comes behind the last opaque triangle.
    TriangleRange& triangles = settings.triangles;
    if (triangles.end() <= opaque)
        return {};
    if (!transparent && triangles.first <= opaque)
        if (auto done = screen.drawSky(scene.light(frame.light), background, look.backgroundBlur,
                                       settings.floats);
            !done)
            return done;
    const std::uint64_t first = std::max(triangles.first, opaque);
    triangles = {first - opaque, triangles.end() - first};
    return surface.drawBlended(scene, list, settings);
}

Result<void> SceneRenderer::Impl::drawNumbers(const SceneDraw& draw, const ViewsBlock& settings,
                                              bool asPicture) {
    views.setBlock(settings);
    if (asPicture) {
        SceneDraw picture = draw;
        picture.withBackground = settings.kinds[0] == shading::kViewFinal;
        return drawPicture(picture);
    }
    if (auto done = relight.update(scene, relightSettings(draw.frame, draw.kind), draw.block);
        !done)
        return done;
    shadows.bind();
    // Blended surfaces, too, stand for themselves.
    DrawList list = visibleItems(draw);
    list.opaque.insert(list.opaque.end(), list.blended.begin(), list.blended.end());
    SurfaceSettings surfaces = surfaceSettings(draw.frame, draw.block, draw.output, draw.kind);
    surfaces.floats = draw.output == SurfaceOutput::OneView; // others are never drawn otherwise
    if (draw.slice) {
        surfaces.triangles = draw.slice->triangles;
        surfaces.clip = sliceClip(draw);
        draw.slice->shown = triangleCount(list.opaque, surfaces.clip);
        draw.slice->complete = draw.slice->triangles.end() > draw.slice->shown;
    }
    draw.target.bind();
    constexpr std::array<float, 4> kNothing{};
    if (surfaces.triangles.first == 0) {
        for (int i = 0; i < (draw.output == SurfaceOutput::EightViews ? 8 : 1); ++i)
            glClearNamedFramebufferfv(draw.target.id(), GL_COLOR, i, kNothing.data());
        draw.target.clearDepth(1.0f);
    }
    return surface.drawOpaque(scene, list, surfaces);
}

Result<ViewRange> SceneRenderer::Impl::rangeFor(const ViewChoice& choice,
                                                const gl::Texture& values) {
    const ViewInfo& info = viewInfo(choice.kind);
    ViewRange range{info.rangeMin, info.rangeMax};
    if (choice.range) {
        range = *choice.range;
    } else if (info.automaticRange) {
        const auto measured = views.measure(values, info.logarithmic);
        if (!measured)
            return measured.error();
        if (*measured)
            range = **measured;
    }
    // A single value, give or take rounding, lies in the middle of a range of its own.
    const float middle = 0.5f * (range.min + range.max);
    if (!(range.max - range.min > 0.02f * std::abs(middle))) {
        const float half = std::max(0.05f * std::abs(middle), 1e-6f);
        range = info.logarithmic ? ViewRange{0.5f * middle, 2.0f * middle}
                                 : ViewRange{middle - half, middle + half};
    }
    if (info.logarithmic)
        range.min = std::max(range.min, range.max * 1e-6f);
    return range;
}

bool SceneRenderer::Impl::isEmpty(const FrameSettings& frame, ViewKind kind) const {
    if (viewInfo(kind).lighting == LightingMode::Radiosity && !scene.radiosity())
        return true; // not solved yet
    if (kind == shading::kViewFormFactor && !scene.radiosity()->chosen)
        return true;
    if (frame.light == kDocumentLight && !frame.look)
        return !whyEmpty(kind, scene.document(), frame.view.light).empty();
    Document shown = scene.document();
    if (frame.light != kDocumentLight) { // it lights alone
        Environment& environment = shown.environments.emplace_back(scene.environment(frame.light));
        environment.id = shown.mix.first = shown.takeId();
        environment.solo = scene.document().environment().solo;
        shown.mix.second = 0;
    }
    shown.view = lookOf(frame);
    return !whyEmpty(kind, shown, frame.view.light).empty();
}

// --- OpenGL's state ------------------------------------------------------------------------------

SceneRenderer::Impl::GlScope::GlScope(const Impl& renderer, unsigned targetFramebuffer)
    : m_renderer(renderer)
    , m_targetFramebuffer(targetFramebuffer) {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glCullFace(GL_BACK);
    glEnable(GL_MULTISAMPLE);
}

SceneRenderer::Impl::GlScope::~GlScope() {
    glBindFramebuffer(GL_FRAMEBUFFER, m_targetFramebuffer);
    glBindVertexArray(0);
    glUseProgram(0);
    m_renderer.shadows.unbind();
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glFrontFace(GL_CCW);
}

bool blends(const ViewChoice& choice) {
    return choice.mode == ViewMode::Contribution ||
           viewInfo(viewInfo(choice.kind).recorded).value == ViewValue::Radiance;
}

void flipRows(Image& image) {
    const auto flip = [&](auto values) {
        const std::size_t row = static_cast<std::size_t>(image.width()) * 4;
        const auto rows = static_cast<std::size_t>(image.height());
        for (std::size_t top = 0; top < rows / 2; ++top) {
            const auto a = values.begin() + static_cast<std::ptrdiff_t>(top * row);
            const auto b = values.begin() + static_cast<std::ptrdiff_t>((rows - 1 - top) * row);
            std::swap_ranges(a, a + static_cast<std::ptrdiff_t>(row), b);
        }
    };
    if (image.type() == PixelType::F32)
        flip(image.f32());
    else
        flip(image.u8());
}

} // namespace patina::render
