// A frame in slices: it is drawn piece by piece into targets of its own, between other work, up to
// the finished picture with its overlays. Showing it is one copy.
#include "render/ViewRendererImpl.h"

#include "core/base/Check.h"

#include <algorithm>
#include <chrono>
#include <epoxy/gl.h>
#include <utility>

namespace patina::render {
namespace {

using Clock = std::chrono::steady_clock;
using Stage = FrameStage;

// What a tile costs that shows nothing but sky, of what one costs that surfaces fill.
constexpr float kSkyCost = 0.1f;

} // namespace

bool ViewRenderer::Impl::isBegun(const FrameSettings& frame) const {
    return next.begun && next.revision == revision(frame) && showSameScene(next.frame, frame);
}

bool ViewRenderer::isPrepared(const FrameSettings& frame) const {
    const Impl& r = *m_impl;
    if (!r.isBegun(frame) || r.next.stage != Stage::Done)
        return false;
    // The sides of a split cannot be displayed anew: the next frame follows.
    return r.next.sides.size() > 1 || !r.displaysAnew(frame);
}

bool ViewRenderer::preparesPicture(const FrameSettings& frame) const {
    return m_impl->isBegun(frame) && m_impl->next.stage > Stage::Measure;
}

bool ViewRenderer::isCurrent(const FrameSettings& frame) const {
    const Impl& r = *m_impl;
    if (r.targets.width() == 0 || r.sceneIsNew(frame))
        return false;
    FrameSettings last = r.lastFrame;
    const bool isWholeMean = accumulatedFrames() == steadyFrames(r.lastFrame.camera);
    if (!frame.accumulate || isWholeMean)
        last.accumulate = frame.accumulate;
    if (frame.view.split && (!showSameOverlays(frame, last) || frame.view.flags != last.view.flags))
        return false;
    return showSameScene(frame, last) &&
           (!frame.accumulate || isWholeMean || Impl::framesWith(frame, r.targets, 0) == 0);
}

void ViewRenderer::Impl::swapWithNext() {
    std::swap(targets, next.targets);
    std::swap(accumulated, next.accumulated);
    std::swap(lastBlock, next.block);
    std::swap(ranges, next.ranges);
}

void ViewRenderer::Impl::takePrepared() {
    std::swap(targets, next.targets);
    accumulated = next.accumulated;
    lastBlock = next.block;
    ranges = next.ranges;
    luminanceIsNew = next.luminanceIsNew;
    shownRevision = revision(next.frame);
    drawnRevision = shared.revision(next.frame);
    next.begun = false;
    next.hasMeans = false;
    if (accumulated == 0 || accumulated >= steadyFrames(next.frame.camera))
        next.targets = {}; // at rest the memory is others'
}

// Tiles where the last frame, which may have other pixels, shows surfaces, and others.
std::vector<float> ViewRenderer::Impl::costsOfTiles(const FrameSettings& frame) {
    const int columns = FrameSlicer::tiles(frame.width), rows = FrameSlicer::tiles(frame.height);
    const auto count = static_cast<std::size_t>(columns * rows);
    if (tileCosts.size() == count && tileCamera == frame.camera)
        return tileCosts;
    tileCamera = frame.camera;
    tileCosts.assign(count, 1.0f);
    if (targets.width() == 0 || lastFrame.camera != frame.camera)
        return tileCosts; // nothing is known of it
    const std::vector<float> depth = targets.depth().readFloats(1);
    const int width = targets.width(), height = targets.height();
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto along = [](int tile, int pixels, int from) {
                const int at = static_cast<int>(static_cast<std::int64_t>(tile) *
                                                FrameSlicer::kTile * from / pixels);
                return std::min(at, from);
            };
            int surfaces = 0, all = 0;
            for (int y = along(row, frame.height, height); y < along(row + 1, frame.height, height);
                 ++y)
                for (int x = along(column, frame.width, width);
                     x < along(column + 1, frame.width, width); ++x) {
                    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x);
                    surfaces += depth[at] < 1.0f ? 1 : 0;
                    ++all;
                }
            const float covered =
                all > 0 ? static_cast<float>(surfaces) / static_cast<float>(all) : 1.0f;
            tileCosts[static_cast<std::size_t>(row * columns + column)] =
                kSkyCost + (1.0f - kSkyCost) * covered;
        }
    return tileCosts;
}

Result<void> ViewRenderer::Impl::beginPreparing(const FrameSettings& frame, double budgetMs,
                                                double expectedMs) {
    const bool continues = !sceneIsNew(frame) && !next.hasMeans && showSameScene(frame, lastFrame);
    if (auto sized = next.targets.resize(shared.context, frame.width, frame.height, frame.samples,
                                         frame.floats);
        !sized)
        return sized;
    ++shared.scenes;
    if (auto done = shared.shadows.update(shared.scene); !done)
        return done;
    next.accumulated = framesWith(frame, next.targets, continues ? accumulated : 0);
    if (next.accumulated > 1) {
        next.targets.takeMeans(targets);
        next.hasMeans = true;
    }
    next.frame = frame;
    next.block = shared.packFrame(frame);
    next.revision = revision(frame);
    next.ranges = {};
    next.luminanceIsNew = luminanceIsNew;
    next.hasMask = false;
    next.sides = sidesOf(frame);
    next.side = 0;
    next.budgetMs = budgetMs;
    next.expectedMs = expectedMs / static_cast<double>(next.sides.size());
    swapWithNext();
    shared.useFrame(lastBlock);
    Result<void> done = meetLuminance(frame);
    swapWithNext();
    shared.useFrame(lastBlock);
    beginStage(Stage::Scene);
    next.begun = true;
    return done;
}

// --- Stages --------------------------------------------------------------------------------------

void ViewRenderer::Impl::beginStage(Stage stage) {
    next.stage = stage;
    if (stage == Stage::Picture)
        next.eye = adaptation.revision();
    if (stage == Stage::Scene)
        next.slicer.begin(next.frame.width, next.frame.height, costsOfTiles(next.frame),
                          next.expectedMs, next.budgetMs);
    else if (stage != Stage::Done)
        next.band().begin(next.frame.height);
}

bool ViewRenderer::Impl::needsStage() const {
    const ViewChoice& choice = next.sides[next.side].choice;
    const FrameSettings& frame = next.frame;
    const bool radiance = hasRadiance(frame, choice);
    const bool overlays = frame.showOverlays && !isStretched(frame);
    switch (next.stage) {
    case Stage::Measure:
        return !radiance || (frame.view.isOrdinary(choice) && wantsLuminance(frame));
    case Stage::Wires:
        return radiance && choice.kind == shading::kViewWireframe;
    case Stage::Mask:
        return overlays && frame.selectedMesh != 0;
    case Stage::Overlays:
        return overlays;
    case Stage::Scene:
    case Stage::Picture:
    case Stage::Done:
        break;
    }
    return true;
}

// The range of numbers is found, and the outline's mask drawn, in one piece.
bool ViewRenderer::Impl::hasBands() const {
    if (next.stage == Stage::Measure)
        return hasRadiance(next.frame, next.sides[next.side].choice);
    return next.stage != Stage::Mask;
}

void ViewRenderer::Impl::advanceStage() {
    do {
        if (next.stage == Stage::Wires && next.side + 1 < next.sides.size()) {
            ++next.side;
            beginStage(Stage::Scene);
        } else {
            beginStage(static_cast<Stage>(static_cast<int>(next.stage) + 1));
        }
    } while (!needsStage());
}

bool ViewRenderer::Impl::displaysAnew(const FrameSettings& frame) const {
    return !showSameOverlays(frame, next.frame) ||
           (needsLuminance(shared.lookOf(frame)) && next.eye != adaptation.revision());
}

void ViewRenderer::Impl::followDisplay(const FrameSettings& frame) {
    if (next.stage < Stage::Picture || !displaysAnew(frame)) {
        next.frame = withOverlaysOf(next.frame, frame);
    } else if (next.sides.size() == 1) {
        next.frame = withOverlaysOf(next.frame, frame);
        beginStage(Stage::Picture);
    }
}

// Into what is shown: the targets are those of the frame that is prepared.
Result<void> ViewRenderer::Impl::drawStage(SceneSlice& drawn) {
    const FrameSettings& frame = next.frame;
    const Side& side = next.sides[next.side];
    switch (next.stage) {
    case Stage::Scene: {
        slice = &drawn;
        Result<void> done = drawScene(frame, side.choice, side.index);
        slice = nullptr;
        return done;
    }
    case Stage::Measure:
        if (!hasBands())
            return measureSide(frame, side);
        if (auto done = adaptation.measure(targets, drawn.rect.y, drawn.rect.w); !done)
            return done;
        if (drawn.rect.y + drawn.rect.w < frame.height)
            return {};
        next.luminanceIsNew = false;
        return adaptToMeasured(frame);
    case Stage::Picture:
        return displaySide(frame, side);
    case Stage::Wires:
        return drawWires(frame, side);
    case Stage::Mask:
        next.hasMask = true;
        return overlay.drawMask(Canvas::of(targets), shared.scene, overlaySettings(frame));
    case Stage::Overlays:
        adaptation.bind();
        if (!next.hasMask) { // the frame that is shown has drawn its own since
            glDisable(GL_SCISSOR_TEST);
            next.hasMask = true;
            if (auto done =
                    overlay.drawMask(Canvas::of(targets), shared.scene, overlaySettings(frame));
                !done)
                return done;
            glEnable(GL_SCISSOR_TEST);
        }
        return overlay.drawLines(Canvas::of(targets), targets, shared.scene, lastBlock,
                                 frame.camera, overlaySettings(frame));
    case Stage::Done:
        break;
    }
    return {};
}

Result<void> ViewRenderer::Impl::prepareSlice() {
    const Clock::time_point begun = Clock::now();
    const bool ofScene = next.stage == Stage::Scene;
    SceneSlice drawn;
    if (ofScene)
        drawn = next.slicer.slice();
    else
        drawn.rect = {0, next.band().first(), next.frame.width, next.band().rows()};
    swapWithNext();
    shared.useFrame(lastBlock);
    if (ofScene || hasBands()) {
        glScissor(drawn.rect.x, drawn.rect.y, drawn.rect.z, drawn.rect.w);
        glEnable(GL_SCISSOR_TEST);
    }
    Result<void> done = drawStage(drawn);
    glDisable(GL_SCISSOR_TEST);
    swapWithNext();
    shared.useFrame(lastBlock);
    glFinish(); // so that the time is the slice's, not that of the calls
    if (!done)
        return done;
    const double milliseconds =
        std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    if (ofScene)
        next.slicer.took(milliseconds, drawn);
    else if (hasBands())
        next.band().took(milliseconds, next.budgetMs);
    const Side& side = next.sides[next.side];
    if (ofScene && next.slicer.done() && hasRadiance(next.frame, side.choice))
        next.luminanceIsNew = next.frame.view.isOrdinary(side.choice);
    if (ofScene ? next.slicer.done() : !hasBands() || next.band().done())
        advanceStage();
    return {};
}

Result<bool> ViewRenderer::prepare(const FrameSettings& frame, double budgetMs, double expectedMs) {
    Impl& r = *m_impl;
    if (isPrepared(frame))
        return true;
    const bool begun = r.isBegun(frame);
    if (begun)
        r.followDisplay(frame);
    const Impl::GlScope scope(r.shared);
    Result<void> done = begun ? r.prepareSlice() : r.beginPreparing(frame, budgetMs, expectedMs);
    if (!done) {
        r.next.begun = false;
        return done.error();
    }
    return isPrepared(frame);
}

} // namespace patina::render
