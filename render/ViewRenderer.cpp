#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "render/ViewRendererImpl.h"

#include "core/base/Check.h"
#include "core/document/Lighting.h"

#include <algorithm>
#include <utility>

namespace patina::render {

ViewRenderer::ViewRenderer(SceneRenderer& scene)
    : m_impl(std::make_unique<Impl>(*scene.m_impl)) {}

ViewRenderer::~ViewRenderer() = default;

bool ViewRenderer::Impl::wantsLuminance(const FrameSettings& frame) const {
    return needsLuminance(shared.lookOf(frame)) || frame.measureLuminance;
}

// What exposure needs to know of the picture, where it or the caller asks for it.
Result<void> ViewRenderer::Impl::adapt(const FrameSettings& frame) {
    if (!wantsLuminance(frame))
        return {};
    if (luminanceIsNew)
        if (auto done = adaptation.measure(targets); !done)
            return done;
    luminanceIsNew = false;
    return adaptToMeasured(frame);
}

Result<void> ViewRenderer::Impl::adaptToMeasured(const FrameSettings& frame) {
    luminanceKnown = true;
    const View& look = shared.lookOf(frame);
    return adaptation.adapt(look.exposureMode == ExposureMode::Automatic
                                ? frame.adaptSeconds
                                : std::numeric_limits<float>::infinity(),
                            look.exposureMeter);
}

// Overlays are as fine as what they are shown on, however coarse the picture below them is.
Result<void> ViewRenderer::Impl::show(const FrameSettings& frame, bool overlaysDrawn,
                                      unsigned targetFramebuffer) {
    const OverlaySettings settings = overlaySettings(frame);
    adaptation.bind();
    if (!isStretched(frame)) {
        Result<void> done;
        if (frame.showOverlays && !overlaysDrawn) {
            next.hasMask = false;
            done = overlay.draw(Canvas::of(targets), targets, shared.scene, lastBlock, frame.camera,
                                settings);
        }
        if (!done || targetFramebuffer == kNowhere)
            return done;
        return shared.screen.present(targets, Canvas::window(targets, targetFramebuffer));
    }
    if (targetFramebuffer == kNowhere)
        return {};
    const Canvas canvas{targetFramebuffer, frame.shownWidth, frame.shownHeight};
    if (auto done = shared.screen.present(targets, canvas); !done || !frame.showOverlays)
        return done;
    FrameSettings fine = frame;
    fine.width = frame.shownWidth;
    fine.height = frame.shownHeight;
    const FrameBlock block = shared.packFrame(fine);
    shared.useFrame(block);
    next.hasMask = false;
    Result<void> done = overlay.draw(canvas, targets, shared.scene, block, frame.camera, settings);
    shared.useFrame(lastBlock);
    return done;
}

FrameSettings ViewRenderer::Impl::kept(const FrameSettings& wanted) const {
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
    frame.light = lastFrame.light;
    frame.look = lastFrame.look;
    frame.view = lastFrame.view;
    if (!lastFrame.view.split)
        frame.view.flags = wanted.view.flags;
    else if (!isStretched(frame)) // the overlays are part of what is displayed, too
        frame = withOverlaysOf(frame, lastFrame);
    return frame;
}

bool ViewRenderer::Impl::isDisplayed(const FrameSettings& frame) const {
    if (frame.view.split)
        return true; // only one of its sides is there to be displayed anew
    const bool eyeRests =
        !needsLuminance(shared.lookOf(frame)) && !(frame.measureLuminance && luminanceIsNew);
    return eyeRests && shownRevision == revision(frame) &&
           frame.view.flags == lastFrame.view.flags && showSameOverlays(frame, lastFrame);
}

bool ViewRenderer::Impl::isPlain(const FrameSettings& frame) const {
    return !frame.view.split && !frame.keepPicture && !frame.showOverlays &&
           frame.view.shown.kind != shading::kViewWireframe &&
           hasRadiance(frame, frame.view.shown) && !wantsLuminance(frame);
}

Result<void> ViewRenderer::render(const FrameSettings& frame, unsigned targetFramebuffer) {
    return render(frame, targetFramebuffer, false);
}

Result<bool> ViewRenderer::begin(const FrameSettings& frame) {
    if (auto done = render(frame, kNowhere, true); !done)
        return done.error();
    return !m_impl->unfinished;
}

Result<void> ViewRenderer::finish() {
    Impl& r = *m_impl;
    CHECK(r.unfinished.has_value());
    FrameSettings frame = r.lastFrame;
    frame.look = std::exchange(r.unfinished, std::nullopt);
    const Impl::GlScope scope(r.shared);
    return r.displaySide(frame, r.sidesOf(frame).front());
}

Result<void> ViewRenderer::render(const FrameSettings& wanted, unsigned targetFramebuffer,
                                  bool begins) {
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
    const bool continues =
        !r.sceneIsNew(frame) && showSameScene(frame, r.lastFrame) && !r.next.hasMeans;
    // Nor does a frame that reuses its scene draw another camera's.
    FrameSettings moved = frame;
    moved.camera = r.lastFrame.camera;
    if (!showSameScene(moved, r.lastFrame))
        r.drawnRevision = 0;
    r.lastFrame = frame;
    if (prepared)
        r.takePrepared();
    else if (!displayed)
        r.shownRevision = r.revision(frame);
    if (auto sized = r.targets.resize(r.shared.context, frame.width, frame.height, frame.samples,
                                      frame.floats);
        !sized)
        return sized;
    const Impl::GlScope scope(r.shared, targetFramebuffer == kNowhere ? 0 : targetFramebuffer);

    const bool drawsScene =
        !keeps && !prepared && (r.sceneIsNew(frame) || !frame.reuseScene || frame.view.split);
    if (drawsScene) {
        ++r.shared.scenes;
        if (auto done = r.shared.shadows.update(r.shared.scene); !done)
            return done;
        r.accumulated = Impl::framesWith(frame, r.targets, continues ? r.accumulated : 0);
        r.next.hasMeans = r.next.hasMeans && r.accumulated != 1;
    }
    if (!prepared)
        r.lastBlock = r.shared.packFrame(frame);
    r.shared.useFrame(r.lastBlock);

    r.unfinished.reset();
    if (begins && drawsScene && r.isPlain(frame)) {
        Result<void> done = r.drawScene(frame, frame.view.shown, 0);
        r.drawnRevision = done ? r.shared.revision(frame) : 0;
        r.luminanceIsNew = frame.view.isOrdinary(frame.view.shown);
        if (done)
            r.unfinished = r.shared.lookOf(frame);
        return done;
    }
    Result<void> done = displayed ? Result<void>() : r.drawViews(frame, drawsScene);
    if (drawsScene)
        r.drawnRevision = done ? r.shared.revision(frame) : 0;
    if (done)
        done = r.show(frame, displayed, targetFramebuffer);
    return done;
}

Result<void> ViewRenderer::present(unsigned targetFramebuffer, const Presentation& how) const {
    const Impl& r = *m_impl;
    CHECK(r.targets.width() > 0);
    const Impl::GlScope scope(r.shared, targetFramebuffer);
    const PixelRectangle& part = how.part;
    const glm::vec3 side =
        how.split ? rightSide(*how.split, part.width, part.height) : glm::vec3(0.0f);
    return r.shared.screen.present(
        r.targets, {targetFramebuffer, part.width, part.height, part.x, part.y}, side, how.opacity);
}

void ViewRenderer::resume() {
    Impl& r = *m_impl;
    if (r.drawnRevision != 0)
        r.drawnRevision = r.shared.revision(r.lastFrame);
}

int ViewRenderer::accumulatedFrames() const {
    return std::min(m_impl->accumulated, steadyFrames(m_impl->lastFrame.camera));
}

int ViewRenderer::steadyFrames(const Camera& camera) {
    return camera.lensRadius() > 0.0f ? kLensFrames : kSteadyFrames;
}

bool ViewRenderer::isSteady() const {
    return m_impl->accumulated == 0 ||
           accumulatedFrames() == steadyFrames(m_impl->lastFrame.camera);
}

int ViewRenderer::Impl::framesWith(const FrameSettings& frame, const Targets& into, int before) {
    const bool accumulates =
        frame.accumulate && (into.samples() == 1 || frame.camera.lensRadius() > 0.0f);
    return accumulates ? std::min(before + 1, steadyFrames(frame.camera) + 1) : 0;
}

std::optional<Luminance> ViewRenderer::luminance() {
    return m_impl->adaptation.poll();
}

bool ViewRenderer::luminancePending() const {
    return m_impl->adaptation.pending();
}

std::optional<Luminance> ViewRenderer::readLuminance() {
    return m_impl->adaptation.read();
}

Result<void> ViewRenderer::prepareNearLights(LightingMode lighting) {
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
    const Impl::GlScope scope(r.shared);
    r.shared.useFrame(block);
    const Result<void> done = r.shared.relight.update(
        r.shared.scene, {lighting, r.lastFrame.light, r.shared.lookOf(r.lastFrame).bounces >= 0},
        block);
    r.shared.useFrame(r.lastBlock);
    return done;
}

} // namespace patina::render
