#include "app/editor/trace/TraceWork.h"

#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/error/SeenMaterials.h"
#include "core/trace/whitted/WhittedTracer.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

namespace patina::editor {
namespace {

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

// Edits of others change no picture.
TraceInputs withUsedMaterials(TraceInputs inputs) {
    std::vector<Material> used;
    std::map<std::size_t, std::size_t> places;
    for (TraceMesh& mesh : inputs.meshes) {
        const auto [place, isNew] = places.try_emplace(mesh.material, used.size());
        if (isNew)
            used.push_back(inputs.materials.at(mesh.material));
        mesh.material = place->second;
    }
    inputs.materials = std::move(used);
    return inputs;
}

} // namespace

TraceSubject TraceSubject::of(const Document& document, const Camera& camera, const QSize& size) {
    return {withUsedMaterials(traceInputs(document)), camera, size, document.view,
            shownEnvironment(document)};
}

bool TraceSubject::sameAs(const TraceSubject& other) const {
    return camera == other.camera && size == other.size && sameBackground(look, other.look) &&
           inputs == other.inputs &&
           (look.background != BackgroundMode::Blurred || behind == other.behind);
}

TraceWork::TraceWork(const TraceSubject& subject, TracedBy tracer, const WhittedSettings& whitted,
                     Known known)
    : m_inputs(subject.inputs)
    , m_known(std::move(known))
    , m_tracer(tracer)
    , m_whitted(whitted) {
    m_view.camera = subject.camera;
    m_view.width = subject.size.width();
    m_view.height = subject.size.height();
    m_view.transparent = subject.look.background == BackgroundMode::Off;
    if (subject.look.background == BackgroundMode::Color)
        m_view.background = [color = subject.look.backgroundColor](const glm::vec3&) {
            return color;
        };
    if (subject.look.background == BackgroundMode::Blurred && subject.behind.image) {
        m_behind = subject.behind;
        m_blur = subject.look.backgroundBlur;
    }
    m_whitted.depthOfField = subject.camera.lensRadius() > 0.0f;
}

void TraceWork::setFine(std::uint32_t samples) {
    m_reduction = 1;
    m_most = samples;
}

// A pinhole's classical picture is done after the corners of pixels and what lies between those
// that differ.
std::uint32_t TraceWork::mostSamples() const {
    if (m_tracer == TracedBy::Paths)
        return m_most.value_or(kMostSamples);
    if (m_whitted.isStochastic())
        return m_most.value_or(kMostWhittedSamples);
    return m_whitted.subdivisions > 0 ? 2 : 1;
}

// As the viewport blurs it, from small maps: what is blurred has no detail.
Result<void> TraceWork::blurBackground(const JobContext& job) {
    if (!m_behind)
        return {};
    BlurredLight& blurred = m_known.blurred;
    if (!blurred.maps || blurred.image != m_behind->image) {
        Result<IblMaps> maps = computeIbl(*m_behind->image, IblSettings::quick(), job);
        if (!maps)
            return maps.error();
        blurred = {m_behind->image, std::make_shared<const IblMaps>(*std::move(maps))};
    }
    m_view.background = blurredBackground(blurred.maps, *m_behind, m_blur);
    return {};
}

Result<void> TraceWork::prepare(const JobContext& job) {
    if (m_scene)
        return {};
    if (m_known.scene && m_known.scene->inputs() == m_inputs) {
        m_scene = m_known.scene;
    } else {
        Result<TraceScene> built = TraceScene::build(m_inputs, job, m_known.scene.get());
        if (!built)
            return built.error();
        m_scene = m_known.scene = std::make_shared<const TraceScene>(*std::move(built));
    }
    return blurBackground(job);
}

TraceWork::Reference TraceWork::reference(const JobContext& job) {
    std::optional<TracedPicture> traced = tracedPicture(m_film);
    if (!traced)
        return {};
    if (!m_materials) {
        auto seen = std::make_shared<const std::vector<Id>>(seenMaterials(*m_scene, m_view, job));
        if (job.cancelled())
            return {};
        m_materials = std::move(seen);
    }
    return {std::make_shared<const TracedPicture>(*std::move(traced)), m_materials};
}

TraceWork::Pass TraceWork::tell(const JobContext& job) {
    Pass pass;
    pass.known = m_known;
    pass.reference = reference(job);
    return pass;
}

Result<TraceWork::Pass> TraceWork::trace(double seconds, bool tells, const JobContext& job) {
    if (Result<void> prepared = prepare(job); !prepared)
        return prepared.error();
    const auto start = std::chrono::steady_clock::now();
    Pass pass;
    pass.known = m_known;
    pass.traces = true;
    TraceRays rays;
    const Result<void> traced = m_tracer == TracedBy::Whitted ? traceWhittedPass(pass, job, rays)
                                                              : tracePass(pass, job, rays);
    if (!traced)
        return traced.error();
    if (tells && m_tracer == TracedBy::Paths && m_samples > 0)
        pass.reference = reference(job);
    if (2.0 * secondsSince(start) < seconds && m_samples > 0)
        m_next = std::min(2 * m_next, kMostAtOnce);
    pass.rays = static_cast<double>(rays.count);
    pass.seconds = secondsSince(start);
    return pass;
}

Result<void> TraceWork::addSamples(Pass& pass, const JobContext& job, TraceRays& rays) {
    if (m_samples == 0)
        m_film = Film(m_view.width, m_view.height);
    const std::uint32_t count = std::min(m_next, mostSamples() - m_samples);
    if (auto done =
            m_tracer == TracedBy::Paths
                ? tracePaths(*m_scene, m_view, {}, m_film, m_samples, count, job, &rays)
                : traceWhitted(*m_scene, m_view, m_whitted, m_film, m_samples, count, job, &rays);
        !done)
        return done;
    m_samples += count;
    pass.picture = std::make_shared<const Image>(m_film.radiance(true));
    pass.noise = m_film.noise();
    return {};
}

Result<void> TraceWork::tracePass(Pass& pass, const JobContext& job, TraceRays& rays) {
    if (m_reduction == 1)
        return addSamples(pass, job, rays);
    const TraceView coarse = reduced(m_view, m_reduction);
    Film film(coarse.width, coarse.height);
    if (auto done = tracePaths(*m_scene, coarse, {}, film, 0, 1, job, &rays); !done)
        return done;
    pass.picture = std::make_shared<const Image>(film.radiance(true));
    m_reduction /= 2;
    return {};
}

Result<void> TraceWork::traceWhittedPass(Pass& pass, const JobContext& job, TraceRays& rays) {
    if (m_reduction == 1 && m_whitted.isStochastic())
        return addSamples(pass, job, rays);
    WhittedSettings settings = m_whitted;
    const TraceView view = reduced(m_view, m_reduction);
    if (m_reduction > 1 || m_samples == 0)
        settings.subdivisions = 0;
    Film film(view.width, view.height);
    if (auto done = traceWhitted(*m_scene, view, settings, film, 0, 1, job, &rays); !done)
        return done;
    pass.picture = std::make_shared<const Image>(film.radiance(true));
    if (m_reduction > 1)
        m_reduction /= 2;
    else
        ++m_samples;
    return {};
}

void TraceProgress::add(const TraceWork::Pass& pass, const TraceWork& work) {
    samples = work.samples();
    limit = pass.known.scene->limit();
    if (pass.noise)
        noise = pass.noise;
    rays += pass.rays;
    seconds += pass.seconds;
    raysPerSecond = seconds > 0.0 ? rays / seconds : 0.0;
    refined = samples >= work.mostSamples() || (noise && *noise <= TraceWork::kCertain);
}

void TraceProgress::fail(const Error& reason) {
    error = reason;
    refined = true;
}

} // namespace patina::editor
