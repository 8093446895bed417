#include "app/cli/Report.h"

#include "core/base/PrintableText.h"
#include "core/scene/OutsidePictures.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

const char* kindName(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::Usage:
        return "usage";
    case ErrorKind::InputBroken:
        return "inputBroken";
    case ErrorKind::InputMissing:
        return "inputMissing";
    case ErrorKind::NoOpenGl:
        return "noOpenGl";
    case ErrorKind::Internal:
        return "internal";
    case ErrorKind::CannotCreate:
        return "cannotCreate";
    case ErrorKind::Io:
        return "io";
    case ErrorKind::Cancelled:
        return "cancelled";
    }
    return "internal";
}

// Characters as a terminal shows them: code points of the texts we print are one column wide.
std::size_t columns(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

// Everything that people read leaves through here: it may hold names that somebody else chose.
void say(std::FILE* stream, std::string_view text) {
    fmt::print(stream, "{}\n", printableText(text));
}

} // namespace

int exitStatus(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::Usage:
        return 2;
    case ErrorKind::InputBroken:
        return 65;
    case ErrorKind::InputMissing:
        return 66;
    case ErrorKind::NoOpenGl:
        return 69;
    case ErrorKind::Internal:
        return 70;
    case ErrorKind::CannotCreate:
        return 73;
    case ErrorKind::Io:
        return 74;
    case ErrorKind::Cancelled:
        return 130;
    }
    return 70;
}

Report::Report(std::string command, bool json, bool quiet)
    : m_json(std::make_unique<nlohmann::ordered_json>())
    , m_command(std::move(command))
    , m_wantsJson(json)
    , m_quiet(quiet) {
    if (!m_command.empty())
        (*m_json)["command"] = m_command;
}

Report::~Report() = default;

nlohmann::ordered_json& Report::json() {
    return *m_json;
}

void Report::line(const std::string& text) {
    if (!m_wantsJson)
        say(stdout, text);
}

void Report::table(const std::string& title,
                   const std::vector<std::pair<std::string, std::string>>& rows) {
    if (!title.empty())
        line(title);
    // A name that spans lines would look like several rows; one that is too long for a line moves
    // its own value alone.
    constexpr std::size_t kWidest = 60;
    std::size_t widest = 0;
    for (const auto& [label, value] : rows)
        if (const std::size_t width = columns(printableLine(label)); width <= kWidest)
            widest = std::max(widest, width);
    for (const auto& [name, value] : rows) {
        const std::string label = printableLine(name);
        line(fmt::format(
            "{}{}{}{}", title.empty() ? "" : "  ", label,
            std::string(value.empty() ? 0 : std::max(widest, columns(label)) - columns(label) + 2,
                        ' '),
            printableLine(value)));
    }
}

void Report::warn(const std::string& text) {
    nlohmann::ordered_json& warnings = (*m_json)["warnings"];
    if (std::find(warnings.begin(), warnings.end(), text) != warnings.end())
        return; // of several pictures of one scene
    warnings.push_back(text);
    if (!m_quiet)
        say(stderr, "patina: warning: " + printableLine(text));
}

void Report::add(const Notice& notice) {
    warn(notice.file.empty() ? notice.message : notice.file.string() + ": " + notice.message);
}

void Report::add(const OpenedScene& scene) {
    for (const Notice& notice : scene.notices)
        add(notice);
    for (const ChosenScene& chosen : scene.scenes) {
        (*m_json)["visualScenes"].push_back({{"file", chosen.file},
                                             {"taken", chosen.scenes[chosen.scene]},
                                             {"all", chosen.scenes}});
        if (!chosen.asked && !scene.isProject)
            warn("--visual-scene NAME reads another visual scene");
    }
    if (!scene.missingFiles.empty())
        (*m_json)["missing"] = scene.missingFiles;
    if (const OutsidePictures outside = outsidePictures(scene.document); !outside.files.empty()) {
        (*m_json)["outside"] = outside.files;
        warn(
            "--allow-outside reads what lies outside the folder of a model or project, too: use it "
            "for files that you trust");
    }
}

void Report::output(const std::filesystem::path& file, const std::string& what) {
    (*m_json)["outputs"].push_back(file.string());
    if (!m_quiet)
        say(stderr, fmt::format("patina: wrote {}{}", printableLine(file.string()),
                                what.empty() ? "" : " (" + what + ")"));
}

void Report::failCheck(const std::string& text) {
    (*m_json)["failed"].push_back(text);
    say(stderr, "patina: " + printableLine(text));
    m_status = 1;
}

int Report::fail(const Error& error, int status) {
    // A result that never came to be has no keys of its own.
    nlohmann::ordered_json description = {{"kind", kindName(error.kind)},
                                          {"message", error.message},
                                          {"file", error.file.string()},
                                          {"exitStatus", status}};
    if (!error.detail.empty())
        description["detail"] = error.detail;
    (*m_json)["error"] = std::move(description);
    say(stderr, "patina: " + error.text());
    return print(status);
}

int Report::succeed() {
    return print(m_status);
}

int Report::print(int status) {
    if (m_wantsJson)
        fmt::print("{}\n", printableJson(m_json->dump(
                               2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
    // A full disk behind a redirection shows only when the last bytes leave.
    if (std::fflush(stdout) != 0 && status == 0) {
        fmt::print(stderr, "patina: standard output cannot be written\n");
        return exitStatus(ErrorKind::Io);
    }
    return status;
}

std::string countText(std::size_t count) {
    const std::string digits = std::to_string(count);
    std::string result;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            result += ',';
        result += digits[i];
    }
    return result;
}

std::string bytesText(std::size_t bytes) {
    if (bytes < 1024)
        return fmt::format("{} bytes", bytes);
    double value = static_cast<double>(bytes) / 1024;
    for (const char* unit : {"KiB", "MiB"}) {
        if (value < 1024)
            return fmt::format("{:.1f} {}", value, unit);
        value /= 1024;
    }
    return fmt::format("{:.1f} GiB", value);
}

} // namespace patina::cli
