// What becomes of the client when its worker misbehaves, and of the worker when it tries to.
#include "core/worker/WorkerClient.h"
#include "core/base/FileDescriptor.h"
#include "tests/support/TemporaryFolder.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace patina {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr WorkerLimits kLimits{std::size_t{4} << 30, 20.0, 60.0};

class Worker : public testing::Test {
  protected:
    Worker() { client.setLimits(kLimits); }

    Result<WorkerClient::Reply> ask(json header) {
        header["op"] = "selfTest";
        return client.request(WorkerKind::Model, header.dump(), std::span<const std::byte>(),
                              "chair.obj");
    }
    // Waits for something that other processes do; the test's own time limit ends it.
    template <class Condition>
    static bool eventually(Condition condition) {
        while (!condition())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return true;
    }

    WorkerClient client;
};

bool alive(int pid) {
    // A zombie still answers kill(pid, 0); its state says Z.
    std::ifstream status("/proc/" + std::to_string(pid) + "/stat");
    std::string text((std::istreambuf_iterator<char>(status)), std::istreambuf_iterator<char>());
    const std::size_t end = text.rfind(')');
    return end != std::string::npos && end + 2 < text.size() && text[end + 2] != 'Z';
}

std::size_t openDescriptors() {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
        ++count;
    return count;
}

TEST_F(Worker, AnswersWithHeaderAndPayload) {
    const auto reply = ask({{"do", "echo"}, {"size", 1000003}});
    ASSERT_TRUE(reply.ok()) << reply.error().text();
    const std::span<const std::byte> payload = reply->payload.bytes();
    ASSERT_EQ(payload.size(), 1000003u);
    for (std::size_t i = 0; i < payload.size(); ++i)
        ASSERT_EQ(payload[i], static_cast<std::byte>(i % 251));
}

TEST_F(Worker, EachRequestHasAProcessOfItsOwn) {
    const auto a = ask({{"do", "echo"}});
    const auto b = ask({{"do", "echo"}});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_NE(json::parse(a->header)["pid"], json::parse(b->header)["pid"]);
    EXPECT_NE(json::parse(a->header)["pid"], ::getpid());
    EXPECT_TRUE(client.childProcesses().empty());
}

// A thread that runs while the worker forks may hold a lock that the child then waits for for ever.
TEST_F(Worker, ForksFromASingleThread) {
    ASSERT_TRUE(ask({{"do", "echo"}}).ok());
    const auto tasks =
        std::filesystem::path("/proc") / std::to_string(client.workerProcess(WorkerKind::Model));
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& task : std::filesystem::directory_iterator(tasks / "task"))
        ++count;
#if defined(__SANITIZE_THREAD__)
    EXPECT_LE(count, 2u); // one may be the sanitizer's own
#else
    EXPECT_EQ(count, 1u);
#endif
}

TEST_F(Worker, NothingStartsBeforeTheFirstRequest) {
    EXPECT_EQ(client.workerProcess(WorkerKind::Model), -1);
    client.warmUp(WorkerKind::Model);
    EXPECT_TRUE(alive(client.workerProcess(WorkerKind::Model)));
}

TEST_F(Worker, ACrashIsAMessage) {
    for (const char* how : {"crash", "abort"}) {
        const auto reply = ask({{"do", how}});
        ASSERT_FALSE(reply.ok());
        EXPECT_EQ(reply.error().kind, ErrorKind::InputBroken);
        EXPECT_EQ(reply.error().file, "chair.obj");
        EXPECT_THAT(reply.error().message, HasSubstr("made its decoder crash"));
        EXPECT_THAT(reply.error().detail,
                    HasSubstr(how == std::string("crash") ? "SIGSEGV" : "SIGABRT"));
    }
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, EndingWithoutAnAnswerIsAMessage) {
    const auto reply = ask({{"do", "exit"}});
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::InputBroken);
    EXPECT_THAT(reply.error().detail, HasSubstr("exit status 7"));
}

TEST_F(Worker, ARefusalCarriesMessageAndDetail) {
    const auto reply = ask({{"do", "throw"}});
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().message, "a message for the user");
    EXPECT_EQ(reply.error().detail, "a detail for the log");
}

TEST_F(Worker, AHangIsEndedByTheWallClock) {
    client.setLimits({kLimits.memoryBytes, 20.0, 1.0});
    client.warmUp(WorkerKind::Model);
    int child = -1;
    std::thread observer([&] {
        eventually([&] {
            const auto children = client.childProcesses();
            child = children.empty() ? -1 : children.front();
            return child > 0;
        });
    });
    const auto reply = ask({{"do", "hang"}});
    observer.join();
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::InputBroken);
    EXPECT_THAT(reply.error().message, HasSubstr("longer than 1 s "));
    ASSERT_GT(child, 0);
    EXPECT_TRUE(eventually([&] { return !alive(child); }));
    EXPECT_TRUE(client.childProcesses().empty());
    client.setLimits(kLimits);
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, ACancelEndsTheChild) {
    client.warmUp(WorkerKind::Model);
    const test::TemporaryFolder folder;
    const FileDescriptor file(
        ::open(folder.write("input", std::string_view("text")).c_str(), O_RDONLY | O_CLOEXEC));
    ASSERT_TRUE(file.valid());
    const auto hang = [&](const JobContext& job) {
        return client.request(WorkerKind::Model, json{{"op", "selfTest"}, {"do", "hang"}}.dump(),
                              file.get(), "chair.obj", job);
    };
    JobControl control;
    int child = -1;
    std::thread canceller([&] {
        eventually([&] {
            const auto children = client.childProcesses();
            child = children.empty() ? -1 : children.front();
            return child > 0;
        });
        control.cancel();
    });
    const auto reply = hang(control.context());
    canceller.join();
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::Cancelled);
    ASSERT_GT(child, 0);
    EXPECT_TRUE(eventually([&] { return !alive(child); }));
    // One that is cancelled before it begins does not begin.
    EXPECT_EQ(hang(control.context()).error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, EndlessWorkIsEndedByTheProcessorLimit) {
    client.setLimits({kLimits.memoryBytes, 1.0, 60.0});
    const auto reply = ask({{"do", "spin"}});
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::InputBroken);
    EXPECT_THAT(reply.error().message, HasSubstr("longer than 1 s "));
    EXPECT_EQ(reply.error().detail, "processor time limit");
}

TEST_F(Worker, TooMuchMemoryIsAMessage) {
    const auto reply = ask({{"do", "allocate"}});
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::InputBroken);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    // The sanitizers' operator new reports and ends the process where others throw.
    EXPECT_THAT(reply.error().detail, HasSubstr("SUMMARY: "));
    EXPECT_THAT(reply.error().detail, HasSubstr("out-of-memory"));
#else
    EXPECT_THAT(reply.error().message, HasSubstr("more than 4096 MiB of memory"));
#endif
}

TEST_F(Worker, PrintingWithoutEndFillsNothing) {
    const auto reply = ask({{"do", "print"}});
    ASSERT_FALSE(reply.ok());
    EXPECT_THAT(reply.error().detail, HasSubstr("SIGABRT"));
    EXPECT_THAT(reply.error().detail, HasSubstr("so many words"));
    EXPECT_LT(reply.error().detail.size(), 1000u);
}

TEST_F(Worker, AKilledChildIsAnErrorAndNoMore) {
    client.warmUp(WorkerKind::Model);
    std::thread killer([&] {
        eventually([&] { return !client.childProcesses().empty(); });
        ::kill(client.childProcesses().front(), SIGKILL);
    });
    const auto reply = ask({{"do", "hang"}});
    killer.join();
    ASSERT_FALSE(reply.ok());
    EXPECT_THAT(reply.error().detail, HasSubstr("SIGKILL"));
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, AKilledWorkerIsStartedAgain) {
    ASSERT_TRUE(ask({{"do", "echo"}}).ok());
    const int first = client.workerProcess(WorkerKind::Model);
    ::kill(first, SIGKILL);
    // Whether or not its death has been noticed, the next request succeeds.
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
    EXPECT_NE(client.workerProcess(WorkerKind::Model), first);
    EXPECT_FALSE(alive(first));
}

TEST_F(Worker, AWorkerKilledDuringARequestTakesItsChildAlong) {
    client.warmUp(WorkerKind::Model);
    int child = -1;
    std::thread killer([&] {
        eventually([&] { return !client.childProcesses().empty(); });
        child = client.childProcesses().front();
        ::kill(client.workerProcess(WorkerKind::Model), SIGKILL);
    });
    const auto reply = ask({{"do", "hang"}});
    killer.join();
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::Internal);
    EXPECT_THAT(reply.error().message, HasSubstr("try again"));
    EXPECT_TRUE(eventually([&] { return !alive(child); }));
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, AStoppedWorkerDoesNotHoldUpItsClient) {
    ASSERT_TRUE(ask({{"do", "echo"}}).ok());
    client.setLimits({kLimits.memoryBytes, 20.0, 0.5});
    ::kill(client.workerProcess(WorkerKind::Model), SIGSTOP);
    const auto reply = ask({{"do", "echo"}});
    ASSERT_FALSE(reply.ok());
    client.setLimits(kLimits);
    EXPECT_TRUE(ask({{"do", "echo"}}).ok());
}

TEST_F(Worker, TheEndOfTheClientEndsEverything) {
    auto other = std::make_unique<WorkerClient>();
    ASSERT_TRUE(other->request(WorkerKind::Model, R"({"op":"selfTest","do":"echo"})", {}, {}).ok());
    const int worker = other->workerProcess(WorkerKind::Model);
    ASSERT_TRUE(alive(worker));
    other.reset();
    EXPECT_FALSE(std::filesystem::exists("/proc/" + std::to_string(worker))); // reaped, too
}

TEST_F(Worker, AMissingProgramIsAMessage) {
    WorkerClient broken({"/nowhere/patina-model-worker", "/nowhere/patina-image-worker",
                         "/nowhere/patina-openimageio-worker"});
    const auto reply =
        broken.request(WorkerKind::Model, "{}", std::span<const std::byte>(), "a.png");
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::Internal);
    EXPECT_THAT(reply.error().text(), HasSubstr("/nowhere/patina-model-worker"));
}

TEST_F(Worker, AProgramThatIsNoWorkerIsAMessage) {
    WorkerClient broken({"/bin/true", "/bin/true", "/bin/true"});
    const auto reply =
        broken.request(WorkerKind::Model, "{}", std::span<const std::byte>(), "a.png");
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().kind, ErrorKind::Internal);
}

TEST_F(Worker, RequestsFromManyThreadsRunSideBySide) {
    constexpr int kThreads = 8;
    constexpr int kRequests = 12;
    std::atomic<int> good = 0;
    std::atomic<int> crashed = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < kRequests; ++i) {
                const bool crash = (t + i) % 4 == 0;
                const std::size_t size = static_cast<std::size_t>(t * 1000 + i);
                const auto reply = ask({{"do", crash ? "abort" : "echo"}, {"size", size}});
                if (crash && !reply.ok())
                    ++crashed;
                if (!crash && reply.ok() && reply->payload.bytes().size() == size)
                    ++good;
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(crashed, kThreads * kRequests / 4);
    EXPECT_EQ(good, kThreads * kRequests * 3 / 4);
    EXPECT_TRUE(client.childProcesses().empty());
}

TEST_F(Worker, LeavesNeitherDescriptorsNorZombies) {
    const auto openInChild = [this] {
        const auto reply = ask({{"do", "describe"}});
        return reply.ok() ? json::parse(reply->header)["descriptors"].size() : 0u;
    };
    const std::size_t inChild = openInChild();
    ASSERT_GT(inChild, 0u);
    const std::size_t before = openDescriptors();
    for (int i = 0; i < 30; ++i)
        (void)ask({{"do", i % 3 == 0 ? "abort" : "echo"}});
    EXPECT_EQ(openDescriptors(), before);

    // Nor does the worker keep any of either.
    const std::string worker = "/proc/" + std::to_string(client.workerProcess(WorkerKind::Model));
    EXPECT_TRUE(eventually([&] {
        std::string children;
        std::getline(std::ifstream(worker + "/task/" + worker.substr(6) + "/children"), children);
        return children.empty();
    }));
    // (A child sees those of its worker, whose own list is closed to others.)
    EXPECT_EQ(openInChild(), inChild);
}

} // namespace
} // namespace patina
