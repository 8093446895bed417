#include "render/shader/ShaderSources.h"

#include "core/base/AtomicFile.h"
#include "render/shader/GeneratedShaders.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <sstream>

namespace patina::render {

namespace {

constexpr std::size_t kMaxShaderBytes = std::size_t{1} << 20;

// #line carries the file in the line number, too: Mesa forgets the file's number in every message
// but those about syntax.
constexpr std::size_t kLinesPerFile = 100'000;

std::string lineDirective(std::size_t line, std::size_t file) {
    return fmt::format("#line {} {}\n", file * kLinesPerFile + line, file);
}

// The name between the quotes of an #include line.
std::optional<std::string> includedName(std::string_view line) {
    const auto skipBlanks = [&] {
        while (!line.empty() && (line.front() == ' ' || line.front() == '\t'))
            line.remove_prefix(1);
    };
    skipBlanks();
    if (line.empty() || line.front() != '#')
        return std::nullopt;
    line.remove_prefix(1);
    skipBlanks();
    constexpr std::string_view kInclude = "include";
    if (!line.starts_with(kInclude))
        return std::nullopt;
    line.remove_prefix(kInclude.size());
    const auto open = line.find('"');
    const auto close = open == std::string_view::npos ? open : line.find('"', open + 1);
    if (close == std::string_view::npos)
        return std::nullopt;
    return std::string(line.substr(open + 1, close - open - 1));
}

class Expander {
  public:
    Expander(const ShaderSources& sources, std::span<const std::string> defines,
             ExpandedShader& result)
        : m_sources(sources)
        , m_defines(defines)
        , m_result(result)
        , m_first(result.files.size()) {
        m_result.text.clear();
    }

    Result<void> add(const std::string& name) {
        const std::size_t number = m_result.files.size();
        m_result.files.push_back(name);
        Result<std::string> text = m_sources.read(name);
        if (!text)
            return text.error();
        m_open.push_back(name);
        if (number > m_first)
            m_result.text += lineDirective(1, number);

        std::istringstream lines(*text);
        std::string line;
        for (std::size_t lineNumber = 1; std::getline(lines, line); ++lineNumber) {
            if (const auto wanted = includedName(line)) {
                if (Result<void> done = include(*wanted, name, lineNumber); !done)
                    return done;
                m_result.text += lineDirective(lineNumber + 1, number);
                continue;
            }
            m_result.text += line + '\n';
            // #version must stay the first line; what follows it keeps its own line numbers.
            if (number == m_first && line.starts_with("#version")) {
                for (const std::string& define : m_defines)
                    m_result.text += "#define " + define + '\n';
                m_result.text += lineDirective(lineNumber + 1, number);
            }
        }
        m_open.pop_back();
        return {};
    }

  private:
    Result<void> include(const std::string& wanted, const std::string& from,
                         std::size_t lineNumber) {
        const std::filesystem::path folder = std::filesystem::path(from).parent_path();
        std::string name = (folder / wanted).lexically_normal().generic_string();
        if (m_sources.stamp(name) < 0)
            name = std::filesystem::path(wanted).lexically_normal().generic_string();
        if (m_sources.stamp(name) < 0) {
            m_result.files.push_back(name);
            return Error{
                ErrorKind::InputMissing,
                fmt::format("{}:{}: there is no \"{}\" to include", from, lineNumber, wanted),
                {},
                {}};
        }
        if (std::find(m_open.begin(), m_open.end(), name) != m_open.end())
            return Error{ErrorKind::InputBroken,
                         fmt::format("{}:{}: \"{}\" includes itself through {}", from, lineNumber,
                                     name, fmt::join(m_open, " > ")),
                         {},
                         {}};
        const auto first = m_result.files.begin() + static_cast<std::ptrdiff_t>(m_first);
        if (std::find(first, m_result.files.end(), name) != m_result.files.end())
            return {}; // pasted in already
        return add(name);
    }

    const ShaderSources& m_sources;
    std::span<const std::string> m_defines;
    ExpandedShader& m_result;
    std::size_t m_first;             // this stage's files begin here
    std::vector<std::string> m_open; // files being pasted, outermost first
};

// Reads a number at the start of `text` and removes it.
std::optional<std::size_t> takeNumber(std::string_view& text) {
    std::size_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc())
        return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::string mapLine(std::string_view line, std::span<const std::string> files) {
    std::string_view rest = line;
    for (std::string_view prefix : {"ERROR: ", "WARNING: "})
        if (rest.starts_with(prefix))
            rest.remove_prefix(prefix.size());
    if (!takeNumber(rest) || rest.empty() || (rest.front() != ':' && rest.front() != '('))
        return std::string(line);
    rest.remove_prefix(1);
    const auto number = takeNumber(rest);
    if (!number || *number / kLinesPerFile >= files.size())
        return std::string(line);
    const auto message = rest.find(": ");
    return fmt::format("{}:{}: {}", files[*number / kLinesPerFile], *number % kLinesPerFile,
                       message == std::string_view::npos ? rest : rest.substr(message + 2));
}

} // namespace

ShaderSources::ShaderSources(std::filesystem::path folder)
    : m_folder(std::move(folder)) {}

Result<std::string> ShaderSources::read(std::string_view name) const {
    if (auto generated = generatedShader(name))
        return *std::move(generated);
    if (onDisk())
        return readTextFile(m_folder / name, kMaxShaderBytes);
    const auto all = embeddedShaders();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const EmbeddedShader& s) { return s.name == name; });
    if (found == all.end())
        return Error{
            ErrorKind::InputMissing, fmt::format("There is no shader \"{}\".", name), {}, {}};
    return std::string(found->text);
}

long long ShaderSources::stamp(std::string_view name) const {
    if (generatedShader(name))
        return 0;
    if (!onDisk()) {
        const auto all = embeddedShaders();
        return std::any_of(all.begin(), all.end(),
                           [&](const EmbeddedShader& s) { return s.name == name; })
                   ? 0
                   : -1;
    }
    std::error_code error;
    const auto path = m_folder / name;
    const auto time = std::filesystem::last_write_time(path, error);
    if (error || !std::filesystem::is_regular_file(path, error))
        return -1;
    const auto size = std::filesystem::file_size(path, error);
    // Half of the bits each: an edit changes at least one of them.
    const auto ticks = static_cast<unsigned long long>(time.time_since_epoch().count());
    return static_cast<long long>((ticks ^ (static_cast<unsigned long long>(size) << 40)) >> 1);
}

Result<void> expandShader(const ShaderSources& sources, const std::string& name,
                          std::span<const std::string> defines, ExpandedShader& result) {
    return Expander(sources, defines, result).add(name);
}

std::string mapCompilerLog(const std::string& log, std::span<const std::string> files) {
    std::istringstream lines(log);
    std::string line, result;
    while (std::getline(lines, line)) {
        if (line.empty())
            continue;
        if (!result.empty())
            result += '\n';
        result += mapLine(line, files);
    }
    return result;
}

} // namespace patina::render
