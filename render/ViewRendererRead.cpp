// Looking at a frame that has been drawn: pixels, numbers of views, the explanation of a pixel.
#include "render/ViewRendererImpl.h"

#include "core/base/Check.h"
#include "core/base/Log.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <span>
#include <utility>

namespace patina::render {

using shading::kViewFinal;

Image ViewRenderer::readLinear() const {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::F32, ColorEncoding::Linear);
    const auto values = targets.linear().readFloats(4);
    std::copy(values.begin(), values.end(), image.f32().begin());
    flipRows(image);
    return image;
}

Image ViewRenderer::readDisplayed() const {
    const Targets& targets = m_impl->targets;
    if (targets.width() == 0)
        return {};
    Image image(targets.width(), targets.height(), 4, PixelType::U8, ColorEncoding::Srgb);
    const auto bytes = targets.displayed().readBytes(4);
    std::copy(bytes.begin(), bytes.end(), image.u8().begin());
    flipRows(image);
    return image;
}

Result<Image> ViewRenderer::Impl::readNumbers(const ViewSettings& view,
                                              const ViewChoice& choice) const {
    const int width = targets.width(), height = targets.height();
    CHECK(width > 0);
    ReadTargets& reading = shared.reading;
    if (auto sized = reading.resize(shared.context, width, height, targets.samples()); !sized)
        return sized.error();
    const bool asPicture = blends(choice);
    const GlScope scope(shared);
    shared.useFrame(lastBlock);
    SceneDraw drawing{lastFrame, lastBlock, asPicture ? reading.sampled() : reading.single(),
                      SurfaceOutput::OneView, choice.kind};
    drawing.floats = true;
    if (auto done = shared.drawNumbers(
            drawing, shared.viewsBlock(view, std::span(&choice, 1), false), asPicture);
        !done)
        return done.error();
    if (asPicture)
        reading.resolve();
    Image image(width, height, 4, PixelType::F32, ColorEncoding::Linear);
    const auto values = reading.data().readFloats(4);
    std::copy(values.begin(), values.end(), image.f32().begin());
    flipRows(image);
    return image;
}

Result<Image> ViewRenderer::readView(ViewKind kind, ViewMode mode) const {
    return m_impl->readNumbers(m_impl->lastFrame.view, {kind, mode, {}});
}

Result<Image> ViewRenderer::readBackground() const {
    ViewSettings without = m_impl->lastFrame.view;
    without.terms.fill(false);
    return m_impl->readNumbers(without, {kViewFinal, ViewMode::Raw, {}});
}

std::optional<ViewRange> ViewRenderer::shownRange() const {
    return m_impl->ranges.shown;
}

std::optional<ViewRange> ViewRenderer::otherRange() const {
    return m_impl->ranges.other;
}

// What the shader computes of the surface that is seen there, if one is.
Result<void> ViewRenderer::Impl::inspectSurface(Inspection& result) const {
    const int fromBottom = result.height - 1 - result.y;
    const std::vector<DrawItem>& items =
        shared.scene.items(shared.lightingFor(lastFrame, kViewFinal), lastFrame.light);
    const Result<Id> id = shared.picking.pick(items, lastBlock.worldToClip, result.width,
                                              result.height, result.x, fromBottom);
    if (!id)
        return id.error();
    std::vector<const DrawItem*> found; // both sides, where it has two
    for (const DrawItem& item : items)
        if (item.id == *id)
            found.push_back(&item);
    if (found.empty())
        return {};
    result.mesh = *id;
    result.material = shared.scene.document().mesh(*id)->material;
    shared.views.setBlock(shared.viewsBlock(lastFrame.view, {}, false));
    shared.shadows.bind();
    if (auto done = shared.relight.update(shared.scene,
                                          shared.relightSettings(lastFrame, kViewFinal), lastBlock);
        !done)
        return done;
    return shared.inspection.draw(
        shared.scene, found, shared.picking, shared.surface,
        shared.surfaceSettings(lastFrame, lastBlock, SurfaceOutput::Inspection, kViewFinal),
        result.x, fromBottom, result);
}

// The picture there, as radiance and as displayed.
Result<void> ViewRenderer::Impl::inspectPicture(Inspection& result) const {
    const int x = result.x, fromBottom = result.height - 1 - result.y;
    ReadTargets& reading = shared.reading;
    if (auto sized = reading.resize(shared.context, result.width, result.height, targets.samples());
        !sized)
        return sized;
    const ViewChoice final;
    FrameSettings frame = lastFrame;
    frame.coarse = false; // of the same triangles as the surface's numbers
    glScissor(x, fromBottom, 1, 1);
    glEnable(GL_SCISSOR_TEST);
    SceneDraw drawing{frame, lastBlock, reading.single(), SurfaceOutput::OneView};
    drawing.floats = true;
    Result<void> done = shared.drawNumbers(
        drawing, shared.viewsBlock(frame.view, std::span(&final, 1), false), true);
    if (done) {
        adaptation.bind();
        done = shared.screen.toneMap(reading.data(), reading.display(), shared.lookOf(frame), {});
    }
    glDisable(GL_SCISSOR_TEST);
    if (!done)
        return done;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, reading.single().id());
    glReadPixels(x, fromBottom, 1, 1, GL_RGBA, GL_FLOAT, &result.radiance);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, reading.display().id());
    glReadPixels(x, fromBottom, 1, 1, GL_RGBA, GL_FLOAT, &result.displayed);
    return {};
}

Result<Inspection> ViewRenderer::inspect(int x, int y) const {
    Impl& r = *m_impl;
    Inspection result;
    result.x = x;
    result.y = y;
    result.width = r.targets.width();
    result.height = r.targets.height();
    result.view = r.lastFrame.view;
    CHECK(x >= 0 && y >= 0 && x < result.width && y < result.height);
    const Impl::GlScope scope(r.shared);
    r.shared.useFrame(r.lastBlock);
    Result<void> done = r.inspectSurface(result);
    if (done)
        done = r.inspectPicture(result);
    const View& look = r.shared.lookOf(r.lastFrame);
    if (needsLuminance(look))
        result.luminance = r.adaptation.read().value_or(Luminance());
    const float opacity = result.radiance.a > 0.0f ? result.radiance.a : 1.0f;
    result.exposed = glm::vec3(result.radiance) / opacity * exposureScale(look, result.luminance);
    if (!done)
        return done.error();
    return result;
}

Id ViewRenderer::pick(int x, int y) const {
    Impl& r = *m_impl;
    const int width = r.targets.width(), height = r.targets.height();
    if (x < 0 || y < 0 || x >= width || y >= height)
        return 0;
    const Impl::GlScope scope(r.shared);
    r.shared.useFrame(r.lastBlock);
    const Result<Id> id = r.shared.picking.pick(r.shared.scene.items(), r.lastBlock.worldToClip,
                                                width, height, x, height - 1 - y);
    if (id)
        return *id;
    logError("{}", id.error().text());
    return 0;
}

} // namespace patina::render
