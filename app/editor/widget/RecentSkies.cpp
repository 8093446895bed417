#include "app/editor/widget/RecentSkies.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

namespace patina::editor {
namespace {

const char* const kKey = "recentEnvironments";

// Named by the path: another file, another picture. The system may empty the folder at any time.
QString pictureFile(const QString& file) {
    const QByteArray name =
        QCryptographicHash::hash(file.toUtf8(), QCryptographicHash::Sha1).toHex();
    return QDir(QStandardPaths::writableLocation(QStandardPaths::CacheLocation))
        .filePath(QStringLiteral("skies/%1.png").arg(QString::fromLatin1(name)));
}

} // namespace

QStringList recentSkies() {
    QStringList files = QSettings().value(QLatin1String(kKey)).toStringList();
    files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
    return files.mid(0, kMostRecentSkies);
}

void rememberSky(const QString& file) {
    QStringList files = recentSkies();
    if (!files.isEmpty() && files.front() == file)
        return;
    files.removeAll(file);
    files.prepend(file);
    for (const QString& old : files.mid(kMostRecentSkies))
        QFile::remove(pictureFile(old));
    QSettings().setValue(QLatin1String(kKey), files.mid(0, kMostRecentSkies));
}

void keepSkyPicture(const QString& file, const QImage& picture) {
    const QString path = pictureFile(file);
    // Without a cache the button stays plain in the next session: nothing else depends on it.
    if (QDir().mkpath(QFileInfo(path).absolutePath()))
        picture.save(path);
}

QImage skyPicture(const QString& file) {
    return QImage(pictureFile(file));
}

} // namespace patina::editor
