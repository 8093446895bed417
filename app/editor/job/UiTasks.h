// The editor's end of TaskRunner: what work comes to is applied on the thread that asked for it.
#pragma once

#include "core/job/TaskRunner.h"

#include <QMetaObject>
#include <QObject>
#include <memory>

namespace patina::editor {

// For a runner of the calling thread, which has an event loop.
[[nodiscard]] inline TaskRunner::Post postToThisThread() {
    return [here = std::make_shared<QObject>()](std::function<void()> call) {
        QMetaObject::invokeMethod(here.get(), std::move(call), Qt::QueuedConnection);
    };
}

} // namespace patina::editor
