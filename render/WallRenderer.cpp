#include "render/WallRenderer.h"

#include "core/base/Check.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <epoxy/gl.h>
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
    bool hasPicture = false;
    bool drawn = false;      // the picture is that of the cell
    bool unfinished = false; // its scene is drawn, its picture is not: only within proceed()
    int frames = 0;          // that it is the mean of
    std::size_t turn = 0;    // when it was drawn last: Counts::pictures

    // Whether another frame would change it.
    [[nodiscard]] bool isDue() const {
        if (cell.waits)
            return false;
        return !drawn || (cell.frame.accumulate && frames > 0 &&
                          frames < ViewRenderer::steadyFrames(cell.frame.camera));
    }
};

bool sameFrame(const FrameSettings& a, const FrameSettings& b) {
    return showSameScene(a, b) && showSameOverlays(a, b) && a.dither == b.dither;
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

} // namespace

bool CellView::sameAs(const CellView& other) const {
    return light == other.light && sceneLight == other.sceneLight &&
           nearShadows == other.nearShadows && radiosity == other.radiosity &&
           sameFrame(frame, other.frame) && document == other.document;
}

struct WallRenderer::Impl {
    explicit Impl(SceneRenderer& s)
        : scene(s) {}

    LightId lightOf(const CellView& cell);
    LightId show(const CellView& cell); // returns what lights it
    Result<void> draw(Shown& shown);
    Result<void> finish(Shown& shown);
    [[nodiscard]] Shown* next(); // null: all are drawn
    void letLightsGo();          // that no cell has

    SceneRenderer& scene;
    std::vector<Shown> cells;
    std::vector<WallLight> lights;
    std::weak_ptr<const EnvironmentTexels> documentTexels; // of the document's own light
    NearShadowsPtr nearShadows;                            // that the scene shows
    std::optional<ShownRadiosityPtr> radiosity;            // that it was given last by a cell
    Counts counts;
};

LightId WallRenderer::Impl::lightOf(const CellView& cell) {
    if (cell.sceneLight)
        return kDocumentLight;
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
    if (cell.radiosity && radiosity != cell.radiosity) {
        scene.setRadiosity(*cell.radiosity);
        radiosity = cell.radiosity;
    }
    return lightOf(cell);
}

Result<void> WallRenderer::Impl::draw(Shown& shown) {
    FrameSettings frame = shown.cell.frame;
    if (frame.radiance) { // all that is of the scene in it is how it is displayed
        frame.look = shown.cell.document.view;
    } else {
        frame.light = show(shown.cell);
        frame.look.reset();
    }
    if (shown.drawn)
        shown.view->resume();
    const Result<bool> complete = shown.view->begin(frame);
    if (!complete)
        return complete.error();
    shown.drawn = shown.hasPicture = true;
    shown.unfinished = !*complete;
    shown.frames = shown.view->accumulatedFrames();
    shown.turn = ++counts.pictures;
    return {};
}

Result<void> WallRenderer::Impl::finish(Shown& shown) {
    shown.unfinished = false;
    Result<void> done = shown.view->finish();
    shown.drawn = done.ok();
    return done;
}

// What is to show something else first, in turn, so that none waits for long while all of them
// change all the time; then one after the other is refined.
Shown* WallRenderer::Impl::next() {
    Shown* chosen = nullptr;
    const auto isBefore = [](const Shown& a, const Shown& b) {
        if (a.drawn != b.drawn)
            return b.drawn;
        return a.drawn ? a.turn > b.turn : a.turn < b.turn;
    };
    for (Shown& shown : cells)
        if (shown.isDue() && (chosen == nullptr || isBefore(shown, *chosen)))
            chosen = &shown;
    return chosen;
}

void WallRenderer::Impl::letLightsGo() {
    std::erase_if(lights, [&](const WallLight& light) {
        const bool used = std::ranges::any_of(cells, [&](const Shown& shown) {
            return !shown.cell.sceneLight && shown.cell.document.secondEnvironment() == nullptr &&
                   shown.cell.light == light.texels &&
                   shown.cell.document.environment() == light.environment;
        });
        if (!used)
            scene.removeLight(light.id);
        return !used;
    });
}

WallRenderer::WallRenderer(SceneRenderer& scene)
    : m_impl(std::make_unique<Impl>(scene)) {}

WallRenderer::~WallRenderer() {
    for (const WallLight& light : m_impl->lights)
        m_impl->scene.removeLight(light.id);
}

void WallRenderer::set(std::span<const CellView> cells, bool sameCells) {
    Impl& r = *m_impl;
    std::vector<Shown> before = std::exchange(r.cells, std::vector<Shown>(cells.size()));
    const auto takeAlong = [](Shown& from, Shown& to) {
        to.view = std::move(from.view);
        to.hasPicture = from.hasPicture;
        to.drawn = from.drawn;
        to.frames = from.frames;
        to.turn = from.turn;
        from = {};
    };
    // Most often it is in its place; where cells are the same it is nowhere else.
    const std::size_t places = sameCells && before.size() == cells.size() ? 1 : before.size();
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t k = 0; k < places && !r.cells[i].view; ++k)
            if (Shown& other = before[(i + k) % before.size()];
                other.view && other.hasPicture && other.cell.sameAs(cells[i]))
                takeAlong(other, r.cells[i]);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        Shown& shown = r.cells[i];
        shown.cell = cells[i];
        if (shown.view)
            continue;
        if (sameCells && i < before.size() && before[i].view)
            takeAlong(before[i], shown);
        else
            shown.view = std::make_unique<ViewRenderer>(r.scene);
        shown.drawn = false;
    }
}

void WallRenderer::setFrame(std::size_t cell, const FrameSettings& frame) {
    CHECK(cell < m_impl->cells.size());
    Shown& shown = m_impl->cells[cell];
    shown.drawn = shown.drawn && sameFrame(frame, shown.cell.frame);
    shown.cell.frame = frame;
    shown.cell.document.view.camera = frame.camera;
}

void WallRenderer::invalidate() {
    m_impl->documentTexels.reset();
    for (Shown& shown : m_impl->cells)
        shown.drawn = false;
}

Result<bool> WallRenderer::proceed(double budgetMs) {
    Impl& r = *m_impl;
    const auto start = std::chrono::steady_clock::now();
    const bool endless = std::isinf(budgetMs);
    // Some scenes are drawn ahead of the picture that is finished next: making that waits for its
    // scene, and those of the others give software OpenGL something to do meanwhile.
    constexpr std::size_t kAhead = 2;
    std::deque<Shown*> begun;
    Result<void> done;
    const auto finishAllBut = [&](std::size_t ahead) {
        for (; done && begun.size() > ahead; begun.pop_front())
            if (begun.front()->unfinished)
                done = r.finish(*begun.front());
    };
    while (Shown* shown = r.next()) {
        if (std::ranges::find(begun, shown) != begun.end())
            finishAllBut(0); // another frame of it
        if (done)
            done = r.draw(*shown);
        if (!done)
            break;
        begun.push_back(shown);
        finishAllBut(kAhead);
        if (!done)
            break;
        if (!endless && millisecondsSince(start) >= budgetMs)
            break;
    }
    finishAllBut(0);
    // Those that an error left behind.
    for (Shown* shown : begun)
        if (std::exchange(shown->unfinished, false))
            shown->drawn = false;
    if (!done)
        return done.error();
    if (!endless)
        glFinish();
    if (!complete())
        return false;
    r.letLightsGo(); // only now: what is new may share textures with what goes
    return true;
}

bool WallRenderer::complete() const {
    return m_impl->next() == nullptr;
}

std::size_t WallRenderer::due() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        m_impl->cells, [](const Shown& shown) { return !shown.drawn && !shown.cell.waits; }));
}

std::size_t WallRenderer::dueFromScene() const {
    return static_cast<std::size_t>(std::ranges::count_if(m_impl->cells, [](const Shown& shown) {
        return !shown.drawn && !shown.cell.waits && !shown.cell.frame.radiance;
    }));
}

Result<void> WallRenderer::draw(std::span<const CellView> cells) {
    set(cells, false);
    const Result<bool> done = proceed();
    return done ? Result<void>() : Result<void>(done.error());
}

Result<void> WallRenderer::drawFrame(const CellView& cell, ViewRenderer& picture, bool continues) {
    FrameSettings frame = cell.frame;
    frame.light = m_impl->show(cell);
    frame.look.reset();
    if (continues)
        picture.resume();
    return picture.render(frame, ViewRenderer::kNowhere);
}

bool WallRenderer::isFine(const CellView& cell, const ViewRenderer& picture) {
    return !cell.frame.accumulate || picture.isSteady();
}

std::size_t WallRenderer::size() const {
    return m_impl->cells.size();
}

bool WallRenderer::hasPicture(std::size_t cell) const {
    return cell < m_impl->cells.size() && m_impl->cells[cell].hasPicture;
}

const ViewRenderer& WallRenderer::picture(std::size_t cell) const {
    CHECK(hasPicture(cell));
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
