#include "app/editor/FileFlow.h"

#include "app/editor/OutsideQuestion.h"
#include "app/editor/Session.h"
#include "app/editor/VisualSceneQuestion.h"
#include "app/editor/bracket/BracketFlow.h"
#include "app/editor/document/DropPlan.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SaveQuestion.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "core/scene/Scene.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

namespace patina::editor {
namespace {

constexpr int kMaxRecent = 10;

QString recentKey() {
    return QStringLiteral("recentFiles");
}
QString folderKey() {
    return QStringLiteral("folders/scenes");
}

} // namespace

FileFlow::FileFlow(Session& session, QWidget& window)
    : QObject(&window)
    , m_session(session)
    , m_window(window)
    , m_brackets(new BracketFlow(session.controller, session.jobs, window)) {
    new OutsideQuestion(session, window); // the window's
    connect(new VisualSceneQuestion(session.controller, window), &VisualSceneQuestion::chosen, this,
            [this](const QString& scene) { openScene(scene); });
    const auto remembers = [this](const QString& scene) {
        if (!isBuiltin(scene.toStdString()))
            remember(scene);
    };
    connect(&session.controller, &DocumentController::sceneOpened, this, remembers);
    connect(&session.controller, &DocumentController::saved, this, remembers);
    connect(&session.controller, &DocumentController::openFailed, this,
            [this](const QString& file) {
                if (!QFileInfo::exists(file))
                    forget(file);
            });
    session.controller.setSaveQuestion(
        [this](const SaveQuestion& question) { askBeforeOverwriting(question); });
    session.controller.setReplaceQuestion([this](const std::function<void()>& proceed) {
        if (m_question) // about something else; one at a time
            Q_EMIT m_session.controller.noticed(
                {NoticeKind::Warning,
                 tr("The scene was not opened: this one was edited meanwhile. Open it again."),
                 {}});
        else
            guard(proceed);
    });
}

// --- Opening -------------------------------------------------------------------------------------

void FileFlow::newScene() {
    guard([this] { m_session.controller.newDocument(); });
}

void FileFlow::openScene(const QString& scene, const std::function<void(bool)>& done) {
    m_session.controller.openScene(scene, [this, done](bool opened) {
        Q_EMIT openingChanged({});
        if (done)
            done(opened);
    });
    Q_EMIT openingChanged(isBuiltin(scene.toStdString())
                              ? MapSlotWidget::sourceTitle(scene.toStdString())
                              : shownFileName(scene));
}

void FileFlow::open(const QString& scene) {
    guard([this, scene] { openScene(scene); });
}

void FileFlow::openWithDialog() {
    guard([this] {
        auto* dialog = new QFileDialog(&m_window, tr("Open"), startFolder(), sceneFilter());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setFileMode(QFileDialog::ExistingFile);
        connect(dialog, &QFileDialog::fileSelected, this,
                [this](const QString& file) { openScene(file); });
        dialog->open();
    });
}

void FileFlow::addModelWithDialog() {
    auto* dialog = new QFileDialog(&m_window, tr("Add Model"), startFolder(), modelFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    connect(dialog, &QFileDialog::filesSelected, this, [this](const QStringList& files) {
        for (const QString& file : files)
            m_session.controller.addModel(file);
    });
    dialog->open();
}

void FileFlow::makeHdrWithDialog() {
    m_brackets->openWithDialog();
}

void FileFlow::dropped(const QStringList& files, const QPoint& globalPosition) {
    QStringList models, others;
    for (const QString& file : files) {
        if (QFileInfo(file).isDir()) {
            m_session.library.addFolder(file);
            Q_EMIT folderAdded();
            continue;
        }
        const FileKind kind = fileKind(file);
        if (kind == FileKind::Project) {
            open(file); // replaces everything, so the rest would be lost anyway
            return;
        }
        (kind == FileKind::Model ? models : others) << file;
    }
    if (!models.isEmpty()) {
        // Models bring their own maps, and the material that is selected may be about to go.
        const DropPlan plan = planDrop(others);
        QStringList images = plan.unclear;
        for (const MapFile& one : plan.maps)
            images << one.file;
        for (const QString& image : images)
            others.removeAll(image);
        if (!images.isEmpty())
            Q_EMIT m_session.controller.noticed(
                {NoticeKind::Warning,
                 tr("The images that came with the model were left out: drop them again, onto the "
                    "material that they belong to."),
                 images});
    }
    const QStringList photos = models.isEmpty() ? planDrop(others).photos() : QStringList();
    if (!photos.isEmpty()) {
        for (const QString& photo : photos)
            others.removeAll(photo);
        m_brackets->offer(photos, [this, photos] {
            Q_EMIT m_session.controller.noticed(
                {NoticeKind::Warning,
                 unclearText(photos) + QLatin1Char(' ') +
                     tr("Photos become an HDR when their files say different exposures (Exif); "
                        "File > Make HDR from Photos lets you type them."),
                 photos});
        });
    }
    m_session.controller.addFiles(others, m_session.selection.material());
    if (models.isEmpty())
        return;

    const auto openModels = [this, models] {
        openScene(models.first(),
                  [this, models](bool) { m_session.controller.addFiles(models.mid(1)); });
    };
    if (m_session.controller.isPristine()) {
        openModels();
        return;
    }
    // With work on the table, only the user knows.
    auto* menu = new QMenu(&m_window);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->setObjectName(QStringLiteral("dropMenu"));
    menu->addAction(tr("Add to the Scene"), this,
                    [this, models] { m_session.controller.addFiles(models); });
    menu->addAction(tr("Replace the Scene"), this, [this, openModels] { guard(openModels); });
    menu->addSeparator();
    menu->addAction(tr("Cancel"), menu, &QMenu::close);
    menu->popup(globalPosition);
}

void FileFlow::openFromCommandLine(const QStringList& files, const QString& environment) {
    QString scene;
    QStringList rest;
    for (const QString& file : files) {
        const FileKind kind = fileKind(file);
        const bool opens = kind == FileKind::Project || kind == FileKind::Model ||
                           kind == FileKind::Unknown || isBuiltin(file.toStdString());
        if (opens && scene.isEmpty())
            scene = file;
        else
            rest << file;
    }
    const auto then = [this, rest, environment](bool) {
        m_session.controller.addFiles(rest, m_session.selection.material());
        if (!environment.isEmpty())
            m_session.controller.setEnvironment(environment);
    };
    if (scene.isEmpty()) {
        m_session.controller.newDocument(then);
        return;
    }
    openScene(scene, [this, then](bool opened) {
        if (opened)
            then(true);
        else
            m_session.controller.newDocument(then); // an empty window would help nobody
    });
}

// --- Saving --------------------------------------------------------------------------------------

void FileFlow::save() {
    save({});
}

void FileFlow::saveAs() {
    saveAs([](bool) {});
}

void FileFlow::save(const std::function<void()>& then) {
    const QString file = m_session.controller.saveTarget();
    const auto done = [then](bool ok) {
        if (ok && then)
            then();
    };
    if (file.isEmpty())
        saveAs(done);
    else
        m_session.controller.saveAs(file, done);
}

void FileFlow::saveAs(const std::function<void(bool)>& done) {
    const QString file = m_session.controller.filePath();
    auto* dialog = new QFileDialog(&m_window, tr("Save As"), startFolder(), projectFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("patina"));
    dialog->selectFile(
        file.isEmpty() ? m_session.controller.displayName() + QStringLiteral(".patina") : file);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, done](const QString& chosen) { m_session.controller.saveAs(chosen, done); });
    dialog->open();
}

void FileFlow::askBeforeOverwriting(const SaveQuestion& question) {
    using Reason = SaveQuestion::Reason;
    if (m_question) {
        m_question->raise();
        question.done(false);
        return;
    }
    m_question = new QMessageBox(QMessageBox::Warning, tr("Save"), question.text,
                                 QMessageBox::Cancel, &m_window);
    m_question->setObjectName(QStringLiteral("overwriteQuestion"));
    m_question->setIconPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                                  .pixmap(QSize(36, 36), m_window.devicePixelRatioF()));
    m_question->setInformativeText(
        question.reason == Reason::FolderGone
            ? tr("Nothing was saved. Choose another place for it.")
            : tr("Nothing was saved. Overwriting replaces what the file holds."));
    const auto add = [this](const QString& text, QMessageBox::ButtonRole role, const char* name) {
        QPushButton* button = m_question->addButton(text, role);
        button->setObjectName(QLatin1String(name));
        return button;
    };
    QPushButton* elsewhere = add(tr("Save &As…"), QMessageBox::AcceptRole, "saveElsewhere");
    QPushButton *overwrite = nullptr, *reload = nullptr;
    if (question.reason != Reason::FolderGone)
        overwrite = add(tr("&Overwrite"), QMessageBox::DestructiveRole, "overwrite");
    if (question.reason == Reason::Changed || question.reason == Reason::OpenElsewhere) {
        reload = add(tr("&Reload"), QMessageBox::DestructiveRole, "reload");
        reload->setToolTip(tr("Opens the file as it is now; your changes are lost"));
    }
    m_question->setDefaultButton(elsewhere);
    connect(m_question, &QMessageBox::finished, this,
            [this, question, box = m_question.data(), elsewhere, overwrite, reload] {
                m_question = nullptr;
                const QAbstractButton* answer = box->clickedButton(); // null: closed
                if (answer == nullptr) {
                    question.done(false);
                } else if (answer == elsewhere) {
                    saveAs(question.done);
                } else if (answer == overwrite) {
                    question.overwrite();
                } else {
                    question.done(false);
                    if (answer == reload)
                        m_session.controller.openScene(question.file);
                }
            });
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    m_question->open();
}

void FileFlow::guard(const std::function<void()>& proceed) {
    if (!m_session.controller.isModified()) {
        proceed();
        return;
    }
    if (m_question) {
        m_question->raise();
        return;
    }
    m_question = new QMessageBox(
        QMessageBox::Warning, tr("Unsaved Changes"),
        tr("Save the changes to %1?").arg(shownName(m_session.controller.displayName())),
        QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &m_window);
    m_question->setIconPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                                  .pixmap(QSize(36, 36), m_window.devicePixelRatioF()));
    m_question->setInformativeText(tr("Your changes will be lost if you don't save."));
    m_question->setDefaultButton(QMessageBox::Save);
    m_question->button(QMessageBox::Discard)->setText(tr("&Don't Save"));
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    connect(m_question, &QMessageBox::finished, this, [this, proceed](int answer) {
        m_question = nullptr;
        if (answer == QMessageBox::Save)
            save(
                [this, proceed] { guard(proceed); }); // what was edited meanwhile is asked for anew
        else if (answer == QMessageBox::Discard)
            proceed();
    });
    m_question->open();
}

void FileFlow::guardQuit(const std::function<void()>& proceed) {
    const int running = m_session.jobs.runningCount();
    if (running == 0) {
        guard(proceed);
        return;
    }
    if (m_question) {
        m_question->raise();
        return;
    }
    m_question = new QMessageBox(QMessageBox::Question, tr("Jobs Are Running"),
                                 running == 1 ? tr("A job is running. Quit?")
                                              : tr("%1 jobs are running. Quit?").arg(running),
                                 QMessageBox::Cancel, &m_window);
    m_question->setIconPixmap(icon(QStringLiteral("jobs"), tokens::kCopper)
                                  .pixmap(QSize(36, 36), m_window.devicePixelRatioF()));
    m_question->setInformativeText(
        tr("Bakes can be resumed when you open this scene again; what else "
           "runs is lost."));
    QPushButton* quit = m_question->addButton(tr("&Quit"), QMessageBox::DestructiveRole);
    m_question->button(QMessageBox::Cancel)->setText(tr("&Keep Working"));
    m_question->setDefaultButton(QMessageBox::Cancel);
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    connect(quit, &QPushButton::clicked, this, [this, proceed] {
        m_question = nullptr;
        guard(proceed);
    });
    m_question->open();
}

// --- Recent files --------------------------------------------------------------------------------

QStringList FileFlow::recentFiles() const {
    return QSettings().value(recentKey()).toStringList();
}

void FileFlow::remember(const QString& file) {
    QStringList files = recentFiles();
    files.removeAll(file);
    files.prepend(file);
    QSettings settings;
    settings.setValue(recentKey(), files.mid(0, kMaxRecent));
    rememberFolder(m_session.controller, folderKey(), file);
    Q_EMIT recentFilesChanged();
}

void FileFlow::forget(const QString& file) {
    QStringList files = recentFiles();
    if (files.removeAll(file) == 0)
        return;
    QSettings().setValue(recentKey(), files);
    Q_EMIT recentFilesChanged();
}

void FileFlow::clearRecentFiles() {
    QSettings().remove(recentKey());
    Q_EMIT recentFilesChanged();
}

QString FileFlow::startFolder() const {
    return proposedFolder(m_session.controller, folderKey());
}

} // namespace patina::editor
