// `patina`: what the editor can do to files, without a window. Without a command it starts the
// editor that lies beside it.
#include "app/cli/Allocator.h"
#include "app/cli/CommandLine.h"
#include "app/cli/Commands.h"
#include "app/cli/EarlySignals.h"
#include "app/cli/Report.h"
#include "app/cli/Session.h"

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <type_traits>
#include <unistd.h>
#include <vector>

namespace patina::cli {
namespace {

constexpr int kKilled = 128; // plus the signal's number, as shells say it

// Becomes the editor; returns only when that fails.
int startEditor(int argc, char** argv) {
    std::error_code ignored;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const std::string program = (self.parent_path() / "patina-editor").string();
    std::string name = program;
    std::vector<char*> arguments = {name.data()};
    const int first = argc > 1 && std::string_view(argv[1]) == "edit" ? 2 : 1;
    arguments.insert(arguments.end(), argv + std::min(first, argc), argv + argc);
    arguments.push_back(nullptr);
    if (const int signal = EarlySignals::take(); signal != 0)
        return kKilled + signal; // the editor would not hear of it
    ::execv(program.c_str(), arguments.data());
    return Report({}, false, false)
        .fail({ErrorKind::InputMissing,
               "the editor cannot be started; it belongs beside this program",
               program,
               {}},
              exitStatus(ErrorKind::InputMissing));
}

int runCommand(const Invocation& invocation) {
    Session session(invocation.common);
    Result<void> result;
    try {
        result = std::visit(
            [&](const auto& options) {
                constexpr bool kDraws =
                    std::is_base_of_v<PictureOptions, std::decay_t<decltype(options)>>;
                if (!kDraws)
                    useSmallPages();
                return run(session, options);
            },
            invocation.options);
    } catch (const std::bad_alloc&) {
        result = Error{
            ErrorKind::Internal, "there is not enough memory; use smaller inputs or sizes", {}, {}};
    } catch (const std::exception& exception) {
        result = Error{ErrorKind::Internal, "this is a fault of Patina", {}, exception.what()};
    }
    return session.finish(result);
}

int runMain(int argc, char** argv) {
    if (isForEditor(argc, argv))
        return startEditor(argc, argv);
    const Result<std::variant<Invocation, HelpText>> parsed = parseCommandLine(argc, argv);
    if (!parsed) {
        const bool json = std::any_of(argv + 1, argv + argc, [](const char* argument) {
            return std::string_view(argument) == "--json";
        });
        return Report({}, json, false).fail(parsed.error(), exitStatus(parsed.error().kind));
    }
    if (const HelpText* help = std::get_if<HelpText>(&*parsed)) {
        Report report({}, false, false);
        std::string text = help->text;
        while (text.ends_with('\n'))
            text.pop_back();
        report.line(text);
        return report.succeed();
    }
    return runCommand(std::get<Invocation>(*parsed));
}

} // namespace
} // namespace patina::cli

int main(int argc, char** argv) {
    const patina::cli::EarlySignals early;
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit is an error that is told, not the end
    return patina::cli::runMain(argc, argv);
}
