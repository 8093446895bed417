#include "app/editor/Startup.h"

#include "app/editor/Allocator.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QGuiApplication>
#include <QStandardPaths>
#include <QStorageInfo>
#include <QSurfaceFormat>

namespace patina::editor {
namespace {

// Mesa maps the index of its shader cache (1.3 MB, sparse) into memory: on a full disk, writing to
// it would end the process. Without the cache the first frames only take longer.
void avoidFullShaderCache() {
    constexpr qint64 kEnough = 16 << 20;
    QString folder = qEnvironmentVariable(
        "MESA_SHADER_CACHE_DIR",
        QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation));
    while (!QFileInfo::exists(folder)) // Mesa would create it
        folder = QFileInfo(folder).path();
    const QStorageInfo disk(folder);
    if (disk.isValid() && disk.bytesAvailable() < kEnough)
        qputenv("MESA_SHADER_CACHE_DISABLE", "true");
}

} // namespace

void prepareApplication() {
    prepareAllocator();
    avoidFullShaderCache();
    // Without shared contexts, floating a dock would destroy the viewport's.
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(0); // the renderer brings its own targets
    format.setStencilBufferSize(0);
#ifndef NDEBUG
    format.setOption(QSurfaceFormat::DebugContext);
#endif
    QSurfaceFormat::setDefaultFormat(format);
    QCoreApplication::setOrganizationName(QStringLiteral("Patina"));
    QCoreApplication::setApplicationName(QStringLiteral("Patina"));
    QCoreApplication::setApplicationVersion(QStringLiteral(PATINA_VERSION));
    QGuiApplication::setDesktopFileName(QStringLiteral("patina"));
}

} // namespace patina::editor
