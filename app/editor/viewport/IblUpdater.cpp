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
    m_environment = std::move(environment);
    if (m_quickUnderWay)
        m_waiting = true;
    else
        start();
}

void IblUpdater::start() {
    m_control.cancel();
    m_control = JobControl();
    m_quickUnderWay = true;
    m_waiting = false;
    const quint64 id = ++m_request;
    m_pool.start([this, id, image = m_environment, job = m_control.context()] {
        // Reduced first: the eye gets light at once, the full resolution follows.
        IblSettings quick;
        quick.cubeSize = 64;
        quick.levels = 5;
        for (const bool isQuick : {true, false}) {
            Result<IblMaps> maps = computeIbl(*image, isQuick ? quick : IblSettings{}, job);
            if (!maps && maps.error().kind != ErrorKind::Cancelled)
                logError("image-based light: {}", maps.error().text());
            std::shared_ptr<const IblMaps> shared;
            if (maps)
                shared = std::make_shared<const IblMaps>(std::move(maps).value());
            // The destructor waits for the pool, so `this` is alive.
            QMetaObject::invokeMethod(
                this, [this, id, isQuick, shared] { deliver(id, isQuick, shared); },
                Qt::QueuedConnection);
            if (!shared)
                return;
        }
    });
}

void IblUpdater::deliver(quint64 request, bool quick, std::shared_ptr<const IblMaps> maps) {
    if (request != m_request)
        return;
    if (quick)
        m_quickUnderWay = false;
    if (maps) {
        m_maps = std::move(maps);
        Q_EMIT ready();
    }
    if (m_waiting)
        start();
}

} // namespace patina::editor
