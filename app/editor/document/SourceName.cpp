#include "app/editor/document/SourceName.h"

#include "app/editor/document/QtText.h"
#include "core/document/SceneSource.h"
#include "core/document/Source.h"
#include "core/library/Library.h"
#include "core/material/Material.h"

#include <QFileInfo>
#include <string>

namespace patina::editor {

QString sourceName(const QString& source) {
    const std::string name = source.toStdString();
    if (!isBuiltin(name)) {
        const SceneSource scene = parseSceneSource(name);
        const QString file = shownFileName(QString::fromStdString(scene.file));
        return scene.title.empty()
                   ? file
                   : QStringLiteral("%1 (%2)").arg(file, QString::fromStdString(scene.title));
    }
    const std::string key = name.substr(name.find(':') + 1);
    for (const auto* entries :
         {&library::models(), &library::environments(), &library::materials()})
        for (const library::Entry& entry : *entries)
            if (entry.name == key)
                return QString::fromStdString(entry.title);
    return QString::fromStdString(key);
}

} // namespace patina::editor
