#include "app/editor/OutsideQuestion.h"

#include "app/editor/Session.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "core/base/PrintableText.h"
#include "core/document/Snapshot.h"
#include "core/edit/Change.h"
#include "core/edit/Parameters.h"
#include "core/light/Environment.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/scene/OutsideGrants.h"
#include "core/scene/Scene.h"

#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <algorithm>
#include <memory>
#include <vector>

namespace patina::editor {
namespace {

constexpr int kShownPictures = 6;   // in the question
constexpr int kMaxRemembered = 200; // models that the user has agreed to

QString agreedKey() {
    return QStringLiteral("outsidePictures/agreed");
}

QString shown(const std::string& path) {
    return QString::fromStdString(printableLine(path));
}

std::string native(const QString& path) {
    return QFile::encodeName(path).toStdString();
}

struct ReadPicture {
    std::string source;
    ColorEncoding encoding;
    ImagePtr image;
};
struct ReadEnvironment {
    std::string source;
    EnvironmentLayout layout;
    ImagePtr image;
};
struct ReadImages {
    std::vector<ReadPicture> pictures;
    std::vector<ReadEnvironment> environments;
    std::vector<Notice> notices;
};

// What was left out as an environment, in each layout that some environment asks for.
std::vector<ReadEnvironment> environmentsLeftOut(const Document& document,
                                                 const std::vector<std::string>& sources) {
    std::vector<ReadEnvironment> result;
    const auto add = [&](const Environment& environment) {
        const bool wanted = environment.problem == kOutsideProjectProblem &&
                            std::ranges::find(sources, environment.source) != sources.end();
        if (wanted && std::ranges::none_of(result, [&](const ReadEnvironment& other) {
                return other.source == environment.source && other.layout == environment.layout;
            }))
            result.push_back({environment.source, environment.layout, nullptr});
    };
    for (const Environment& environment : document.environments)
        add(environment);
    for (const Snapshot& snapshot : document.snapshots)
        for (const auto& environment : snapshot.look->environments)
            add(*environment);
    return result;
}

// Each picture once for each way in which its colours are meant.
void readPicture(WorkerClient& worker, const std::string& file, ReadImages& read) {
    for (const ColorEncoding encoding : {ColorEncoding::Srgb, ColorEncoding::Data}) {
        Result<ImagePtr> image = loadMapImage(worker, file, encoding, &read.notices);
        if (image.ok())
            read.pictures.push_back({file, encoding, *image});
        else if (encoding == ColorEncoding::Srgb)
            read.notices.push_back({image.error().message, file});
    }
}

void take(Session& session, const DocumentController::Begun& begun,
          const std::shared_ptr<const ReadImages>& read) {
    DocumentController& controller = session.controller;
    controller.deliver(begun, OutsideQuestion::tr("Pictures from outside"), [&controller, read] {
        controller.editStructure(OutsideQuestion::tr("Read Pictures"), [&](Document& document) {
            for (const ReadPicture& picture : read->pictures)
                fillOutsidePicture(document, picture.source, picture.encoding, picture.image);
            for (const ReadEnvironment& environment : read->environments)
                fillOutsideEnvironment(document, environment.source, environment.layout,
                                       environment.image);
            if (!read->environments.empty())
                resolveBlend(document);
        });
    });
    const UserNotice notice =
        UserNotice::fromImport(OutsideQuestion::tr("Pictures from outside"), read->notices, {});
    if (!notice.text.isEmpty())
        Q_EMIT controller.noticed(notice);
}

} // namespace

OutsideQuestion::OutsideQuestion(Session& session, QWidget& window)
    : QObject(&window)
    , m_session(session)
    , m_window(window) {
    for (const QString& model : QSettings().value(agreedKey()).toStringList())
        session.worker.allowOutside(native(model));
    // Whoever opens a file again may have thought again. Changed: a model may have been added.
    connect(&session.controller, &DocumentController::sceneOpened, this, [this] {
        if (m_question)
            return; // about this very scene
        m_asked.clear();
        m_askedOfProject.clear();
        askIfNeeded();
    });
    connect(&session.controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target)
            askIfNeeded();
    });
}

void OutsideQuestion::askIfNeeded() {
    if (m_question)
        return;
    const Document& document = m_session.controller.document();
    const std::vector<std::string> models = outsidePictures(document).models;
    const auto model = std::find_if(models.begin(), models.end(), [&](const std::string& name) {
        return !m_asked.contains(QFile::decodeName(name.c_str()));
    });
    if (model != models.end()) {
        askAboutModel(*model, outsidePicturesOf(document, *model));
        return;
    }
    std::vector<std::string> ofProject = outsidePictures(document).ofProject;
    std::erase_if(ofProject, [&](const std::string& picture) {
        return std::ranges::find(m_askedOfProject, picture) != m_askedOfProject.end();
    });
    if (!ofProject.empty())
        askAboutProject(ofProject);
}

void OutsideQuestion::askAboutModel(const std::string& model,
                                    const std::vector<std::string>& pictures) {
    const QString name = QFile::decodeName(model.c_str());
    m_asked << name;
    ask(tr("Pictures Outside the Model's Folder"),
        tr("Read pictures from outside the folder of %1?")
            .arg(shown(native(QFileInfo(name).fileName()))),
        tr("The model names these files. They are shown and exported with it. Read them only if "
           "you know where the model comes from."),
        pictures, [this, model, pictures] { agreeToModel(model, pictures); });
}

void OutsideQuestion::askAboutProject(const std::vector<std::string>& pictures) {
    m_askedOfProject.insert(m_askedOfProject.end(), pictures.begin(), pictures.end());
    ask(tr("Pictures Outside the Project's Folder"),
        tr("Read pictures from outside the folder of %1?")
            .arg(shown(m_session.controller.displayName().toStdString())),
        tr("The project names these files, and you have not saved it with them on this computer. "
           "They are shown and exported with it. Read them only if you know where the project "
           "comes from."),
        pictures, [this, pictures] { agreeToProject(pictures); });
}

void OutsideQuestion::ask(const QString& title, const QString& text, const QString& explanation,
                          const std::vector<std::string>& pictures,
                          const std::function<void()>& agree) {
    QStringList files;
    for (const std::string& picture : pictures)
        if (files.size() < kShownPictures)
            files << shown(picture);
    const int count = static_cast<int>(pictures.size());
    if (count > kShownPictures)
        files << tr("and %n more", nullptr, count - kShownPictures);
    m_question =
        new QMessageBox(QMessageBox::Question, title, text, QMessageBox::NoButton, &m_window);
    m_question->setObjectName(QStringLiteral("outsideQuestion"));
    m_question->setTextFormat(Qt::PlainText);
    m_question->setIconPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                                  .pixmap(QSize(36, 36), m_window.devicePixelRatioF()));
    m_question->setInformativeText(explanation + QStringLiteral("\n\n") +
                                   files.join(QLatin1Char('\n')));
    QPushButton* read = m_question->addButton(tr("&Read Them"), QMessageBox::AcceptRole);
    QPushButton* leave = m_question->addButton(tr("&Leave Out"), QMessageBox::RejectRole);
    m_question->setDefaultButton(leave);
    m_question->setEscapeButton(leave);
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    connect(read, &QPushButton::clicked, this, agree);
    // The next file has a question of its own.
    connect(m_question, &QObject::destroyed, this, &OutsideQuestion::askIfNeeded,
            Qt::QueuedConnection);
    m_question->open();
}

void OutsideQuestion::agreeToModel(const std::string& model,
                                   const std::vector<std::string>& pictures) {
    m_session.worker.allowOutside(model);
    const QString name = QFile::decodeName(model.c_str());
    QSettings settings;
    QStringList agreed = settings.value(agreedKey()).toStringList();
    agreed.removeAll(name);
    agreed.prepend(name);
    settings.setValue(agreedKey(), agreed.mid(0, kMaxRemembered));
    read(QStringLiteral("outside ") + name, pictures);
}

void OutsideQuestion::agreeToProject(const std::vector<std::string>& pictures) {
    std::vector<std::string> files;
    for (const std::string& picture : pictures)
        files.push_back(fileOfPicture(picture));
    if (const QString project = m_session.controller.filePath(); !project.isEmpty())
        if (const Result<void> kept = grantOutside(native(project), files, outsideGrantsFile());
            !kept)
            Q_EMIT m_session.controller.noticed(UserNotice::fromError(kept.error()));
    read(QStringLiteral("outside the project"), pictures);
}

void OutsideQuestion::read(const QString& key, const std::vector<std::string>& pictures) {
    Session& session = m_session; // it outlives this window's question
    const Document& document = session.controller.document();
    session.controller.tasks().start(
        key, tr("Reading pictures"),
        [&session, pictures, ofMaps = outsidePictures(document).ofMaps,
         environments = environmentsLeftOut(document, pictures),
         begun = session.controller.begun()](const JobContext& job) -> BackgroundTasks::Apply {
            auto read = std::make_shared<ReadImages>();
            for (ReadEnvironment environment : environments) {
                Result<ImagePtr> image = loadEnvironmentImage(
                    session.worker, environment.source, read->notices, environment.layout, job);
                if (job.cancelled())
                    return {};
                if (image.ok()) {
                    environment.image = *image;
                    read->environments.push_back(environment);
                } else {
                    read->notices.push_back({image.error().message, environment.source});
                }
            }
            for (const std::string& file : pictures) {
                if (job.cancelled())
                    return {};
                if (std::ranges::find(ofMaps, file) != ofMaps.end())
                    readPicture(session.worker, file, *read);
            }
            return [&session, begun, read] { take(session, begun, read); };
        });
}

} // namespace patina::editor
