// What the sides of a frame show: the picture, or views of the shading equation's terms.
#include "render/ViewRendererImpl.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace patina::render {
namespace {

using namespace shading;

// A frame moved by a fraction of a pixel, the first one by none: the points of the R2 sequence
// (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences") fill a pixel evenly.
glm::mat4 besideBy(int frame, int width, int height, const glm::mat4& worldToClip) {
    const auto offset = [&](double step) { // -0.5 … 0.5 pixel
        const double x = 0.5 + step * frame;
        return static_cast<float>(x - std::floor(x) - 0.5);
    };
    const glm::vec3 clip(2.0f * offset(0.7548776662466927) / static_cast<float>(width),
                         2.0f * offset(0.5698402909980532) / static_cast<float>(height), 0.0f);
    return glm::translate(glm::mat4(1.0f), clip) * worldToClip;
}

// Points of the unit disc, each in the middle of as much of it, kLensFrames in all: a sunflower
// (Vogel 1979, "A Better Way to Construct the Sunflower Head"), from which an odd step takes them
// so that a few are spread as well.
glm::vec2 lensPoint(int frame) {
    constexpr int kCount = ViewRenderer::kLensFrames, kStep = 37;
    constexpr double kGoldenAngle = 2.399963229728653;
    static_assert((kCount & (kCount - 1)) == 0 && kStep % 2 == 1);
    const int k = frame * kStep % kCount;
    const double radius = std::sqrt((k + 0.5) / kCount);
    return {static_cast<float>(radius * std::cos(kGoldenAngle * k)),
            static_cast<float>(radius * std::sin(kGoldenAngle * k))};
}

// With the sky behind: what is made of the whole picture.
bool hasBackground(const ViewChoice& choice) {
    return choice.mode == ViewMode::Raw && viewInfo(choice.kind).recorded == kViewFinal;
}

} // namespace

bool ViewSettings::isOrdinary(const ViewChoice& choice) const {
    const bool allTerms = std::all_of(terms.begin(), terms.end(), [](bool on) { return on; });
    return allTerms && !furnace && choice.mode == ViewMode::Raw &&
           viewInfo(choice.kind).recorded == kViewFinal && choice.kind != kViewFlat;
}

Result<void> ViewRenderer::Impl::drawRadiance(const FrameSettings& frame, const ViewChoice& choice,
                                              std::size_t sideIndex) {
    if (accumulated > ViewRenderer::steadyFrames(frame.camera)) {
        if (slice)
            slice->complete = true;
        return shared.screen.showMean(targets, sideIndex);
    }
    const bool ordinary = frame.view.isOrdinary(choice);
    if (frame.radiance && ordinary) {
        targets.setLinear(*frame.radiance);
        if (slice)
            slice->complete = true;
        return {};
    }
    shared.views.setBlock(shared.viewsBlock(frame.view, std::span(&choice, 1), !targets.floats()));
    FrameBlock block = lastBlock;
    const bool hasLens = accumulated > 0 && frame.camera.lensRadius() > 0.0f;
    if (hasLens) {
        const glm::vec2 onLens = frame.camera.lensRadius() * lensPoint(accumulated - 1);
        const auto width = static_cast<float>(frame.width),
                   height = static_cast<float>(frame.height);
        block.worldToClip = frame.camera.worldToClip(width / height, shared.scene.bounds(), onLens);
        block.cameraPosition = glm::vec4(frame.camera.position(onLens), 1.0f);
    }
    if (accumulated > 1 || hasLens) {
        block.worldToClip = besideBy(accumulated - 1, frame.width, frame.height, block.worldToClip);
        block.clipToWorld = glm::inverse(block.worldToClip);
        shared.useFrame(block);
    }
    SceneDraw drawing =
        drawingOf(frame, block, targets.scene(),
                  ordinary ? SurfaceOutput::Picture : SurfaceOutput::OneView, choice.kind);
    drawing.withBackground = hasBackground(choice);
    drawing.floats = targets.floats();
    if (auto done = shared.drawPicture(drawing); !done)
        return done;
    if (accumulated > 1 || hasLens)
        shared.useFrame(lastBlock);
    if (slice && !slice->complete)
        return {};
    targets.resolve();
    if (accumulated == 0)
        return {};
    return shared.screen.accumulate(shared.context, targets, sideIndex, accumulated);
}

Result<void> ViewRenderer::Impl::drawScene(const FrameSettings& frame, const ViewChoice& choice,
                                           std::size_t sideIndex) {
    const bool empty = shared.isEmpty(frame, choice.kind);
    if (!empty && showsRadiance(choice))
        return drawRadiance(frame, choice, sideIndex);
    const auto target = targets.dataTarget(shared.context);
    if (!target)
        return target.error();
    const ViewChoice shape{kViewNoV, ViewMode::Raw, {}};
    const ViewChoice& drawn = empty ? shape : choice;
    return shared.drawNumbers(drawingOf(frame, lastBlock, **target, SurfaceOutput::OneView,
                                        empty ? kViewFinal : choice.kind),
                              shared.viewsBlock(frame.view, std::span(&drawn, 1), false),
                              !empty && blends(choice));
}

std::vector<ViewRenderer::Impl::Side> ViewRenderer::Impl::sidesOf(const FrameSettings& frame) {
    const std::optional<ViewSplit>& split = frame.view.split;
    if (!split)
        return {Side{frame.view.shown, glm::vec3(0.0f), 0, false}};
    const glm::vec3 right = rightSide(*split, frame.width, frame.height);
    const auto index = [](const glm::vec3& plane) -> std::size_t { return plane.x < 0.0f ? 1 : 0; };
    return {Side{split->other, right, index(right), true},
            Side{frame.view.shown, -right, index(-right), false}};
}

bool ViewRenderer::Impl::hasRadiance(const FrameSettings& frame, const ViewChoice& choice) const {
    return showsRadiance(choice) && !shared.isEmpty(frame, choice.kind);
}

Result<void> ViewRenderer::Impl::measureSide(const FrameSettings& frame, const Side& side) {
    const ViewChoice& choice = side.choice;
    // The eye is used to the picture, not to one of its terms.
    if (hasRadiance(frame, choice))
        return frame.view.isOrdinary(choice) ? adapt(frame) : Result<void>();
    if (const auto target = targets.dataTarget(shared.context); !target)
        return target.error();
    if (shared.isEmpty(frame, choice.kind))
        return {};
    const auto range = shared.rangeFor(choice, targets.data());
    if (!range)
        return range.error();
    ranges.side = *range;
    if (viewInfo(choice.kind).value == ViewValue::Scalar || choice.kind == kViewLuminance)
        (side.isOther ? ranges.other : ranges.shown) = *range;
    return {};
}

Result<void> ViewRenderer::Impl::displaySide(const FrameSettings& frame, const Side& side) {
    const ViewChoice& choice = side.choice;
    const ViewInfo& info = viewInfo(choice.kind);
    const View& look = shared.lookOf(frame);
    adaptation.bind();
    if (hasRadiance(frame, choice))
        return shared.screen.toneMap(
            targets.linear(), targets.display(), look,
            {.dither = frame.dither,
             .scale = choice.mode == ViewMode::Raw ? info.displayScale : 1.0f,
             .fillEmpty = !hasBackground(choice),
             .markClipped = choice.kind == kViewClipped,
             .side = side.plane});
    if (shared.isEmpty(frame, choice.kind))
        return shared.views.showEmpty(targets.data(), side.plane, targets.display());
    return shared.views.show(targets.data(), info, ranges.side, look, side.plane, frame.view.flags,
                             targets.display());
}

Result<void> ViewRenderer::Impl::drawWires(const FrameSettings& frame, const Side& side) {
    if (side.choice.kind != kViewWireframe || !hasRadiance(frame, side.choice))
        return {};
    return wires.draw(
        makeDrawList(shared.scene.items(shared.lightingFor(frame, side.choice.kind), frame.light),
                     lastBlock.worldToClip, frame.camera.position()),
        side.plane, frame.width, frame.height, targets.display());
}

// Exposure follows the whole picture, even where only a term of it is shown.
Result<void> ViewRenderer::Impl::meetLuminance(const FrameSettings& frame) {
    if (!needsLuminance(shared.lookOf(frame)) || luminanceKnown ||
        frame.view.isOrdinary(frame.view.shown))
        return {};
    SceneDraw picture = drawingOf(frame, lastBlock, targets.scene(), SurfaceOutput::Picture);
    picture.withBackground = true;
    picture.floats = targets.floats();
    if (auto done = shared.drawPicture(picture); !done)
        return done;
    targets.resolve();
    luminanceIsNew = true;
    return adapt(frame);
}

Result<void> ViewRenderer::Impl::drawViews(const FrameSettings& frame, bool drawsScene) {
    ranges = {};
    if (auto done = meetLuminance(frame); !done)
        return done;
    for (const Side& side : sidesOf(frame)) {
        if (drawsScene || frame.view.split) {
            if (auto done = drawScene(frame, side.choice, side.index); !done)
                return done;
            if (hasRadiance(frame, side.choice))
                luminanceIsNew = frame.view.isOrdinary(side.choice);
        }
        auto done = measureSide(frame, side);
        if (done)
            done = displaySide(frame, side);
        if (done)
            done = drawWires(frame, side);
        if (!done)
            return done;
    }
    return {};
}

} // namespace patina::render
