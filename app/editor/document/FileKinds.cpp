#include "app/editor/document/FileKinds.h"

#include "core/io/MeshImport.h"

#include <QCoreApplication>
#include <QFileInfo>

namespace patina::editor {
namespace {

QString trKinds(const char* text) {
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

// Radiance, OpenEXR and PFM pictures light the scene; on a map slot they are maps all the same.
const QStringList kEnvironmentSuffixes = {QStringLiteral("hdr"), QStringLiteral("exr"),
                                          QStringLiteral("pfm")};
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
    return QStringList{filter(trKinds("Projects and models"),
                              QStringList{QStringLiteral("patina")} + modelSuffixes()),
                       projectFilter(), modelFilter(), trKinds("All files (*)")}
        .join(QStringLiteral(";;"));
}

QString modelFilter() {
    return filter(trKinds("Models"), modelSuffixes());
}

QString imageFilter() {
    return filter(trKinds("Images"), kImageSuffixes + kEnvironmentSuffixes);
}

QString environmentFilter() {
    return filter(trKinds("Environments"), kEnvironmentSuffixes + kImageSuffixes);
}

QString projectFilter() {
    return filter(trKinds("Patina projects"), {QStringLiteral("patina")});
}

QString displayConfigFilter() {
    return filter(trKinds("OpenColorIO configurations"), {QStringLiteral("ocio")});
}

} // namespace patina::editor
