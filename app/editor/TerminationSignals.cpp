#include "app/editor/TerminationSignals.h"

#include "app/editor/TerminationWatch.h"

#include <QMetaObject>
#include <utility>

namespace patina::editor {

TerminationSignals::TerminationSignals(TerminationWatch& watch, std::function<void()> atLast,
                                       QObject* parent)
    : QObject(parent)
    , m_watch(watch) {
    m_watch.atLast(std::move(atLast));
    m_watch.endInOrder([this](int signal) {
        QMetaObject::invokeMethod(
            this, [this, signal] { Q_EMIT received(signal); }, Qt::QueuedConnection);
    });
}

TerminationSignals::~TerminationSignals() {
    m_watch.release();
}

} // namespace patina::editor
