#include "app/editor/document/DisplayLoader.h"

#include "app/editor/document/DocumentController.h"

namespace patina::editor {

DisplayLoader::DisplayLoader(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_tasks(1) {
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

    m_tasks.start(
        QStringLiteral("display"), tr("Reading OpenColorIO's view"),
        [this, request](const JobContext&) -> BackgroundTasks::Apply {
            WorkerClient& worker = m_controller.worker();
            auto menu =
                std::make_shared<Result<DisplayMenu>>(loadDisplayMenu(worker, request.config));
            auto transform = std::make_shared<Result<DisplayTransform>>(
                menu->ok()
                    ? loadDisplayTransform(worker, request.config, request.display, request.view)
                    : menu->error());
            return [this, menu, transform] {
                m_menu = menu->ok() ? std::optional(menu->value()) : std::nullopt;
                m_problem.clear();
                if (transform->ok())
                    m_transform = std::make_shared<const DisplayTransform>(transform->value());
                else
                    fail(transform->error());
                Q_EMIT changed();
            };
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
