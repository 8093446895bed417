#include "app/editor/document/DisplayLoader.h"

#include "app/editor/document/DocumentController.h"
#include "core/document/ViewChoices.h"

namespace patina::editor {

DisplayLoader::DisplayLoader(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_tasks(controller.runner()) {
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::View)
            refresh();
    });
    refresh();
}

void DisplayLoader::refresh() {
    const View& view = m_controller.document().view;
    Request request;
    if (view.toneMap == ToneMap::OpenColorIo)
        request = {true, openColorIoConfig(view.ocioConfig), view.ocioDisplay, view.ocioView};
    if (request == m_request)
        return;
    if (request.config != m_request.config)
        m_menu.reset();
    m_request = request;
    m_tasks.cancelAll();
    if (!request.wanted || request.config.empty()) {
        m_transform.reset();
        m_problem.clear();
        if (request.wanted)
            fail({ErrorKind::Usage,
                  whyUnavailable(*findParameter("view.toneMap"), m_controller.document(),
                                 static_cast<int>(ToneMap::OpenColorIo)),
                  {},
                  {}});
        Q_EMIT changed();
        return;
    }

    struct Read {
        Result<DisplayMenu> menu;
        Result<DisplayTransform> transform;
    };
    m_tasks.run(
        {.tag = "display", .name = tr("Reading OpenColorIO's view").toStdString()},
        [&worker = m_controller.worker(), request](const JobContext&) {
            Result<DisplayMenu> menu = loadDisplayMenu(worker, request.config);
            Result<DisplayTransform> transform =
                menu ? loadDisplayTransform(worker, request.config, request.display, request.view)
                     : Result<DisplayTransform>(menu.error());
            return Read{std::move(menu), std::move(transform)};
        },
        [this](Result<Read> read) {
            if (read && read->menu)
                m_menu = read->menu.value();
            else
                m_menu.reset();
            m_problem.clear();
            if (!read)
                fail(read.error());
            else if (read->transform)
                m_transform = std::make_shared<const DisplayTransform>(read->transform.value());
            else
                fail(read->transform.error());
            Q_EMIT changed();
        });
}

void DisplayLoader::fail(const Error& error) {
    m_transform.reset();
    m_problem = QString::fromStdString(error.message);
    UserNotice notice = UserNotice::fromError(error);
    notice.text = tr("%1; PBR Neutral is shown meanwhile.").arg(notice.text);
    Q_EMIT noticed(notice);
}

void DisplayLoader::refuse(const Error& error) {
    fail(error);
    Q_EMIT changed();
}

} // namespace patina::editor
