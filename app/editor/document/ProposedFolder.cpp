#include "app/editor/document/ProposedFolder.h"

#include "app/editor/document/DocumentController.h"
#include "core/document/Source.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

namespace patina::editor {
namespace {

// Whose scene's dialog it was.
QString sceneKey(const QString& key) {
    return key + QStringLiteral("Of");
}

bool exists(const QString& folder) {
    return !folder.isEmpty() && QFileInfo(folder).isDir();
}

} // namespace

QString sceneFolder(const DocumentController& controller) {
    if (!controller.filePath().isEmpty())
        return QFileInfo(controller.filePath()).absolutePath();
    for (const MeshInstance& mesh : controller.document().meshes)
        if (!mesh.source.empty() && !isBuiltin(mesh.source))
            return QFileInfo(QString::fromStdString(mesh.source)).absolutePath();
    return {};
}

QString proposedFolder(const DocumentController& controller, const QString& key) {
    const QSettings settings;
    const QString scene = sceneFolder(controller), last = settings.value(key).toString();
    const bool ofThisScene = settings.value(sceneKey(key)).toString() == scene;
    if (exists(scene) && !(ofThisScene && exists(last)))
        return scene;
    if (exists(last))
        return last;
    const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    return exists(documents) ? documents : QDir::homePath();
}

QString proposedFile(const DocumentController& controller, const QString& key,
                     const QString& ending) {
    const QString name = QFileInfo(controller.displayName()).completeBaseName();
    return QDir(proposedFolder(controller, key))
        .filePath((name.isEmpty() ? QStringLiteral("scene") : name) + ending);
}

void rememberFolder(const DocumentController& controller, const QString& key, const QString& file) {
    QSettings settings;
    settings.setValue(key, QFileInfo(file).absolutePath());
    settings.setValue(sceneKey(key), sceneFolder(controller));
}

} // namespace patina::editor
