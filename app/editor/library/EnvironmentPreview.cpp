#include "app/editor/library/EnvironmentPreview.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "core/document/Source.h"
#include "core/scene/Scene.h"

#include <QSettings>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

constexpr const char* kPreviewTask = "preview of an environment";
const char* const kPreviewKey = "library/previewOnHover";

} // namespace

EnvironmentPreview::EnvironmentPreview(DocumentController& controller, PreparedLights& lights,
                                       QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_lights(lights)
    , m_wanted(QSettings().value(QLatin1String(kPreviewKey), true).toBool())
    , m_tasks(controller.runner()) {
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.affects != Affects::Nothing)
            end();
    });
}

void EnvironmentPreview::setWanted(bool wanted) {
    if (wanted == m_wanted)
        return;
    m_wanted = wanted;
    QSettings().setValue(QLatin1String(kPreviewKey), wanted);
    if (!wanted)
        end();
}

void EnvironmentPreview::show(const QString& source, const QString& title) {
    if (!m_wanted || source == m_source)
        return;
    end();
    m_source = source;
    m_title = title;
    m_tasks.run(
        {.tag = kPreviewTask},
        [this,
         name = normalizeSource(source.toStdString())](const JobContext& job) -> Result<IblLight> {
            std::vector<Notice> notices; // are told when it is used
            const Result<ImagePtr> image = loadEnvironmentImage(
                m_controller.worker(), name, notices, EnvironmentLayout::Automatic, job);
            if (!image)
                return image.error();
            return m_lights.first(*image, job);
        },
        [this](const Result<IblLight>& light) { prepared(light); });
}

void EnvironmentPreview::prepared(const Result<IblLight>& light) {
    if (light) {
        m_texels = light->texels;
        if (!light->full)
            refine(*light);
    } else {
        m_problem = toQString(light.error().message);
    }
    Q_EMIT changed();
}

void EnvironmentPreview::refine(const IblLight& small) {
    m_tasks.run(
        {.tag = kPreviewTask, .priority = TaskPriority::Low},
        [todo = IblLight{small.environment, small.key, small.background, nullptr, nullptr, false}](
            const JobContext& job) { return refinedIbl(todo, job); },
        [this](const Result<IblLight>& light) {
            if (!light)
                return; // the small one stays
            m_lights.keep(*light);
            m_texels = light->texels;
            Q_EMIT changed();
        });
}

void EnvironmentPreview::end() {
    if (m_source.isEmpty())
        return;
    m_tasks.cancel(kPreviewTask);
    m_source.clear();
    const bool shown = isOn() || !m_problem.isEmpty();
    m_problem.clear();
    m_texels = nullptr;
    if (shown)
        Q_EMIT changed();
}

Environment EnvironmentPreview::inPlaceOf(const Environment& lit) const {
    Environment shown = lit;
    shown.kind = EnvironmentKind::Image;
    shown.source = normalizeSource(m_source.toStdString());
    shown.layout = EnvironmentLayout::Automatic;
    shown.image = shown.fileImage = m_texels ? m_texels->image : nullptr;
    shown.removedSources = 0;
    shown.problem.clear();
    return shown;
}

} // namespace patina::editor
