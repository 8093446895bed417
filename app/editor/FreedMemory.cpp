#include "app/editor/FreedMemory.h"

#include "core/base/HeapGrowth.h"

namespace patina::editor {

FreedMemory::FreedMemory(QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(1);
    m_rest.setSingleShot(true);
    connect(&m_rest, &QTimer::timeout, this, &FreedMemory::giveBack);
}

void FreedMemory::frameDrawn() {
    m_rest.start(kRestMs);
}

void FreedMemory::giveBack() {
    if (m_last.isValid() && m_last.elapsed() < kPauseMs) {
        m_rest.start(kPauseMs - static_cast<int>(m_last.elapsed()));
        return;
    }
    m_last.start();
    m_pool.start([this] {
        returnFreedMemory();
        Q_EMIT returned();
    });
}

} // namespace patina::editor
