// A folder that holds the unsaved work of one running editor, below a root that all editors of the
// user share. It is locked while its editor runs, however that ends; what is not locked was left
// behind by one that ended before the work was saved.
#pragma once

#include "core/base/FileLock.h"
#include "core/base/Result.h"
#include "core/recovery/RecoveryRecord.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

class RecoverySession {
  public:
    // A new folder below `root`, which is made where it is missing; only the user may read it.
    // Errors: CannotCreate.
    static Result<std::unique_ptr<RecoverySession>> create(const std::filesystem::path& root);
    // Takes over a folder; null when its editor runs, or another one offers it.
    static std::unique_ptr<RecoverySession> takeOver(const std::filesystem::path& folder);

    ~RecoverySession(); // gives the lock back, and removes the folder where nothing is in it
    RecoverySession(const RecoverySession&) = delete;
    RecoverySession& operator=(const RecoverySession&) = delete;

    [[nodiscard]] const std::filesystem::path& folder() const { return m_folder; }
    [[nodiscard]] std::filesystem::path recordFile() const { return m_folder / "work.recovery"; }
    [[nodiscard]] std::filesystem::path pictureFile() const { return m_folder / "work.png"; }
    [[nodiscard]] std::filesystem::path savedPictureFile() const { return m_folder / "saved.png"; }
    [[nodiscard]] std::filesystem::path bakeFolder() const { return m_folder / "bakes"; }

    // Removes the work; the folder stays.
    void clear() const;

  private:
    RecoverySession(std::filesystem::path folder, FileLock lock)
        : m_folder(std::move(folder))
        , m_lock(std::move(lock)) {}

    std::filesystem::path m_folder;
    std::optional<FileLock> m_lock;
};

struct AbandonedWork {
    std::unique_ptr<RecoverySession> session; // nobody else is offered it while this is held
    RecoveryRecord record;
};

// What is kept of work that nobody recovers or discards.
struct RecoveryLimits {
    std::chrono::seconds age = std::chrono::hours(24 * 60);
    std::size_t count = 50;                           // of pieces of work; the oldest go first
    std::uint64_t bakeBytes = std::uint64_t{4} << 30; // of all: those of the oldest go first
};

struct AbandonedWorks {
    std::vector<AbandonedWork> works; // newest first
    std::vector<std::string> removed; // sentences for the user: what the limits or damage removed
};

// All work below `root` whose editor has ended. A damaged record is removed, with a sentence.
[[nodiscard]] AbandonedWorks abandonedWorks(const std::filesystem::path& root,
                                            const RecoveryLimits& limits = {});

} // namespace patina
