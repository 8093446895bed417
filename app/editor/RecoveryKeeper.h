// Keeps unsaved work where a crash leaves it: the document's values a fraction of a second
// after an edit, on a thread of its own (core/recovery/RecoveryWriter.h). What is saved, or given
// up by the user, is not kept.
#pragma once

#include "core/recovery/RecoveryWriter.h"

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <vector>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;
class ViewportWidget;

class RecoveryKeeper : public QObject {
    Q_OBJECT
  public:
    // `root`: the folder of all sessions. Both outlive the keeper.
    RecoveryKeeper(DocumentController& controller, ViewportWidget& viewport,
                   const std::filesystem::path& root, QObject* parent = nullptr);
    ~RecoveryKeeper() override; // leaves what is unsaved to be recovered

    // Everything unsaved is on the disk when this returns; false when that took too long.
    bool keepNow();
    // The same of what was taken so far. From any thread.
    bool flush();
    // The user has decided about what is unsaved: nothing is kept, now and later.
    void discard();
    // The document is what this session holds.
    void adopt(std::unique_ptr<RecoverySession> session);

  private:
    void fileChanged();
    void saved(const QString& file);
    void edited();   // keeps it now, or soon after the last time
    void schedule(); // soon
    void take();     // hands the document over
    void takePicture();
    void markBakesSaved();
    [[nodiscard]] std::vector<BakeArtifactPtr> savedBakes() const;

    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    int m_periodMs = 0; // between two states that are handed over
    RecoveryWriter m_writer;
    QTimer m_timer, m_pictureTimer;
    QElapsedTimer m_taken, m_pictureTaken;                       // since the last time
    QString m_file;                                              // the controller's
    std::vector<std::weak_ptr<const BakeArtifact>> m_savedBakes; // which that file holds
    bool m_discarded = false;
};

} // namespace patina::editor
