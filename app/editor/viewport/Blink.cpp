#include "app/editor/viewport/Blink.h"

namespace patina::editor {
namespace {
constexpr int kTurnMs = 350;
}

Blink::Blink(QObject* parent)
    : QObject(parent) {
    m_timer.setInterval(kTurnMs);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        m_faded = !m_faded;
        Q_EMIT turned();
    });
}

void Blink::setActive(bool active) {
    if (active == m_timer.isActive())
        return;
    m_faded = false;
    if (active)
        m_timer.start();
    else
        m_timer.stop();
}

} // namespace patina::editor
