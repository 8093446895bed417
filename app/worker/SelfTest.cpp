#include "app/worker/SelfTest.h"

#include "core/base/FileDescriptor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
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

// Any system call at all: what a decoder would make that was taken over.
json callSystem(const json& request) {
    std::array<std::string, 6> blocks;
    std::array<long, 6> values{};
    const json& arguments = request.at("arguments");
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const json& argument = arguments.at(i);
        if (argument.is_number()) {
            values.at(i) = argument.get<long>();
            continue;
        }
        blocks.at(i) = argument.is_string()
                           ? argument.get<std::string>()
                           : std::string(argument.at("bytes").get<std::size_t>(), '\0');
        values.at(i) = reinterpret_cast<long>(blocks.at(i).data());
    }
    const long result = ::syscall(request.at("number").get<long>(), values[0], values[1], values[2],
                                  values[3], values[4], values[5]);
    const int code = resultOf(result);
    return {{"errno", code}, {"result", result}};
}

json openManyFiles() {
    std::vector<FileDescriptor> files; // closed again: the answer needs some
    constexpr std::size_t kMany = 20000;
    while (files.size() < kMany) {
        files.emplace_back(::open("/dev/null", O_RDONLY | O_CLOEXEC));
        if (!files.back().valid())
            return {{"errno", errno}};
    }
    return {{"errno", 0}};
}

json describe() {
    json answer = {{"pid", ::getpid()},
                   {"parent", ::getppid()},
                   {"session", ::getsid(0)},
                   {"dumpable", ::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0)}};
    json& environment = answer["environment"] = json::array();
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry)
        environment.push_back(*entry);
    // What the kernel keeps of the start, where that may be read.
    std::ifstream start("/proc/self/environ");
    answer["startedWith"] = std::string(std::istreambuf_iterator<char>(start), {});
    std::ifstream limits("/proc/self/limits"); // (the filter forbids asking by getrlimit)
    answer["limits"] = std::string(std::istreambuf_iterator<char>(limits), {});
    std::size_t open = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
        ++open;
    answer["open"] = open;
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
        ::pause();
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

json answerTo(const std::string& what, const json& request) {
    if (what == "try")
        return {{"errno", attempt(request.at("call"))}};
    if (what == "call")
        return callSystem(request);
    if (what == "files")
        return openManyFiles();
    if (what == "describe")
        return describe();
    act(what, request);
    return {{"pid", ::getpid()}};
}

} // namespace

codec::Reply selfTest(const json& request) {
    codec::Reply reply;
    reply.payload = codec::allocate(request.value("size", std::size_t{0}));
    reply.header = answerTo(request.at("do"), request).dump();
    reply.header.resize(std::max(reply.header.size(), request.value("words", std::size_t{0})), ' ');
    if (request.value("hollow", false))
        return reply;
    auto bytes = reply.payload.writable();
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i % 251);
    return reply;
}

} // namespace patina::worker
