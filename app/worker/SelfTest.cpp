#include "app/worker/SelfTest.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
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

int attempt(const std::string& call, const json& request) {
    if (call == "socket")
        return resultOf(::socket(AF_INET, SOCK_STREAM, 0));
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
    if (call == "kill")
        return resultOf(::kill(::getppid(), 0));
    if (call == "create")
        return resultOf(::open(request.at("file").get<std::string>().c_str(),
                               O_RDONLY | O_CREAT | O_CLOEXEC, 0600));
    if (call == "write")
        return resultOf(
            ::open(request.at("file").get<std::string>().c_str(), O_WRONLY | O_CLOEXEC));
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

void act(const std::string& what) {
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
        throw codec::Refusal("a message for the user", "a detail for the log");
    while (what == "print")
        if (::write(STDERR_FILENO, "so many words ", 14) < 0)
            ::abort();
}

} // namespace

codec::Reply selfTest(const json& request) {
    codec::Reply reply;
    reply.payload = codec::allocate(request.value("size", std::size_t{0}));
    json answer = {{"pid", ::getpid()}};
    const auto what = request.at("do").get<std::string>();
    if (what == "try")
        answer["errno"] = attempt(request.at("call"), request);
    else
        act(what);
    auto bytes = reply.payload.writable();
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i % 251);
    reply.header = answer.dump();
    return reply;
}

} // namespace patina::worker
