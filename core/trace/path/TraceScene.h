// A scene as path tracers and ray tracers see it: a snapshot, ready for rays from any thread. Light
// is in the world's metres, the hierarchy in scene units (core/trace/BakeGeometry.h).
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeScene.h"
#include "core/trace/path/EmissiveTriangles.h"
#include "core/trace/path/EnvironmentSampler.h"
#include "core/trace/path/Glass.h"
#include "core/trace/path/GlassAlbedo.h"
#include "core/trace/path/LightSampler.h"
#include "core/trace/path/TraceInputs.h"
#include "core/trace/path/TraceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

// A place on a surface, seen from the side that a ray came from.
struct TracePoint {
    glm::vec3 position{0.0f}; // scene units
    glm::vec3 face{0.0f};     // unit: the triangle's normal, on the side of the ray
    glm::vec3 normal{0.0f};   // unit: as the surface shader has it
    glm::vec2 uv{0.0f};
    const TraceMaterial* material = nullptr;
    std::uint32_t mesh = 0, triangle = 0;
    bool isBack = false; // of the triangle

    // Backs of surfaces that have only a front are not there for the camera, and absorb.
    [[nodiscard]] bool hasSurface() const {
        return !isBack || material->doubleSided() || material->transmits();
    }
    // Such a back does not glow either.
    [[nodiscard]] glm::vec3 emission() const {
        return isBack && !material->doubleSided() ? glm::vec3(0.0f) : material->emissionAt(uv);
    }
};

// A surface as a mixture: a share of it is glass, and the rest reflects.
struct TraceSurface {
    shading::SurfaceTerms opaque{}; // what is not glass; of glass alone: unused
    GlassTerms glass{};             // where there is a share
    float glassShare = 0.0f;        // 0…1
    float ior = 1.5f;               // of the glass
};

class TraceScene {
  public:
    // Errors: those of BakeScene::build(), but for a scene without triangles, which has only its
    // environment.
    // What `previous` has of the same geometry, environments and lobe is used by both.
    static Result<TraceScene> build(const TraceInputs& inputs, const JobContext& job,
                                    const TraceScene* previous = nullptr);
    [[nodiscard]] const TraceInputs& inputs() const { return m_inputs; } // what it was built from

    // A ray in scene units from `origin` along a unit vector, and what it meets first. Its distance
    // is in closest.ray.maxDistance.
    [[nodiscard]] ClosestRay closest(const glm::vec3& origin, const glm::vec3& direction) const;
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction,
                                float distance) const; // scene units, may be infinite
    [[nodiscard]] TracePoint pointAt(const ClosestRay& hit) const;
    // Of an emissive triangle at barycentric weights, seen from its front; normal: its face.
    [[nodiscard]] TracePoint pointAt(const EmissiveTriangles::Triangle& triangle,
                                     const glm::vec2& weights) const;
    // Of a triangle of geometry(), seen from its front.
    [[nodiscard]] TracePoint pointAt(std::uint32_t mesh, std::uint32_t triangle,
                                     const glm::vec2& weights) const {
        return pointAt(mesh, triangle, weights, nullptr);
    }
    // Clear of the surface, on the side of the face or behind it.
    [[nodiscard]] static glm::vec3 origin(const TracePoint& point, bool behind = false) {
        return point.position + (behind ? -kRayOffset : kRayOffset) * point.face;
    }

    // Material::id of what covers a mesh; TracePoint::mesh.
    [[nodiscard]] Id materialOf(std::uint32_t mesh) const {
        return m_inputs.materials[m_instances[mesh].material].id;
    }
    // TraceMesh::id.
    [[nodiscard]] Id meshId(std::uint32_t mesh) const { return m_scene->geometry->meshes[mesh].id; }

    // (scale, bias) of the model's lobe, as the viewport looks them up.
    [[nodiscard]] shading::SurfaceTerms surface(const TracePoint& point, const glm::vec3& v) const;

    // Where the viewport looks image-based light up for its specular lobe; unit.
    [[nodiscard]] glm::vec3 lobeDirection(const shading::SurfaceTerms& terms) const;

    // The same as a mixture, for a path: `media` are those on the viewer's side.
    [[nodiscard]] TraceSurface surfaceIn(const TracePoint& point, const glm::vec3& v,
                                         const Media& media) const;
    // Refractive index, where the shading model has one for all, too.
    [[nodiscard]] float indexOf(const TraceMaterial& material) const;
    // What paths through this scene cannot show, as a sentence for the user.
    [[nodiscard]] std::optional<std::string> limit() const;
    // Somewhere a sheet is smooth glass, or a body has the index of air: rays to lights go on.
    [[nodiscard]] bool hasStraightGlass() const { return m_hasStraightGlass; }

    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& scenePoint) const;
    [[nodiscard]] glm::vec3 toScene(const glm::dvec3& worldPoint) const;
    [[nodiscard]] float metres(float sceneUnits) const { return sceneUnits * m_metresPerUnit; }
    [[nodiscard]] float sceneUnits(float metres) const { return metres / m_metresPerUnit; }

    // All environments together. Sums of what each sends.
    [[nodiscard]] glm::vec3 environmentRadiance(const glm::vec3& direction) const;
    [[nodiscard]] glm::vec3 meanEnvironment() const; // over all directions
    [[nodiscard]] EnvironmentSampler::Sample sampleEnvironment(glm::vec2 u) const;
    [[nodiscard]] float environmentPdf(const glm::vec3& direction) const;
    // The same at less cost: in steps, with EnvironmentSampler's in between; radiance and density
    // of one direction.
    [[nodiscard]] EnvironmentSampler::Search searchEnvironment(glm::vec2 u) const;
    [[nodiscard]] EnvironmentSampler::Sample endOf(const EnvironmentSampler::Search& search) const;
    [[nodiscard]] EnvironmentSampler::Lookup lookUpEnvironment(const glm::vec3& direction) const;
    [[nodiscard]] bool hasEnvironment() const { return m_environmentPower > 0.0; }
    [[nodiscard]] const LightSampler& lights() const { return m_lights; }
    [[nodiscard]] const EmissiveTriangles& emissive() const { return m_emissive; }
    // Share of an emissive surface that is there, and so of its light: what rays of a path do not
    // meet where it is cut out or blended, rays to it must not find either.
    [[nodiscard]] float solidShare(const TracePoint& emissive) const {
        const Instance& instance = m_instances[emissive.mesh];
        return instance.coverage ? instance.coverage->solidShareAt(emissive.uv) : 1.0f;
    }
    [[nodiscard]] bool isEmpty() const { return !m_scene; }
    // Its triangles; null: none.
    [[nodiscard]] const BakeGeometry* geometry() const {
        return m_scene ? m_scene->geometry.get() : nullptr;
    }
    // For who casts many rays at a time; null: no triangles.
    [[nodiscard]] const RayScene* rays() const { return m_scene ? &m_scene->rays : nullptr; }

  private:
    TraceScene() = default;
    Result<void> buildGeometry(const JobContext& job, const TraceScene* previous);
    [[nodiscard]] TracePoint pointAt(std::uint32_t mesh, std::uint32_t triangle,
                                     const glm::vec2& weights, const glm::vec3* direction) const;
    [[nodiscard]] glm::vec3 dfg(float NoV, float perceptualRoughness) const;
    [[nodiscard]] GlassTerms glassTerms(const TracePoint& point, const glm::vec3& v,
                                        const shading::SurfaceInputs& inputs, const Media& media,
                                        float ior) const;
    void collectEmissive();
    void collectGlass(const TraceScene* previous);

    TraceInputs m_inputs;
    std::shared_ptr<const BakeScene> m_scene; // null: no triangles
    struct Instance {
        std::size_t material = 0;
        glm::mat3 linear{1.0f}; // of the transform, for tangents
        float handedness = 1.0f;
        std::shared_ptr<const Coverage> coverage; // of what is emissive and not opaque
    };
    std::vector<Instance> m_instances; // of m_scene's meshes
    std::vector<TraceMaterial> m_materials;
    std::vector<std::shared_ptr<const EnvironmentSampler>> m_environments;
    double m_environmentPower = 0.0;
    LightSampler m_lights{{}};
    EmissiveTriangles m_emissive;
    shading::BrdfModel m_model{};
    std::shared_ptr<const std::vector<glm::vec3>> m_dfg; // computeDfgTable()
    struct GlassTable {
        float eta = 1.5f;
        bool thinWalled = false;
        std::shared_ptr<const GlassAlbedo> albedo;
    };
    std::vector<GlassTable> m_glassTables; // of rough glass
    bool m_hasStraightGlass = false, m_hasSolidGlass = false;
    float m_metresPerUnit = 1.0f;
    glm::dvec3 m_centre{0.0};
};

} // namespace patina
