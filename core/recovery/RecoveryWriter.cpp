#include "core/recovery/RecoveryWriter.h"

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/recovery/RecoveryBakes.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/OutsidePictures.h"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPause{150}; // between two records

std::int64_t secondsNow() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

bool contains(const std::vector<BakeArtifactPtr>& bakes, const BakeArtifactPtr& bake) {
    return std::ranges::find(bakes, bake) != bakes.end();
}

std::string titleOf(BakeKind kind) {
    switch (kind) {
    case BakeKind::AoTexel:
        return "the baked ambient occlusion (texture)";
    case BakeKind::AoVertex:
        return "the baked ambient occlusion (per vertex)";
    case BakeKind::PrtTexel:
        return "the baked radiance transfer (texture)";
    case BakeKind::LightMap:
        return "the baked light map";
    case BakeKind::PrtVertex:
        break;
    }
    return "the baked radiance transfer (per vertex)";
}

} // namespace

RecoveryWriter::RecoveryWriter(fs::path root, Tell tell, Settings settings)
    : m_root(std::move(root))
    , m_tell(std::move(tell))
    , m_settings(settings)
    , m_thread([this] { run(); })
    , m_bakeThread([this] { runBakes(); }) {}

RecoveryWriter::~RecoveryWriter() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_wake.notify_all();
    m_thread.join();
    m_bakeThread.join();
}

// --- What the editor calls -----------------------------------------------------------------------

void RecoveryWriter::keep(RecoverySnapshot snapshot) {
    {
        const std::lock_guard lock(m_mutex);
        m_work.snapshot = std::move(snapshot);
    }
    m_wake.notify_all();
}

void RecoveryWriter::clear() {
    {
        const std::lock_guard lock(m_mutex);
        m_work.clear = true;
        m_work.snapshot.reset();
        m_work.picture = nullptr;
    }
    m_wake.notify_all();
}

void RecoveryWriter::setSavedFile(const fs::path& file) {
    {
        const std::lock_guard lock(m_mutex);
        m_work.savedFile = file;
    }
    m_wake.notify_all();
}

void RecoveryWriter::setPicture(MakePicture make) {
    {
        const std::lock_guard lock(m_mutex);
        m_work.picture = std::move(make);
    }
    m_wake.notify_all();
}

void RecoveryWriter::setSavedPicture(MakePicture make) {
    {
        const std::lock_guard lock(m_mutex);
        m_work.savedPicture = std::move(make);
    }
    m_wake.notify_all();
}

void RecoveryWriter::adopt(std::unique_ptr<RecoverySession> session) {
    {
        const std::lock_guard lock(m_mutex);
        m_work.session = std::move(session);
    }
    m_wake.notify_all();
}

bool RecoveryWriter::flush(std::chrono::milliseconds longest) {
    std::unique_lock lock(m_mutex);
    m_hurry = true;
    m_wake.notify_all();
    const bool done = m_idle.wait_for(lock, longest, [this] {
        return m_work.empty() && !m_rewrite && !m_working && !m_bakeWorking &&
               nextBake(Clock::now()) == nullptr;
    });
    m_hurry = false;
    return done;
}

// --- The thread that writes values ---------------------------------------------------------------

void RecoveryWriter::run() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_wake.wait(lock, [this] { return m_stop || m_rewrite || !m_work.empty(); });
        if (m_work.empty() && !m_rewrite)
            return; // m_stop, and all is written
        Work work = std::exchange(m_work, {});
        const bool rewrite = std::exchange(m_rewrite, false) && !work.snapshot && !work.clear;
        m_working = true;
        lock.unlock();
        try {
            handle(std::move(work));
            if (rewrite && m_last)
                write();
        } catch (const std::exception& exception) {
            fail(exception.what());
        }
        lock.lock();
        m_working = false;
        m_idle.notify_all();
        m_wake.notify_all(); // there may be bakes to store
        // A drag hands over a state with each frame: the disk need not have them all.
        m_wake.wait_for(lock, kPause, [this] { return m_stop || m_hurry; });
    }
}

void RecoveryWriter::handle(Work work) {
    if (work.clear) {
        m_last = nullptr;
        m_unsavedSince = 0;
        m_failed = false;
        {
            const std::lock_guard lock(m_mutex);
            m_bakesOf = nullptr;
            forgetBakes();
        }
        if (m_session)
            m_session->clear();
    }
    if (work.session) {
        const std::unique_ptr<RecoverySession> before =
            std::exchange(m_session, std::move(work.session));
        m_savedPicture = nullptr; // it brings its own
        {
            const std::lock_guard lock(m_mutex);
            forgetBakes();
            m_bakeFolder = m_session->bakeFolder();
        }
        if (m_last && !work.snapshot)
            write();
        if (before)
            before->clear();
    }
    if (work.savedFile) {
        m_savedFile = *work.savedFile;
        m_savedContent = m_savedFile.empty() ? Hash{} : hashFile(m_savedFile);
    }
    if (work.snapshot) {
        m_last = std::make_shared<const RecoverySnapshot>(*std::move(work.snapshot));
        if (m_unsavedSince == 0)
            m_unsavedSince = secondsNow();
        write();
    }
    if (work.savedPicture)
        m_savedPicture = std::move(work.savedPicture);
    if (!m_last || !m_session)
        return;
    if (m_savedPicture)
        writePicture(std::exchange(m_savedPicture, nullptr), m_session->savedPictureFile());
    if (work.picture)
        writePicture(work.picture, m_session->pictureFile());
}

// A picture that is missing is no reason to trouble anybody.
void RecoveryWriter::writePicture(const MakePicture& make, const fs::path& file) {
    if (const Bytes png = make(); !png.empty())
        static_cast<void>(writeFileAtomically(file, png));
}

void RecoveryWriter::write() {
    std::error_code error;
    if (m_session && !fs::exists(m_session->folder(), error)) // somebody tidied up
        m_session.reset();
    if (!m_session) {
        Result<std::unique_ptr<RecoverySession>> made = RecoverySession::create(m_root);
        if (!made) {
            fail(made.error().text());
            return;
        }
        m_session = std::move(made).value();
    }
    const RecoveryRecord record = recordOf(*m_last);
    if (const Result<void> written = writeRecoveryRecord(m_session->recordFile(), record);
        !written) {
        fail(written.error().text());
        return;
    }
    m_failed = false;

    // Bakes that no record names any more; those that the next one will name stay.
    std::vector<Hash> kept;
    for (const RecoveryBake& bake : record.bakes)
        kept.push_back(bake.content);
    const std::lock_guard lock(m_mutex);
    for (const auto& [address, stored] : m_stored)
        if (stored.leftOut.empty() && !stored.artifact.expired())
            kept.push_back(stored.content);
    if (m_storing)
        kept.push_back(*m_storing);
    removeBakesExcept(m_session->bakeFolder(), kept);
    m_bakeFolder = m_session->bakeFolder();
    m_bakesOf = m_last;
}

RecoveryRecord RecoveryWriter::recordOf(const RecoverySnapshot& snapshot) {
    const Document& document = snapshot.document;
    RecoveryRecord record;
    record.name = snapshot.name;
    record.file = snapshot.file;
    record.savedContent = snapshot.file == m_savedFile ? m_savedContent : Hash{};
    record.writtenAt = secondsNow();
    record.unsavedSince = m_unsavedSince;
    record.steps = snapshot.steps;
    record.lastStep = snapshot.lastStep;
    record.meshes = static_cast<int>(document.meshes.size());
    record.materials = static_cast<int>(document.materials.size());
    record.lights = static_cast<int>(document.lights.size());
    {
        const std::lock_guard lock(m_mutex);
        for (const BakeArtifactPtr& bake : document.bakes) {
            if (!bake)
                continue;
            RecoveryBake entry{bake->kind, {}, bake->inputs, bake->samplesDone};
            if (contains(snapshot.savedBakes, bake)) {
                record.bakes.push_back(entry);
                continue;
            }
            const auto stored = m_stored.find(bake.get());
            const bool known = stored != m_stored.end() && stored->second.artifact.lock() == bake;
            if (known && stored->second.leftOut.empty()) {
                entry.content = stored->second.content;
                record.bakes.push_back(entry);
            } else {
                record.leftOut.push_back(known ? stored->second.leftOut
                                               : titleOf(bake->kind) + ": it was not written yet");
            }
        }
    }
    record.outside = outsidePictures(document).ofProject;
    Document values = document;
    values.bakes.clear(); // named above
    record.project = documentToJson(values, record.projectFile());
    return record;
}

void RecoveryWriter::fail(const std::string& sentence) {
    if (!std::exchange(m_failed, true))
        m_tell("Unsaved work cannot be kept for recovery: " + sentence);
}

// --- The thread that writes bakes ----------------------------------------------------------------

// With the mutex held. One that the record waits for, and that may be written by now.
BakeArtifactPtr RecoveryWriter::nextBake(Clock::time_point now) const {
    if (!m_bakesOf)
        return nullptr;
    for (const BakeArtifactPtr& bake : m_bakesOf->document.bakes) {
        if (!bake || contains(m_bakesOf->savedBakes, bake))
            continue;
        const auto stored = m_stored.find(bake.get());
        if (stored != m_stored.end() && stored->second.artifact.lock() == bake)
            continue;
        const auto last = m_bakeTimes.find(bake->kind);
        if (m_hurry || last == m_bakeTimes.end() || now - last->second >= m_settings.bakePause)
            return bake;
    }
    return nullptr;
}

void RecoveryWriter::runBakes() {
    std::unique_lock lock(m_mutex);
    while (!m_stop) {
        const BakeArtifactPtr bake = nextBake(Clock::now());
        if (!bake) {
            constexpr std::chrono::seconds kPoll{1}; // for the pauses between bakes
            if (m_bakesOf && !m_bakesOf->document.bakes.empty())
                m_wake.wait_for(lock, kPoll);
            else
                m_wake.wait(lock);
            continue;
        }
        m_bakeWorking = true;
        storeBake(lock, bake);
        m_bakeWorking = false;
        m_idle.notify_all();
        m_wake.notify_all();
    }
}

void RecoveryWriter::storeBake(std::unique_lock<std::mutex>& lock, const BakeArtifactPtr& bake) {
    const std::shared_ptr<const RecoverySnapshot> snapshot = m_bakesOf;
    const fs::path folder = m_bakeFolder;
    const int generation = m_bakeGeneration;
    std::uint64_t others = 0;
    for (const BakeArtifactPtr& other : snapshot->document.bakes) {
        const auto stored = other ? m_stored.find(other.get()) : m_stored.end();
        if (stored != m_stored.end() && stored->second.leftOut.empty())
            others += artifactBytes(*other);
    }
    m_bakeTimes[bake->kind] = Clock::now();
    lock.unlock();

    StoredBake stored{bake, {}, {}};
    const std::uint64_t bytes = artifactBytes(*bake);
    std::error_code error;
    const fs::space_info space = fs::space(folder.parent_path(), error);
    if (others + bytes > m_settings.maxBakeBytes) {
        stored.leftOut =
            fmt::format("{}: with {} MiB it is larger than what is kept ({} MiB)",
                        titleOf(bake->kind), bytes >> 20, m_settings.maxBakeBytes >> 20);
    } else if (!error && space.available < bytes + m_settings.freeBytes) {
        stored.leftOut = fmt::format("{}: the disk has no room for its {} MiB", titleOf(bake->kind),
                                     bytes >> 20);
    } else {
        stored.content = hashBake(*bake);
        lock.lock();
        m_storing = stored.content;
        lock.unlock();
        try {
            if (const Result<void> kept =
                    keepBake(folder, stored.content, *bake, snapshot->document);
                !kept)
                stored.leftOut = titleOf(bake->kind) + ": " + kept.error().text();
        } catch (const std::bad_alloc&) {
            stored.leftOut = titleOf(bake->kind) + ": the memory did not suffice to write it";
        }
    }

    lock.lock();
    m_storing.reset();
    const bool isNews = !stored.leftOut.empty() && m_toldLeftOut != stored.leftOut;
    if (isNews)
        m_toldLeftOut = stored.leftOut;
    std::erase_if(m_stored, [](const auto& entry) { return entry.second.artifact.expired(); });
    if (m_bakeGeneration == generation)
        m_stored[bake.get()] = stored;
    m_rewrite = m_bakesOf != nullptr;
    if (!isNews)
        return;
    lock.unlock();
    m_tell("A crash would lose " + stored.leftOut + ". Save the project to keep it.");
    lock.lock();
}

// With the mutex held: their files are gone, or are another session's.
void RecoveryWriter::forgetBakes() {
    m_stored.clear();
    m_bakeTimes.clear();
    ++m_bakeGeneration;
}

} // namespace patina
