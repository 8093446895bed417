#include "app/worker/SelfTest.h"

#include "core/base/FileDescriptor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace patina::worker {

namespace {

using nlohmann::json;

int resultOf(long value) {
    return value < 0 ? errno : 0;
}

int attempt(const std::string& call) {
    if (call == "exec") {
        std::string program = "/bin/true";
        char* const arguments[] = {program.data(), nullptr};
        return resultOf(::execv(program.c_str(), arguments));
    }
    if (call == "fork") {
        const pid_t pid = ::fork();
        if (pid == 0)
            ::_exit(0);
        return resultOf(pid);
    }
    if (call == "thread") {
        try {
            std::thread([] {}).join();
            return 0;
        } catch (const std::system_error& error) {
            return error.code().value();
        }
    }
    throw codec::Refusal("unknown call", call);
}

// Any system calls at all: what a decoder would make that was taken over.
json callSystem(const json& calls) {
    json answers = json::array();
    for (const json& call : calls) {
        std::array<std::string, 6> blocks;
        std::array<long, 6> values{};
        const json& arguments = call.at("arguments");
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const json& argument = arguments.at(i);
            if (argument.is_number()) {
                values.at(i) = argument.get<long>();
                continue;
            }
            if (argument.is_object() && argument.contains("result")) {
                values.at(i) = answers.at(argument["result"].get<std::size_t>()).at("result");
                continue;
            }
            blocks.at(i) = argument.is_string()
                               ? argument.get<std::string>()
                               : std::string(argument.at("bytes").get<std::size_t>(), '\0');
            values.at(i) = reinterpret_cast<long>(blocks.at(i).data());
        }
        const long result = ::syscall(call.at("number").get<long>(), values[0], values[1],
                                      values[2], values[3], values[4], values[5]);
        const int code = resultOf(result);
        answers.push_back({{"errno", code}, {"result", result}});
    }
    return answers;
}

json openManyFiles() {
    std::vector<FileDescriptor> files; // closed again: the answer needs some
    constexpr std::size_t kMany = 20000;
    while (files.size() < kMany) {
        files.emplace_back(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0));
        if (!files.back().valid())
            return {{"errno", errno}};
    }
    return {{"errno", 0}};
}

// Memory files of `each` bytes, all kept, as many as there are to be had.
json takeMemory(std::size_t each) {
    std::vector<MemoryFile> files;
    constexpr std::size_t kMany = 500;
    while (files.size() < kMany) {
        auto file = MemoryFile::create(each);
        if (!file)
            return {{"errno", errno}, {"files", files.size()}};
        files.push_back(std::move(*file));
    }
    return {{"errno", 0}, {"files", files.size()}};
}

std::uint64_t softLimit(__rlimit_resource resource) {
    rlimit limit{};
    return ::getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

json describe(int landlock) {
    json answer = {{"pid", ::getpid()},
                   {"dumpable", ::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0)},
                   {"landlock", landlock},
                   {"openFiles", softLimit(RLIMIT_NOFILE)},
                   {"tasks", softLimit(RLIMIT_NPROC)},
                   {"fileBytes", softLimit(RLIMIT_FSIZE)}};
    json& environment = answer["environment"] = json::array();
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry)
        environment.push_back(*entry);
    json& open = answer["descriptors"] = json::array();
    constexpr int kMany = 1024;
    for (int fd = 0; fd < kMany; ++fd)
        if (::fcntl(fd, F_GETFD) >= 0)
            open.push_back(fd);
    return answer;
}

void act(const std::string& what, const json& request) {
    if (what == "crash") {
        ::signal(SIGSEGV, SIG_DFL); // AddressSanitizer would turn it into an exit
        ::raise(SIGSEGV);
    }
    if (what == "abort")
        ::abort();
    while (what == "hang")
        std::this_thread::sleep_for(std::chrono::hours(1));
    for (volatile unsigned counter = 0; what == "spin";)
        counter = counter + 1;
    if (what == "allocate") {
        std::vector<std::vector<char>> blocks;
        constexpr std::size_t kBlock = std::size_t{256} << 20;
        for (int i = 0; i < 1024; ++i)
            blocks.emplace_back().reserve(kBlock);
    }
    if (what == "exit")
        ::syscall(SYS_exit_group, 7);
    if (what == "throw")
        throw codec::Refusal("a message for the user" +
                                 std::string(request.value("words", std::size_t{0}), '!'),
                             "a detail for the log");
    while (what == "print")
        if (::write(STDERR_FILENO, "so many words ", 14) < 0)
            ::abort();
}

json answerTo(const std::string& what, const json& request, int landlock) {
    if (what == "try")
        return {{"errno", attempt(request.at("call"))}};
    if (what == "call")
        return callSystem(request.at("calls"));
    if (what == "files")
        return openManyFiles();
    if (what == "memory")
        return takeMemory(request.at("each"));
    if (what == "describe")
        return describe(landlock);
    act(what, request);
    return {{"pid", ::getpid()}};
}

} // namespace

codec::Reply selfTest(const json& request, int landlock) {
    codec::Reply reply;
    reply.payload = codec::allocate(request.value("size", std::size_t{0}));
    reply.header = answerTo(request.at("do"), request, landlock).dump();
    reply.header.resize(std::max(reply.header.size(), request.value("words", std::size_t{0})), ' ');
    if (request.value("hollow", false))
        return reply;
    auto bytes = reply.payload.writable();
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i % 251);
    return reply;
}

} // namespace patina::worker
