// Programs made of shader files, compiled once per variant and kept. With a folder on disk it can
// compile again what changed there, without ever losing a program that worked.
#pragma once

#include "render/gl/Program.h"
#include "render/shader/ShaderSources.h"

#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace patina::render {

// What makes a program: its files (the stage follows from .vert, .frag, .comp) and its #defines.
struct ProgramKey {
    std::vector<std::string> files;
    std::vector<std::string> defines;
    friend auto operator<=>(const ProgramKey&, const ProgramKey&) = default;
};

class ShaderLibrary {
  public:
    ShaderLibrary(gl::Context& context, std::filesystem::path folder);

    // The program, compiled on first use; the pointer stays valid and follows reload(). When a file
    // on disk does not compile, the built-in version steps in and the log says so. Error Internal
    // with the compiler's messages ("file:line: …") when there is no version that compiles.
    Result<const gl::Program*> program(const ProgramKey& key);

    // Compiles again the programs one of whose files changed. Returns the messages of those that
    // failed, each line as "file:line: …"; they keep their last good program.
    std::vector<std::string> reload();

    [[nodiscard]] std::vector<ProgramKey> keys() const; // of its programs
    [[nodiscard]] std::size_t programCount() const { return m_programs.size(); }
    [[nodiscard]] std::size_t compilations() const { return m_compilations; } // so far

  private:
    struct Stamped {
        std::string file;
        long long stamp = 0;
    };
    struct Entry {
        gl::Program program;
        std::vector<Stamped> files; // every file that went into it, includes too
    };
    // `files` receives every file met, on failure too, so that a later fix is noticed.
    Result<gl::Program> compile(const ShaderSources& sources, const ProgramKey& key,
                                std::vector<Stamped>& files);

    gl::Context& m_context;
    ShaderSources m_sources;
    std::map<ProgramKey, Entry> m_programs;
    std::size_t m_compilations = 0;
};

} // namespace patina::render
