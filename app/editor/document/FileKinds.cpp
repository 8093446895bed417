#include "app/editor/document/FileKinds.h"

#include "core/io/MeshImport.h"

#include <QCoreApplication>
#include <QFileInfo>

namespace patina::editor {
namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("FileKinds", text);
}

const QStringList& modelSuffixes() {
    static const QStringList suffixes = [] {
        QStringList list;
        for (const std::string& extension : modelExtensions())
            list << QString::fromStdString(extension).mid(1);
        return list;
    }();
    return suffixes;
}

// Radiance and OpenEXR pictures light the scene; on a map slot they are maps all the same.
const QStringList kEnvironmentSuffixes = {QStringLiteral("hdr"), QStringLiteral("exr")};
const QStringList kImageSuffixes = {
    QStringLiteral("png"), QStringLiteral("jpg"),  QStringLiteral("jpeg"), QStringLiteral("tga"),
    QStringLiteral("tif"), QStringLiteral("tiff"), QStringLiteral("bmp"),  QStringLiteral("psd"),
    QStringLiteral("dds"), QStringLiteral("webp")};

QString filter(const QString& title, const QStringList& suffixes) {
    return QStringLiteral("%1 (*.%2)").arg(title, suffixes.join(QStringLiteral(" *.")));
}

} // namespace

FileKind fileKind(const QString& file) {
    const QString suffix = QFileInfo(file).suffix().toLower();
    if (suffix == QLatin1String("patina"))
        return FileKind::Project;
    if (modelSuffixes().contains(suffix))
        return FileKind::Model;
    if (kEnvironmentSuffixes.contains(suffix))
        return FileKind::Environment;
    if (kImageSuffixes.contains(suffix))
        return FileKind::Image;
    if (suffix == QLatin1String("ocio"))
        return FileKind::DisplayConfig;
    return FileKind::Unknown;
}

QString sceneFilter() {
    return QStringList{
        filter(tr("Projects and models"), QStringList{QStringLiteral("patina")} + modelSuffixes()),
        projectFilter(), modelFilter(), tr("All files (*)")}
        .join(QStringLiteral(";;"));
}

QString modelFilter() {
    return filter(tr("Models"), modelSuffixes());
}

QString imageFilter() {
    return filter(tr("Images"), kImageSuffixes + kEnvironmentSuffixes);
}

QString environmentFilter() {
    return filter(tr("Environments"), kEnvironmentSuffixes + kImageSuffixes);
}

QString projectFilter() {
    return filter(tr("Patina projects"), {QStringLiteral("patina")});
}

QString displayConfigFilter() {
    return filter(tr("OpenColorIO configurations"), {QStringLiteral("ocio")});
}

} // namespace patina::editor
