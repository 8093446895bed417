#include "render/WallRenderer.h"

#include "core/base/Check.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace patina::render {
namespace {

// An environment's light in the scene. Rotation and brightness are numbers of it, so that two of
// the same texels share their textures.
struct WallLight {
    LightId id = kDocumentLight;
    Environment environment;
    EnvironmentTexelsPtr texels; // null: dark
};

struct Shown {
    CellView cell;
    std::unique_ptr<ViewRenderer> view;
    bool drawn = false; // the picture is that of the cell
};

} // namespace

bool CellView::sameAs(const CellView& other) const {
    return light == other.light && nearShadows == other.nearShadows &&
           showSameScene(frame, other.frame) && showSameOverlays(frame, other.frame) &&
           frame.dither == other.frame.dither && document == other.document;
}

struct WallRenderer::Impl {
    explicit Impl(SceneRenderer& s)
        : scene(s) {}

    LightId lightOf(const CellView& cell);
    LightId show(const CellView& cell); // returns what lights it
    Result<void> draw(Shown& shown);

    SceneRenderer& scene;
    std::vector<Shown> cells;
    std::vector<WallLight> lights;
    std::weak_ptr<const EnvironmentTexels> documentTexels; // of the document's own light
    NearShadowsPtr nearShadows;                            // that the scene shows
    Counts counts;
};

LightId WallRenderer::Impl::lightOf(const CellView& cell) {
    // A cross-fade is of the document's mix, which only its own light knows.
    if (cell.document.secondEnvironment() != nullptr) {
        if (cell.light && documentTexels.lock() != cell.light)
            scene.setEnvironment(cell.light);
        documentTexels = cell.light;
        return kDocumentLight;
    }
    const Environment& environment = cell.document.environment();
    const auto known = std::ranges::find_if(lights, [&](const WallLight& light) {
        return light.texels == cell.light && light.environment == environment;
    });
    if (known != lights.end())
        return known->id;
    const LightId id = scene.addLight(environment);
    if (cell.light)
        scene.setEnvironment(cell.light, id);
    lights.push_back({id, environment, cell.light});
    ++counts.lights;
    return id;
}

LightId WallRenderer::Impl::show(const CellView& cell) {
    scene.setDocument(cell.document);
    if (nearShadows != cell.nearShadows)
        scene.setNearShadows(cell.nearShadows);
    nearShadows = cell.nearShadows;
    return lightOf(cell);
}

Result<void> WallRenderer::Impl::draw(Shown& shown) {
    FrameSettings frame = shown.cell.frame;
    frame.light = show(shown.cell);
    frame.look.reset();
    if (auto done = shown.view->render(frame, 0); !done)
        return done;
    shown.drawn = true;
    ++counts.pictures;
    return {};
}

WallRenderer::WallRenderer(SceneRenderer& scene)
    : m_impl(std::make_unique<Impl>(scene)) {}

WallRenderer::~WallRenderer() {
    for (const WallLight& light : m_impl->lights)
        m_impl->scene.removeLight(light.id);
}

Result<void> WallRenderer::draw(std::span<const CellView> cells) {
    Impl& r = *m_impl;
    r.cells.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        Shown& shown = r.cells[i];
        if (!shown.view)
            shown.view = std::make_unique<ViewRenderer>(r.scene);
        if (shown.drawn && shown.cell.sameAs(cells[i]))
            continue;
        shown.cell = cells[i];
        shown.drawn = false;
        if (auto done = r.draw(shown); !done)
            return done;
    }
    // Only now: what is new may share textures with what goes.
    std::erase_if(r.lights, [&](const WallLight& light) {
        const bool used = std::ranges::any_of(r.cells, [&](const Shown& shown) {
            return shown.cell.document.secondEnvironment() == nullptr &&
                   shown.cell.light == light.texels &&
                   shown.cell.document.environment() == light.environment;
        });
        if (!used)
            r.scene.removeLight(light.id);
        return !used;
    });
    return {};
}

const ViewRenderer& WallRenderer::picture(std::size_t cell) const {
    CHECK(cell < m_impl->cells.size() && m_impl->cells[cell].drawn);
    return *m_impl->cells[cell].view;
}

void WallRenderer::show(std::size_t cell) {
    CHECK(cell < m_impl->cells.size());
    m_impl->show(m_impl->cells[cell].cell);
}

WallRenderer::Counts WallRenderer::counts() const {
    return m_impl->counts;
}

} // namespace patina::render
