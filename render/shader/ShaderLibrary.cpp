#include "render/shader/ShaderLibrary.h"

#include "core/base/Check.h"
#include "core/base/Log.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina::render {

namespace {

gl::Stage stageOf(const std::string& file) {
    if (file.ends_with(".vert"))
        return gl::Stage::Vertex;
    if (file.ends_with(".frag"))
        return gl::Stage::Fragment;
    CHECK(file.ends_with(".comp"));
    return gl::Stage::Compute;
}

std::string labelOf(const ProgramKey& key) {
    return fmt::format("{}", fmt::join(key.files, " + "));
}

} // namespace

ShaderLibrary::ShaderLibrary(gl::Context& context, std::filesystem::path folder,
                             std::size_t mostPrograms)
    : m_context(context)
    , m_sources(std::move(folder))
    , m_mostPrograms(mostPrograms) {
    CHECK(mostPrograms > 0);
}

Result<gl::Program> ShaderLibrary::compile(const ShaderSources& sources, const ProgramKey& key,
                                           std::vector<Stamped>& files) {
    ++m_compilations;
    ExpandedShader shader;
    Result<void> expanded;
    std::vector<gl::StageSource> stages;
    for (const std::string& file : key.files) {
        expanded = expandShader(sources, file, key.defines, shader);
        if (!expanded)
            break;
        stages.push_back({stageOf(file), shader.text});
    }
    files.clear();
    for (const std::string& file : shader.files)
        files.push_back({file, sources.stamp(file)});
    if (!expanded)
        return expanded.error();

    Result<gl::Program> program = gl::Program::create(m_context, labelOf(key), stages);
    if (program)
        return program;
    Error error = program.error();
    error.detail = mapCompilerLog(error.detail, shader.files);
    return error;
}

Result<const gl::Program*> ShaderLibrary::program(const ProgramKey& key) {
    if (const auto found = m_programs.find(key); found != m_programs.end()) {
        found->second.lastUse = ++m_uses;
        return &found->second.program;
    }
    Entry entry;
    Result<gl::Program> program = compile(m_sources, key, entry.files);
    if (!program && m_sources.onDisk()) {
        std::vector<Stamped> builtInFiles;
        Result<gl::Program> builtIn = compile(ShaderSources(), key, builtInFiles);
        if (builtIn) {
            logWarning("{} The built-in version is used.", program.error().text());
            program = std::move(builtIn);
        }
    }
    if (!program)
        return program.error();
    if (m_programs.size() >= m_mostPrograms)
        dropOldest();
    entry.program = std::move(*program);
    entry.lastUse = ++m_uses;
    Entry& kept = m_programs.emplace(key, std::move(entry)).first->second;
    m_entries.emplace(&kept.program, &kept);
    return &kept.program;
}

void ShaderLibrary::touch(const gl::Program& program) {
    const auto found = m_entries.find(&program);
    CHECK(found != m_entries.end());
    found->second->lastUse = ++m_uses;
}

void ShaderLibrary::dropOldest() {
    const auto oldest =
        std::min_element(m_programs.begin(), m_programs.end(), [](const auto& a, const auto& b) {
            return a.second.lastUse < b.second.lastUse;
        });
    m_entries.erase(&oldest->second.program);
    m_programs.erase(oldest);
    ++m_drops;
}

std::vector<ProgramKey> ShaderLibrary::keys() const {
    std::vector<ProgramKey> keys;
    for (const auto& [key, entry] : m_programs)
        keys.push_back(key);
    return keys;
}

std::vector<std::string> ShaderLibrary::reload() {
    std::vector<std::string> messages;
    for (auto& [key, entry] : m_programs) {
        const bool changed =
            std::any_of(entry.files.begin(), entry.files.end(),
                        [&](const Stamped& s) { return m_sources.stamp(s.file) != s.stamp; });
        if (!changed)
            continue;
        Result<gl::Program> program = compile(m_sources, key, entry.files);
        if (program)
            entry.program = std::move(*program);
        else
            messages.push_back(program.error().detail.empty() ? program.error().text()
                                                              : program.error().detail);
    }
    // Variants of one broken file fail alike: say it once.
    std::sort(messages.begin(), messages.end());
    messages.erase(std::unique(messages.begin(), messages.end()), messages.end());
    return messages;
}

} // namespace patina::render
