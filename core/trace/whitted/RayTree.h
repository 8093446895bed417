// The rays that one pixel of a classical ray tracer's picture is made of: each with what it met,
// what light it brought and why it ended. Filled by WhittedShader while it shades.
#pragma once

#include "core/base/Id.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace patina {

enum class RayKind { Camera, Shadow, Reflected, Refracted };

// Why no ray follows. A surface whose reflected and refracted rays were all cut says Continues: the
// cut rays are nodes of their own, and say why.
enum class RayEnd {
    Continues,     // met a surface that reflects or refracts
    Missed,        // met nothing: the background
    NotReflecting, // met a surface without mirror reflection and refraction
    Emissive,      // the same, of a surface that gives off light
    Back,          // met the back of a surface that has only a front, which absorbs
    Depth,         // not cast: it would be deeper in the tree than is allowed
    Contribution,  // not cast: its weight is below the least
    Below,         // not cast: the shading normal sends it below the triangle
    Lit,           // shadow ray: reached the light
    Blocked,       // shadow ray: something is in the way
    NoShadow,      // shadow ray, not cast: the light casts no shadow
    Facing,        // shadow ray, not cast: the light is behind the surface or gives nothing
};

struct RayEndInfo {
    std::string_view id;   // as in files
    std::string_view text; // for the user
};
[[nodiscard]] const RayEndInfo& rayEndInfo(RayEnd end);
[[nodiscard]] const RayEndInfo& rayKindInfo(RayKind kind);
[[nodiscard]] bool wasCast(RayEnd end);

// The terms of Whitted's equation (docs/maths/whitted.md) as numbers, each channel by itself and
// without the ray's weight.
struct RayTerms {
    // At the surface that a ray met which is no shadow ray.
    glm::vec3 ambientLight{0.0f}, ambient{0.0f}; // Ia, ka
    glm::vec3 emission{0.0f};
    // Of a shadow ray that brings light: f_att Ip, kd (N · L), ks (R · V)^n; of the material's BRDF
    // what takes their place. S is RayNode::passes.
    glm::vec3 arriving{0.0f}, diffuse{0.0f}, specular{0.0f};
    // Of a reflected or refracted ray: kr or kt, the share of its light that the surface it left
    // sends on.
    glm::vec3 factor{1.0f};
};

struct RayNode {
    static constexpr int kNone = -1;

    RayKind kind = RayKind::Camera;
    RayEnd end = RayEnd::Continues;
    int parent = kNone;                      // index of RayTree::nodes(); cameras have none
    int depth = 0;                           // reflections and refractions before it
    glm::vec3 origin{0.0f}, direction{0.0f}; // world, metres; unit
    // What it met; of a shadow ray what is in the way first, or the light itself.
    bool hit = false;
    glm::vec3 position{0.0f}, normal{0.0f}; // world; normal of shading, unit, towards the ray
    float distance = 0.0f;                  // metres; infinite: met nothing
    Id mesh = 0, material = 0;              // of what was met
    // Shadow rays: the light it goes to, or 0 and the mesh that glows.
    Id light = 0, glowing = 0;
    glm::vec3 passes{1.0f}; // and what of its light comes through glass on the way
    // Share of the light that comes along the ray, from its far end, that reaches the sample.
    glm::vec3 weight{1.0f};
    // Light that this node itself adds to its sample: emission and ambient light of the surface
    // that was met, the background, or of a shadow ray what the surface reflects of the light.
    glm::vec3 contribution{0.0f};
    RayTerms terms;
    // Snell's law at the surface that was met; 0: it does not refract.
    float cosIncident = 0.0f, etaRatio = 0.0f; // etaRatio: index before over index behind
    bool totalReflection = false;
    // Camera rays: where in the pixel, in [0, 1]² from its upper left corner, and the share of the
    // sample in the pixel.
    glm::vec2 at{0.0f};
    double share = 1.0;
};

class RayTree {
  public:
    // In the order in which they were cast; a node comes after its parent.
    [[nodiscard]] std::span<const RayNode> nodes() const { return m_nodes; }
    [[nodiscard]] bool empty() const { return m_nodes.empty(); }
    [[nodiscard]] std::size_t sampleCount() const { return m_samples; }

    // What the film has for the pixel, to the last bit: within each sample contributions add up in
    // the order of the nodes, in double precision, and are rounded to a float; samples add up by
    // their shares, and the pixel is rounded again.
    [[nodiscard]] glm::vec3 radiance() const;
    // Of each node: its own contribution and those of all below it, times the sample's share.
    [[nodiscard]] std::vector<glm::vec3> subtotals() const;

    int add(const RayNode& node);
    [[nodiscard]] RayNode& at(int node) { return m_nodes[static_cast<std::size_t>(node)]; }
    // Samples whose shares are counts: the mean is over this number of them; 0: shares are shares.
    void setMean(std::uint32_t samples) { m_mean = samples; }

  private:
    std::vector<RayNode> m_nodes;
    std::size_t m_samples = 0;
    std::uint32_t m_mean = 0;
};

} // namespace patina
