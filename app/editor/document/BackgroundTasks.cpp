#include "app/editor/document/BackgroundTasks.h"

#include <vector>

namespace patina::editor {

BackgroundTasks::BackgroundTasks(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner, [this] { Q_EMIT busyChanged(); }) {}

void BackgroundTasks::start(const QString& key, const QString& activity, Work work) {
    m_tasks.run({.tag = "key " + key.toStdString(), .name = activity.toStdString()},
                std::move(work), [this, activity](const Result<Apply>& apply) {
                    if (!apply)
                        Q_EMIT failed(activity, QString::fromStdString(apply.error().detail));
                    else if (*apply)
                        (*apply)();
                });
}

void BackgroundTasks::cancelAll(const QStringList& but) {
    std::vector<std::string> tags;
    for (const QString& key : but)
        tags.push_back("key " + key.toStdString());
    m_tasks.cancelAll(tags);
}

QString BackgroundTasks::activity() const {
    return QString::fromStdString(m_tasks.activity());
}

} // namespace patina::editor
