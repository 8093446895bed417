#include "app/editor/document/DraggedSources.h"

#include "core/library/Library.h"
#include "core/material/Material.h"

#include <QList>
#include <QMimeData>
#include <QUrl>
#include <algorithm>

namespace patina::editor {
namespace {

const QString kBuiltinPrefix = QStringLiteral("builtin:");

// Whoever dragged it may be another program.
bool isBuiltinSky(const QString& source) {
    return source.startsWith(kBuiltinPrefix) &&
           std::ranges::any_of(library::environments(), [&](const library::Entry& entry) {
               return source.mid(kBuiltinPrefix.size()) == QString::fromStdString(entry.name);
           });
}

} // namespace

QStringList draggedFiles(const QMimeData& data) {
    QStringList files;
    for (const QUrl& url : data.urls())
        if (url.isLocalFile())
            files << url.toLocalFile();
    return files;
}

QStringList draggedSources(const QMimeData& data) {
    QStringList sources = draggedFiles(data);
    const QStringList skies =
        QString::fromUtf8(data.data(QLatin1String(kEnvironmentMime))).split(QLatin1Char('\n'));
    for (const QString& sky : skies)
        if (isBuiltinSky(sky) && !sources.contains(sky))
            sources << sky;
    return sources;
}

void setDraggedSources(QMimeData& data, const QStringList& sources) {
    QList<QUrl> urls;
    QStringList skies;
    for (const QString& source : sources)
        if (isBuiltinSky(source))
            skies << source;
        else
            urls << QUrl::fromLocalFile(source);
    if (!urls.isEmpty())
        data.setUrls(urls);
    if (!skies.isEmpty())
        data.setData(QLatin1String(kEnvironmentMime), skies.join(QLatin1Char('\n')).toUtf8());
}

} // namespace patina::editor
