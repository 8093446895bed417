#include "render/RendererImpl.h"

#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/document/Lighting.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <glm/matrix.hpp>
#include <utility>

namespace patina::render {

FrameBlock Renderer::Impl::packFrame(const FrameSettings& frame) {
    const auto width = static_cast<float>(frame.width), height = static_cast<float>(frame.height);
    FrameBlock block;
    block.worldToClip =
        frame.camera.projectionMatrix(width / height, scene.bounds()) * frame.camera.viewMatrix();
    block.clipToWorld = glm::inverse(block.worldToClip);
    block.cameraPosition = glm::vec4(frame.camera.position(), 1.0f);
    block.viewport = {width, height, 1.0f / width, 1.0f / height};
    scene.fill(block, shadows.lights());
    if (block.lightEnds.w > kUniformLights)
        scene.setManyLights(shadows.lights());
    if (frame.view.furnace)
        block.lightEnds = glm::ivec4(0);
    return block;
}

LightingMode Renderer::Impl::lightingFor(const ViewSettings& view, ViewKind kind) const {
    return lightingOf(kind, view.lighting.value_or(scene.document().view.lighting));
}

void Renderer::Impl::useFrame(const FrameBlock& block) {
    frameBlock.writeValue(block);
    frameBlock.bindUniform(kFrameBinding);
    scene.manyLights().bind();
}

SurfaceSettings Renderer::Impl::surfaceSettings(const FrameBlock& block, SurfaceOutput output,
                                                LightingMode lighting) const {
    return {lighting,
            block.lightEnds.y > 0,
            block.lightEnds.w > block.lightEnds.y,
            block.lightEnds,
            static_cast<int>(shadows.lights().size()),
            scene.document().model,
            output};
}

Result<void> Renderer::Impl::drawPicture(const FrameSettings& frame, const FrameBlock& block,
                                         const gl::Framebuffer& target, SurfaceOutput output,
                                         bool withBackground, ViewKind kind) {
    const LightingMode lighting = lightingFor(frame.view, kind);
    if (auto done = relight.update(scene, lighting, block); !done)
        return done;
    const Document& document = scene.document();
    SurfaceSettings settings = surfaceSettings(block, output, lighting);
    settings.floats = targets.floats() || target.id() != targets.scene().id();
    if (frame.coarse)
        settings.coarseView = block.worldToClip;
    shadows.bind();
    const DrawList list = visibleItems(block, frame.camera.position());
    settings.clip = sliceClip(block);
    const std::uint64_t opaque = triangleCount(list.opaque, settings.clip);
    const std::uint64_t all = opaque + triangleCount(list.blended, settings.clip);
    if (slice) {
        settings.triangles = slice->triangles;
        slice->shown = all;
        slice->complete = slice->triangles.end() > all;
    }

    target.bind();
    const std::optional<glm::vec3>& furnace = frame.view.furnace;
    const BackgroundMode background =
        furnace ? BackgroundMode::Color : document.environment.background;
    const bool transparent =
        !withBackground || frame.transparentBackground || background == BackgroundMode::Off;
    const glm::vec3 clear = transparent || background != BackgroundMode::Color ? glm::vec3(0.0f)
                            : furnace                                          ? *furnace
                                      : document.environment.backgroundColor;
    if (settings.triangles.first == 0) {
        target.clearColor(clear.r, clear.g, clear.b, transparent ? 0.0f : 1.0f);
        target.clearDepth(1.0f);
    }

    if (auto done = surface.drawOpaque(scene, list, settings); !done)
        return done;
    // The sky comes behind the last opaque triangle.
    TriangleRange& triangles = settings.triangles;
    if (triangles.end() <= opaque)
        return {};
    if (!transparent && triangles.first <= opaque)
        if (auto done = screen.drawSky(scene.environment(), background,
                                       document.environment.backgroundBlur, settings.floats);
            !done)
            return done;
    const std::uint64_t first = std::max(triangles.first, opaque);
    triangles = {first - opaque, triangles.end() - first};
    return surface.drawBlended(scene, list, settings);
}

bool Renderer::Impl::wantsLuminance(const FrameSettings& frame) const {
    return needsLuminance(scene.document().view) || frame.measureLuminance;
}

// What exposure needs to know of the picture, where it or the caller asks for it.
Result<void> Renderer::Impl::adapt(const FrameSettings& frame) {
    if (!wantsLuminance(frame))
        return {};
    if (luminanceIsNew)
        if (auto done = adaptation.measure(targets); !done)
            return done;
    luminanceIsNew = false;
    return adaptToMeasured(frame);
}

Result<void> Renderer::Impl::adaptToMeasured(const FrameSettings& frame) {
    luminanceKnown = true;
    return adaptation.adapt(scene.document().view.exposureMode == ExposureMode::Automatic
                                ? frame.adaptSeconds
                                : std::numeric_limits<float>::infinity());
}

Renderer::Renderer(std::unique_ptr<Impl> impl)
    : m_impl(std::move(impl)) {}

Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(gl::Context& context,
                                                   const std::filesystem::path& shaderFolder) {
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
    if (auto done = impl->adaptation.compile(); !done)
        return done.error();
    return std::unique_ptr<Renderer>(new Renderer(std::move(impl)));
}

void Renderer::setDocument(const Document& document) {
    if (m_impl->scene.update(document).any())
        m_impl->setChanged();
}

void Renderer::setEnvironment(const EnvironmentTexels& texels) {
    m_impl->scene.environment().set(texels);
    m_impl->setChanged();
}

void Renderer::setIbl(const IblMaps& maps) {
    m_impl->scene.environment().setIbl(maps);
    m_impl->setChanged();
}

void Renderer::beginEnvironment(EnvironmentTexelsPtr texels) {
    m_impl->scene.environment().begin(std::move(texels));
}

void Renderer::setProjection(const ImagePtr& image, const ProjectionSh& coefficients) {
    m_impl->scene.environment().setProjection(image, coefficients);
    m_impl->setChanged();
}

bool Renderer::knowsProjection(const ImagePtr& image) const {
    return m_impl->scene.environment().knowsProjection(image);
}

std::vector<glm::vec3> Renderer::transferLight(int order) const {
    return m_impl->scene.transferLight(order);
}

bool Renderer::proceedEnvironment(std::size_t bytes) {
    const bool done = m_impl->scene.environment().proceed(bytes);
    if (done)
        m_impl->setChanged();
    return done;
}

Result<void> Renderer::setDisplay(const DisplayTransformPtr& display) {
    m_impl->screen.setDisplay(std::nullopt);
    ++m_impl->revision;
    if (!display)
        return {};
    auto program = DisplayProgram::create(m_impl->context, *display);
    if (!program)
        return program.error();
    m_impl->screen.setDisplay(std::move(*program));
    return {};
}

void Renderer::previewVertices(BakeKind kind, Id mesh, int stride, std::span<const float> values) {
    m_impl->scene.previewVertices(kind, mesh, stride, values);
    m_impl->setChanged();
}

void Renderer::previewTexels(Id material, int size, std::span<const float> values) {
    m_impl->scene.previewTexels(material, size, values);
    m_impl->setChanged();
}

void Renderer::setBouncedLight(Id mesh, std::span<const glm::vec3> radiance) {
    m_impl->scene.setBouncedLight(mesh, radiance);
    m_impl->setChanged();
}

void Renderer::setNearShadows(const NearShadowsPtr& shadows) {
    m_impl->scene.setNearShadows(shadows);
    m_impl->setChanged();
}

bool Renderer::takeNearShadowUse() {
    return m_impl->relight.takeNearUse();
}

void Renderer::clearBouncedLight() {
    m_impl->scene.clearBouncedLight();
    m_impl->setChanged();
}

void Renderer::clearPreview() {
    m_impl->scene.clearPreview();
    m_impl->setChanged();
}

Renderer::Impl::GlScope::GlScope(const Impl& renderer, unsigned targetFramebuffer)
    : m_renderer(renderer)
    , m_targetFramebuffer(targetFramebuffer) {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glCullFace(GL_BACK);
    glEnable(GL_MULTISAMPLE);
}

Renderer::Impl::GlScope::~GlScope() {
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

// Overlays are as fine as what they are shown on, however coarse the picture below them is.
Result<void> Renderer::Impl::show(const FrameSettings& frame, bool overlaysDrawn,
                                  unsigned targetFramebuffer) {
    const OverlaySettings settings = overlaySettings(frame);
    adaptation.bind();
    if (!isStretched(frame)) {
        Result<void> done;
        if (frame.showOverlays && !overlaysDrawn) {
            next.hasMask = false;
            done = overlay.draw(Canvas::of(targets), targets, scene, lastBlock, frame.camera,
                                settings);
        }
        return done ? screen.present(targets, Canvas::window(targets, targetFramebuffer)) : done;
    }
    const Canvas canvas{targetFramebuffer, frame.shownWidth, frame.shownHeight};
    if (auto done = screen.present(targets, canvas); !done || !frame.showOverlays)
        return done;
    FrameSettings fine = frame;
    fine.width = frame.shownWidth;
    fine.height = frame.shownHeight;
    const FrameBlock block = packFrame(fine);
    useFrame(block);
    next.hasMask = false;
    Result<void> done = overlay.draw(canvas, targets, scene, block, frame.camera, settings);
    useFrame(lastBlock);
    return done;
}

bool isStretched(const FrameSettings& frame) {
    return frame.shownWidth > 0 &&
           (frame.shownWidth != frame.width || frame.shownHeight != frame.height);
}

bool showSameScene(const FrameSettings& a, const FrameSettings& b) {
    ViewSettings view = a.view;
    view.flags = b.view.flags; // marks are drawn over the numbers
    return a.width == b.width && a.height == b.height && a.samples == b.samples &&
           a.floats == b.floats && a.coarse == b.coarse && a.accumulate == b.accumulate &&
           a.camera == b.camera && a.transparentBackground == b.transparentBackground &&
           view == b.view;
}

bool showSameOverlays(const FrameSettings& a, const FrameSettings& b) {
    return isStretched(a) == isStretched(b) && a.showOverlays == b.showOverlays &&
           a.selectedMesh == b.selectedMesh && a.selectedLight == b.selectedLight &&
           a.lobe == b.lobe && a.overlayScale == b.overlayScale;
}

FrameSettings withOverlaysOf(const FrameSettings& frame, const FrameSettings& other) {
    FrameSettings result = frame;
    result.showOverlays = other.showOverlays;
    result.selectedMesh = other.selectedMesh;
    result.selectedLight = other.selectedLight;
    result.lobe = other.lobe;
    result.overlayScale = other.overlayScale;
    return result;
}

FrameSettings Renderer::Impl::kept(const FrameSettings& wanted) const {
    FrameSettings frame = wanted;
    frame.width = lastFrame.width;
    frame.height = lastFrame.height;
    frame.samples = lastFrame.samples;
    frame.accumulate = lastFrame.accumulate;
    frame.floats = lastFrame.floats;
    frame.coarse = lastFrame.coarse;
    frame.dither = lastFrame.dither;
    frame.transparentBackground = lastFrame.transparentBackground;
    frame.camera = lastFrame.camera;
    frame.view = lastFrame.view;
    if (!lastFrame.view.split)
        frame.view.flags = wanted.view.flags;
    else if (!isStretched(frame)) // the overlays are part of what is displayed, too
        frame = withOverlaysOf(frame, lastFrame);
    return frame;
}

bool Renderer::Impl::isDisplayed(const FrameSettings& frame) const {
    if (frame.view.split)
        return true; // only one of its sides is there to be displayed anew
    const bool eyeRests =
        !needsLuminance(scene.document().view) && !(frame.measureLuminance && luminanceIsNew);
    return eyeRests && shownRevision == revision && frame.view.flags == lastFrame.view.flags &&
           showSameOverlays(frame, lastFrame);
}

Result<void> Renderer::render(const FrameSettings& wanted, unsigned targetFramebuffer) {
    Impl& r = *m_impl;
    FrameSettings frame = wanted;
    const bool keeps = frame.keepPicture && r.targets.width() > 0;
    if (keeps)
        frame = r.kept(wanted);
    const bool prepared = !keeps && isPrepared(frame);
    if (prepared) {
        frame = r.next.frame;
        frame.shownWidth = wanted.shownWidth;
        frame.shownHeight = wanted.shownHeight;
    }
    // What is displayed is what it would become.
    const bool displayed = prepared || (keeps && r.isDisplayed(frame));
    const bool continues = !r.sceneIsNew && showSameScene(frame, r.lastFrame) && !r.next.hasMeans;
    // Nor does a frame that reuses its scene draw another camera's.
    FrameSettings moved = frame;
    moved.camera = r.lastFrame.camera;
    if (!showSameScene(moved, r.lastFrame))
        r.sceneIsNew = true;
    r.lastFrame = frame;
    if (prepared)
        r.takePrepared();
    else if (!displayed)
        r.shownRevision = r.revision;
    if (auto sized =
            r.targets.resize(r.context, frame.width, frame.height, frame.samples, frame.floats);
        !sized)
        return sized;
    const Impl::GlScope scope(r, targetFramebuffer);

    const bool drawsScene =
        !keeps && !prepared && (r.sceneIsNew || !frame.reuseScene || frame.view.split);
    if (drawsScene) {
        if (auto done = r.shadows.update(r.scene); !done)
            return done;
        const bool accumulates = frame.accumulate && r.targets.samples() == 1;
        r.accumulated =
            accumulates ? std::min(continues ? r.accumulated + 1 : 1, kSteadyFrames + 1) : 0;
        r.next.hasMeans = r.next.hasMeans && r.accumulated != 1;
    }
    if (!prepared)
        r.lastBlock = r.packFrame(frame);
    r.useFrame(r.lastBlock);

    Result<void> done = displayed ? Result<void>() : r.drawViews(frame, drawsScene);
    if (drawsScene)
        r.sceneIsNew = !done.ok();
    if (done)
        done = r.show(frame, displayed, targetFramebuffer);
    return done;
}

int Renderer::accumulatedFrames() const {
    return std::min(m_impl->accumulated, kSteadyFrames);
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

Image Renderer::readLinear() {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::F32, ColorEncoding::Linear);
    const auto values = targets.linear().readFloats(4);
    std::copy(values.begin(), values.end(), image.f32().begin());
    flipRows(image);
    return image;
}

Image Renderer::readDisplayed() {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::U8, ColorEncoding::Srgb);
    const auto bytes = targets.displayed().readBytes(4);
    std::copy(bytes.begin(), bytes.end(), image.u8().begin());
    flipRows(image);
    return image;
}

std::optional<Luminance> Renderer::luminance() {
    return m_impl->adaptation.poll();
}

bool Renderer::luminancePending() const {
    return m_impl->adaptation.pending();
}

std::optional<Luminance> Renderer::readLuminance() {
    return m_impl->adaptation.read();
}

Result<void> Renderer::prepareNearLights(LightingMode lighting) {
    Impl& r = *m_impl;
    CHECK(r.targets.width() > 0);
    LightBlock point, sphere, rectangle;
    point.place = sphere.place = rectangle.place = glm::vec4(0.0f, 0.0f, 2.0f, -1.0f);
    point.axis.w = 1.0f;
    sphere.axis.x = rectangle.axis.x = rectangle.side.y = 0.5f;
    FrameBlock block = r.lastBlock;
    block.lightEnds = {0, 1, 2, 3};
    block.lights[0] = point;
    block.lights[1] = sphere;
    block.lights[2] = rectangle;
    const Impl::GlScope scope(r);
    r.useFrame(block);
    Result<void> done = r.relight.update(r.scene, lighting, block);
    r.useFrame(r.lastBlock);
    r.setChanged();
    return done;
}

std::vector<ProgramKey> Renderer::programs() const {
    return m_impl->shaders.keys();
}

std::vector<std::string> Renderer::reloadShaders() {
    std::vector<std::string> messages = m_impl->shaders.reload();
    m_impl->setChanged();
    for (const std::string& message : messages)
        logError("{}", message);
    return messages;
}

Id Renderer::pick(int x, int y) {
    Impl& r = *m_impl;
    const int width = r.targets.width(), height = r.targets.height();
    if (x < 0 || y < 0 || x >= width || y >= height)
        return 0;
    r.frameBlock.bindUniform(kFrameBinding);
    const Result<Id> id =
        r.picking.pick(r.scene, r.lastBlock.worldToClip, width, height, x, height - 1 - y);
    glBindVertexArray(0);
    glUseProgram(0);
    if (id)
        return *id;
    logError("{}", id.error().text());
    return 0;
}

} // namespace patina::render
