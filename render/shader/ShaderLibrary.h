// Programs made of shader files, compiled once per variant and kept while they are in use. With a
// folder on disk it can compile again what changed there, without ever losing a program that
// worked.
#pragma once

#include "render/gl/Program.h"
#include "render/shader/ShaderSources.h"

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
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
    // Each choice of maps, model, lights and output is a program of some 4 MiB in the driver:
    // an afternoon of trying things would keep hundreds of them. What one scene is looked at with
    // are some dozens; drivers find those that were dropped on disk.
    static constexpr std::size_t kMostPrograms = 64;
    // CHECKs that mostPrograms > 0.
    ShaderLibrary(gl::Context& context, std::filesystem::path folder,
                  std::size_t mostPrograms = kMostPrograms);

    // The program, compiled on first use. The pointer follows reload(); it is valid until as many
    // other programs as the library holds were asked for since. When a file on disk does not
    // compile, the built-in version steps in and the log says so. Error Internal with the
    // compiler's messages ("file:line: …") when there is no version that compiles.
    Result<const gl::Program*> program(const ProgramKey& key);

    // What program() does to one that it returned before: the others are dropped first.
    void touch(const gl::Program& program);

    // Compiles again the programs one of whose files changed. Returns the messages of those that
    // failed, each line as "file:line: …"; they keep their last good program.
    std::vector<std::string> reload();

    [[nodiscard]] std::vector<ProgramKey> keys() const; // of its programs
    [[nodiscard]] std::size_t programCount() const { return m_programs.size(); }
    [[nodiscard]] std::size_t compilations() const { return m_compilations; } // so far
    [[nodiscard]] std::size_t drops() const { return m_drops; }               // so far

  private:
    struct Stamped {
        std::string file;
        long long stamp = 0;
    };
    struct Entry {
        gl::Program program;
        std::vector<Stamped> files; // every file that went into it, includes too
        std::uint64_t lastUse = 0;  // of m_uses
    };
    // `files` receives every file met, on failure too, so that a later fix is noticed.
    Result<gl::Program> compile(const ShaderSources& sources, const ProgramKey& key,
                                std::vector<Stamped>& files);
    void dropOldest();

    gl::Context& m_context;
    ShaderSources m_sources;
    std::size_t m_mostPrograms;
    std::map<ProgramKey, Entry> m_programs;
    std::unordered_map<const gl::Program*, Entry*> m_entries; // of m_programs
    std::uint64_t m_uses = 0;
    std::size_t m_compilations = 0, m_drops = 0;
};

} // namespace patina::render
