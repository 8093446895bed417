#include "app/cli/SheetCells.h"

#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

namespace patina::cli {

SheetCells::~SheetCells() = default;

Result<void> SheetCells::open(Id environment) {
    const auto file = m_source.wall.files.find(environment);
    if (file == m_source.wall.files.end() || !file->second.problem.empty())
        return {};
    Environment& target = *m_source.document.environment(environment);
    Result<void> read = setEnvironment(m_source.session, target, target.source, target.layout);
    if (read)
        return read;
    Error error = read.error();
    if (error.kind == ErrorKind::Cancelled || error.kind == ErrorKind::Internal)
        return error;
    if (m_source.options.skipBroken) {
        file->second.problem = error.message;
        return {};
    }
    error.message += "; --skip-broken draws the others";
    return error;
}

void SheetCells::close(Id environment) {
    if (!m_source.wall.files.contains(environment))
        return;
    Environment& target = *m_source.document.environment(environment);
    target.image = target.fileImage = nullptr;
    letGoOfLight();
}

Result<Document> SheetCells::shownBy(const Cell& cell) const {
    Result<Document> shown = documentOf(m_source.document, cell);
    if (!shown)
        return shown;
    resolveCell(*shown, m_source.document, m_source.session.job());
    if (m_source.session.job().cancelled())
        return cancelledError();
    const render::FrameSettings& frame = m_source.frame;
    const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
    const Result<Camera> camera =
        chooseCamera(m_source.session, m_source.options, *shown, m_source.request, aspect);
    if (!camera)
        return camera.error();
    shown->view.camera = *camera;
    return shown;
}

} // namespace patina::cli
