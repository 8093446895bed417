// What a traced picture may hold besides its colour: what the camera sees first at each pixel, and
// by which way light got there (arbitrary output variables, AOVs).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// Of one path. Of light: radiance, linear; beauty = emission + background + the other four.
struct TraceSample {
    bool hit = false; // a surface; what is of one is 0 otherwise
    // Share that the surface reflects of uniform light to the viewer: the directional albedos of
    // both lobes, so that metals have one.
    glm::vec3 albedo{0.0f};
    glm::vec3 normal{0.0f};     // of shading, world, unit
    glm::vec3 position{0.0f};   // from the camera, metres, world axes
    glm::vec3 emission{0.0f};   // of the surface that is seen
    glm::vec3 background{0.0f}; // where there is none
    // Reflected by the lobe of the surface that is seen: light straight from a light, a glowing
    // surface or the environment, and light by way of other surfaces.
    glm::vec3 directDiffuse{0.0f}, directSpecular{0.0f};
    glm::vec3 indirectDiffuse{0.0f}, indirectSpecular{0.0f};
    // Of these four, what came through the surface that is seen. Not of TraceOutputs.
    glm::vec3 through{0.0f};
};

class TraceOutputs {
  public:
    // 112 bytes: 160 with the film's. Sums of a pass run in double precision and are then added
    // here, so that rounding grows with the passes and not with the samples.
    struct Pixel {
        glm::vec3 albedo{0.0f}, normal{0.0f}, position{0.0f}, emission{0.0f}, background{0.0f};
        glm::vec3 directDiffuse{0.0f}, directSpecular{0.0f};
        glm::vec3 indirectDiffuse{0.0f}, indirectSpecular{0.0f};
        std::uint32_t hits = 0; // samples that met a surface
        friend bool operator==(const Pixel&, const Pixel&) = default;
    };

    TraceOutputs() = default; // none
    TraceOutputs(int width, int height)
        : m_pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    [[nodiscard]] bool empty() const { return m_pixels.empty(); }
    [[nodiscard]] std::span<Pixel> pixels() { return m_pixels; } // row by row, 0 on top
    [[nodiscard]] std::span<const Pixel> pixels() const { return m_pixels; }
    friend bool operator==(const TraceOutputs&, const TraceOutputs&) = default;

  private:
    std::vector<Pixel> m_pixels;
};

// The samples of a pass at one pixel.
class TraceOutputSum {
  public:
    // `radiance`: of the path; one that is no finite number counts as black here as in the film.
    void add(const TraceSample& sample, const glm::vec3& radiance);
    void addTo(TraceOutputs::Pixel& pixel) const;

  private:
    glm::dvec3 m_albedo{0.0}, m_normal{0.0}, m_position{0.0}, m_emission{0.0}, m_background{0.0};
    glm::dvec3 m_directDiffuse{0.0}, m_directSpecular{0.0};
    glm::dvec3 m_indirectDiffuse{0.0}, m_indirectSpecular{0.0};
    std::uint32_t m_hits = 0;
};

// Tells apart by which way the light of one path comes, while it is followed. Does nothing without
// a sample to fill.
class TraceSplit {
  public:
    explicit TraceSplit(TraceSample* sample)
        : m_sample(sample) {}

    // What a surface reflects of the light that is looked at next, by lobe. `through`: it comes
    // through the surface.
    void reflects(const glm::vec3& diffuse, const glm::vec3& specular, bool through = false) {
        if (m_sample != nullptr) {
            m_share = shareOf(diffuse, specular);
            m_through = through;
        }
    }
    // The path goes on from the surface that is seen, in the direction that reflects() was of.
    void leaves() {
        m_way = m_share;
        m_wayThrough = m_through;
    }

    // Light that a ray from surface number `surface` found there, as reflects() has it; returns it.
    const glm::vec3& sent(int surface, const glm::vec3& light) {
        if (m_sample != nullptr && surface == 0)
            add(m_sample->directDiffuse, m_sample->directSpecular, m_share, m_through, light);
        return light;
    }
    // Light by way of the path, which came to surface number `surface` before; returns it.
    const glm::vec3& came(int surface, const glm::vec3& light) {
        if (m_sample != nullptr) {
            if (surface == 0)
                add(m_sample->directDiffuse, m_sample->directSpecular, m_way, m_wayThrough, light);
            else
                add(m_sample->indirectDiffuse, m_sample->indirectSpecular, m_way, m_wayThrough,
                    light);
        }
        return light;
    }

    [[nodiscard]] TraceSample* sample() const { return m_sample; }

  private:
    static glm::vec3 shareOf(const glm::vec3& diffuse, const glm::vec3& specular);
    void add(glm::vec3& diffuse, glm::vec3& specular, const glm::vec3& share, bool through,
             const glm::vec3& light) {
        if (through)
            m_sample->through += light;
        const glm::vec3 first = share * light;
        diffuse += first;
        specular += light - first;
    }

    TraceSample* m_sample;
    glm::vec3 m_share{0.0f}, m_way{0.0f}; // of the diffuse lobe, by channel
    bool m_through = false, m_wayThrough = false;
};

} // namespace patina
