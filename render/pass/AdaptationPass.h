// How bright the picture is on the whole, and the luminance that the eye is used to meanwhile: both
// live on the GPU, where tone mapping reads them (shaders/include/exposure.glsl) in the same frame.
// The CPU learns of them later, without waiting.
#pragma once

#include "core/document/ToneResponse.h"
#include "render/gl/Buffer.h"
#include "render/pass/Targets.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <optional>

namespace patina::render {

class AdaptationPass {
  public:
    AdaptationPass(gl::Context& context, ShaderLibrary& shaders);
    ~AdaptationPass();
    AdaptationPass(const AdaptationPass&) = delete;
    AdaptationPass& operator=(const AdaptationPass&) = delete;

    // Sums up targets.linear() where the model is, by targets.depth(); all of it where none is.
    Result<void> measure(const Targets& targets);
    // The eye looks at what was measured for `seconds` more; infinite: until it is used to it.
    Result<void> adapt(float seconds);
    // For the uniform block `Adaptation`.
    void bind() const { m_state.bindUniform(kBinding); }

    // The newest result that the GPU has finished; nothing before the first.
    [[nodiscard]] std::optional<Luminance> poll();
    [[nodiscard]] std::optional<Luminance> read();                // waits for the GPU
    [[nodiscard]] bool pending() const { return m_underWay > 0; } // poll() will have a newer one

    // Compiles the programs, so that a broken one is found when the renderer is made.
    Result<void> compile();

  private:
    static constexpr unsigned kBinding = 5;
    static constexpr std::size_t kSlots = 3; // results under way
    struct Slot {
        void* fence = nullptr; // GLsync; null: nothing under way
    };

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    gl::Buffer m_tiles, m_state;
    int m_tileCount = 0;
    gl::Handle<gl::deleteBuffer> m_readback; // kSlots results
    const Luminance* m_results = nullptr;    // mapped for as long as the buffer lives
    std::array<Slot, kSlots> m_slots;
    std::size_t m_oldest = 0, m_underWay = 0; // slots m_oldest … m_oldest + m_underWay - 1
    std::optional<Luminance> m_newest;
};

} // namespace patina::render
