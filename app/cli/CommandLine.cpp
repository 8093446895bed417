#include "app/cli/CommandLine.h"

#include "app/cli/CommandParser.h"
#include "app/cli/HelpFormatter.h"
#include "app/cli/RenderViews.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace patina::cli {
namespace {

constexpr std::array kCommands = {"info",   "render",  "sheet",       "rank",      "ladder",
                                  "bake",   "merge",   "environment", "bracket",   "export",
                                  "refine", "compare", "certificate", "parameters"};

constexpr const char* kAbout =
    "Patina: a desktop editor for physically based materials you can trust.\n\n"
    "  patina [FILE …] [--environment HDR]   start the editor (also: patina edit …)\n"
    "  patina COMMAND …                      do one thing without a window\n\n"
    "SCENE is a model (glTF, GLB, OBJ, FBX, COLLADA, PLY, STL), a .patina project or\n"
    "builtin:NAME; HDR is an image of any layout or builtin:NAME. `patina info builtin:list`\n"
    "prints the built-in names.";
constexpr const char* kFooter =
    "Exit status: 0 done, 1 a check failed (certificate, compare --fail-above or --fail-below),\n"
    "2 wrong usage, 65 an input is broken, 66 an input is missing, 69 no OpenGL, 70 a fault of\n"
    "ours, 73 an output cannot be created, 74 I/O error or disk full, 75 stopped for now\n"
    "(--checkpoint, --resume), 130/143 interrupted.";

} // namespace

CLI::Validator plain(const CLI::Validator& check) {
    return {[check](std::string& text) {
                char* end = nullptr;
                const double value = std::strtod(text.c_str(), &end);
                if (end != text.c_str() && *end == '\0' && !std::isfinite(value))
                    return fmt::format("{} is no finite number", text);
                return check(text);
            },
            ""};
}

CommandParser::CommandParser()
    : m_app(kAbout, "patina") {
    m_app.set_version_flag("--version", "patina " PATINA_VERSION, "Print the version");
    m_app.footer(kFooter);
    m_app.formatter(std::make_shared<HelpFormatter>()); // which commands take over
    m_app.require_subcommand(1);
    addInfo();
    addRender();
    addSheet();
    addRank();
    addLadder();
    addBakes();
    addMerge();
    addEnvironment();
    addBracket();
    addExport();
    addRefine();
    addCompare();
    addCertificate();
    addParameters();
}

Result<std::variant<Invocation, HelpText>> CommandParser::parse(int argc, const char* const* argv) {
    if (argc > 1 && argv[1][0] != '-' &&
        std::find(kCommands.begin(), kCommands.end(), std::string_view(argv[1])) == kCommands.end())
        return Error{ErrorKind::Usage,
                     fmt::format("there is no command or file \"{}\"; commands are {}", argv[1],
                                 fmt::join(kCommands, ", ")),
                     {},
                     {}};
    try {
        m_app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return {HelpText{m_app.help()}};
    } catch (const ListViews&) {
        return {HelpText{listViews()}};
    } catch (const CLI::CallForVersion&) {
        return {HelpText{m_app.version() + "\n"}};
    } catch (const CLI::ParseError& error) {
        return Error{ErrorKind::Usage,
                     fmt::format("{}; see {} --help", error.what(), innermostName()),
                     {},
                     {}};
    }
    m_invocation.common.command = innermostName().substr(std::string_view("patina ").size());
    m_invocation.options = m_select.at(innermost())();
    for (const LongBakeOptions* work : {&m_ao.work, &m_prt.work, &m_light.work, &m_render.work,
                                        &m_radiosity.work}) // only one was filled in
        m_invocation.common.requeues |= work->resume || !work->checkpoint.empty();
    return {std::move(m_invocation)};
}

CLI::App* CommandParser::innermost() {
    CLI::App* app = &m_app;
    while (!app->get_subcommands().empty())
        app = app->get_subcommands().front();
    return app;
}

std::string CommandParser::innermostName() {
    std::string name = "patina";
    for (CLI::App* app = &m_app; !app->get_subcommands().empty();) {
        app = app->get_subcommands().front();
        name += " " + app->get_name();
    }
    return name;
}

void CommandParser::addCommon(CLI::App* command) {
    CommonOptions& common = m_invocation.common;
    command->add_flag("--json", common.json, "Print one JSON object, also on failure");
    command->footer("");
    command->add_flag("--quiet", common.quiet, "No progress and no notices");
}

void CommandParser::addOutside(CLI::App* command) {
    command->add_flag("--allow-outside", m_invocation.common.allowOutside,
                      "Also read pictures that a model or a project names outside its own folder "
                      "(else they are listed and left out)");
}

void CommandParser::addVisualScene(CLI::App* command) {
    command
        ->add_option("--visual-scene", m_invocation.common.visualScene,
                     "Of a COLLADA file that holds several visual scenes (patina info lists them) "
                     "the one to read, by name or id (default: the one that the file names)")
        ->type_name("NAME");
}

void CommandParser::addThreads(CLI::App* command) {
    command
        ->add_option("--threads", m_invocation.common.threads,
                     "Threads to use; the result does not depend on it (default: all cores)")
        ->check(plain(CLI::Range(1, 1024)))
        ->type_name("N");
}

void CommandParser::addSets(CLI::App* command) {
    command
        ->add_option("--set", m_invocation.common.sets,
                     "Set a parameter, e.g. material[Body].metallic=1; see patina parameters")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
}

CLI::Option* CommandParser::addLayout(CLI::App* command, std::string& layout) {
    return command
        ->add_option("--environment-layout", layout,
                     "How the HDR shows the environment (default: guessed): " +
                         std::string(kLayoutNames))
        ->type_name("NAME");
}

void CommandParser::addBakeFiles(CLI::App* command, const char* name,
                                 std::vector<std::string>& bakes, const char* help) {
    command->add_option(name, bakes, help)
        ->type_name("FILE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
}

Result<std::variant<Invocation, HelpText>> parseCommandLine(int argc, const char* const* argv) {
    return CommandParser().parse(argc, argv);
}

bool isForEditor(int argc, const char* const* argv) {
    if (argc < 2)
        return true;
    const std::string_view first = argv[1];
    if (first == "edit" || first.starts_with("--environment"))
        return true;
    if (first.starts_with("-") ||
        std::find(kCommands.begin(), kCommands.end(), first) != kCommands.end())
        return false;
    std::error_code ignored;
    return first.find_first_of("./:") != std::string_view::npos ||
           std::filesystem::exists(first, ignored);
}

} // namespace patina::cli
