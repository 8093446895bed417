#include "app/editor/wall/WallPainter.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/wall/TracedCells.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/wall/WallState.h"
#include "core/document/Snapshot.h"
#include "core/document/ViewChoices.h"
#include "core/image/Channels.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"
#include "render/FollowedRadiosity.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/WarmUp.h"

#include <QColor>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <tuple>

namespace patina::editor {
namespace {

// Whether they show the same of a document, however fine.
bool sameLook(const render::FrameSettings& a, const render::FrameSettings& b) {
    return a.camera == b.camera && a.view == b.view;
}

// Whether cells drawn with these look the same, apart from what is in their documents.
bool sameFrame(const render::FrameSettings& a, const render::FrameSettings& b) {
    return showSameScene(a, b) && a.view.flags == b.view.flags;
}

} // namespace

WallPainter::WallPainter(DocumentController& controller, PreparedLights& lights, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_lights(controller.runner(), lights)
    , m_radiosity(controller.runner()) {
    const auto again = [this] {
        recompose();
        Q_EMIT changed();
    };
    connect(&m_lights, &WallLights::changed, this, again);
    connect(&m_radiosity, &WallRadiosity::changed, this, [this, again] {
        if (isOn())
            again();
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.affects != Affects::Nothing)
            recompose();
    });
}

void WallPainter::setWall(WallState& wall, WallComparison& comparison, TracedCells& traced) {
    m_wall = &wall;
    m_comparison = &comparison;
    m_traced = &traced;
    connect(&traced, &TracedCells::chosen, this, [this] {
        recompose(); // their documents are wanted, whatever their light lacks yet
        Q_EMIT changed();
    });
    connect(&traced, &TracedCells::changed, this, &WallPainter::finer);
    connect(&comparison, &WallComparison::changed, this, &WallPainter::changed);
    connect(&comparison, &WallComparison::measuredChanged, this, [this] {
        if (m_comparison->isOutdated()) // pictures became finer meanwhile
            Q_EMIT changed();
    });
    connect(&wall, &WallState::changed, this, [this] {
        recompose();
        m_sameCells = false;
        if (!m_wall->isOn()) {
            m_lights.clear();
            m_radiosity.clear();
        }
        Q_EMIT changed();
    });
    connect(&wall, &WallState::cellsChosen, this, &WallPainter::changed);
    connect(&wall, &WallState::ownChanged, this, [this] { // the same cells, one of them edited
        recompose();
        Q_EMIT changed();
    });
}

bool WallPainter::isOn() const {
    return m_wall != nullptr && m_wall->isOn();
}

void WallPainter::setSceneLight(const ImagePtr& picture) {
    m_sceneLight = picture;
    invalidate();
    recompose();
}

void WallPainter::setNearShadows(const NearShadowsPtr& shadows) {
    if (shadows != m_nearShadows)
        recompose();
    m_nearShadows = shadows;
}

void WallPainter::invalidate() {
    if (!m_renderer)
        return;
    m_renderer->invalidate();
    m_comparison->outdate();
}

void WallPainter::release() {
    m_sheetPicture.reset();
    m_renderer.reset();
    m_views.clear();
    m_places.clear();
    m_composed = m_sameCells = false;
}

bool WallPainter::complete() const {
    return !m_renderer || m_renderer->complete();
}

std::size_t WallPainter::due() const {
    return m_renderer ? m_renderer->due() : 0;
}

std::size_t WallPainter::dueFromScene() const {
    return m_renderer ? m_renderer->dueFromScene() : 0;
}

std::size_t WallPainter::cellsFromScene() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        m_views, [](const render::CellView& view) { return !view.frame.radiance; }));
}

bool WallPainter::isTracing() const {
    return isOn() && m_traced->isBusy();
}

bool WallPainter::preparing() const {
    return m_lights.busy() || m_radiosity.busy() ||
           std::ranges::any_of(m_absences, [](const Absence& absence) {
               return absence.passes && !absence.text.isEmpty();
           });
}

// --- What the cells show -------------------------------------------------------------------------

void WallPainter::composeCell(std::size_t index, const render::FrameSettings& frame) {
    render::CellView& view = m_views[index];
    QString& text = m_absences[index].text;
    m_absences[index] = {};
    m_resolved[index] = false;
    const Document& document = m_controller.document();
    Result<Document> shown = documentOf(document, m_wall->cells()[index].cell);
    if (!shown) {
        m_absences[index] = {toQString(shown.error().message), false};
        return;
    }
    shown->snapshots.clear(); // keeping one changes no picture
    // The viewport has one display.
    const auto display = [](const View& of) {
        return std::tie(of.ocioConfig, of.ocioDisplay, of.ocioView);
    };
    if (shown->view.toneMap == ToneMap::OpenColorIo &&
        display(shown->view) != display(document.view)) {
        m_absences[index] = {tr("This snapshot has another OpenColorIO display than the scene; "
                                "restore it to see it"),
                             false};
        return;
    }
    const bool preview = previews() && index == m_wall->current();
    if (preview) {
        shown->environment() = m_preview->inPlaceOf(shown->environment());
        shown->mix.second = 0;
        shown->mix.blended = nullptr;
    }
    const bool resolved = m_lights.resolve(*shown, document);
    shown->view.camera = view.document.view.camera; // see frameOf()
    // What is traced needs its pictures alone, not what the viewport prepares of them.
    m_resolved[index] = resolved && !preview;
    const auto takeForTracer = [&] {
        if (!isTraced(index) || !m_resolved[index])
            return;
        m_edited[index] = m_edited[index] || *shown != view.document;
        view.document = std::move(*shown);
    };
    const bool lit = !environmentParts(*shown).empty();
    const ImagePtr picture = resolved && lit ? shownEnvironment(*shown).image : nullptr;
    // Cells that cross-fade set the scene's light: none relies on it then.
    const bool sceneLight = picture && picture == m_sceneLight &&
                            document.secondEnvironment() == nullptr &&
                            shown->secondEnvironment() == nullptr;
    EnvironmentTexelsPtr light;
    if (picture && !sceneLight)
        light = preview && picture == m_preview->texels()->image ? m_preview->texels()
                                                                 : m_lights.light(picture);
    if (lit && !sceneLight && !light) {
        text = tr("Preparing light…");
        takeForTracer();
        return;
    }
    render::ViewSettings settings = frame.view;
    settings.split.reset();
    if (m_ready && !m_ready(render::frameKinds(settings, *shown))) {
        text = tr("Preparing shaders…");
        takeForTracer();
        return;
    }
    std::optional<ShownRadiosityPtr> radiosity;
    if (render::isLitBy(LightingMode::Radiosity, shown->view.lighting, settings)) {
        const WallRadiosity::Found found = m_radiosity.find(*shown, document);
        if (found.waits() || !found.failure.isEmpty()) {
            m_absences[index] = {found.waits() ? tr("Solving radiosity…") : found.failure,
                                 found.waits()};
            takeForTracer();
            return;
        }
        radiosity = found.shown;
    }
    // Of lights that are where they were, on what is where it was.
    const bool shadowed = shown->lights == document.lights && shown->meshes == document.meshes;
    const NearShadowsPtr shadows = shadowed ? m_nearShadows : nullptr;
    m_edited[index] = m_edited[index] || light != view.light || sceneLight != view.sceneLight ||
                      shadows != view.nearShadows || radiosity != view.radiosity ||
                      *shown != view.document;
    view.light = light;
    view.sceneLight = sceneLight;
    view.nearShadows = shadows;
    view.radiosity = radiosity;
    view.document = std::move(*shown);
}

bool WallPainter::isLitBy(LightingMode lighting) const {
    return std::ranges::any_of(
        m_views, [&](const auto& view) { return view.document.view.lighting == lighting; });
}

bool WallPainter::previews() const {
    return m_preview != nullptr && m_preview->isOn();
}

void WallPainter::compose(const render::FrameSettings& frame) {
    const std::size_t count = m_wall->cells().size();
    if (!m_sameCells)
        m_views.clear();
    m_views.resize(count);
    m_absences.resize(count);
    m_edited.assign(count, false);
    m_resolved.assign(count, false);
    for (std::size_t i = 0; i < count; ++i)
        composeCell(i, frame);
    m_lights.sweep();
    m_radiosity.sweep();
    m_composed = true;
}

render::FrameSettings WallPainter::frameOf(const render::FrameSettings& frame, const QRect& cell,
                                           float scale) const {
    const auto scaled = [&](int pixels) {
        return std::max(1, static_cast<int>(std::lround(static_cast<float>(pixels) * scale)));
    };
    render::FrameSettings own;
    own.width = scaled(cell.width());
    own.height = scaled(cell.height());
    own.samples = frame.samples;
    own.accumulate = frame.accumulate;
    own.coarse = frame.coarse;
    own.dither = frame.dither;
    own.view = frame.view;
    own.view.split.reset();
    own.camera = frame.camera;
    // What the viewport shows of the scene stays in the picture: a narrow cell sees wider.
    const float wanted =
        std::min(static_cast<float>(frame.width) / static_cast<float>(frame.height), 1.0f);
    const float aspect = static_cast<float>(own.width) / static_cast<float>(own.height);
    if (aspect < wanted)
        own.camera.fovDeg = glm::degrees(
            2.0f * std::atan(wanted / aspect * std::tan(0.5f * glm::radians(own.camera.fovDeg))));
    return own;
}

void WallPainter::set(render::SceneRenderer& scene, const render::FrameSettings& frame,
                      const std::vector<QRect>& cells, float scale) {
    if (!m_renderer)
        m_renderer = std::make_unique<render::WallRenderer>(scene);
    const bool composes = !m_composed;
    if (composes)
        compose(frame);
    traceCells(frame, cells, composes);
    bool differs = composes || cells != m_places;
    std::vector<std::size_t> others; // seen through another frame
    bool onlyFiner = true;           // what these show of the same
    const std::vector<QRect> before = std::exchange(m_places, cells);
    m_places.resize(m_views.size());
    for (std::size_t i = 0; i < m_views.size(); ++i) {
        render::CellView& view = m_views[i];
        render::FrameSettings own = frameOf(frame, m_places[i], scale);
        // What input leaves alone stays as fine as it is.
        const bool kept = scale < 1.0f && !m_edited[i] && i < before.size() &&
                          before[i] == m_places[i] && sameLook(own, view.frame) &&
                          !view.frame.radiance && m_renderer->hasPicture(i);
        if (kept)
            own = view.frame;
        if (ImagePtr traced = tracedPicture(i, frame)) {
            own.width = traced->width();
            own.height = traced->height();
            own.samples = 1;
            own.accumulate = own.coarse = false;
            own.radiance = std::move(traced);
        }
        const bool waits =
            m_places[i].isEmpty() || (!m_absences[i].text.isEmpty() && !own.radiance);
        differs = differs || waits != view.waits;
        if (!sameFrame(own, view.frame)) {
            others.push_back(i);
            onlyFiner =
                onlyFiner && own.radiance && view.frame.radiance && sameLook(own, view.frame);
        }
        view.waits = waits;
        view.frame = own;
        view.document.view.camera = own.camera;
    }
    if (differs)
        m_renderer->set(m_views, m_sameCells);
    else
        for (const std::size_t i : others)
            m_renderer->setFrame(i, m_views[i].frame);
    if (!differs && onlyFiner && !others.empty())
        m_comparison->refine();
    else if ((differs || !others.empty()) && !m_renderer->complete())
        m_comparison->outdate();
    m_sameCells = true;
    std::vector<QString> texts;
    for (std::size_t i = 0; i < m_views.size(); ++i) {
        const bool shows =
            m_absences[i].passes && (m_renderer->hasPicture(i) || m_views[i].frame.radiance);
        texts.push_back(shows ? QString() : m_absences[i].text);
    }
    m_wall->setTexts(std::move(texts));
}

bool WallPainter::isTraced(std::size_t index) const {
    return m_traced->tracer(index).has_value();
}

// Views of terms are drawn, and so is what is looked at before it is used.
ImagePtr WallPainter::tracedPicture(std::size_t index, const render::FrameSettings& frame) const {
    const bool shows = isTraced(index) && m_absences[index].passes &&
                       frame.view.isOrdinary(frame.view.shown) &&
                       !(previews() && index == m_wall->current());
    return shows ? m_traced->picture(index) : nullptr;
}

void WallPainter::traceCells(const render::FrameSettings& frame, const std::vector<QRect>& cells,
                             bool composed) {
    std::vector<TracedCells::Wanted> wanted(m_views.size());
    const bool ordinary = frame.view.isOrdinary(frame.view.shown);
    for (std::size_t i = 0; i < std::min(wanted.size(), cells.size()); ++i) {
        wanted[i].edited = composed && m_edited[i];
        if (!isTraced(i) || !m_resolved[i] || !ordinary || cells[i].isEmpty())
            continue;
        wanted[i].document = &m_views[i].document;
        wanted[i].camera = frameOf(frame, cells[i], 1.0f).camera;
        wanted[i].size = cells[i].size();
    }
    m_traced->want(wanted);
}

Result<bool> WallPainter::draw(double budgetMs) {
    return m_renderer ? m_renderer->proceed(budgetMs) : true;
}

Result<void> WallPainter::present(unsigned framebuffer, const QSize& size) {
    QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    const QColor well(tokens::kWell);
    gl->glClearColor(well.redF(), well.greenF(), well.blueF(), 1.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    if (!m_renderer)
        return {};
    const auto show = [&](std::size_t cell, const WallComparison::Shown& how) -> Result<void> {
        const QRect& place = m_places[cell];
        if (place.isEmpty() || !m_renderer->hasPicture(cell))
            return {};
        const int bottom = size.height() - place.y() - place.height();
        return m_renderer->picture(cell).present(
            framebuffer,
            {{place.x(), bottom, place.width(), place.height()}, how.split, how.opacity});
    };
    const std::optional<std::size_t> other = m_wall->compared();
    for (std::size_t i = 0; i < m_places.size(); ++i)
        if (i != other)
            if (auto done = show(i, {}); !done)
                return done;
    const WallComparison::Shown shown = m_comparison->shown();
    return other && *other < m_places.size() && shown.any ? show(*other, shown) : Result<void>();
}

bool WallPainter::isMeasurable(std::size_t index) const {
    return m_renderer->hasPicture(index) &&
           (!m_views[index].frame.radiance || m_traced->progress(index).samples > 0);
}

// Once both cells that are compared are as fine as they get; of traced ones the newest pictures.
void WallPainter::measure() {
    if (previews() || m_comparison->isMeasuring())
        return; // numbers are of the cells
    const std::optional<std::size_t> a = m_wall->enlarged();
    if (m_comparison->hasFile()) {
        if (!m_comparison->isOutdated() || !a || !complete() || preparing() || !isMeasurable(*a))
            return;
        const render::ViewRenderer& picture = m_renderer->picture(*a);
        m_comparison->measureFile(withoutAlpha(picture.readDisplayed()),
                                  m_comparison->wantsRadiance() ? picture.readLinear() : Image(),
                                  m_views[*a].document.view);
        return;
    }
    const std::optional<std::size_t> b = m_wall->compared();
    if (!m_comparison->isOutdated() || !a || !b || !complete() || preparing() ||
        !isMeasurable(*a) || !isMeasurable(*b))
        return;
    m_comparison->measure(withoutAlpha(m_renderer->picture(*a).readDisplayed()),
                          withoutAlpha(m_renderer->picture(*b).readDisplayed()));
}

// --- Sheets --------------------------------------------------------------------------------------

std::optional<std::size_t> WallPainter::shownCell() const {
    for (std::size_t i = 0; i < std::min(m_places.size(), m_views.size()); ++i)
        if (!m_places[i].isEmpty())
            return i;
    return std::nullopt;
}

QSize WallPainter::sheetCellSize(int width) const {
    const std::optional<std::size_t> shown = shownCell();
    if (!shown)
        return {};
    const QRect& place = m_places[*shown];
    const double height = static_cast<double>(width) * place.height() / place.width();
    return {width, std::max(1, static_cast<int>(std::lround(height)))};
}

std::optional<std::vector<WallPainter::SheetCell>> WallPainter::sheetCells(int width) const {
    const std::optional<std::size_t> shown = shownCell();
    if (!isOn() || !m_composed || preparing() || previews() || !shown)
        return std::nullopt;
    const QSize size = sheetCellSize(width);
    std::vector<SheetCell> cells;
    for (std::size_t i = 0; i < m_views.size(); ++i) {
        SheetCell& cell = cells.emplace_back(SheetCell{m_views[i], m_absences[i].text});
        render::FrameSettings& frame = cell.view.frame;
        frame = m_views[*shown].frame; // the camera is all cells' own
        frame.width = size.width();
        frame.height = size.height();
        frame.samples = 1; // the mean of some frames is as smooth
        frame.accumulate = true;
        frame.coarse = frame.dither = false;
        frame.radiance = nullptr;
        cell.view.document.view.camera = frame.camera;
        cell.view.waits = false;
        if (frame.view.isOrdinary(frame.view.shown))
            cell.tracer = m_traced->tracer(i);
        cell.whitted = m_traced->whitted();
    }
    return cells;
}

Result<std::optional<Image>> WallPainter::drawSheetFrame(render::SceneRenderer& scene,
                                                         const render::CellView& cell, bool begins,
                                                         bool linear) {
    if (!m_renderer)
        m_renderer = std::make_unique<render::WallRenderer>(scene);
    begins = begins || !m_sheetPicture;
    if (!m_sheetPicture)
        m_sheetPicture = std::make_unique<render::ViewRenderer>(scene);
    if (auto done = m_renderer->drawFrame(cell, *m_sheetPicture, !begins); !done)
        return done.error();
    if (!render::WallRenderer::isFine(cell, *m_sheetPicture))
        return std::optional<Image>();
    return std::optional(linear ? m_sheetPicture->readLinear() : m_sheetPicture->readDisplayed());
}

void WallPainter::endSheet() {
    m_sheetPicture.reset();
}

} // namespace patina::editor
