#include "app/editor/viewport/LightLimitNotice.h"

#include "core/edit/Change.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>

namespace patina::editor {

LightLimitNotice::LightLimitNotice(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {
    m_later.setSingleShot(true);
    connect(&m_later, &QTimer::timeout, this, &LightLimitNotice::check);
    connect(&controller, &DocumentController::changed, this, &LightLimitNotice::follow);
}

void LightLimitNotice::follow(const Change& change) {
    if (change.isAnotherDocument())
        m_told.clear();
    if (!m_later.isActive())
        m_later.start(0);
}

// Once for each limit that is passed; again when it has been kept to meanwhile.
void LightLimitNotice::check() {
    std::vector<render::LightLimit> limits = render::lightLimits(m_controller.document());
    std::vector<std::string> passed;
    for (const render::LightLimit& limit : limits) {
        passed.emplace_back(limit.id);
        if (std::ranges::find(m_told, passed.back()) != m_told.end())
            continue;
        UserNotice notice;
        notice.kind = NoticeKind::Warning;
        notice.text = QString::fromStdString(limit.text);
        notice.about = NoticeAbout::Drawing;
        Q_EMIT m_controller.noticed(notice);
    }
    m_told = std::move(passed);
}

} // namespace patina::editor
