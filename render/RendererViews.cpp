// Views of the shading equation's terms, thumbnails of them, and the explanation of a pixel.
#include "render/RendererImpl.h"

#include "core/base/Check.h"
#include "core/edit/ViewReasons.h"
#include "render/scene/LightBlocks.h"

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

// The half-plane right of the limit, in pixels from the bottom left: see shaders/include/side.glsl.
glm::vec3 rightOf(const ViewSplit& split, int width, int height) {
    const float angle = glm::radians(split.angleDeg);
    const glm::vec2 normal(std::cos(angle), -std::sin(angle));
    const glm::vec2 through(split.position.x * static_cast<float>(width),
                            (1.0f - split.position.y) * static_cast<float>(height));
    return {normal, -glm::dot(normal, through)};
}

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

// Whether what is recorded is radiance with the opacity of its surface, to be laid over what is
// behind; other numbers stand alone.
bool blends(const ViewChoice& choice) {
    return choice.mode == ViewMode::Contribution ||
           viewInfo(recordedFor(choice.kind)).value == ViewValue::Radiance;
}

// With the sky behind: what is made of the whole picture.
bool hasBackground(const ViewChoice& choice) {
    return choice.mode == ViewMode::Raw && recordedFor(choice.kind) == kViewFinal;
}

// Puts back what one pixel of the targets held: depth, numbers and display value.
class PixelOfTargets {
  public:
    PixelOfTargets(const Targets& targets, int x, int y)
        : m_targets(targets)
        , m_x(x)
        , m_y(y) {
        const auto read = [&](const gl::Texture& texture, GLenum format, GLenum type, auto& into) {
            glGetTextureSubImage(texture.id(), 0, x, y, 0, 1, 1, 1, format, type, sizeof(into),
                                 &into);
        };
        read(targets.depth(), GL_DEPTH_COMPONENT, GL_FLOAT, m_depth);
        read(targets.data(), GL_RGBA, GL_FLOAT, m_numbers);
        read(targets.displayed(), GL_RGBA, GL_UNSIGNED_BYTE, m_displayed);
    }
    ~PixelOfTargets() {
        const auto write = [&](const gl::Texture& texture, GLenum format, GLenum type,
                               const auto& from) {
            glTextureSubImage2D(texture.id(), 0, m_x, m_y, 1, 1, format, type, &from);
        };
        write(m_targets.depth(), GL_DEPTH_COMPONENT, GL_FLOAT, m_depth);
        write(m_targets.data(), GL_RGBA, GL_FLOAT, m_numbers);
        write(m_targets.displayed(), GL_RGBA, GL_UNSIGNED_BYTE, m_displayed);
    }
    PixelOfTargets(const PixelOfTargets&) = delete;
    PixelOfTargets& operator=(const PixelOfTargets&) = delete;

  private:
    const Targets& m_targets;
    int m_x, m_y;
    float m_depth = 1.0f;
    glm::vec4 m_numbers{0.0f};
    std::array<unsigned char, 4> m_displayed{};
};

} // namespace

bool ViewSettings::isOrdinary(const ViewChoice& choice) const {
    const bool allTerms = std::all_of(terms.begin(), terms.end(), [](bool on) { return on; });
    return allTerms && !furnace && choice.mode == ViewMode::Raw &&
           recordedFor(choice.kind) == kViewFinal && choice.kind != kViewFlat;
}

ViewsBlock Renderer::Impl::viewsBlock(const ViewSettings& view, std::span<const ViewChoice> choices,
                                      bool halfFloats) const {
    CHECK(choices.size() <= 8);
    ViewsBlock block;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        block.kinds[i] = recordedFor(choices[i].kind);
        block.modes[i] = choices[i].mode == ViewMode::Contribution ? 1 : 0;
        block.flat |= choices[i].kind == kViewFlat ? 1 : 0;
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

Result<void> Renderer::Impl::drawNumbers(const FrameSettings& frame, const FrameBlock& block,
                                         const gl::Framebuffer& target, const ViewsBlock& settings,
                                         bool asPicture, SurfaceOutput output, ViewKind kind) {
    views.setBlock(settings);
    if (asPicture)
        return drawPicture(frame, block, target, output, settings.kinds[0] == kViewFinal, kind);
    const LightingMode lighting = lightingFor(frame.view, kind);
    if (auto done = relight.update(scene, lighting, block); !done)
        return done;
    shadows.bind();
    // Blended surfaces, too, stand for themselves.
    DrawList list = visibleItems(block, frame.camera.position());
    list.opaque.insert(list.opaque.end(), list.blended.begin(), list.blended.end());
    SurfaceSettings surfaces = surfaceSettings(block, output, lighting);
    surfaces.floats = output == SurfaceOutput::OneView; // others are never drawn otherwise
    if (slice) {
        surfaces.triangles = slice->triangles;
        surfaces.clip = sliceClip(block);
        slice->shown = triangleCount(list.opaque, surfaces.clip);
        slice->complete = slice->triangles.end() > slice->shown;
    }
    target.bind();
    constexpr std::array<float, 4> kNothing{};
    if (surfaces.triangles.first == 0) {
        for (int i = 0; i < (output == SurfaceOutput::EightViews ? 8 : 1); ++i)
            glClearNamedFramebufferfv(target.id(), GL_COLOR, i, kNothing.data());
        target.clearDepth(1.0f);
    }
    return surface.drawOpaque(scene, list, surfaces);
}

Result<ViewRange> Renderer::Impl::rangeFor(const ViewChoice& choice, const gl::Texture& values) {
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

Result<void> Renderer::Impl::drawRadiance(const FrameSettings& frame, const ViewChoice& choice,
                                          std::size_t sideIndex) {
    if (accumulated > Renderer::kSteadyFrames) {
        if (slice)
            slice->complete = true;
        return screen.showMean(targets, sideIndex);
    }
    views.setBlock(viewsBlock(frame.view, std::span(&choice, 1), !targets.floats()));
    FrameBlock block = lastBlock;
    if (accumulated > 1) {
        block.worldToClip = besideBy(accumulated - 1, frame.width, frame.height, block.worldToClip);
        block.clipToWorld = glm::inverse(block.worldToClip);
        useFrame(block);
    }
    const bool ordinary = frame.view.isOrdinary(choice);
    if (auto done = drawPicture(frame, block, targets.scene(),
                                ordinary ? SurfaceOutput::Picture : SurfaceOutput::OneView,
                                hasBackground(choice), choice.kind);
        !done)
        return done;
    if (accumulated > 1)
        useFrame(lastBlock);
    if (slice && !slice->complete)
        return {};
    targets.resolve();
    if (accumulated == 0)
        return {};
    return screen.accumulate(context, targets, sideIndex, accumulated);
}

Result<void> Renderer::Impl::drawScene(const FrameSettings& frame, const ViewChoice& choice,
                                       std::size_t sideIndex) {
    const bool empty = !whyEmpty(choice.kind, scene.document(), frame.view.light).empty();
    if (!empty && showsRadiance(choice))
        return drawRadiance(frame, choice, sideIndex);
    const auto target = targets.dataTarget(context);
    if (!target)
        return target.error();
    const ViewChoice shape{kViewNoV, ViewMode::Raw, {}};
    const ViewChoice& drawn = empty ? shape : choice;
    return drawNumbers(
        frame, lastBlock, **target, viewsBlock(frame.view, std::span(&drawn, 1), false),
        !empty && blends(choice), SurfaceOutput::OneView, empty ? kViewFinal : choice.kind);
}

std::vector<Renderer::Impl::Side> Renderer::Impl::sidesOf(const FrameSettings& frame) {
    const std::optional<ViewSplit>& split = frame.view.split;
    if (!split)
        return {Side{frame.view.shown, glm::vec3(0.0f), 0, false}};
    const glm::vec3 right = rightOf(*split, frame.width, frame.height);
    const auto index = [](const glm::vec3& plane) -> std::size_t { return plane.x < 0.0f ? 1 : 0; };
    return {Side{split->other, right, index(right), true},
            Side{frame.view.shown, -right, index(-right), false}};
}

bool Renderer::Impl::hasRadiance(const FrameSettings& frame, const ViewChoice& choice) const {
    return showsRadiance(choice) &&
           whyEmpty(choice.kind, scene.document(), frame.view.light).empty();
}

Result<void> Renderer::Impl::measureSide(const FrameSettings& frame, const Side& side) {
    const ViewChoice& choice = side.choice;
    // The eye is used to the picture, not to one of its terms.
    if (hasRadiance(frame, choice))
        return frame.view.isOrdinary(choice) ? adapt(frame) : Result<void>();
    if (const auto target = targets.dataTarget(context); !target)
        return target.error();
    if (!whyEmpty(choice.kind, scene.document(), frame.view.light).empty())
        return {};
    const auto range = rangeFor(choice, targets.data());
    if (!range)
        return range.error();
    ranges.side = *range;
    if (viewInfo(choice.kind).value == ViewValue::Scalar || choice.kind == kViewLuminance)
        (side.isOther ? ranges.other : ranges.shown) = *range;
    return {};
}

Result<void> Renderer::Impl::displaySide(const FrameSettings& frame, const Side& side) {
    const ViewChoice& choice = side.choice;
    const ViewInfo& info = viewInfo(choice.kind);
    const View& look = scene.document().view;
    adaptation.bind();
    if (hasRadiance(frame, choice))
        return screen.toneMap(targets.linear(), targets.display(), look,
                              {.dither = frame.dither,
                               .scale = choice.mode == ViewMode::Raw ? info.displayScale : 1.0f,
                               .fillEmpty = !hasBackground(choice),
                               .markClipped = choice.kind == kViewClipped,
                               .side = side.plane});
    if (!whyEmpty(choice.kind, scene.document(), frame.view.light).empty())
        return views.showEmpty(targets.data(), side.plane, targets.display());
    return views.show(targets.data(), info, ranges.side, look, side.plane, frame.view.flags,
                      targets.display());
}

Result<void> Renderer::Impl::drawWires(const FrameSettings& frame, const Side& side) {
    if (side.choice.kind != kViewWireframe || !hasRadiance(frame, side.choice))
        return {};
    return wires.draw(makeDrawList(scene.items(), lastBlock.worldToClip, frame.camera.position()),
                      side.plane, frame.width, frame.height, targets.display());
}

// Exposure follows the whole picture, even where only a term of it is shown.
Result<void> Renderer::Impl::meetLuminance(const FrameSettings& frame) {
    if (!needsLuminance(scene.document().view) || luminanceKnown ||
        frame.view.isOrdinary(frame.view.shown))
        return {};
    if (auto done = drawPicture(frame, lastBlock, targets.scene(), SurfaceOutput::Picture, true);
        !done)
        return done;
    targets.resolve();
    luminanceIsNew = true;
    return adapt(frame);
}

Result<void> Renderer::Impl::drawViews(const FrameSettings& frame, bool drawsScene) {
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

Result<void> Renderer::Impl::showOnSheet(const FrameSettings& frame, const FrameBlock& block,
                                         const ViewChoice& choice, const gl::Texture& values) {
    const View& look = scene.document().view;
    adaptation.bind();
    if (!whyEmpty(choice.kind, scene.document(), frame.view.light).empty())
        return views.showEmpty(values, glm::vec3(0.0f), sheet.display());
    if (!showsRadiance(choice)) {
        const auto range = rangeFor(choice, values);
        if (!range)
            return range.error();
        return views.show(values, viewInfo(choice.kind), *range, look, glm::vec3(0.0f), 1.0f,
                          sheet.display());
    }
    if (auto done = screen.toneMap(
            values, sheet.display(), look,
            {.scale = choice.mode == ViewMode::Raw ? viewInfo(choice.kind).displayScale : 1.0f,
             .fillEmpty = true,
             .markClipped = choice.kind == kViewClipped});
        !done)
        return done;
    if (choice.kind != kViewWireframe)
        return {};
    return wires.draw(makeDrawList(scene.items(), block.worldToClip, frame.camera.position()),
                      glm::vec3(0.0f), frame.width, frame.height, sheet.display());
}

std::optional<ViewRange> Renderer::shownRange() const {
    return m_impl->ranges.shown;
}

std::optional<ViewRange> Renderer::otherRange() const {
    return m_impl->ranges.other;
}

Result<Image> Renderer::Impl::readNumbers(const ViewSettings& view, const ViewChoice& choice) {
    CHECK(targets.width() > 0);
    const bool asPicture = blends(choice);
    const auto target =
        asPicture ? targets.dataSamplesTarget(context) : targets.dataTarget(context);
    if (!target)
        return target.error();
    const GlScope scope(*this);
    useFrame(lastBlock);
    Result<void> done =
        drawNumbers(lastFrame, lastBlock, **target, viewsBlock(view, std::span(&choice, 1), false),
                    asPicture, SurfaceOutput::OneView, choice.kind);
    Image image;
    if (done) {
        if (asPicture)
            targets.resolveData();
        image = Image(targets.width(), targets.height(), 4, PixelType::F32, ColorEncoding::Linear);
        const auto values = targets.data().readFloats(4);
        std::copy(values.begin(), values.end(), image.f32().begin());
        flipRows(image);
    }
    // The numbers of the last frame's own view are gone.
    setChanged();
    if (!done)
        return done.error();
    return image;
}

Result<Image> Renderer::readView(ViewKind kind, ViewMode mode) {
    return m_impl->readNumbers(m_impl->lastFrame.view, {kind, mode, {}});
}

Result<Image> Renderer::readBackground() {
    ViewSettings without = m_impl->lastFrame.view;
    without.terms.fill(false);
    return m_impl->readNumbers(without, {kViewFinal, ViewMode::Raw, {}});
}

Result<std::vector<Image>> Renderer::drawSheet(const FrameSettings& frame, const ViewSheet& sheet) {
    Impl& r = *m_impl;
    if (auto sized = r.sheet.resize(r.context, sheet.width, sheet.height); !sized)
        return sized.error();
    FrameSettings small = frame;
    small.width = sheet.width;
    small.height = sheet.height;
    small.samples = 1;
    const Impl::GlScope scope(r);
    Result<void> done = r.shadows.update(r.scene);
    const FrameBlock block = r.packFrame(small);
    r.useFrame(block);

    std::vector<Image> pictures;
    std::size_t next = 0;
    while (done && next < sheet.kinds.size()) {
        // Flat shading and light of another kind change every term: a pass of their own.
        std::vector<ViewChoice> choices;
        while (next < sheet.kinds.size() && choices.size() < SheetTargets::kViews) {
            const ViewKind kind = sheet.kinds[next];
            const bool alone = kind == kViewFlat || viewInfo(kind).group == ViewGroup::Lighting;
            if (alone && !choices.empty())
                break;
            choices.push_back({kind, sheet.mode, {}});
            ++next;
            if (alone)
                break;
        }
        done =
            r.drawNumbers(small, block, r.sheet.numbers(), r.viewsBlock(small.view, choices, false),
                          false, SurfaceOutput::EightViews, choices.front().kind);
        for (std::size_t i = 0; done && i < choices.size(); ++i) {
            done = r.showOnSheet(small, block, choices[i], r.sheet.values(i));
            if (done)
                pictures.push_back(r.sheet.readDisplayed());
        }
    }
    r.useFrame(r.lastBlock);
    if (!done)
        return done.error();
    return pictures;
}

Result<Inspection> Renderer::inspect(int x, int y) {
    Impl& r = *m_impl;
    Inspection result;
    result.x = x;
    result.y = y;
    result.width = r.targets.width();
    result.height = r.targets.height();
    result.view = r.lastFrame.view;
    CHECK(x >= 0 && y >= 0 && x < result.width && y < result.height);
    const int fromBottom = result.height - 1 - y;
    const Impl::GlScope scope(r);
    r.useFrame(r.lastBlock);
    const auto inspectSurface = [&]() -> Result<void> {
        const Result<Id> id = r.picking.pick(r.scene, r.lastBlock.worldToClip, result.width,
                                             result.height, x, fromBottom);
        if (!id)
            return id.error();
        const auto& items = r.scene.items();
        const auto item = std::find_if(items.begin(), items.end(),
                                       [&](const DrawItem& i) { return i.id == *id; });
        if (item == items.end())
            return {};
        result.mesh = *id;
        result.material = r.scene.document().mesh(*id)->material;
        r.views.setBlock(r.viewsBlock(r.lastFrame.view, {}, false));
        r.shadows.bind();
        const LightingMode lighting = r.lightingFor(r.lastFrame.view, kViewFinal);
        if (auto done = r.relight.update(r.scene, lighting, r.lastBlock); !done)
            return done;
        return r.inspection.draw(
            r.scene, *item, r.picking, r.surface,
            r.surfaceSettings(r.lastBlock, SurfaceOutput::Inspection, lighting), x, fromBottom,
            result);
    };
    const auto inspectPicture = [&]() -> Result<void> {
        const auto target = r.targets.dataTarget(r.context);
        if (!target)
            return target.error();
        const ViewChoice final;
        FrameSettings frame = r.lastFrame;
        frame.coarse = false; // of the same triangles as the surface's numbers
        const PixelOfTargets before(r.targets, x, fromBottom); // the frame stays as it is
        glScissor(x, fromBottom, 1, 1);
        glEnable(GL_SCISSOR_TEST);
        Result<void> done = r.drawNumbers(frame, r.lastBlock, **target,
                                          r.viewsBlock(frame.view, std::span(&final, 1), false),
                                          true, SurfaceOutput::OneView);
        if (done) {
            r.adaptation.bind();
            done = r.screen.toneMap(r.targets.data(), r.targets.display(), r.scene.document().view,
                                    {});
        }
        glDisable(GL_SCISSOR_TEST);
        if (!done)
            return done;
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, (*target)->id());
        glReadPixels(x, fromBottom, 1, 1, GL_RGBA, GL_FLOAT, &result.radiance);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, r.targets.display().id());
        glReadPixels(x, fromBottom, 1, 1, GL_RGBA, GL_FLOAT, &result.displayed);
        return {};
    };
    Result<void> done = inspectSurface();
    if (done)
        done = inspectPicture();
    const View& view = r.scene.document().view;
    if (needsLuminance(view))
        result.luminance = r.adaptation.read().value_or(Luminance());
    const float opacity = result.radiance.a > 0.0f ? result.radiance.a : 1.0f;
    result.exposed = glm::vec3(result.radiance) / opacity * exposureScale(view, result.luminance);
    if (!done)
        return done.error();
    return result;
}

} // namespace patina::render
