#include "core/io/VideoWriter.h"

#include "core/base/AtomicFile.h"
#include "core/base/Check.h"
#include "core/base/ChildAttributes.h"
#include "core/base/LowerCase.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <span>
#include <spawn.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace patina {
namespace {

constexpr int kVideoFd = 3;              // what ffmpeg writes to, in its own numbers
constexpr int kPollMs = 20;              // between looks whether it is cancelled
constexpr off_t kMostMessageBytes = 600; // the end of what ffmpeg says, where its reason is

std::string endingOf(const std::filesystem::path& file) {
    return lowerCase(file.extension().string());
}

std::vector<std::string> argumentsFor(const std::filesystem::path& program,
                                      const std::string& ending, int width, int height, int rate) {
    std::vector<std::string> arguments{
        program.string(), "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
        // What comes in: the bytes of pictures.
        "-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size", fmt::format("{}x{}", width, height),
        "-framerate", std::to_string(rate), "-i", "pipe:0",
        // sRGB pictures in the colours of ITU-R BT.709, whose primaries are the same; said, so that
        // players do not guess. 4:2:0 wants even sides.
        "-vf",
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=in_range=full:out_range=tv:out_color_matrix=bt709",
        "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc",
        "iec61966-2-1", "-color_range", "tv"};
    const std::vector<std::string> codec =
        ending == ".webm" ? std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf", "24",
                                                     "-b:v", "0",          "-f",   "webm"}
                          : std::vector<std::string>{"-c:v",      "libx264",    "-crf", "18",
                                                     "-movflags", "+faststart", "-f",   "mp4"};
    arguments.insert(arguments.end(), codec.begin(), codec.end());
    arguments.push_back(fmt::format("/dev/fd/{}", kVideoFd));
    return arguments;
}

FileDescriptor memoryFile(const char* name) {
    return FileDescriptor(::memfd_create(name, MFD_CLOEXEC));
}

Error cancelledVideo() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

} // namespace

bool isVideoFile(const std::filesystem::path& file) {
    const std::string ending = endingOf(file);
    return ending == ".mp4" || ending == ".webm";
}

Result<std::filesystem::path> videoProgram() {
    const char* search = std::getenv("PATH");
    std::string_view rest = search != nullptr ? search : "";
    while (!rest.empty()) {
        const std::string_view folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
        std::filesystem::path program = std::filesystem::path(folder) / "ffmpeg";
        if (!folder.empty() && ::access(program.c_str(), X_OK) == 0)
            return program;
    }
    return Error{ErrorKind::InputMissing,
                 "videos are encoded by ffmpeg, which is not installed; install it, or choose "
                 "numbered pictures",
                 {},
                 {}};
}

Result<std::unique_ptr<VideoWriter>>
VideoWriter::create(const std::filesystem::path& file, int width, int height, int framesPerSecond) {
    if (!isVideoFile(file))
        return Error{ErrorKind::Usage, "a video's name ends in .mp4 or .webm", file, {}};
    if (framesPerSecond < 1 || framesPerSecond > kMostVideoRate)
        return Error{ErrorKind::Usage,
                     fmt::format("a video has 1 to {} frames per second", kMostVideoRate),
                     {},
                     {}};
    CHECK(width > 0 && height > 0);
    const Result<std::filesystem::path> program = videoProgram();
    if (!program)
        return program.error();
    std::unique_ptr<VideoWriter> writer(new VideoWriter);
    writer->m_file = file;
    writer->m_width = width;
    writer->m_height = height;
    writer->m_video = memoryFile("patina-video");
    writer->m_messages = memoryFile("patina-video-messages");
    std::array<int, 2> pair{};
    if (!writer->m_video.valid() || !writer->m_messages.valid() ||
        ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0)
        return Error{ErrorKind::Internal, "ffmpeg cannot be started", *program,
                     std::strerror(errno)};
    writer->m_pictures = FileDescriptor(pair[0]);
    const FileDescriptor theirs(pair[1]);

    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, theirs.get(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, writer->m_messages.get(), STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&files, writer->m_video.get(), kVideoFd);
    posix_spawn_file_actions_addclosefrom_np(&files, kVideoFd + 1);
    const ChildAttributes attributes;
    std::vector<std::string> arguments =
        argumentsFor(*program, endingOf(file), width, height, framesPerSecond);
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int failure = ::posix_spawn(&writer->m_pid, program->c_str(), &files, attributes.get(),
                                      pointers.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) {
        writer->m_pid = -1;
        return Error{ErrorKind::Internal, "ffmpeg cannot be started", *program,
                     std::strerror(failure)};
    }
    return writer;
}

VideoWriter::~VideoWriter() {
    end();
}

void VideoWriter::end() {
    m_pictures.reset();
    if (m_pid <= 0)
        return;
    ::kill(m_pid, SIGKILL); // not reaped yet, so the id is still its
    while (::waitpid(m_pid, &m_status, 0) < 0 && errno == EINTR) {
    }
    m_pid = -1;
}

Error VideoWriter::failure() {
    const off_t size = std::max<off_t>(::lseek(m_messages.get(), 0, SEEK_END), 0);
    std::string said(static_cast<std::size_t>(std::min(size, kMostMessageBytes)), '\0');
    const ssize_t got =
        ::pread(m_messages.get(), said.data(), said.size(), size - static_cast<off_t>(said.size()));
    said.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return {ErrorKind::Internal,
            "ffmpeg could not encode the video; choose numbered pictures, or another format",
            m_file, said.empty() ? "it said nothing" : said};
}

Result<void> VideoWriter::add(const Image& picture, const JobContext& job) {
    CHECK(picture.width() == m_width && picture.height() == m_height);
    CHECK(picture.channels() == 3 && picture.type() == PixelType::U8);
    std::span<const std::byte> rest = picture.bytes();
    while (!rest.empty()) {
        if (job.cancelled()) {
            end();
            return cancelledVideo();
        }
        const ssize_t sent =
            ::send(m_pictures.get(), rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) { // it encodes what it has
            pollfd room{m_pictures.get(), POLLOUT, 0};
            ::poll(&room, 1, kPollMs);
            continue;
        }
        if (sent < 0) { // it has ended
            end();
            return failure();
        }
        rest = rest.subspan(static_cast<std::size_t>(sent));
    }
    return {};
}

Result<void> VideoWriter::finish(const JobContext& job) {
    m_pictures.reset();
    while (m_pid > 0) {
        const pid_t ended = ::waitpid(m_pid, &m_status, WNOHANG);
        if (ended == m_pid || (ended < 0 && errno != EINTR)) {
            m_pid = -1;
        } else if (job.cancelled()) {
            end();
            return cancelledVideo();
        } else {
            ::poll(nullptr, 0, kPollMs);
        }
    }
    struct stat info {};
    if (!WIFEXITED(m_status) || WEXITSTATUS(m_status) != 0 || ::fstat(m_video.get(), &info) != 0 ||
        info.st_size == 0)
        return failure();
    const auto size = static_cast<std::size_t>(info.st_size);
    void* data = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, m_video.get(), 0);
    if (data == MAP_FAILED)
        return Error{ErrorKind::Internal, "the video cannot be read", m_file, std::strerror(errno)};
    Result<void> written =
        writeFileAtomically(m_file, std::span(static_cast<const std::byte*>(data), size));
    ::munmap(data, size);
    return written;
}

} // namespace patina
