#include "core/worker/WorkerClient.h"

#include "core/base/Limits.h"
#include "core/base/Log.h"
#include "core/worker/GuestRequests.h"
#include "core/worker/MemoryFile.h"
#include "core/worker/WorkerProcess.h"
#include "core/worker/WorkerProtocol.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <set>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

namespace patina {

namespace {

using Clock = std::chrono::steady_clock;

Error died(const std::filesystem::path& file, std::string cause, std::string detail) {
    return {ErrorKind::InputBroken, std::move(cause), file, std::move(detail)};
}

Error timedOut(const std::filesystem::path& file, double seconds, std::string detail) {
    return died(file,
                fmt::format("reading the file took longer than {:g} s and was given up; it "
                            "is damaged or too large",
                            seconds),
                std::move(detail));
}

// How a child that gave no answer ended, in the user's words.
Error endedWithoutAnswer(int status, const WorkerLimits& limits, const std::filesystem::path& file,
                         const std::string& log) {
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        if (signal == SIGXCPU)
            return timedOut(file, limits.cpuSeconds, "processor time limit");
        const char* name = ::sigabbrev_np(signal);
        std::string detail = fmt::format("decoder killed by SIG{}", name != nullptr ? name : "?");
        if (!log.empty())
            detail += ": " + log;
        return died(file,
                    "the file made its decoder crash; it is damaged or uses a feature that is not "
                    "supported",
                    std::move(detail));
    }
    return died(
        file,
        "the decoder ended without an answer; the file is damaged or uses a feature that "
        "is not supported",
        fmt::format("exit status {}{}{}", WEXITSTATUS(status), log.empty() ? "" : ": ", log));
}

// The child's standard output and error: a memory file that cannot grow, so that a decoder that
// prints without end only loses its words.
FileDescriptor createLog() {
    FileDescriptor log(::memfd_create("patina-log", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (log.valid() && (::ftruncate(log.get(), static_cast<off_t>(protocol::kLogBytes)) != 0 ||
                        ::fcntl(log.get(), F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK) != 0))
        log.reset();
    return log;
}

// What a sanitizer found in the decoder must not pass for a damaged file: it is shown in full, and
// ctest fails on reports about our own code (cmake/PatinaTesting.cmake).
void showSanitizerReport([[maybe_unused]] int log) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    std::string text(protocol::kLogBytes, '\0');
    const ssize_t size = ::pread(log, text.data(), text.size(), 0);
    text.resize(std::min(text.size(), text.find('\0')));
    if (size > 0)
        std::fputs(text.c_str(), stderr);
#endif
}

// The last line or so of the log, printable.
std::string readLog(int log) {
    constexpr off_t kTail = 400;
    const off_t end = ::lseek(log, 0, SEEK_CUR); // the offset is shared with the child
    if (end <= 0)
        return {};
    const off_t begin = std::max<off_t>(0, end - kTail);
    std::string text(static_cast<std::size_t>(std::min(end, kTail)), '\0');
    const ssize_t size = ::pread(log, text.data(), text.size(), begin);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, size)));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) == 127)
            c = ' ';
    const std::size_t last = text.find_last_not_of(' ');
    text.resize(last == std::string::npos ? 0 : last + 1);
    return text;
}

Error refusedByDecoder(std::string_view header, const std::filesystem::path& file) {
    Error error{ErrorKind::InputBroken, "the file could not be decoded", file, {}};
    const auto json = nlohmann::json::parse(header, nullptr, false);
    if (json.is_object()) {
        if (const auto it = json.find("message"); it != json.end() && it->is_string())
            error.message = it->get<std::string>();
        if (const auto it = json.find("detail"); it != json.end() && it->is_string())
            error.detail = it->get<std::string>();
        if (const auto it = json.find("kind"); it != json.end() && *it == "internal")
            error.kind = ErrorKind::Internal;
        if (const auto it = json.find("kind"); it != json.end() && *it == "usage")
            error.kind = ErrorKind::Usage;
    }
    return error;
}

// One name for a file, however it is spelled.
std::filesystem::path sameFileName(const std::filesystem::path& file) {
    std::error_code failed;
    std::filesystem::path name = std::filesystem::weakly_canonical(file, failed);
    return failed ? file : name;
}

// An encoder's pixels are ours, and nobody knows the size of its file before it is written.
bool isEncoding(const std::string& header) {
    const auto json = nlohmann::json::parse(header, nullptr, false);
    return json.is_object() && json.value("op", std::string()) == "encodeImage";
}

Error noMemory(const std::filesystem::path& file) {
    return {ErrorKind::Internal, "there is not enough memory to read the file", file,
            std::strerror(errno)};
}

} // namespace

std::filesystem::path insideCanonicalFolder(const std::filesystem::path& file) {
    std::error_code ignored;
    const std::filesystem::path absolute = std::filesystem::absolute(file, ignored);
    return std::filesystem::weakly_canonical(absolute.parent_path(), ignored) / absolute.filename();
}

struct WorkerClient::Impl {
    explicit Impl(WorkerPrograms found)
        : programs(std::move(found)) {}

    [[nodiscard]] const std::filesystem::path& program(WorkerKind kind) const {
        return kind == WorkerKind::Model   ? programs.model
               : kind == WorkerKind::Image ? programs.image
                                           : programs.openImageIo;
    }
    [[nodiscard]] WorkerProcess& process(WorkerKind kind) {
        return kind == WorkerKind::Model   ? modelProcess
               : kind == WorkerKind::Image ? imageProcess
                                           : openImageIoProcess;
    }

    // One attempt; nothing when the worker died before it took the request, so that trying again is
    // safe.
    std::optional<Result<Reply>> attempt(WorkerKind kind, const protocol::Request& request,
                                         const WorkerLimits& used, Clock::time_point deadline,
                                         int headerFd, const GuestRights& rights,
                                         const std::filesystem::path& file, const JobContext& job);
    Result<Reply> run(WorkerKind kind, const std::string& header, int payloadFd,
                      std::size_t payloadSize, bool payloadIsFile,
                      const std::filesystem::path& file, const JobContext& job,
                      const std::filesystem::path& readable);

    WorkerPrograms programs;
    mutable std::mutex mutex; // guards everything below
    WorkerLimits limits{limits::kWorkerMemoryBytes, limits::kWorkerCpuSeconds,
                        limits::kWorkerWallSeconds, limits::kWorkerReplyBytes};
    WorkerProcess modelProcess, imageProcess, openImageIoProcess;
    std::vector<int> children;
    std::set<std::filesystem::path> outsideModels; // that may name pictures anywhere
    bool outsideOfAll = false;
};

WorkerClient::WorkerClient(WorkerPrograms programs)
    : m_impl(std::make_unique<Impl>(std::move(programs))) {}

WorkerClient::~WorkerClient() = default;

WorkerPrograms WorkerClient::defaultPrograms() {
    std::error_code ignored;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const std::filesystem::path folder = self.parent_path();
    const auto find = [&](const char* name) {
        for (const auto& candidate : {folder / name, folder.parent_path() / "bin" / name,
                                      folder.parent_path() / PATINA_LIBEXEC / "patina" / name})
            if (std::filesystem::exists(candidate, ignored))
                return candidate;
        if (const char* programs = std::getenv("PATINA_BIN_DIR"))
            return std::filesystem::path(programs) / name;
        return folder / name; // named in the message when it is missing
    };
    return {find("patina-model-worker"), find("patina-image-worker"),
            find("patina-openimageio-worker")};
}

void WorkerClient::warmUp(WorkerKind kind) {
    const std::lock_guard lock(m_impl->mutex);
    if (const auto started = m_impl->process(kind).ensureRunning(m_impl->program(kind)); !started)
        logWarning("{}", started.error().text());
}

void WorkerClient::setLimits(const WorkerLimits& limits) {
    const std::lock_guard lock(m_impl->mutex);
    m_impl->limits = limits;
}

void WorkerClient::allowOutside(const std::filesystem::path& model) {
    const std::lock_guard lock(m_impl->mutex);
    m_impl->outsideModels.insert(sameFileName(model));
}

void WorkerClient::allowOutsideOfAll() {
    const std::lock_guard lock(m_impl->mutex);
    m_impl->outsideOfAll = true;
}

bool WorkerClient::outsideAllowed(const std::filesystem::path& model) const {
    const std::lock_guard lock(m_impl->mutex);
    return m_impl->outsideOfAll || m_impl->outsideModels.contains(sameFileName(model));
}

int WorkerClient::workerProcess(WorkerKind kind) const {
    const std::lock_guard lock(m_impl->mutex);
    return m_impl->process(kind).pid();
}

std::vector<int> WorkerClient::childProcesses() const {
    const std::lock_guard lock(m_impl->mutex);
    return m_impl->children;
}

Result<WorkerClient::Reply> WorkerClient::request(WorkerKind kind, const std::string& header,
                                                  std::span<const std::byte> payload,
                                                  const std::filesystem::path& fileForMessages) {
    auto copy = MemoryFile::copyOf(payload);
    if (!copy)
        return noMemory(fileForMessages);
    return request(kind, header, *std::move(copy), fileForMessages);
}

Result<WorkerClient::Reply> WorkerClient::request(WorkerKind kind, const std::string& header,
                                                  MemoryFile payload,
                                                  const std::filesystem::path& fileForMessages) {
    const std::size_t size = payload.bytes().size();
    if (!payload.seal())
        return noMemory(fileForMessages);
    return m_impl->run(kind, header, payload.fd(), size, false, fileForMessages, {}, {});
}

Result<WorkerClient::Reply> WorkerClient::request(WorkerKind kind, const std::string& header,
                                                  int payloadFd,
                                                  const std::filesystem::path& fileForMessages,
                                                  const JobContext& job,
                                                  const std::filesystem::path& readable) {
    struct stat status {};
    if (::fstat(payloadFd, &status) != 0)
        return Error{ErrorKind::InputMissing, "the file cannot be read", fileForMessages,
                     std::strerror(errno)};
    return m_impl->run(kind, header, payloadFd, static_cast<std::size_t>(status.st_size), true,
                       fileForMessages, job, readable);
}

Result<WorkerClient::Reply> WorkerClient::Impl::run(WorkerKind kind, const std::string& header,
                                                    int payloadFd, std::size_t payloadSize,
                                                    bool payloadIsFile,
                                                    const std::filesystem::path& file,
                                                    const JobContext& job,
                                                    const std::filesystem::path& readable) {
    auto headerCopy = MemoryFile::copyOf(std::as_bytes(std::span(header)));
    if (!headerCopy || !headerCopy->seal())
        return noMemory(file);

    const WorkerLimits used = [this] {
        const std::lock_guard lock(mutex);
        return limits;
    }();
    protocol::Request request;
    request.payloadIsFile = payloadIsFile ? 1 : 0;
    request.headerSize = header.size();
    request.payloadSize = payloadSize;
    request.memoryBytes = used.memoryBytes;
    request.cpuSeconds = used.cpuSeconds;
    request.landlock = used.landlock ? 1 : 0;
    GuestRights rights;
    rights.file = readable;
    rights.folder = readable.parent_path();
    rights.payloadFd = payloadFd;
    rights.memoryBytes = used.memoryBytes;
    rights.encodes = isEncoding(header);

    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double>(used.wallSeconds));
    constexpr int kAttempts = 3;
    for (int i = 0; i < kAttempts; ++i)
        if (auto result =
                attempt(kind, request, used, deadline, headerCopy->fd(), rights, file, job))
            return std::move(*result);
    return Error{ErrorKind::Internal,
                 "the program that reads files does not start; reinstall Patina", program(kind),
                 "it ended before it took a request"};
}

std::optional<Result<WorkerClient::Reply>>
WorkerClient::Impl::attempt(WorkerKind kind, const protocol::Request& request,
                            const WorkerLimits& used, Clock::time_point deadline, int headerFd,
                            const GuestRights& rights, const std::filesystem::path& file,
                            const JobContext& job) {
    std::array<int, 2> pair{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0)
        return noMemory(file);
    const FileDescriptor mine(pair[0]);
    FileDescriptor theirs(pair[1]);
    const FileDescriptor log = createLog();
    if (!log.valid())
        return noMemory(file);

    // Hand the request over.
    int worker = -1;
    {
        const std::lock_guard lock(mutex);
        if (const auto started = process(kind).ensureRunning(program(kind)); !started)
            return started.error();
        worker = process(kind).pid();
        const std::array<int, 4> descriptors{theirs.get(), headerFd, log.get(), rights.payloadFd};
        if (!protocol::send(process(kind).control(), request, descriptors)) {
            process(kind).kill();
            return std::nullopt;
        }
    }
    theirs.reset(); // so that the death of all others reads as the end of the stream

    // The child is forgotten, and killed by the closing of `mine`, whichever way this ends.
    struct Guard {
        Impl& impl;
        int child = -1;
        ~Guard() {
            const std::lock_guard lock(impl.mutex);
            std::erase(impl.children, child);
        }
    } guard{*this};

    GuestRequests requests(rights);
    std::array<std::byte, sizeof(protocol::Report) + protocol::kMaxPathBytes> message{};
    while (true) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "reading the file was cancelled", file, {}};
        pollfd waiting{mine.get(), POLLIN, 0};
        constexpr int kCancelPoll = 50; // milliseconds
        const int ready =
            left <= 0
                ? 0
                : ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left, kCancelPoll)));
        if (ready == 0 && left > kCancelPoll)
            continue;
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0) {
            // A worker that has not even forked by now hangs itself: the next request gets a new
            // one.
            if (guard.child < 0) {
                const std::lock_guard lock(mutex);
                if (process(kind).pid() == worker)
                    process(kind).kill();
            }
            return timedOut(file, used.wallSeconds, "wall clock limit");
        }

        auto received = protocol::receive(mine.get(), message);
        if (!received && errno == EAGAIN)
            continue;
        if (!received || received->size == 0) {
            {
                const std::lock_guard lock(mutex);
                if (process(kind).pid() == worker)
                    process(kind).reapIfEnded();
            }
            if (guard.child < 0)
                return std::nullopt;
            return Error{ErrorKind::Internal,
                         "the program that reads files was ended from outside; try again", file,
                         readLog(log.get())};
        }
        protocol::Report report;
        std::memcpy(&report, message.data(), std::min(received->size, sizeof report));
        const bool goesOn = report.event == protocol::Event::OpenFile; // with a path
        if (received->size < sizeof report || (received->size > sizeof report && !goesOn) ||
            report.magic != protocol::kMagic)
            return died(file, "the decoder gave an answer that makes no sense; the file is damaged",
                        "malformed message");

        switch (report.event) {
        case protocol::Event::Started: {
            if (guard.child >= 0)
                return died(file, "the decoder gave an answer that makes no sense",
                            "started twice");
            const std::lock_guard lock(mutex);
            guard.child = static_cast<int>(report.value);
            children.push_back(guard.child);
            break;
        }
        case protocol::Event::CannotFork:
            return Error{ErrorKind::Internal,
                         "the system refuses to start another process; close some programs", file,
                         std::strerror(static_cast<int>(report.value))};
        case protocol::Event::OpenFile:
        case protocol::Event::OpenPayload:
        case protocol::Event::CreateMemory: {
            const auto* path = reinterpret_cast<const char*>(message.data()) + sizeof report;
            if (!requests.answer(mine.get(), report, {path, received->size - sizeof report}))
                return died(file, "the decoder gave an answer that makes no sense",
                            "more requests than answers were fetched");
            break;
        }
        case protocol::Event::Ended:
            showSanitizerReport(log.get());
            return endedWithoutAnswer(static_cast<int>(report.value), used, file,
                                      readLog(log.get()));
        case protocol::Event::Answered:
        case protocol::Event::Failed: {
            // Believed only when sealed, as large as announced, and no larger than an answer may
            // be: a memory file of gigabytes costs a decoder nothing until we copy it.
            const bool failed = report.event == protocol::Event::Failed;
            if (received->descriptors.size() != 2 ||
                report.headerSize > (failed ? protocol::kMaxErrorBytes : protocol::kMaxHeaderBytes))
                return died(file, "the decoder gave an answer that makes no sense", "malformed");
            if (report.payloadSize > (failed ? 0 : used.replyBytes))
                return died(file,
                            fmt::format("what the file holds takes more than the supported {} MiB",
                                        used.replyBytes >> 20),
                            fmt::format("an answer of {} bytes", report.payloadSize));
            const auto header =
                MemoryFile::open(std::move(received->descriptors[0]), report.headerSize);
            auto payload =
                MemoryFile::open(std::move(received->descriptors[1]), report.payloadSize);
            if (!header || !payload)
                return died(file, "the decoder gave an answer that makes no sense", "not sealed");
            if (failed)
                return refusedByDecoder(header->text(), file);
            try {
                return Reply{std::string(header->text()), *std::move(payload)};
            } catch (const std::bad_alloc&) {
                return noMemory(file);
            }
        }
        default:
            return died(file, "the decoder gave an answer that makes no sense", "unknown event");
        }
    }
}

} // namespace patina
