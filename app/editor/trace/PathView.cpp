#include "app/editor/trace/PathView.h"

#include "app/editor/document/DocumentController.h"
#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/error/SeenMaterials.h"
#include "core/trace/whitted/WhittedTracer.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kTag = "path tracing";
// The sides of the first pictures, of one sample, are these shares of the full ones.
constexpr int kCoarsest = 8;
// A pass takes about so long, so that the picture is seen to become finer; and between two of them
// what somebody waits for comes first.
constexpr double kPassSeconds = 0.25;
constexpr std::uint32_t kMostAtOnce = 64;
// Of a classical picture through the lens, the only thing in it that is spread.
constexpr std::uint32_t kMostWhittedSamples = 256;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TraceView reduced(TraceView view, int reduction) {
    view.width = std::max(1, view.width / reduction);
    view.height = std::max(1, view.height / reduction);
    return view;
}

// Whether both have the same behind the scene; the environment itself is part of the inputs.
bool sameBackground(const View& a, const View& b) {
    return a.background == b.background &&
           (a.background != BackgroundMode::Color || a.backgroundColor == b.backgroundColor) &&
           (a.background != BackgroundMode::Blurred || a.backgroundBlur == b.backgroundBlur);
}

} // namespace

struct PathView::Work {
    TraceInputs inputs;
    std::shared_ptr<const TraceScene> scene; // null: to be built, like `previous` where it can be
    std::shared_ptr<const TraceScene> previous;
    TraceView view;
    std::optional<EnvironmentPart> behind; // blurred, in place of the environment
    float blur = 0.0f;
    BlurredLight blurred;      // as far as it is known
    int reduction = kCoarsest; // of the next pass; 1: full size
    Film film;                 // of full size
    std::uint32_t samples = 0, next = 1;
    std::shared_ptr<const std::vector<Id>> materials; // null: not looked for yet
    TracedBy tracer = TracedBy::Paths;
    WhittedSettings whitted;

    // A pinhole's classical picture is done after the corners of pixels and what lies between those
    // that differ.
    [[nodiscard]] std::uint32_t mostSamples() const {
        if (tracer == TracedBy::Paths)
            return kMostSamples;
        if (whitted.isStochastic())
            return kMostWhittedSamples;
        return whitted.subdivisions > 0 ? 2 : 1;
    }
};

PathView::PathView(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_tasks(controller.runner()) {}

void PathView::setOn(bool on) {
    if (on == m_on)
        return;
    m_on = on;
    m_paused = m_tells = false;
    m_reference = {};
    m_tasks.cancel(kTag);
    m_work = nullptr;
    m_scene = nullptr;
    m_blurred = {};
    m_picture = nullptr;
    m_inputs = {};
    m_behind = {};
    m_size = {};
    m_stale = false;
    m_progress = {};
    Q_EMIT changed();
}

void PathView::setTracer(TracedBy tracer) {
    if (tracer == m_tracer)
        return;
    m_tracer = tracer;
    if (m_on && m_work)
        begin();
    Q_EMIT changed();
}

void PathView::setWhitted(const WhittedSettings& settings) {
    if (settings == m_whitted)
        return;
    m_whitted = settings;
    if (isWhitted() && m_work)
        begin();
    Q_EMIT changed();
}

std::optional<PathView::Frame> PathView::frame() const {
    if (!m_on || !m_work || !m_scene || m_progress.samples == 0)
        return std::nullopt;
    return Frame{m_scene, m_work->view};
}

bool PathView::isTracing() const {
    return m_tasks.busy(kTag);
}

void PathView::setPaused(bool paused) {
    if (!m_on || paused == m_paused)
        return;
    m_paused = paused;
    if (!paused)
        proceed();
    Q_EMIT changed();
}

void PathView::setTellsCertainty(bool tells) {
    if (!m_on || tells == m_tells)
        return;
    m_tells = tells;
    if (!tells)
        m_reference = {};
    else if (m_work && !m_tasks.busy(kTag) && m_work->samples > 1)
        run(false); // it rests
}

void PathView::want(const Camera& camera, const QSize& size) {
    if (!m_on || size.isEmpty())
        return;
    TraceInputs inputs = traceInputs(m_controller.document());
    const View& look = m_controller.document().view;
    const EnvironmentPart behind = shownEnvironment(m_controller.document());
    if (camera == m_camera && size == m_size && sameBackground(look, m_look) &&
        inputs == m_inputs && (look.background != BackgroundMode::Blurred || behind == m_behind))
        return;
    m_inputs = std::move(inputs);
    m_camera = camera;
    m_look = look;
    m_behind = behind;
    m_size = size;
    m_stale = true;
    if (!m_work || m_hasFirst || !m_tasks.busy(kTag))
        begin();
}

void PathView::begin() {
    m_stale = false;
    m_tasks.cancel(kTag);
    m_work = std::make_shared<Work>();
    m_work->inputs = m_inputs;
    m_work->previous = m_scene;
    m_work->view.camera = m_camera;
    m_work->view.width = m_size.width();
    m_work->view.height = m_size.height();
    m_work->view.transparent = m_look.background == BackgroundMode::Off;
    if (m_look.background == BackgroundMode::Color)
        m_work->view.background = [color = m_look.backgroundColor](const glm::vec3&) {
            return color;
        };
    if (m_look.background == BackgroundMode::Blurred && m_behind.image) {
        m_work->behind = m_behind;
        m_work->blur = m_look.backgroundBlur;
        m_work->blurred = m_blurred;
    }
    m_work->tracer = m_tracer;
    m_work->whitted = m_whitted;
    m_work->whitted.depthOfField = m_camera.lensRadius() > 0.0f;
    m_hasFirst = m_paused = false;
    m_reference = {};
    ++m_number;
    m_progress = {};
    m_rays = 0.0;
    proceed();
}

void PathView::proceed() {
    if (!m_work || m_progress.refined || m_tasks.busy(kTag) ||
        (m_paused && m_work->reduction < kCoarsest))
        return;
    run(true);
}

void PathView::run(bool traces) {
    m_tasks.run(
        {.tag = kTag, .priority = m_work->samples == 0 ? TaskPriority::Normal : TaskPriority::Low},
        [work = m_work, traces, tells = m_tells](const JobContext& job) {
            return trace(*work, traces, tells, job);
        },
        [this, work = m_work](const Result<Pass>& pass) {
            if (work == m_work)
                take(pass);
        });
}

void PathView::take(const Result<Pass>& pass) {
    if (!pass) {
        if (pass.error().kind != ErrorKind::Cancelled) {
            m_progress.error = pass.error();
            m_progress.refined = true;
            m_picture = nullptr;
        }
        Q_EMIT changed();
        return;
    }
    m_hasFirst = true;
    m_scene = pass->scene;
    if (pass->blurred.maps)
        m_blurred = pass->blurred;
    if (pass->picture)
        m_picture = pass->picture;
    if (pass->reference.traced && m_tells)
        m_reference = pass->reference;
    m_rays += pass->rays;
    m_progress.samples = m_work->samples;
    m_progress.limit = pass->scene->limit();
    if (pass->noise)
        m_progress.noise = pass->noise;
    m_progress.seconds += pass->seconds;
    m_progress.raysPerSecond = m_progress.seconds > 0.0 ? m_rays / m_progress.seconds : 0.0;
    m_progress.rays = m_rays;
    m_progress.refined = m_work->samples >= m_work->mostSamples() ||
                         (m_progress.noise && *m_progress.noise <= kCertain);
    const bool rests = m_progress.refined || m_paused;
    if (m_stale)
        begin();
    else if (rests && m_tells && !m_reference.traced && pass->traces && m_work->samples > 1)
        run(false); // it was asked for in the last pass
    else
        proceed();
    Q_EMIT changed();
}

// The view is complete since the first picture: what is blurred behind the scene is part of it.
PathView::Subject PathView::subject() const {
    if (!m_work || !m_hasFirst || m_stale)
        return {};
    return {m_scene, m_work->view, m_work->inputs.model};
}

// As the viewport blurs it, from small maps: what is blurred has no detail.
Result<void> PathView::blurBackground(Work& work, const JobContext& job) {
    if (!work.behind)
        return {};
    if (!work.blurred.maps || work.blurred.image != work.behind->image) {
        Result<IblMaps> maps = computeIbl(*work.behind->image, IblSettings::quick(), job);
        if (!maps)
            return maps.error();
        work.blurred = {work.behind->image, std::make_shared<const IblMaps>(*std::move(maps))};
    }
    work.view.background = blurredBackground(work.blurred.maps, *work.behind, work.blur);
    return {};
}

PathView::Reference PathView::tell(Work& work, const JobContext& job) {
    std::optional<TracedPicture> traced = tracedPicture(work.film);
    if (!traced)
        return {};
    if (!work.materials) {
        auto seen =
            std::make_shared<const std::vector<Id>>(seenMaterials(*work.scene, work.view, job));
        if (job.cancelled())
            return {};
        work.materials = std::move(seen);
    }
    return {std::make_shared<const TracedPicture>(*std::move(traced)), work.materials};
}

Result<PathView::Pass> PathView::trace(Work& work, bool traces, bool tells, const JobContext& job) {
    if (!traces) {
        Pass pass;
        pass.scene = work.scene;
        pass.blurred = work.blurred;
        pass.reference = tell(work, job);
        return pass;
    }
    if (!work.scene) {
        Result<TraceScene> built = TraceScene::build(work.inputs, job, work.previous.get());
        if (!built)
            return built.error();
        work.scene = std::make_shared<const TraceScene>(*std::move(built));
        work.previous = nullptr;
        if (auto made = blurBackground(work, job); !made)
            return made.error();
    }
    const auto start = std::chrono::steady_clock::now();
    Pass pass;
    pass.scene = work.scene;
    pass.blurred = work.blurred;
    TraceRays rays;
    pass.traces = true;
    const Result<void> traced = work.tracer == TracedBy::Whitted
                                    ? traceWhittedPass(work, pass, job, rays)
                                    : tracePass(work, pass, job, rays);
    if (!traced)
        return traced.error();
    if (tells && work.tracer == TracedBy::Paths && work.samples > 0)
        pass.reference = tell(work, job);
    if (2.0 * secondsSince(start) < kPassSeconds && work.samples > 0)
        work.next = std::min(2 * work.next, kMostAtOnce);
    pass.rays = static_cast<double>(rays.count);
    pass.seconds = secondsSince(start);
    return pass;
}

Result<void> PathView::tracePass(Work& work, Pass& pass, const JobContext& job, TraceRays& rays) {
    if (work.reduction > 1) {
        const TraceView coarse = reduced(work.view, work.reduction);
        Film film(coarse.width, coarse.height);
        if (auto done = tracePaths(*work.scene, coarse, {}, film, 0, 1, job, &rays); !done)
            return done;
        pass.picture = std::make_shared<const Image>(film.radiance(true));
        work.reduction /= 2;
        return {};
    }
    if (work.samples == 0)
        work.film = Film(work.view.width, work.view.height);
    const std::uint32_t count = std::min(work.next, kMostSamples - work.samples);
    if (auto done =
            tracePaths(*work.scene, work.view, {}, work.film, work.samples, count, job, &rays);
        !done)
        return done;
    work.samples += count;
    pass.picture = std::make_shared<const Image>(work.film.radiance(true));
    pass.noise = work.film.noise();
    return {};
}

Result<void> PathView::traceWhittedPass(Work& work, Pass& pass, const JobContext& job,
                                        TraceRays& rays) {
    WhittedSettings settings = work.whitted;
    if (work.reduction == 1 && settings.isStochastic()) {
        if (work.samples == 0)
            work.film = Film(work.view.width, work.view.height);
        const std::uint32_t count = std::min(work.next, kMostWhittedSamples - work.samples);
        if (auto done = traceWhitted(*work.scene, work.view, settings, work.film, work.samples,
                                     count, job, &rays);
            !done)
            return done;
        work.samples += count;
        pass.picture = std::make_shared<const Image>(work.film.radiance(true));
        pass.noise = work.film.noise();
        return {};
    }
    const TraceView view = reduced(work.view, work.reduction);
    if (work.reduction > 1 || work.samples == 0)
        settings.subdivisions = 0;
    Film film(view.width, view.height);
    if (auto done = traceWhitted(*work.scene, view, settings, film, 0, 1, job, &rays); !done)
        return done;
    pass.picture = std::make_shared<const Image>(film.radiance(true));
    if (work.reduction > 1)
        work.reduction /= 2;
    else
        ++work.samples;
    return {};
}

} // namespace patina::editor
