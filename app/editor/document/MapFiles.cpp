#include "app/editor/document/MapFiles.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "core/document/Source.h"
#include "core/edit/EditSession.h"
#include "core/scene/Scene.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <memory>

namespace patina::editor {

namespace {
QString trMaps(const char* text) {
    return QCoreApplication::translate("MapFiles", text);
}
} // namespace

void setMaps(DocumentController& controller, Id material, const std::vector<MapFile>& files) {
    const Target target{Scope::Material, material};
    if (files.empty())
        return;
    if (files.size() == 1) {
        controller.setMap(*files.front().map, target, files.front().file);
        return;
    }
    struct Read {
        const ParameterInfo* map;
        std::string source;
        Result<ImagePtr> image;
    };
    const QString count = QString::number(files.size());
    const auto work = [&controller, files, target, count,
                       begun = controller.begun()](const JobContext&) -> BackgroundTasks::Apply {
        auto read = std::make_shared<std::vector<Read>>();
        for (const MapFile& one : files) {
            std::string source = normalizeSource(one.file.toStdString());
            Result<ImagePtr> image =
                loadMapImage(controller.worker(), source, one.map->mapEncoding);
            read->push_back({one.map, std::move(source), std::move(image)});
        }
        const auto apply = [&controller, target, count, read] {
            const Document& document = controller.document();
            if (!targetExists(document, target))
                return;
            std::vector<ParameterEdit> edits;
            for (const Read& one : *read) {
                if (!one.image.ok()) {
                    Q_EMIT controller.noticed(UserNotice::fromError(one.image.error()));
                    continue;
                }
                MapSlot slot = std::get<MapSlot>(one.map->get(document, target.id));
                slot.source = one.source;
                slot.image = one.image.value();
                slot.problem.clear();
                for (ParameterEdit& edit : editsForMap(document, *one.map, target, slot))
                    edits.push_back(std::move(edit));
            }
            controller.setParameters(
                target, edits,
                trMaps("Set %1 Maps of %2")
                    .arg(count, QString::fromStdString(nameOf(document, target))));
        };
        return [&controller, begun, count, apply] {
            controller.deliver(begun, trMaps("What %1 images show").arg(count), apply);
        };
    };
    controller.tasks().start(QStringLiteral("maps:%1").arg(material),
                             trMaps("Reading %1 images").arg(count), work);
}

// Of the controller: files of several kinds at once.
void DocumentController::addFiles(const QStringList& files, Id material) {
    const DropPlan plan = planDrop(files);
    for (const QString& file : plan.projects)
        openScene(file);
    for (const QString& file : plan.models)
        addModel(file);
    for (const QString& file : plan.environments)
        setEnvironment(file);
    for (const QString& file : plan.displayConfigs)
        setDisplayConfig(file);
    if (document().material(material))
        setMaps(*this, material, plan.maps);
    else if (!plan.maps.empty())
        Q_EMIT noticed(
            {NoticeKind::Warning,
             trMaps("No material is selected that the images could belong to: select one in "
                    "the Scene list and drop them again."),
             {}});
    if (!plan.unclear.isEmpty())
        Q_EMIT noticed({NoticeKind::Warning, unclearText(plan.unclear), plan.unclear});
    for (const QString& file : plan.unknown + plan.folders) // those the window takes itself
        Q_EMIT noticed({NoticeKind::Error,
                        trMaps("%1 is neither a model, an image, an environment nor a project that "
                               "Patina can read.")
                            .arg(shownFileName(file)),
                        {file}});
}

} // namespace patina::editor
