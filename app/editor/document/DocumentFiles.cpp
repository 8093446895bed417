// The part of DocumentController that reads and writes files, always in the background.

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/EnvironmentResolver.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/ImportNotice.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SourceName.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/SceneSource.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"
#include "core/io/DisplayTransform.h"
#include "core/library/Library.h"
#include "core/light/BrightSources.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"

#include <QFileInfo>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

const QString environmentTask = QStringLiteral("environment ");            // and its id
const QString addedEnvironmentTask = QStringLiteral("added environment "); // and for cells its file
const QString extractionTask = QStringLiteral("extraction of a source");

// Appends what `part` holds under ids and names that are free in `document`.
void appendScene(Document& document, const Document& part) {
    std::map<Id, Id> materials;
    for (const Material& material : part.materials)
        materials[material.id] = addMaterial(document, material);
    for (MeshInstance mesh : part.meshes) {
        mesh.name = uniqueMeshName(document, mesh.name);
        mesh.id = document.takeId();
        mesh.material = materials.at(mesh.material);
        document.meshes.push_back(std::move(mesh));
    }
    for (const Light& light : part.lights)
        addLight(document, light);
}

// A model brings only the lights of its file; environments, background and lights of the scene
// before stay.
void keepLight(Document& opened, const Document& before) {
    if (!before.environment().image)
        return; // nothing was open
    opened.environments = before.environments;
    opened.mix = before.mix;
    for (Environment& environment : opened.environments) {
        const Id old = std::exchange(environment.id, opened.takeId());
        if (old == before.mix.first)
            opened.mix.first = environment.id;
        if (old == before.mix.second)
            opened.mix.second = environment.id;
        for (Softbox& softbox : environment.softboxes)
            softbox.id = opened.takeId();
    }
    opened.view.background = before.view.background;
    opened.view.backgroundBlur = before.view.backgroundBlur;
    opened.view.backgroundColor = before.view.backgroundColor;
    const std::vector<Light> own = std::exchange(opened.lights, {});
    for (const std::vector<Light>* lights : {&before.lights, &own})
        for (const Light& light : *lights)
            addLight(opened, light);
}

} // namespace

void DocumentController::replaceDocument(Document document, const QString& filePath,
                                         const QString& name, bool pristine) {
    // Results that were on their way belong to elements of the document that goes; only the light
    // stays with a model that is opened in it.
    const bool model = filePath.isEmpty() && !pristine;
    m_tasks.cancelAll(model ? QStringList{environmentTask, addedEnvironmentTask} : QStringList());
    m_waiting.clear();
    m_environment->reset(document);
    m_filePath = filePath;
    m_name = name;
    m_pristine = pristine;
    m_onDisk.reset();
    m_session.replace(std::move(document));
    Q_EMIT fileChanged();
}

void DocumentController::setReplaceQuestion(
    std::function<void(const std::function<void()>& proceed)> ask) {
    m_replaceQuestion = std::move(ask);
}

void DocumentController::replaceWhenAllowed(const DocumentState& begun, const QString& name,
                                            std::function<void()> replace) {
    if (!isModified() || state() == begun)
        replace();
    else if (m_replaceQuestion)
        m_replaceQuestion(replace);
    else
        Q_EMIT noticed({NoticeKind::Warning,
                        tr("%1 was not opened: the scene was edited meanwhile. Save it, then open "
                           "again.")
                            .arg(name),
                        {}});
}

void DocumentController::newDocument(std::function<void(bool)> done) {
    ++m_opened;
    m_opening = std::make_shared<DocumentState>(state());
    const auto work = [this, done,
                       opening = m_opening](const JobContext&) -> BackgroundTasks::Apply {
        auto document = std::make_shared<Document>(startDocument());
        return [this, document, done, opening] {
            replaceWhenAllowed(*opening, tr("The start scene"), [this, document, done] {
                replaceDocument(std::move(*document), {}, {}, true);
                if (done)
                    done(true);
            });
        };
    };
    m_tasks.start(QStringLiteral("open"), tr("Preparing the start scene"), work);
}

void DocumentController::openScene(const QString& scene, std::function<void(bool)> done) {
    const QString name = sourceName(scene);
    const auto savesOf = [this](const QString& file) {
        const auto known = m_files.find(QFileInfo(file).absoluteFilePath());
        const auto onDisk = known == m_files.end() ? nullptr : known->second.lock();
        return onDisk ? onDisk->saves : 0;
    };
    ++m_opened;
    m_opening = std::make_shared<DocumentState>(state());
    const auto work = [this, scene, name, done, opening = m_opening, savesOf,
                       saves = savesOf(scene)](const JobContext& job) -> BackgroundTasks::Apply {
        // Before it is read: what changes meanwhile is noticed when it is saved.
        const std::optional<Hash> version = fileKind(scene) == FileKind::Project
                                                ? projectVersion(absolutePath(scene))
                                                : std::nullopt;
        auto result = std::make_shared<Result<OpenedScene>>(
            patina::openScene(m_worker, scene.toStdString(), job));
        return [this, scene, name, done, opening, savesOf, saves, version, result] {
            if (savesOf(scene) != saves) { // it was saved while it was read
                openScene(scene, done);
                return;
            }
            if (!result->ok()) {
                if (result->error().kind != ErrorKind::Cancelled) {
                    UserNotice notice = UserNotice::fromError(result->error());
                    notice.about = NoticeAbout::UnopenedFile;
                    Q_EMIT noticed(notice);
                }
                Q_EMIT openFailed(scene);
                if (done)
                    done(false);
                return;
            }
            replaceWhenAllowed(*opening, name, [this, scene, name, done, version, result] {
                takeOpened(std::move(result->value()), scene, name, version);
                if (done)
                    done(true);
            });
        };
    };
    m_tasks.start(QStringLiteral("open"), tr("Opening %1").arg(name), work);
}

void DocumentController::takeOpened(OpenedScene opened, const QString& scene, const QString& name,
                                    const std::optional<Hash>& version) {
    UserNotice notice = importNotice(name, opened);
    const SceneSource source = parseSceneSource(scene.toStdString());
    const QString file = isBuiltin(source.file)
                             ? scene
                             : QFileInfo(QString::fromStdString(source.file)).absoluteFilePath();
    notice.file = file;
    if (!opened.isProject)
        keepLight(opened.document, document());
    // What dialogs propose file names from.
    const QString shown =
        opened.isProject || isBuiltin(source.file) ? name : QFileInfo(file).completeBaseName();
    replaceDocument(std::move(opened.document), opened.isProject ? file : QString(), shown, false);
    if (opened.isProject)
        holdFile(version);
    if (!notice.text.isEmpty())
        Q_EMIT noticed(notice);
    Q_EMIT sceneOpened(file);
    for (const ChosenScene& chosen : opened.scenes) {
        if (opened.isProject || chosen.asked)
            continue; // it was chosen before
        QStringList titles;
        for (const std::string& title : chosen.scenes)
            titles << QString::fromStdString(title);
        Q_EMIT severalScenesFound(file, titles, static_cast<int>(chosen.scene));
    }
}

void DocumentController::addModel(const QString& source) {
    const QString name = sourceName(source);
    m_tasks.start(
        QStringLiteral("model:") + source, tr("Adding %1").arg(name),
        [this, source, name, begun = begun()](const JobContext&) -> BackgroundTasks::Apply {
            // Read into a document of its own: the user's may change meanwhile.
            auto part = std::make_shared<Document>();
            auto result = std::make_shared<Result<std::vector<Notice>>>(
                patina::addModel(m_worker, *part, normalizeSource(source.toStdString())));
            return [this, name, begun, part, result] {
                if (!result->ok()) {
                    Q_EMIT noticed(UserNotice::fromError(result->error()));
                    return;
                }
                deliver(begun, name, [this, name, part] {
                    editStructure(tr("Add %1").arg(name),
                                  [&](Document& document) { appendScene(document, *part); });
                });
                const UserNotice notice = UserNotice::fromImport(name, result->value(), {});
                if (!notice.text.isEmpty())
                    Q_EMIT noticed(notice);
            };
        });
}

void DocumentController::setMap(const ParameterInfo& map, Target target, const QString& source) {
    const QString key = QStringLiteral("map:%1:%2")
                            .arg(QString::fromUtf8(map.id.data(), static_cast<int>(map.id.size())))
                            .arg(target.id);
    m_tasks.start(
        key, tr("Reading %1").arg(sourceName(source)),
        [this, &map, target, source, begun = begun()](const JobContext&) -> BackgroundTasks::Apply {
            const std::string name = normalizeSource(source.toStdString());
            auto image =
                std::make_shared<Result<ImagePtr>>(loadMapImage(m_worker, name, map.mapEncoding));
            return [this, &map, target, source, name, begun, image] {
                if (!image->ok()) {
                    Q_EMIT noticed(UserNotice::fromError(image->error()));
                    return;
                }
                deliver(begun, sourceName(source), [this, &map, target, name, image] {
                    if (!targetExists(document(), target))
                        return;
                    MapSlot slot = std::get<MapSlot>(map.get(document(), target.id));
                    slot.source = name;
                    slot.image = image->value();
                    slot.problem.clear();
                    pushParameters(target, editsForMap(document(), map, target, slot),
                                   tr("Set %1").arg(toQString(map.label)));
                });
            };
        });
}

void DocumentController::clearMap(const ParameterInfo& map, Target target) {
    pushParameters(target, {{&map, map.defaultValue()}}, tr("Remove %1").arg(toQString(map.label)));
}

void DocumentController::setEnvironment(const QString& source, DragSession session) {
    // One step for several keeps the text of the first, which must not name that one alone.
    readEnvironment(document().mix.first, source, EnvironmentLayout::Automatic,
                    session == 0 ? tr("Light with %1").arg(sourceName(source))
                                 : tr("Step Through Environments"),
                    session);
}

void DocumentController::replaceEnvironment(Id environment, const QString& source) {
    const Environment* replaced = document().environment(environment);
    if (replaced == nullptr)
        return; // removed since the files began to be held over it
    readEnvironment(
        environment, source, EnvironmentLayout::Automatic,
        tr("Replace %1 by %2").arg(toQString(environmentTitle(*replaced)), sourceName(source)));
}

void DocumentController::addEnvironment(const QString& source, EnvironmentUse use,
                                        std::function<void(Id)> added) {
    const std::string name = normalizeSource(source.toStdString());
    const auto known = std::ranges::find_if(document().environments, [&](const Environment& e) {
        return e.kind == EnvironmentKind::Image && e.source == name && e.problem.empty();
    });
    const Id first = document().mix.first;
    if (known != document().environments.end() &&
        (use != EnvironmentUse::FadeTo || known->id != first)) {
        const Id id = known->id;
        if (use == EnvironmentUse::Light)
            lightWith(id);
        else if (use == EnvironmentUse::FadeTo)
            fadeTo(id);
        if (added)
            added(id);
        return;
    }
    const QString title = sourceName(source);
    m_tasks.start(
        use == EnvironmentUse::Cells ? addedEnvironmentTask + source : addedEnvironmentTask,
        tr("Reading %1").arg(title),
        [this, name, title, use, added,
         begun = begun()](const JobContext& job) -> BackgroundTasks::Apply {
            auto notices = std::make_shared<std::vector<Notice>>();
            auto image = std::make_shared<Result<ImagePtr>>(
                loadEnvironmentImage(m_worker, name, *notices, EnvironmentLayout::Automatic, job));
            return [this, title, name, use, added, begun, notices, image] {
                if (!image->ok()) {
                    Q_EMIT noticed(UserNotice::fromError(image->error()));
                    return;
                }
                Environment environment;
                environment.source = name;
                environment.image = environment.fileImage = image->value();
                deliver(begun, title, [this, title, use, added, environment] {
                    const std::string add = tr("Add %1").arg(title).toStdString();
                    const Id id = use == EnvironmentUse::Light
                                      ? m_session.addEnvironment(environment, add)
                                  : use == EnvironmentUse::Cells
                                      ? m_session.addUnusedEnvironment(environment, add)
                                      : m_session.addSecondEnvironment(
                                            environment, tr("Fade to %1").arg(title).toStdString());
                    if (id != 0 && added)
                        added(id);
                    if (id == 0)
                        Q_EMIT noticed({NoticeKind::Warning,
                                        tr("%1 was not added: a scene holds at most %2 "
                                           "environments. Remove one first.")
                                            .arg(title)
                                            .arg(kMaxEnvironments),
                                        {}});
                });
                const UserNotice notice = UserNotice::fromImport(title, *notices, {});
                if (!notice.text.isEmpty())
                    Q_EMIT noticed(notice);
            };
        });
}

void DocumentController::readEnvironment(Id asked, const QString& source, EnvironmentLayout layout,
                                         const QString& undoText, DragSession session) {
    readEnvironment(asked, source, layout,
                    [this, undoText, session](Target target, std::vector<ParameterEdit> edits) {
                        pushParameters(target, edits, undoText, session);
                    });
}

void DocumentController::readEnvironment(Id asked, const QString& source, EnvironmentLayout layout,
                                         PutEnvironment put) {
    const QString title = sourceName(source);
    m_tasks.start(
        environmentTask + QString::number(asked), tr("Reading %1").arg(title),
        [this, source, layout, title, put = std::move(put), asked,
         scene = m_session.documentNumber(),
         begun = begun()](const JobContext& job) -> BackgroundTasks::Apply {
            const std::string name = normalizeSource(source.toStdString());
            auto notices = std::make_shared<std::vector<Notice>>();
            auto image = std::make_shared<Result<ImagePtr>>(
                loadEnvironmentImage(m_worker, name, *notices, layout, job));
            return [this, title, name, layout, put, asked, scene, begun, notices, image] {
                // A model that was opened meanwhile keeps the light, under other ids.
                const Target environment{Scope::Environment,
                                         scene == m_session.documentNumber() ? asked : 0};
                if (!image->ok()) {
                    Q_EMIT noticed(UserNotice::fromError(image->error()));
                    Q_EMIT changed(
                        {Affects::Nothing, environment}); // rows show what is, not wanted
                    return;
                }
                MapSlot sky;
                sky.source = name;
                sky.image = image->value();
                deliver(begun, title, [this, environment, sky, layout, put] {
                    if (!targetExists(document(), environment))
                        return; // removed meanwhile
                    put(environment,
                        {{&parameter("environment.kind"), static_cast<int>(EnvironmentKind::Image)},
                         {&parameter("environment.image"), sky},
                         {&parameter("environment.layout"), static_cast<int>(layout)},
                         {&parameter("environment.removedSources"), 0.0f}});
                });
                const UserNotice notice = UserNotice::fromImport(title, *notices, {});
                if (!notice.text.isEmpty())
                    Q_EMIT noticed(notice);
            };
        });
}

void DocumentController::extractSun() {
    const Environment& lit = document().environment();
    if (lit.kind != EnvironmentKind::Image || !lit.fileImage)
        return;
    const int removed = lit.removedSources + 1;
    const QString title = toQString(environmentTitle(lit));
    const auto tell = [this](const QString& text) { Q_EMIT noticed({NoticeKind::Info, text, {}}); };
    if (removed > kMostBrightSources) {
        tell(tr("%1 sources have been extracted from %2; that is as many as can be.")
                 .arg(kMostBrightSources)
                 .arg(title));
        return;
    }
    m_tasks.start(
        extractionTask, tr("Finding the sun of %1").arg(title),
        [this, tell, image = lit.fileImage, asked = lit.id, removed, title,
         scene = m_session.documentNumber(),
         begun = begun()](const JobContext& job) -> BackgroundTasks::Apply {
            auto found =
                std::make_shared<BrightSources>(extractBrightSources(*image, removed, job));
            return [this, tell, asked, removed, title, scene, begun, found] {
                if (scene != m_session.documentNumber())
                    return;
                if (std::ssize(found->sources) < removed || !found->sources.back().isClear) {
                    tell(removed == 1
                             ? tr("%1 has no source that stands out from what is around it.")
                                   .arg(title)
                             : tr("%1 has no further source that stands out.").arg(title));
                    return;
                }
                deliver(begun, title, [this, asked, removed, found] {
                    m_session.extractSource(asked, found->sources.back(), removed);
                });
            };
        });
}

void DocumentController::setDisplayConfig(const QString& file) {
    const std::string config =
        file.isEmpty() ? std::string() : QFileInfo(file).absoluteFilePath().toStdString();
    ToneMap curve = ToneMap::OpenColorIo;
    if (openColorIoConfig(config).empty())
        curve = View().toneMap;
    else if (config.empty())
        curve = document().view.toneMap;
    pushParameters({Scope::View, 0},
                   {{&parameter("view.ocioConfig"), config},
                    {&parameter("view.ocioDisplay"), std::string()},
                    {&parameter("view.ocioView"), std::string()},
                    {&parameter("view.toneMap"), static_cast<int>(curve)}},
                   file.isEmpty() ? tr("Leave OpenColorIO Configuration")
                                  : tr("Show Through %1").arg(shownFileName(file)));
}

void DocumentController::setDisplayView(const QString& display, const QString& view) {
    pushParameters({Scope::View, 0},
                   {{&parameter("view.ocioDisplay"), display.toStdString()},
                    {&parameter("view.ocioView"), view.toStdString()}},
                   tr("Show %1").arg(view.isEmpty() ? display : view));
}

void DocumentController::applyLibraryMaterial(Id id, const QString& name) {
    const QString title = sourceName(QStringLiteral("builtin:") + name);
    m_tasks.start(
        QStringLiteral("preset:%1").arg(id), tr("Making %1").arg(title),
        [this, id, name, title, begun = begun()](const JobContext&) -> BackgroundTasks::Apply {
            auto result = std::make_shared<Result<Material>>(library::material(name.toStdString()));
            return [this, id, title, begun, result] {
                if (!result->ok()) {
                    Q_EMIT noticed(UserNotice::fromError(result->error()));
                    return;
                }
                deliver(begun, title, [this, id, title, result] {
                    if (document().material(id))
                        editStructure(tr("Make %1 %2")
                                          .arg(QString::fromStdString(
                                                   nameOf(document(), {Scope::Material, id})),
                                               title),
                                      [&](Document& document) {
                                          replaceLook(document, id, result->value());
                                      });
                });
            };
        });
}

} // namespace patina::editor
