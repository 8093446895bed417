// The parts that the shards of a radiosity found, joined to the state of the whole.
#pragma once

#include "core/radiosity/file/RadiosityFile.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace patina::radiosity {

struct RadiosityPart {
    std::filesystem::path file;
    RadiosityManifest manifest;
};

// The parts in the order of their shards. Errors: those of readRadiosityManifest(); InputBroken,
// naming the file, for parts of different solutions, the same part twice, an unfinished one;
// InputMissing when one is missing.
Result<std::vector<RadiosityPart>> readRadiosityParts(std::span<const std::filesystem::path> files);

// Divides `elements` as a file says. Errors: those of readDivisions(); InputBroken where the file
// is of other elements.
Result<void> divideAsIn(const std::filesystem::path& file, ElementMesh& elements);

// Gives what the parts found to those who solve; keeps nothing itself.
class JoinedRadiosity : public SolveKeeper {
  public:
    // `scene`: what is solved, as RadiosityManifest has it; `inputs`: hashTraceInputs() of it. Rows
    // are left out where they would take more than maxRowBytes (0: no limit).
    JoinedRadiosity(std::span<const RadiosityPart> parts, std::string scene,
                    const TraceHash& inputs, std::size_t maxRowBytes)
        : m_parts(parts)
        , m_here(parts.front().manifest)
        , m_maxRowBytes(maxRowBytes) {
        m_here.scene = std::move(scene);
        m_here.inputs = inputs;
    }

    Result<void> divide(ElementMesh& elements) override;
    // Errors besides: InputBroken where the parts belong to another scene; those of
    // readRadiosity().
    Result<void> begin(const TraceScene& scene, const ElementMesh& elements) override;
    void between(const SolverView&) override {}

  private:
    std::span<const RadiosityPart> m_parts;
    RadiosityManifest m_here;
    std::size_t m_maxRowBytes;
};

} // namespace patina::radiosity
