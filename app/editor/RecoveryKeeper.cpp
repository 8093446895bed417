#include "app/editor/RecoveryKeeper.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QBuffer>
#include <QFile>
#include <QImage>
#include <QMetaObject>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <span>

namespace patina::editor {
namespace {

// Most documents are handed over at each edit, so that nothing waits for a slow frame; of a large
// one, copies take a fiftieth of the window's time at most.
constexpr int kLongestPeriodMs = 1000;
constexpr double kCopyShare = 0.02;
constexpr double kCheapMs = 0.15;           // as often as there are events
constexpr int kPictureRestMs = 800;         // the picture is taken when frames pause
constexpr qint64 kPictureMs = 5000;         // and at the latest after
constexpr QSize kOfferedPicture(480, 360);  // at most
constexpr std::chrono::seconds kLongest{8}; // session managers end who takes longer

// Of the calling thread: what a busy machine does meanwhile says nothing about the document.
double threadMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

Bytes encodePng(const QImage& image) {
    QByteArray png;
    QBuffer buffer(&png);
    if (!buffer.open(QIODevice::WriteOnly) || !image.save(&buffer, "PNG"))
        return {};
    const auto bytes =
        std::as_bytes(std::span(png.constData(), static_cast<std::size_t>(png.size())));
    return {bytes.begin(), bytes.end()};
}

} // namespace

RecoveryKeeper::RecoveryKeeper(DocumentController& controller, ViewportWidget& viewport,
                               const std::filesystem::path& root, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_viewport(viewport)
    , m_writer(root, [&controller](const std::string& sentence) {
        QMetaObject::invokeMethod(
            &controller,
            [&controller, sentence] {
                Q_EMIT controller.noticed(
                    {NoticeKind::Warning, QString::fromStdString(sentence), {}});
            },
            Qt::QueuedConnection);
    }) {
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, &RecoveryKeeper::take);
    m_pictureTimer.setSingleShot(true);
    connect(&m_pictureTimer, &QTimer::timeout, this, &RecoveryKeeper::takePicture);

    // What is no step of its own follows soon.
    connect(&controller.undoStack(), &UndoStack::stepsChanged, this, &RecoveryKeeper::edited);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.affects != Affects::Nothing)
            schedule();
    });
    connect(&controller, &DocumentController::fileChanged, this, &RecoveryKeeper::fileChanged);
    connect(&controller, &DocumentController::saved, this, &RecoveryKeeper::saved);
    connect(&controller, &DocumentController::sceneOpened, this, [this] { markBakesSaved(); });
    connect(&viewport, &ViewportWidget::frameRendered, this, [this] {
        if (!m_pictureTaken.isValid() || m_pictureTaken.elapsed() < kPictureMs)
            m_pictureTimer.start(kPictureRestMs); // anew
        else if (!m_pictureTimer.isActive())
            m_pictureTimer.start(0); // not in the middle of painting
        if (!m_pictureTaken.isValid())
            m_pictureTaken.start();
    });
    fileChanged();
}

RecoveryKeeper::~RecoveryKeeper() {
    take(); // what was changed since the last time; the writer's end waits for it
}

void RecoveryKeeper::fileChanged() {
    if (m_file != m_controller.filePath()) {
        m_file = m_controller.filePath();
        m_savedBakes.clear();
        m_writer.setSavedFile(m_file.isEmpty() ? std::filesystem::path() : toPath(m_file));
    }
    if (m_controller.isModified()) {
        edited();
        return;
    }
    m_timer.stop();
    m_writer.clear();
}

void RecoveryKeeper::saved(const QString& file) {
    m_writer.setSavedFile(toPath(file));
    if (!m_controller.isModified()) // else nobody knows which state was written
        markBakesSaved();
}

void RecoveryKeeper::markBakesSaved() {
    m_savedBakes.clear();
    if (m_controller.filePath().isEmpty())
        return;
    for (const BakeArtifactPtr& bake : m_controller.document().bakes)
        m_savedBakes.emplace_back(bake);
}

std::vector<BakeArtifactPtr> RecoveryKeeper::savedBakes() const {
    std::vector<BakeArtifactPtr> result;
    for (const auto& weak : m_savedBakes)
        if (BakeArtifactPtr bake = weak.lock())
            result.push_back(std::move(bake));
    return result;
}

void RecoveryKeeper::edited() {
    if (m_discarded || !m_controller.isModified())
        return;
    if (!m_taken.isValid() || m_taken.elapsed() >= m_periodMs)
        take();
    else
        schedule();
}

void RecoveryKeeper::schedule() {
    if (m_discarded || m_timer.isActive() || !m_controller.isModified())
        return;
    const qint64 since = m_taken.isValid() ? m_taken.elapsed() : m_periodMs;
    m_timer.start(static_cast<int>(std::clamp<qint64>(m_periodMs - since, 0, m_periodMs)));
}

void RecoveryKeeper::take() {
    m_timer.stop();
    if (m_discarded || !m_controller.isModified())
        return;
    m_taken.start();
    const double start = threadMs();
    const UndoStack& undo = m_controller.undoStack();
    RecoverySnapshot snapshot;
    snapshot.document = m_controller.document();
    snapshot.name = m_controller.displayName().toStdString();
    snapshot.file = m_file.isEmpty() ? std::filesystem::path() : toPath(m_file);
    snapshot.steps = m_controller.unsavedSteps();
    snapshot.lastStep = undo.undoText().toStdString();
    snapshot.savedBakes = savedBakes();
    m_writer.keep(std::move(snapshot));
    const double copyMs = threadMs() - start;
    m_periodMs = copyMs < kCheapMs
                     ? 0
                     : static_cast<int>(std::min<double>(copyMs / kCopyShare, kLongestPeriodMs));
}

void RecoveryKeeper::takePicture() {
    m_pictureTaken.start();
    QImage picture = m_viewport.smallPicture(kOfferedPicture);
    if (picture.isNull() || m_discarded)
        return;
    const auto make = [picture = std::move(picture)] { return encodePng(picture); };
    if (m_controller.isModified())
        m_writer.setPicture(make);
    else
        m_writer.setSavedPicture(make);
}

bool RecoveryKeeper::keepNow() {
    if (m_controller.isModified())
        take();
    return flush();
}

bool RecoveryKeeper::flush() {
    return m_writer.flush(kLongest);
}

void RecoveryKeeper::discard() {
    m_discarded = true;
    m_timer.stop();
    m_pictureTimer.stop();
    m_writer.clear();
}

void RecoveryKeeper::adopt(std::unique_ptr<RecoverySession> session) {
    m_writer.adopt(std::move(session));
}

} // namespace patina::editor
