// How bright the picture is on the whole, and the luminance that the eye is used to meanwhile: both
// live on the GPU, where tone mapping reads them (shaders/include/exposure.glsl) in the same frame.
// The CPU learns of them later, without waiting.
#pragma once

#include "core/document/ToneResponse.h"
#include "render/gl/Buffer.h"
#include "render/pass/Targets.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <cstdint>
#include <optional>

namespace patina {
enum class ExposureMeter;
}

namespace patina::render {

class AdaptationPass {
  public:
    AdaptationPass(gl::Context& context, ShaderLibrary& shaders);
    ~AdaptationPass();
    AdaptationPass(const AdaptationPass&) = delete;
    AdaptationPass& operator=(const AdaptationPass&) = delete;

    // Sums up targets.linear() where the model is, by targets.depth(); all of it where none is.
    // Of a band alone: `firstRow` is a multiple of 64, rows from there; adapt() knows of the
    // picture once its last row has been measured.
    Result<void> measure(const Targets& targets, int firstRow, int rows);
    Result<void> measure(const Targets& targets) { return measure(targets, 0, targets.height()); }
    // The eye looks at what was measured, the surfaces or the frame, for `seconds` more; infinite:
    // until it is used to it.
    Result<void> adapt(float seconds, ExposureMeter meter);
    // For the uniform block `Adaptation`.
    void bind() const { m_state.bindUniform(kBinding); }
    // Counts the times that it may have become used to something else.
    [[nodiscard]] std::uint64_t revision() const { return m_revision; }

    // The newest result that the GPU has finished; nothing before the first.
    [[nodiscard]] std::optional<Luminance> poll();
    [[nodiscard]] std::optional<Luminance> read();                // waits for the GPU
    [[nodiscard]] bool pending() const { return m_underWay > 0; } // poll() will have a newer one

    // Compiles the programs, so that a broken one is found when the renderer is made.
    static Result<void> compile(ShaderLibrary& shaders);

  private:
    static constexpr unsigned kBinding = 5;
    static constexpr std::size_t kSlots = 3; // results under way
    struct Slot {
        void* fence = nullptr; // GLsync; null: nothing under way
    };

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    gl::Buffer m_tiles, m_nextTiles, m_state; // next: of a picture that is measured in bands
    int m_tileCount = 0;
    std::uint64_t m_revision = 0;
    gl::Handle<gl::deleteBuffer> m_readback; // kSlots results
    const Luminance* m_results = nullptr;    // mapped for as long as the buffer lives
    std::array<Slot, kSlots> m_slots;
    std::size_t m_oldest = 0, m_underWay = 0; // slots m_oldest … m_oldest + m_underWay - 1
    std::optional<Luminance> m_newest;
};

} // namespace patina::render
