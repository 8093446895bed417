#include "render/SheetRenderer.h"

#include "render/ViewRendererImpl.h"
#include "render/pass/SheetTargets.h"

#include <span>
#include <utility>

namespace patina::render {

using shading::kViewFlat;

struct SheetRenderer::Impl {
    explicit Impl(SceneRenderer::Impl& s)
        : shared(s)
        , wires(s.context, s.shaders, s.screen) {}

    SceneRenderer::Impl& shared;
    WirePass wires;
    SheetTargets targets;

    Result<void> show(const FrameSettings& frame, const FrameBlock& block, const ViewChoice& choice,
                      const gl::Texture& values);
};

SheetRenderer::SheetRenderer(SceneRenderer& scene)
    : m_impl(std::make_unique<Impl>(*scene.m_impl)) {}

SheetRenderer::~SheetRenderer() = default;

// One view as colours into targets.display().
Result<void> SheetRenderer::Impl::show(const FrameSettings& frame, const FrameBlock& block,
                                       const ViewChoice& choice, const gl::Texture& values) {
    const View& look = shared.lookOf(frame);
    const ViewInfo& info = viewInfo(choice.kind);
    if (shared.isEmpty(frame, choice.kind))
        return shared.views.showEmpty(values, glm::vec3(0.0f), targets.display());
    if (!showsRadiance(choice)) {
        const auto range = shared.rangeFor(choice, values);
        if (!range)
            return range.error();
        return shared.views.show(values, info, *range, look, glm::vec3(0.0f), 1.0f,
                                 targets.display());
    }
    if (auto done =
            shared.screen.toneMap(values, targets.display(), look,
                                  {.scale = choice.mode == ViewMode::Raw ? info.displayScale : 1.0f,
                                   .fillEmpty = true,
                                   .markClipped = choice.kind == shading::kViewClipped});
        !done)
        return done;
    if (choice.kind != shading::kViewWireframe)
        return {};
    return wires.draw(
        makeDrawList(shared.scene.items(shared.lightingFor(frame, choice.kind), frame.light),
                     block.worldToClip, frame.camera.position()),
        glm::vec3(0.0f), frame.width, frame.height, targets.display());
}

Result<std::vector<Image>> SheetRenderer::draw(const FrameSettings& frame, const ViewSheet& sheet,
                                               const ViewRenderer& picture) {
    Impl& r = *m_impl;
    if (auto sized = r.targets.resize(r.shared.context, sheet.width, sheet.height); !sized)
        return sized.error();
    FrameSettings small = frame;
    small.width = sheet.width;
    small.height = sheet.height;
    small.samples = 1;
    const SceneRenderer::Impl::GlScope scope(r.shared);
    Result<void> done = r.shared.shadows.update(r.shared.scene);
    const FrameBlock block = r.shared.packFrame(small);
    r.shared.useFrame(block);

    std::vector<Image> pictures;
    std::size_t next = 0;
    while (done && next < sheet.kinds.size()) {
        // Flat shading and light of another kind change every term: a pass of their own.
        std::vector<ViewChoice> choices;
        while (next < sheet.kinds.size() && choices.size() < SheetTargets::kViews) {
            const ViewKind kind = sheet.kinds[next];
            const bool alone = kind == kViewFlat || viewInfo(kind).lighting.has_value();
            if (alone && !choices.empty())
                break;
            choices.push_back({kind, sheet.mode, {}});
            ++next;
            if (alone)
                break;
        }
        done = r.shared.drawNumbers(
            {small, block, r.targets.numbers(), SurfaceOutput::EightViews, choices.front().kind},
            r.shared.viewsBlock(small.view, choices, false), false);
        picture.m_impl->adaptation.bind();
        for (std::size_t i = 0; done && i < choices.size(); ++i) {
            done = r.show(small, block, choices[i], r.targets.values(i));
            if (done)
                pictures.push_back(r.targets.readDisplayed());
        }
    }
    if (!done)
        return done.error();
    return pictures;
}

} // namespace patina::render
