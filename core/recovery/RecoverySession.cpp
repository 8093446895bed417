#include "core/recovery/RecoverySession.h"

#include "core/base/Utf8.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "session-";
constexpr int kTries = 5;

// FileLock's file is a hidden one beside this name, which itself is never made.
fs::path lockName(const fs::path& folder) {
    return folder / "session";
}

std::uint64_t bytesIn(const fs::path& folder) {
    std::uint64_t bytes = 0;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code gone;
        const std::uint64_t size = fs::file_size(entry->path(), gone);
        bytes += gone ? 0 : size;
    }
    return bytes;
}

std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

} // namespace

Result<std::unique_ptr<RecoverySession>> RecoverySession::create(const fs::path& root) {
    std::error_code error;
    fs::create_directories(root, error);
    fs::permissions(root, fs::perms::owner_all, error); // best effort: folders below are 0700
    Error failed{ErrorKind::CannotCreate,
                 "the folder for unsaved work cannot be made; check that it is writable",
                 root,
                 {}};
    // Another editor that looks for abandoned work may take a folder that is not locked yet.
    for (int attempt = 0; attempt < kTries; ++attempt) {
        std::string folder = (root / (std::string(kPrefix) + "XXXXXX")).string();
        if (::mkdtemp(folder.data()) == nullptr) {
            failed.detail = std::strerror(errno);
            return failed;
        }
        Result<FileLock> lock = FileLock::take(lockName(folder));
        if (lock)
            return std::unique_ptr<RecoverySession>(
                new RecoverySession(folder, std::move(lock).value()));
        failed.detail = lock.error().text();
        fs::remove(folder, error);
    }
    return failed;
}

std::unique_ptr<RecoverySession> RecoverySession::takeOver(const fs::path& folder) {
    Result<FileLock> lock = FileLock::take(lockName(folder));
    if (!lock)
        return nullptr;
    return std::unique_ptr<RecoverySession>(new RecoverySession(folder, std::move(lock).value()));
}

RecoverySession::~RecoverySession() {
    m_lock.reset();
    std::error_code error;
    fs::remove(m_folder, error); // fails where something is in it, as it should
}

void RecoverySession::clear() const {
    std::error_code error;
    // The record first: without it the rest is nothing.
    fs::remove(recordFile(), error);
    fs::remove(pictureFile(), error);
    fs::remove(savedPictureFile(), error);
    fs::remove_all(bakeFolder(), error);
    // Temporary files of writes that were cut off.
    std::vector<fs::path> parts;
    for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".part")
            parts.push_back(entry->path());
    for (const fs::path& part : parts)
        fs::remove(part, error);
}

AbandonedWorks abandonedWorks(const fs::path& root, const RecoveryLimits& limits) {
    AbandonedWorks result;
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(root, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().filename().string().starts_with(kPrefix))
            folders.push_back(entry->path());
    for (const fs::path& folder : folders) {
        std::unique_ptr<RecoverySession> session = RecoverySession::takeOver(folder);
        if (!session)
            continue;
        Result<RecoveryRecord> record = readRecoveryRecord(session->recordFile());
        if (record) {
            result.works.push_back({std::move(session), std::move(record).value()});
            continue;
        }
        // Its editor had nothing unsaved when it ended.
        if (record.error().kind == ErrorKind::InputMissing &&
            !fs::exists(session->recordFile(), error)) {
            session->clear();
            continue;
        }
        if (record.error().kind == ErrorKind::InputBroken) {
            result.removed.push_back(makeValidUtf8(record.error().text()));
            session->clear();
        }
    }
    std::ranges::sort(result.works, std::ranges::greater{},
                      [](const AbandonedWork& work) { return work.record.writtenAt; });

    const auto describe = [](const RecoveryRecord& record) {
        return record.file.empty() ? record.name : makeValidUtf8(record.file.string());
    };
    const std::int64_t oldest = now() - limits.age.count();
    std::size_t kept = 0;
    std::erase_if(result.works, [&](const AbandonedWork& work) {
        const bool old = work.record.writtenAt < oldest;
        if (!old && ++kept <= limits.count)
            return false;
        result.removed.push_back(
            old ? fmt::format("Unsaved work on {} was removed: nobody recovered it in {} days.",
                              describe(work.record), limits.age.count() / 86400)
                : fmt::format("Unsaved work on {} was removed: only the newest {} are kept.",
                              describe(work.record), limits.count));
        work.session->clear();
        return true;
    });
    std::uint64_t bytes = 0;
    for (AbandonedWork& work : result.works) {
        const std::uint64_t own = bytesIn(work.session->bakeFolder());
        if (own == 0 || (bytes += own) <= limits.bakeBytes)
            continue;
        bytes -= own;
        fs::remove_all(work.session->bakeFolder(), error);
        work.record.leftOut.push_back(fmt::format(
            "its unsaved bakes, {} MiB: more than is kept of all unsaved work", own >> 20));
        std::erase_if(work.record.bakes,
                      [](const RecoveryBake& bake) { return bake.content != Hash{}; });
        // Best effort: when it cannot be written, the bakes are found missing at recovery.
        static_cast<void>(writeRecoveryRecord(work.session->recordFile(), work.record));
        result.removed.push_back(
            fmt::format("The bakes of unsaved work on {} were removed ({} MiB).",
                        describe(work.record), own >> 20));
    }
    return result;
}

} // namespace patina
