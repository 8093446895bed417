#include "app/editor/viewport/IblUpdater.h"

#include "core/base/Log.h"

#include <QMetaObject>

namespace patina::editor {

IblUpdater::IblUpdater(QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(1); // newest wins: a cancelled request ends quickly
}

IblUpdater::~IblUpdater() {
    m_control.cancel();
    m_pool.waitForDone();
}

void IblUpdater::request(ImagePtr environment) {
    if (environment == m_environment || !environment)
        return;
    m_environment = environment;
    m_control.cancel();
    m_control = JobControl();
    const quint64 id = ++m_request;
    m_pool.start([this, id, image = std::move(environment), job = m_control.context()] {
        // Reduced first: the eye gets light at once, the full resolution follows.
        IblSettings quick;
        quick.cubeSize = 64;
        quick.levels = 5;
        for (const IblSettings& settings : {quick, IblSettings{}}) {
            Result<IblMaps> maps = computeIbl(*image, settings, job);
            if (!maps) {
                if (maps.error().kind != ErrorKind::Cancelled)
                    logError("image-based light: {}", maps.error().text());
                return;
            }
            auto shared = std::make_shared<const IblMaps>(std::move(maps).value());
            // The destructor waits for the pool, so `this` is alive.
            QMetaObject::invokeMethod(
                this, [this, id, shared] { deliver(id, shared); }, Qt::QueuedConnection);
        }
    });
}

void IblUpdater::deliver(quint64 request, std::shared_ptr<const IblMaps> maps) {
    if (request != m_request)
        return;
    m_maps = std::move(maps);
    Q_EMIT ready();
}

} // namespace patina::editor
