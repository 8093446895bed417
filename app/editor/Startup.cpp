#include "app/editor/Startup.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QSurfaceFormat>

namespace patina::editor {

void prepareApplication() {
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
