#include "app/editor/OutsideQuestion.h"

#include "app/editor/Session.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "core/base/PrintableText.h"
#include "core/edit/Change.h"
#include "core/edit/Parameters.h"
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

void take(Session& session, const DocumentController::Begun& begun,
          const std::vector<ReadPicture>& pictures, const std::vector<Notice>& notices) {
    DocumentController& controller = session.controller;
    controller.deliver(
        begun, OutsideQuestion::tr("Pictures of the model"), [&controller, pictures] {
            controller.editStructure(OutsideQuestion::tr("Read Pictures"), [&](Document& document) {
                for (const ReadPicture& picture : pictures)
                    fillOutsidePicture(document, picture.source, picture.encoding, picture.image);
            });
        });
    const UserNotice notice =
        UserNotice::fromImport(OutsideQuestion::tr("Pictures of the model"), notices, {});
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
    if (model == models.end())
        return;
    ask(*model, outsidePicturesOf(document, *model));
}

void OutsideQuestion::ask(const std::string& model, const std::vector<std::string>& pictures) {
    const QString name = QFile::decodeName(model.c_str());
    m_asked << name;
    QStringList files;
    for (const std::string& picture : pictures)
        if (files.size() < kShownPictures)
            files << shown(picture);
    const int count = static_cast<int>(pictures.size());
    if (count > kShownPictures)
        files << tr("and %n more", nullptr, count - kShownPictures);
    m_question = new QMessageBox(QMessageBox::Question, tr("Pictures Outside the Model's Folder"),
                                 tr("Read pictures from outside the folder of %1?")
                                     .arg(shown(native(QFileInfo(name).fileName()))),
                                 QMessageBox::NoButton, &m_window);
    m_question->setObjectName(QStringLiteral("outsideQuestion"));
    m_question->setTextFormat(Qt::PlainText);
    m_question->setIconPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                                  .pixmap(QSize(36, 36), m_window.devicePixelRatioF()));
    m_question->setInformativeText(
        tr("The model names these files. They are shown and exported with it. Read them only if "
           "you know where the model comes from.") +
        QStringLiteral("\n\n") + files.join(QLatin1Char('\n')));
    QPushButton* read = m_question->addButton(tr("&Read Them"), QMessageBox::AcceptRole);
    QPushButton* leave = m_question->addButton(tr("&Leave Out"), QMessageBox::RejectRole);
    m_question->setDefaultButton(leave);
    m_question->setEscapeButton(leave);
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    connect(read, &QPushButton::clicked, this, [this, model, pictures] { agree(model, pictures); });
    // The next file has a question of its own.
    connect(m_question, &QObject::destroyed, this, &OutsideQuestion::askIfNeeded,
            Qt::QueuedConnection);
    m_question->open();
}

void OutsideQuestion::agree(const std::string& model, const std::vector<std::string>& pictures) {
    Session& session = m_session; // it outlives this window's question
    session.worker.allowOutside(model);
    const QString name = QFile::decodeName(model.c_str());
    QSettings settings;
    QStringList agreed = settings.value(agreedKey()).toStringList();
    agreed.removeAll(name);
    agreed.prepend(name);
    settings.setValue(agreedKey(), agreed.mid(0, kMaxRemembered));

    // Each picture once for each way in which its colours are meant.
    session.controller.tasks().start(
        QStringLiteral("outside ") + name, tr("Reading pictures"),
        [&session, pictures,
         begun = session.controller.begun()](const JobContext& job) -> BackgroundTasks::Apply {
            auto read = std::make_shared<std::vector<ReadPicture>>();
            auto notices = std::make_shared<std::vector<Notice>>();
            for (const std::string& file : pictures)
                for (const ColorEncoding encoding : {ColorEncoding::Srgb, ColorEncoding::Data}) {
                    if (job.cancelled())
                        return {};
                    Result<ImagePtr> image =
                        loadMapImage(session.worker, file, encoding, notices.get());
                    if (image.ok())
                        read->push_back({file, encoding, *image});
                    else if (encoding == ColorEncoding::Srgb)
                        notices->push_back({image.error().message, file});
                }
            return [&session, begun, read, notices] { take(session, begun, *read, *notices); };
        });
}

} // namespace patina::editor
