#include "app/editor/viewport/IblUpdater.h"

#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <QMetaObject>

namespace patina::editor {
namespace {

constexpr IblSettings kFull;

EnvironmentTexelsPtr makeTexels(const ImagePtr& environment, const IblMaps& maps,
                                const HalfMipmapsPtr& background) {
    return std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(environment, maps, background));
}

} // namespace

IblUpdater::IblUpdater(const std::filesystem::path& cacheFolder, QObject* parent)
    : QObject(parent)
    , m_cache(cacheFolder) {
    m_pool.setMaxThreadCount(1); // newest wins: a cancelled request ends quickly
    m_finePool.setMaxThreadCount(1);
}

IblUpdater::~IblUpdater() {
    m_control.cancel();
    m_pool.waitForDone(); // which may still start something in the other
    m_finePool.waitForDone();
}

void IblUpdater::request(ImagePtr environment) {
    if (environment == m_environment || !environment)
        return;
    m_environment = std::move(environment);
    m_finished = false;
    if (m_firstUnderWay)
        m_waiting = true;
    else
        start();
}

void IblUpdater::renew() {
    if (m_environment && !m_texels && !m_firstUnderWay)
        start();
}

void IblUpdater::start() {
    m_control.cancel();
    m_control = JobControl();
    m_firstUnderWay = true;
    m_waiting = m_finished = false;
    const quint64 id = ++m_request;
    m_pool.start(
        [this, id, image = m_environment, job = m_control.context()] { prepare(id, image, job); });
}

void IblUpdater::prepare(quint64 request, const ImagePtr& environment, const JobContext& job) {
    const Hash key = IblCache::key(*environment, kFull);
    std::optional<IblMaps> found = m_cache.find(key);
    const bool known = found.has_value();
    const Result<HalfMipmapsPtr> background = makeBackground(*environment, job);
    if (!background)
        return fail(request, background.error());
    // Reduced first: the eye gets light at once, the full resolution follows.
    Result<IblMaps> maps =
        known ? std::move(*found) : computeIbl(*environment, IblSettings::quick(), job);
    if (!maps)
        return fail(request, maps.error());
    const auto shared = std::make_shared<const IblMaps>(std::move(*maps));
    post(request, makeTexels(environment, *shared, *background), shared, known);
    if (!known)
        m_finePool.start([=, this, background = *background] {
            lowerThreadPriority();
            refine(request, key, environment, background, job);
        });
}

void IblUpdater::refine(quint64 request, const Hash& key, const ImagePtr& environment,
                        const HalfMipmapsPtr& background, const JobContext& job) {
    Result<IblMaps> maps = computeIbl(*environment, kFull, job);
    if (!maps)
        return fail(request, maps.error());
    const auto shared = std::make_shared<const IblMaps>(std::move(*maps));
    post(request, makeTexels(environment, *shared, background), shared, true);
    // The disk may take its time: nobody waits for it. What a drag passes over is not kept.
    if (request == m_request)
        if (const Result<void> stored = m_cache.store(key, *shared); !stored)
            logWarning("The light of this environment could not be kept for next time: {}",
                       stored.error().text());
}

void IblUpdater::fail(quint64 request, const Error& error) {
    if (error.kind != ErrorKind::Cancelled)
        logError("image-based light: {}", error.text());
    post(request, nullptr, nullptr, true);
}

void IblUpdater::post(quint64 request, EnvironmentTexelsPtr texels,
                      std::shared_ptr<const IblMaps> maps, bool last) {
    // The destructor waits for the pool, so `this` is alive.
    QMetaObject::invokeMethod(
        this,
        [this, request, texels = std::move(texels), maps = std::move(maps), last]() mutable {
            deliver(request, std::move(texels), std::move(maps), last);
        },
        Qt::QueuedConnection);
}

void IblUpdater::deliver(quint64 request, EnvironmentTexelsPtr texels,
                         std::shared_ptr<const IblMaps> maps, bool last) {
    if (request != m_request)
        return;
    m_finished = last;
    m_firstUnderWay = false; // whichever it is: small, full from the cache, or none
    if (texels) {
        m_texels = std::move(texels);
        m_maps = std::move(maps);
        Q_EMIT ready();
    }
    if (m_waiting)
        start();
}

} // namespace patina::editor
