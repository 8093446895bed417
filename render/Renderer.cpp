#include "render/Renderer.h"

#include "core/base/Log.h"
#include "render/pass/AdaptationPass.h"
#include "render/pass/OverlayPass.h"
#include "render/pass/PickPass.h"
#include "render/pass/ScreenPasses.h"
#include "render/pass/ShadowPass.h"
#include "render/pass/SurfacePass.h"
#include "render/pass/Targets.h"
#include "render/scene/DrawList.h"
#include "render/scene/GpuScene.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <glm/matrix.hpp>

namespace patina::render {

struct Renderer::Impl {
    Impl(gl::Context& c, const std::filesystem::path& shaderFolder)
        : context(c)
        , shaders(c, shaderFolder)
        , scene(c)
        , shadows(c, shaders)
        , surface(shaders)
        , adaptation(c, shaders)
        , screen(c, shaders)
        , overlay(c, shaders, screen)
        , picking(c, shaders)
        , frameBlock(c, "frame", sizeof(FrameBlock)) {}

    gl::Context& context;
    ShaderLibrary shaders;
    GpuScene scene;
    ShadowPass shadows;
    SurfacePass surface;
    AdaptationPass adaptation;
    ScreenPasses screen;
    OverlayPass overlay;
    PickPass picking;
    gl::Buffer frameBlock;
    Targets targets;
    glm::mat4 worldToClip{1.0f}; // of the last frame
    int samples = 0;             // of the last frame
    bool sceneIsNew = true;      // something was set since the last frame
    bool luminanceIsNew = true;  // the last frame's scene has not been measured

    FrameBlock packFrame(const FrameSettings& frame);
    Result<void> drawScene(const FrameSettings& frame, const FrameBlock& block);
    Result<void> adapt(const FrameSettings& frame);
};

FrameBlock Renderer::Impl::packFrame(const FrameSettings& frame) {
    const auto width = static_cast<float>(frame.width), height = static_cast<float>(frame.height);
    FrameBlock block;
    block.worldToClip =
        frame.camera.projectionMatrix(width / height, scene.bounds()) * frame.camera.viewMatrix();
    block.clipToWorld = glm::inverse(block.worldToClip);
    block.cameraPosition = glm::vec4(frame.camera.position(), 1.0f);
    block.viewport = {width, height, 1.0f / width, 1.0f / height};
    scene.fill(block, shadows.lights());
    return block;
}

Result<void> Renderer::Impl::drawScene(const FrameSettings& frame, const FrameBlock& block) {
    const Document& document = scene.document();
    const SurfaceSettings settings{document.view.lighting,
                                   block.lightEnds.y > 0,
                                   block.lightEnds.w > block.lightEnds.y,
                                   block.lightEnds,
                                   static_cast<int>(shadows.lights().size()),
                                   document.model};
    shadows.bind();
    const DrawList list = makeDrawList(scene.items(), block.worldToClip, frame.camera.position());

    targets.scene().bind();
    const BackgroundMode background = document.environment.background;
    const bool transparent = frame.transparentBackground || background == BackgroundMode::Off;
    const glm::vec3 clear = transparent || background != BackgroundMode::Color
                                ? glm::vec3(0.0f)
                                : document.environment.backgroundColor;
    targets.scene().clearColor(clear.r, clear.g, clear.b, transparent ? 0.0f : 1.0f);
    targets.scene().clearDepth(1.0f);

    if (auto done = surface.drawOpaque(scene, list, settings); !done)
        return done;
    if (!transparent)
        if (auto done = screen.drawSky(scene.environment(), background,
                                       document.environment.backgroundBlur);
            !done)
            return done;
    if (auto done = surface.drawBlended(scene, list, settings); !done)
        return done;
    targets.resolve();
    return {};
}

// What exposure needs to know of the picture, where it or the caller asks for it.
Result<void> Renderer::Impl::adapt(const FrameSettings& frame) {
    const View& view = scene.document().view;
    adaptation.bind();
    if (!needsLuminance(view) && !frame.measureLuminance)
        return {};
    if (luminanceIsNew)
        if (auto done = adaptation.measure(targets); !done)
            return done;
    luminanceIsNew = false;
    return adaptation.adapt(view.exposureMode == ExposureMode::Automatic
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

void Renderer::setDocument(const Document& document, const Change& change) {
    m_impl->scene.update(document, change);
    m_impl->sceneIsNew = true;
}

void Renderer::setEnvironment(const EnvironmentTexels& texels) {
    m_impl->scene.environment().set(texels);
    m_impl->sceneIsNew = true;
}

void Renderer::setIbl(const IblMaps& maps) {
    m_impl->scene.environment().setIbl(maps);
    m_impl->sceneIsNew = true;
}

void Renderer::beginEnvironment(EnvironmentTexelsPtr texels) {
    m_impl->scene.environment().begin(std::move(texels));
}

bool Renderer::proceedEnvironment(std::size_t bytes) {
    const bool done = m_impl->scene.environment().proceed(bytes);
    m_impl->sceneIsNew |= done;
    return done;
}

Result<void> Renderer::setDisplay(const DisplayTransformPtr& display) {
    m_impl->screen.setDisplay(std::nullopt);
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
    m_impl->sceneIsNew = true;
}

void Renderer::previewTexels(Id material, int size, std::span<const float> values) {
    m_impl->scene.previewTexels(material, size, values);
    m_impl->sceneIsNew = true;
}

void Renderer::clearPreview() {
    m_impl->scene.clearPreview();
    m_impl->sceneIsNew = true;
}

Result<void> Renderer::render(const FrameSettings& frame, unsigned targetFramebuffer) {
    Impl& r = *m_impl;
    if (frame.width != r.targets.width() || frame.height != r.targets.height() ||
        frame.samples != r.samples)
        r.sceneIsNew = true;
    r.samples = frame.samples;
    if (auto sized = r.targets.resize(r.context, frame.width, frame.height, frame.samples); !sized)
        return sized;
    // The context may be shared with Qt, which leaves its own state behind.
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glCullFace(GL_BACK);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);

    const bool drawsScene = r.sceneIsNew || !frame.reuseScene;
    if (drawsScene)
        if (auto done = r.shadows.update(r.scene); !done)
            return done;
    const FrameBlock block = r.packFrame(frame);
    r.worldToClip = block.worldToClip;
    r.frameBlock.writeValue(block);
    r.frameBlock.bindUniform(kFrameBinding);

    Result<void> done;
    if (drawsScene) {
        done = r.drawScene(frame, block);
        r.sceneIsNew = !done.ok();
        r.luminanceIsNew = true;
    }
    if (done)
        done = r.adapt(frame);
    if (done)
        done = r.screen.toneMap(r.targets, r.scene.document().view, frame.dither);
    if (done && frame.showOverlays)
        done = r.overlay.draw(r.targets, r.scene, block, frame.camera,
                              {frame.selectedMesh, frame.selectedLight, frame.overlayScale});
    if (done)
        done = r.screen.present(r.targets, targetFramebuffer);

    glBindFramebuffer(GL_FRAMEBUFFER, targetFramebuffer);
    glBindVertexArray(0);
    glUseProgram(0);
    r.shadows.unbind();
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glFrontFace(GL_CCW);
    return done;
}

namespace {

// OpenGL's rows go from bottom to top.
template <class T>
void flipRows(std::span<T> values, std::size_t rowLength) {
    const std::size_t rows = values.size() / rowLength;
    for (std::size_t top = 0; top < rows / 2; ++top) {
        const auto a = values.begin() + static_cast<std::ptrdiff_t>(top * rowLength);
        const auto b = values.begin() + static_cast<std::ptrdiff_t>((rows - 1 - top) * rowLength);
        std::swap_ranges(a, a + static_cast<std::ptrdiff_t>(rowLength), b);
    }
}

} // namespace

Image Renderer::readLinear() {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::F32, ColorEncoding::Linear);
    const auto values = targets.linear().readFloats(4);
    std::copy(values.begin(), values.end(), image.f32().begin());
    flipRows(image.f32(), static_cast<std::size_t>(targets.width()) * 4);
    return image;
}

Image Renderer::readDisplayed() {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::U8, ColorEncoding::Srgb);
    const auto bytes = targets.displayed().readBytes(4);
    std::copy(bytes.begin(), bytes.end(), image.u8().begin());
    flipRows(image.u8(), static_cast<std::size_t>(targets.width()) * 4);
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

std::vector<std::string> Renderer::reloadShaders() {
    std::vector<std::string> messages = m_impl->shaders.reload();
    m_impl->sceneIsNew = true;
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
    const Result<Id> id = r.picking.pick(r.scene, r.worldToClip, width, height, x, height - 1 - y);
    glBindVertexArray(0);
    glUseProgram(0);
    if (id)
        return *id;
    logError("{}", id.error().text());
    return 0;
}

} // namespace patina::render
