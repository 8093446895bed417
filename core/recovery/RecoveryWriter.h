// Keeps the newest state of a document in a recovery session, on threads of its own: values at
// once, bakes after them, so that an edit never waits for a large bake. Atomic at every moment:
// whenever the process ends, the last complete record is there.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/document/Document.h"
#include "core/recovery/RecoverySession.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace patina {

struct RecoverySnapshot {
    Document document;
    std::string name;
    std::filesystem::path file; // as in RecoveryRecord
    int steps = 0;
    std::string lastStep;
    std::vector<BakeArtifactPtr> savedBakes; // those of the document that `file` holds
};

class RecoveryWriter {
  public:
    struct Settings {
        std::uint64_t maxBakeBytes = std::uint64_t{1} << 30; // of all bakes together, in memory
        std::uint64_t freeBytes = std::uint64_t{256} << 20;  // that a bake leaves on the disk
        std::chrono::milliseconds bakePause{30'000};         // between two bakes of one kind
    };
    // From a thread of the writer's: a sentence for the user. Told once until it works again.
    using Tell = std::function<void(const std::string&)>;
    using MakePicture = std::function<Bytes()>; // encodes a PNG; called on the writer's thread

    RecoveryWriter(std::filesystem::path root, Tell tell)
        : RecoveryWriter(std::move(root), std::move(tell), Settings()) {}
    RecoveryWriter(std::filesystem::path root, Tell tell, Settings settings);
    ~RecoveryWriter(); // writes what was handed over, and leaves it where it is
    RecoveryWriter(const RecoveryWriter&) = delete;
    RecoveryWriter& operator=(const RecoveryWriter&) = delete;

    // Return at once; the newest wins.
    void keep(RecoverySnapshot snapshot);
    void clear(); // nothing is unsaved any more: what was kept is removed
    // The saved project is now this file, with its present content; empty: there is none.
    void setSavedFile(const std::filesystem::path& file);
    void setPicture(MakePicture make);      // of the unsaved work
    void setSavedPicture(MakePicture make); // of what is saved, to compare with
    // Goes on in this session's folder, which holds what was recovered; the one before is removed.
    void adopt(std::unique_ptr<RecoverySession> session);

    // Waits until all that was handed over is on the disk, bakes included; false after `longest`.
    bool flush(std::chrono::milliseconds longest);

  private:
    struct StoredBake {
        std::weak_ptr<const BakeArtifact> artifact;
        Hash content;
        std::string leftOut; // why it is not stored
    };
    struct Work { // what the thread has to do; the newest replaces what was not begun
        bool clear = false;
        std::optional<RecoverySnapshot> snapshot;
        std::optional<std::filesystem::path> savedFile;
        MakePicture picture, savedPicture;
        std::unique_ptr<RecoverySession> session;
        [[nodiscard]] bool empty() const {
            return !clear && !snapshot && !savedFile && !picture && !savedPicture && !session;
        }
    };

    void run();
    void runBakes();
    void handle(Work work);
    void write();
    void writePicture(const MakePicture& make, const std::filesystem::path& file);
    [[nodiscard]] RecoveryRecord recordOf(const RecoverySnapshot& snapshot);
    [[nodiscard]] BakeArtifactPtr nextBake(std::chrono::steady_clock::time_point now) const;
    void storeBake(std::unique_lock<std::mutex>& lock, const BakeArtifactPtr& artifact);
    void forgetBakes();
    void fail(const std::string& sentence);

    const std::filesystem::path m_root;
    const Tell m_tell;
    const Settings m_settings;

    // Of the first thread alone, except that the second reads m_session's folder under the mutex.
    std::unique_ptr<RecoverySession> m_session;
    std::shared_ptr<const RecoverySnapshot> m_last; // as written; null: nothing is unsaved
    std::filesystem::path m_savedFile;
    Hash m_savedContent;
    std::int64_t m_unsavedSince = 0;
    MakePicture m_savedPicture; // until there is a session to write it to
    bool m_failed = false;

    std::mutex m_mutex;
    std::condition_variable m_wake, m_idle;
    Work m_work;
    bool m_working = false, m_bakeWorking = false, m_stop = false, m_rewrite = false;
    bool m_hurry = false;                              // flush() waits: no pause between bakes
    std::shared_ptr<const RecoverySnapshot> m_bakesOf; // whose bakes the second thread stores
    std::filesystem::path m_bakeFolder;
    int m_bakeGeneration = 0; // another one: what was stored before is gone
    std::map<const BakeArtifact*, StoredBake> m_stored;
    std::optional<Hash> m_storing;
    std::string m_toldLeftOut; // the last one
    std::map<BakeKind, std::chrono::steady_clock::time_point> m_bakeTimes;

    std::thread m_thread, m_bakeThread; // last: they use all of the above
};

} // namespace patina
