#include "app/editor/viewport/IblUpdater.h"

#include "core/base/Log.h"

#include <QMetaObject>

namespace patina::editor {

IblUpdater::IblUpdater(const std::filesystem::path& cacheFolder, QObject* parent)
    : QObject(parent)
    , m_cache(cacheFolder) {
    m_pool.setMaxThreadCount(1); // newest wins: a cancelled request ends quickly
}

IblUpdater::~IblUpdater() {
    m_control.cancel();
    m_pool.waitForDone();
}

void IblUpdater::request(ImagePtr environment) {
    if (environment == m_environment || !environment)
        return;
    m_environment = std::move(environment);
    if (m_firstUnderWay)
        m_waiting = true;
    else
        start();
}

void IblUpdater::start() {
    m_control.cancel();
    m_control = JobControl();
    m_firstUnderWay = true;
    m_waiting = false;
    const quint64 id = ++m_request;
    m_pool.start(
        [this, id, image = m_environment, job = m_control.context()] { prepare(id, *image, job); });
}

void IblUpdater::prepare(quint64 request, const Image& environment, const JobContext& job) {
    const IblSettings full;
    const Hash key = IblCache::key(environment, full);
    if (std::optional<IblMaps> known = m_cache.find(key)) {
        post(request, std::make_shared<const IblMaps>(std::move(*known)));
        return;
    }
    // Reduced first: the eye gets light at once, the full resolution follows.
    for (const IblSettings& settings : {IblSettings::quick(), full}) {
        Result<IblMaps> maps = computeIbl(environment, settings, job);
        if (!maps) {
            if (maps.error().kind != ErrorKind::Cancelled)
                logError("image-based light: {}", maps.error().text());
            post(request, nullptr);
            return;
        }
        const auto shared = std::make_shared<const IblMaps>(std::move(*maps));
        post(request, shared);
        // The disk may take its time: nobody waits for it. What a drag passes over is not kept.
        if (settings == full && request == m_request)
            if (const Result<void> stored = m_cache.store(key, *shared); !stored)
                logWarning("The light of this environment could not be kept for next time: {}",
                           stored.error().text());
    }
}

void IblUpdater::post(quint64 request, std::shared_ptr<const IblMaps> maps) {
    // The destructor waits for the pool, so `this` is alive.
    QMetaObject::invokeMethod(
        this, [this, request, maps = std::move(maps)] { deliver(request, maps); },
        Qt::QueuedConnection);
}

void IblUpdater::deliver(quint64 request, std::shared_ptr<const IblMaps> maps) {
    if (request != m_request)
        return;
    m_firstUnderWay = false; // whichever it is: small, full from the cache, or none
    if (maps) {
        m_maps = std::move(maps);
        Q_EMIT ready();
    }
    if (m_waiting)
        start();
}

} // namespace patina::editor
