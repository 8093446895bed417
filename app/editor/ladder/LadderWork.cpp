#include "app/editor/ladder/LadderWork.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/image/Channels.h"
#include "core/light/Ibl.h"
#include "core/material/Material.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/error/PictureErrorMap.h"
#include "render/RungRenderer.h"
#include "render/SceneRenderer.h"
#include "render/gl/Context.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

// Of the progress: until light is prepared, until what needs no bake is drawn, until the picture is
// traced, until the bakes are there.
constexpr double kLadderPrepared = 0.1, kLadderDrawn = 0.15, kLadderTraced = 0.55,
                 kLadderBaked = 0.9;
// Errors are measured when there are so many paths per pixel, then at four times as many, …
constexpr std::uint32_t kFirstMeasured = 6;

QImage toQImage(const Image& picture) { // U8, 3 channels
    const auto bytes = picture.u8();
    const int width = picture.width(), height = picture.height();
    return QImage(bytes.data(), width, height, 3 * width, QImage::Format_RGB888).copy();
}

class LadderMaker {
  public:
    LadderMaker(std::shared_ptr<const LadderOrder> order, PreparedLights& lights,
                const std::function<void(LadderShownPtr)>& shown, const JobContext& job)
        : m_order(std::move(order))
        , m_lights(lights)
        , m_tell(shown)
        , m_job(job)
        , m_scene(m_order->scene) {
        m_shown.order = m_order;
        m_shown.kept = m_order->kept;
    }

    Result<LadderShownPtr> run() {
        if (m_scene.document.view.toneMap == ToneMap::OpenColorIo)
            return Error{ErrorKind::Usage,
                         "The ladder compares pictures with Patina's own tone curves; choose one "
                         "in place of OpenColorIO in the Camera dock.",
                         {},
                         {}};
        for (const auto step : {&LadderMaker::prepare, &LadderMaker::drawDue, &LadderMaker::trace,
                                &LadderMaker::bake, &LadderMaker::drawDue, &LadderMaker::measure})
            if (Result<void> done = (this->*step)(); !done)
                return done.error();
        m_shown.seconds = m_truth->seconds;
        return std::make_shared<const LadderShown>(m_shown);
    }

  private:
    void tell() const { m_tell(std::make_shared<const LadderShown>(m_shown)); }

    Result<void> prepare() {
        m_job.setActivity("preparing light");
        if (Result<void> completed = completeEnvironments(m_scene.document, m_job); !completed)
            return completed;
        m_inputs = hashBakeInputs(bakeInputs(m_scene.document));
        const bool kept = m_order->kept && m_order->kept->inputs == m_inputs;
        m_lit = traceInputs(m_scene.document);
        LadderBakes bakes = attachedLadderBakes(m_scene.document);
        if (kept) {
            const BakeArtifactPtr attached = std::exchange(bakes, m_order->kept->bakes).lightMap;
            if (m_order->kept->lit != m_lit)
                bakes.lightMap = attached;
        }
        setRungs(bakes);
        m_shown.steps.emplace_back();
        m_shown.steps.back().name = "path";
        m_shown.steps.back().label = "Path traced";
        tell();
        const Result<EnvironmentTexelsPtr> light =
            lightOf(m_scene, m_lights, m_job.part(0.0, kLadderPrepared));
        if (!light)
            return light.error();
        Result<std::unique_ptr<gl::Context>> context = gl::Context::createHeadless();
        if (!context)
            return context.error();
        m_context = std::move(*context);
        Result<std::unique_ptr<render::SceneRenderer>> renderer =
            render::SceneRenderer::create(*m_context);
        if (!renderer)
            return renderer.error();
        m_renderer = std::move(*renderer);
        render::FrameSettings frame;
        frame.width = m_order->width;
        frame.height = m_order->height;
        frame.samples = 1; // the mean of several frames, as the viewport shows a picture at rest
        frame.accumulate = frame.floats = true;
        frame.camera = m_scene.document.view.camera;
        m_drawer = std::make_unique<render::RungRenderer>(*m_renderer, frame, *light);
        return {};
    }

    void setRungs(const LadderBakes& bakes) {
        m_bakes = bakes;
        m_rungs = ladderRungs(m_scene.document, bakes);
        m_shown.steps.resize(std::max(m_rungs.size(), m_shown.steps.size()));
        m_drawn.resize(m_rungs.size());
        for (std::size_t i = 0; i < m_rungs.size(); ++i) {
            const LadderRung& rung = m_rungs[i];
            LadderStep& step = m_shown.steps[i];
            step.name = rung.name;
            step.label = rung.label;
            step.lighting = rung.document.view.lighting;
            step.bake = rung.name == "ao"                         ? bakes.occlusion
                        : step.lighting == LightingMode::LightMap ? bakes.lightMap
                        : needsLadderBake(step)                   ? bakes.transfer
                                                                  : nullptr;
            // Until it is baked it only waits.
            step.whyNot = needsLadderBake(step) && !step.bake ? std::string() : rung.whyNot;
            step.bakeSeconds = rung.bakeSeconds;
        }
    }

    Result<void> bake() {
        if (m_bakes.occlusion && m_bakes.transfer && m_bakes.lightMap)
            return {};
        Document document = m_scene.document; // with those that there are
        for (const BakeArtifactPtr& bake : {m_bakes.occlusion, m_bakes.transfer, m_bakes.lightMap})
            if (bake)
                attachBake(document, bake);
        const auto prepare = [&](const Image& environment) {
            return computeIbl(environment, IblSettings(), m_job);
        };
        const Result<LadderBakes> made =
            ladderBakes(document, {}, prepare, m_job.part(kLadderTraced, kLadderBaked));
        if (!made)
            return made.error();
        setRungs(*made);
        m_shown.kept =
            std::make_shared<const KeptLadderBakes>(KeptLadderBakes{m_inputs, *made, m_lit});
        return {};
    }

    // What can be drawn by now and is not.
    Result<void> drawDue() {
        for (std::size_t i = 0; i < m_rungs.size(); ++i) {
            if (!m_rungs[i].whyNot.empty() || m_drawn[i])
                continue;
            m_job.setActivity(m_rungs[i].label);
            SceneCopy lit{m_rungs[i].document, {}, nullptr, m_scene.shadows};
            if (Result<void> completed = completeTransfer(lit, lit.document.view.lighting, m_job);
                !completed)
                return completed;
            if (lit.shadows)
                m_scene.shadows = lit.shadows;
            Result<render::RungRenderer::Drawn> drawn =
                m_drawer->draw(std::move(lit.document), lit.shadows, m_job);
            if (!drawn)
                return drawn.error();
            m_drawn[i] = std::move(drawn->picture);
            m_shown.steps[i].milliseconds = drawn->milliseconds;
            if (drawn->solvedSeconds > 0.0)
                m_shown.steps[i].bakeSeconds = drawn->solvedSeconds;
            if (Result<void> shown = display(i, luminanceOf(*m_drawn[i])); !shown)
                return shown;
            tell();
        }
        if (!m_truth)
            m_job.setProgress(kLadderDrawn);
        return {};
    }

    Result<void> trace() {
        const JobContext tracing = m_job.part(kLadderDrawn, kLadderTraced);
        TraceView view;
        view.camera = m_scene.document.view.camera;
        view.width = m_order->width;
        view.height = m_order->height;
        // As the viewport blurs it, from small maps: what is blurred has no detail.
        const auto prepareBlurred = [&](const Image& environment) {
            return computeIbl(environment, IblSettings::quick(), m_job);
        };
        if (Result<void> set = setTracedBackground(m_scene.document, view, prepareBlurred); !set)
            return set;
        Result<void> measured;
        std::uint32_t next = kFirstMeasured;
        const auto seen = [&](const Film& film, std::uint32_t samples) {
            if (samples < next || !measured)
                return;
            next = 4 * samples;
            measured =
                measureAgainst(*tracedPicture(film), {}, samples, film.noise().value_or(0.0));
        };
        Result<LadderTruth> truth =
            traceLadderTruth(m_scene.document, view, m_order->truth, tracing, seen);
        if (!truth)
            return truth.error();
        if (!measured)
            return measured;
        m_truth = *std::move(truth);
        m_shown.limit = m_truth->limit;
        return measure();
    }

    Result<void> measure() {
        return measureAgainst(m_truth->picture, m_truth->materials, m_truth->samples,
                              m_truth->noise);
    }

    // All that is drawn against the traced picture as it is by now.
    Result<void> measureAgainst(const TracedPicture& traced, const std::vector<Id>& materials,
                                std::uint32_t samples, double noise) {
        const Luminance luminance = luminanceOf(traced.radiance);
        for (std::size_t i = 0; i < m_drawn.size(); ++i) {
            LadderStep& step = m_shown.steps[i];
            if (!m_drawn[i] || (i < m_measured.size() && m_measured[i]))
                continue;
            const Result<PictureError> error =
                pictureError(*m_drawn[i], traced, m_scene.document.view, materials, m_job);
            if (!error)
                return error.error();
            step.score = error->whole;
            step.exposure = toQImage(errorPicture(*error, ErrorShown::Exposure));
            step.visible = toQImage(errorPicture(*error, ErrorShown::Visible));
            m_measured.resize(m_drawn.size());
            m_measured[i] = m_truth.has_value();
            if (Result<void> shown = display(i, luminance); !shown)
                return shown;
        }
        const Result<Image> shown =
            displayedPicture(traced.radiance, m_scene.document.view, luminance);
        if (!shown)
            return shown.error();
        m_shown.steps.back().picture = toQImage(*shown);
        m_shown.samples = samples;
        m_shown.noise = noise;
        tell();
        return {};
    }

    Result<void> display(std::size_t rung, const Luminance& luminance) {
        const Result<Image> shown =
            displayedPicture(withoutAlpha(*m_drawn[rung]), m_scene.document.view, luminance);
        if (!shown)
            return shown.error();
        m_shown.steps[rung].picture = toQImage(*shown);
        return {};
    }

    std::shared_ptr<const LadderOrder> m_order;
    PreparedLights& m_lights;
    const std::function<void(LadderShownPtr)>& m_tell;
    const JobContext& m_job;
    SceneCopy m_scene;
    Hash m_inputs;
    TraceInputs m_lit;
    LadderBakes m_bakes;
    std::unique_ptr<gl::Context> m_context; // outlives what it holds
    std::unique_ptr<render::SceneRenderer> m_renderer;
    std::unique_ptr<render::RungRenderer> m_drawer;
    // Of each rung.
    std::vector<LadderRung> m_rungs;
    std::vector<std::optional<Image>> m_drawn; // linear
    std::vector<bool> m_measured;              // against the finished truth
    std::optional<LadderTruth> m_truth;        // finished
    LadderShown m_shown;
};

} // namespace

Result<LadderShownPtr> runLadder(std::shared_ptr<const LadderOrder> order, PreparedLights& lights,
                                 const std::function<void(LadderShownPtr)>& shown,
                                 const JobContext& job) {
    return LadderMaker(std::move(order), lights, shown, job).run();
}

bool needsLadderBake(const LadderStep& step) {
    return step.name == "ao" || readsBake(step.lighting) || step.lighting == LightingMode::LightMap;
}

std::optional<std::size_t> stepInUse(const std::vector<LadderStep>& steps,
                                     const Document& document) {
    const bool occluded = attachedLadderBakes(document).occlusion != nullptr;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (steps[i].score && steps[i].lighting == document.view.lighting &&
            (steps[i].lighting != LightingMode::Ibl || (steps[i].name == "ao") == occluded))
            return i;
    return std::nullopt;
}

std::optional<std::size_t> closestStep(const std::vector<LadderStep>& steps,
                                       const Document& document) {
    // Its baked occlusion stays: light without it is out of reach.
    const bool occluded = attachedLadderBakes(document).occlusion != nullptr;
    std::optional<std::size_t> closest;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (steps[i].score && steps[i].whyNot.empty() && !(occluded && steps[i].name == "ibl") &&
            (!closest || steps[i].score->flip < steps[*closest].score->flip))
            closest = i;
    return closest;
}

bool stillHolds(const LadderOrder& order, const Document& document) {
    const Document& then = order.scene.document;
    View before = then.view;
    before.lighting = document.view.lighting;
    return before == document.view && traceInputs(then) == traceInputs(document);
}

} // namespace patina::editor
